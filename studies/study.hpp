// A Study is what a user asks: a mechanism, what of it is uncertain, which outputs are wanted when, by which analyses.
// It is read from a TOML file (docs/study-file.md); whatever is wrong there is said with file, line and column.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "analyses/dependence.hpp"
#include "analyses/flow/flow.hpp"
#include "analyses/samples/ensemble.hpp"
#include "analyses/uncertainty.hpp"
#include "mechanics/description/mechanism.hpp"
#include "mechanics/element_types.hpp"
#include "studies/analysis.hpp"
#include "studies/demand.hpp"
#include "studies/named_texts.hpp"
#include "studies/results/origin.hpp"
#include "studies/watch.hpp"

namespace gamut {

/// Something is wrong with a study file; what() is one line "file:line:column: what is wrong; what was expected".
class StudyError : public std::runtime_error {
 public:
  /// `place`: of a file, "file:line:column".
  StudyError(std::string place, std::string problem, std::string expected);
  const std::string& place() const { return place_; }
  const std::string& problem() const { return problem_; }
  const std::string& expected() const { return expected_; }

 private:
  std::string place_, problem_, expected_;
};

/// An uncertain number of the mechanism: one of Mechanism::quantities().
struct UncertainQuantity {
  std::string quantity, unit;
  Uncertain uncertain;
  bool varies = false;                                    ///< in time; else it is constant
  double rate = std::numeric_limits<double>::infinity();  ///< of what varies, at most, in its unit per s
  std::string told = {};                                  ///< unit in which it is stated; empty: the SI unit
  std::string stated = {};                                ///< its interval, as it is written; empty: it follows
};

/// An output as it is asked for.
struct WantedOutput : OutputInfo {
  Expression expression = 0.0;  ///< in SI units

  Expression inUnit() const;
};

/// What the motion is to keep. The margins of its terms are outputs, one behind the other.
struct Requirement {
  std::string name;
  std::string statement;  ///< "always tip.position.z > 0.2 m"
  Demand demand;
  std::size_t firstMargin = 0;  ///< number of the output that is the first term's margin

  std::size_t margins() const { return demand.terms.size(); }
  /// Numbers of the outputs that its margins are.
  auto marginOutputs() const { return std::views::iota(firstMargin, firstMargin + margins()); }
};

/// Of which output times probabilities of the outputs' values are bounded, and how closely.
struct DistributionPlan {
  double gap = 0.005;         ///< between the bounds, aimed at
  std::size_t count = 10;     ///< of output times, spread evenly behind the start, if they are not stated; 0: none
  std::vector<double> times;  ///< s: output times, rising
  double storage = 8e6;       ///< bytes that the outputs' polynomials may take in the results
};

/// What is found out of enclosure and samples may cost so many times what these cost, in work (analyses/work.hpp), or
/// what they would have cost in `least` seconds on the machine on which work was measured. What one leaves, the next
/// has.
struct Shares {
  static constexpr double least = 2.5;
  double cuts = 0.5;           ///< own flows of alpha-cuts
  double requirements = 0.8;   ///< but for single violations
  double probabilities = 0.7;  ///< bounds of distributions, Sobol' indices, polynomials of outputs
  double advice = 1;           ///< trials of what would help, where the enclosure ended early; apart from the others
  double derivatives = 20;     ///< apart from the others; of the enclosure alone, or of a second
};

/// Where in the study's file things stand: "file:line:column".
struct StudyPlaces {
  /// A number of the mechanism that is a formula.
  struct Formula {
    std::string name, place;
    Expression number;
  };

  std::string mechanism;
  std::map<std::string, std::string> named;  ///< numbers, parameters and elements of the mechanism
  std::vector<Formula> formulas;             ///< in the order of the file
  std::vector<std::string> outputs;          ///< of each

  /// Where this is given, or that of which it is: "arm" for "arm.mass".
  const std::string& of(std::string name) const;
};

/// The words of a study. What they describe moves as a Machine.
struct Study {
  enum class Analysis { kinematics, equilibria, dynamics, inverseDynamics };

