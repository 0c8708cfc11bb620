// What was asked, and where the numbers come from.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "studies/results/fields.hpp"

namespace gamut {

enum class ShapeKind : unsigned char { distribution, membership };
template <>
inline constexpr std::array<std::string_view, 2> words<ShapeKind>{"distribution", "membership"};

/// One uncertain quantity as the study states it.
struct UncertainInfo {
  std::string name, quantity, unit;
  double lower = 0, nominal = 0, upper = 0;
  std::string distribution, membership;  ///< by name: "uniform", "triangular", …
  /// By how much the probability of an event exceeds its possibility, at most, as a bound that is up to 1/256 too
  /// great; 0 of what varies in time, which has neither.
  double inconsistency = 0;
  std::string told = {};    ///< unit in which people are told of it, as the study states it; empty: the SI unit
  std::string stated = {};  ///< the interval as the study writes it: "± 2 %"; empty where it follows from shapes

  const std::string& shape(ShapeKind kind) const { return kind == ShapeKind::distribution ? distribution : membership; }
};

/// One of the numbers that a distribution or a membership function is made of.
struct ShapeInfo {
  std::string quantity;  ///< name of the uncertain quantity
  ShapeKind shape = ShapeKind::distribution;
  std::string name;  ///< of the number: "lower", "upper", "mode", …
  double value = 0;
  std::string unit;
};

struct OutputInfo {
  std::string name, quantity, unit;
  double resolution = 0;  ///< in its unit: differences up to this count for nothing
  double tightness = std::numeric_limits<double>::quiet_NaN();  ///< that was asked for; NaN: as of all others
};

struct LibraryInfo {
  std::string name, version;
};

/// What a run was allowed to spend: CPU time of all threads, s, and memory, bytes.
struct Limits {
  double time = std::numeric_limits<double>::infinity(), memory = time;                    ///< of the whole run
  double enclosureTime = std::numeric_limits<double>::infinity(), enclosureMemory = time;  ///< of the guarantee
  double sampleTime = std::numeric_limits<double>::infinity();                             ///< of each sample
};

/// Samples that were added later. All were taken then, those that there had been once more.
struct ExtensionInfo {
  std::int64_t before = 0;  ///< samples of the plan that there had been
  std::string version, host, date;
  double cpu = 0;                         ///< s
  double timeLimit = 0, memoryLimit = 0;  ///< of the extension: s of CPU, bytes
};

/// What was spent on something that is no answer of its own.
struct CostInfo {
  std::string what;  ///< "requirements"
  double cpu = 0;    ///< s
};

/// How `stopped` begins where the program itself is to blame.
inline constexpr std::string_view internalFailure = "an internal failure: ";

struct Origin {
  std::string studyText, robotText, tablesText, studyFile, title, analysis;  ///< tablesText: NamedTexts in one
  std::uint64_t seed = 0;
  std::string version, host, date;
  std::vector<LibraryInfo> libraries;
  std::vector<ExtensionInfo> extensions;  ///< one after the other
  std::vector<UncertainInfo> uncertain;
  std::vector<ShapeInfo> shapes;  ///< of all of them
  std::vector<OutputInfo> outputs;
  std::string dependence;    ///< of the uncertain quantities, in words, and whether several distributions are
                             ///< possible; empty where they are independent
  std::string assumptions;   ///< on which all answers rest, but which cannot be proved; empty where there are none
  std::string assembly;      ///< where loops close at the nominal start; empty where there are none
  double horizon = 0;        ///< s
  std::vector<double> time;  ///< output times, s
  Limits limits;
  std::vector<CostInfo> costs;  ///< of `cpu`, beside what the answers took
  double cpu = 0;               ///< s, of all analyses
  double memory = 0;            ///< bytes: the most that the process had at a time
  /// What kept the run from doing all that it could: an interrupt, the first limit of time or memory that it reached,
  /// or an internal failure; empty if nothing did.
  std::string stopped;
};

/// Adds to the cost of this, or begins with it.
void addCost(Origin& origin, std::string_view what, double cpu);

/// By what the samples were taken: "Gamut 1.2.3 on hostname".
std::string takerOfSamples(const Origin& origin);

/// Adds the groups of this part.
void describe(Origin& origin, std::vector<Group>& groups);

}  // namespace gamut