  std::string text;   ///< of the file, word for word
  std::string file;   ///< as it was named
  std::string robot;  ///< text of the robot's file that it names (textOfRobot); empty without one
  NamedTexts tables;  ///< of the CSV files that it names, word for word, by these names
  std::string title;
  Analysis analysis = Analysis::dynamics;
  double horizon = 0;         ///< s; 0 where no time passes
  std::vector<double> times;  ///< the output times, s, 0 first, rising, the horizon last
  std::set<std::string, std::less<>> compare{"fuzzy", "interval", "stochastic"};  ///< words of the answers asked for
  Mechanism mechanism;
  std::map<std::string, std::string, std::less<>> units;  ///< in which numbers of the mechanism are stated, by name
  std::vector<UncertainQuantity> uncertain;
  QuantityDependence dependence;      ///< of these
  std::vector<WantedOutput> outputs;  ///< those of the requirements behind all others
  std::vector<Requirement> requirements;
  DistributionPlan distribution;
  std::vector<Boxed<FurtherAnalysis>> analyses = made(analysisTypes());  ///< that it may ask for besides
  FlowOptions flow;          ///< without jobs, progress and cancelled, which belong to a run
  EnsembleOptions ensemble;  ///< likewise
  double storage = 4e6;      ///< bytes that the samples' values and motions may take in the results
  int levels = 11;           ///< of alpha, from 0 to 1: levelOf(0, levels) …
  StatedLimits limits;
  Shares shares;
  StudyPlaces places;
  std::vector<std::string> notes;  ///< what may be a mistake: lines "file:line:column: note: what"

  /// Whether it asks for this answer: `asksFor<IntervalResult>()`.
  template <class A>
  bool asksFor() const {
    return compare.contains(A::name);
  }

  /// In which people are told of a number of the mechanism that is in the unit `own`: its own unit as it is stated or
  /// looked at, else that in which most of its kind are stated.
  std::string unitTold(const std::string& number, const std::string& own) const;

  /// Its word in files.
  std::string analysisName() const {
    return analysis == Analysis::kinematics   ? "kinematics"
           : analysis == Analysis::equilibria ? "equilibria"
           : analysis == Analysis::dynamics   ? "dynamics"
                                              : "inverse-dynamics";
  }
  /// Time passes.
  bool moves() const { return analysis != Analysis::kinematics && analysis != Analysis::equilibria; }
  /// Time passes, but the motion is given: it has no states.
  bool isMotionGiven() const { return moves() && mechanism.stateNames().empty(); }
};

/// The membership of one of so many levels.
constexpr double levelOf(int level, int levels) { return static_cast<double>(level) / (levels - 1); }

/// The greatest number of output times of a study.
inline constexpr std::size_t maxOutputTimes = 100000;

/// Reads and checks a study file, whose elements are of these types; own ones may be added to elementTypes(). Throws
/// StudyError.
Study readStudy(const std::string& path, const std::vector<Described>& types = elementTypes());

/// What stands in the files that a study names.
struct FilesAtHand {
  std::string robot;
  NamedTexts tables;
};

/// The same for text at hand; `name` is what messages call the file, and where paths of other files begin; with
/// `files`, none of them is looked for. Distributions, memberships and analyses are of these, to which own ones may be
/// added.
Study readStudyText(const std::string& text, const std::string& name,
                    const std::vector<Described>& types = elementTypes(), const std::optional<FilesAtHand>& files = {},
                    const ShapeTypes& shapes = {}, const std::vector<AnalysisType>& analyses = analysisTypes());

/// The mechanism of a study alone, by which a study may begin: of the rest, no more is asked than that it is TOML.
Mechanism readMechanismText(const std::string& text, const std::string& name,
                            const std::vector<Described>& types = elementTypes());

/// The text of a study file. Throws StudyError if it cannot be read.
std::string textOfStudy(const std::string& path);

}  // namespace gamut
