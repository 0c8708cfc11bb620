// What a run consists of: one unit an analysis, each from the study and what the units before it found to its part of
// the results. A unit that the study does not ask for does nothing.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analyses/comparison/comparison.hpp"
#include "analyses/probability/joint_masses.hpp"
#include "analyses/samples/ensemble.hpp"
#include "analyses/samples/first_order.hpp"
#include "analyses/work.hpp"
#include "studies/machine.hpp"
#include "studies/results/results.hpp"
#include "studies/running/former_samples.hpp"
#include "studies/running/picture_programs.hpp"
#include "studies/running/run.hpp"
#include "studies/running/violations.hpp"
#include "studies/watch.hpp"

namespace gamut {

/// What is proved about the whole box and about the boxes of the alpha-cuts, of one flow or one image.
struct Enclosed {
  Bounds at, over, direct;   ///< as in IntervalResult
  std::vector<Bounds> cuts;  ///< one a level; none unless alpha-cuts are asked for
  std::size_t reachedTimes = 0;
  double reached = 0;  ///< s
  std::string why;     ///< why it ended before the horizon; empty if it did not
  double tightness = std::numeric_limits<double>::quiet_NaN();  ///< as in IntervalResult
  std::string shortfall, advice;
  FlowCause cause;                ///< of an early end
  std::vector<double> nonlinear;  ///< Tube::nonlinear
  std::int64_t pieces = 0, steps = 0;
  double cpu = 0, cutCpu = 0;  ///< s: of all, and of the alpha-cuts
  /// Of the requirements' margins, and, where distributions are asked for, of all other outputs behind them.
  std::shared_ptr<const FlowModels> models;
  std::vector<std::vector<OutputExtremes>> extremes;  ///< [time][output], as in Tube; none of some times
  double modelTightness = 0;                          ///< that the models' flow was to have; 0: that of the study
};

/// An output as the first samples show it.
struct OutputScale {
  double size = 0, span = 0;  ///< the greatest that it is; the farthest that samples are apart at one time
  bool vanishes = false;      ///< it is zero but for roundings and the samples' errors
  bool isSteady = false;      ///< nothing that is uncertain moves it by more than these

  /// Nothing is to be compared.
  bool isNothing() const { return vanishes || isSteady; }
};

/// Work (analyses/work.hpp) that was done for each.
struct Spent {
  double enclosure = 0, samples = 0, cuts = 0, requirements = 0, probabilities = 0;
  bool isAll = false;  ///< a tighter flow found too little left
};

/// One run on its way.
struct Run {
  Run(const Machine& whatMoves, const RunOptions& howToRun);
  /// One that goes on from what is there.
  Run(const Machine& whatMoves, const RunOptions& howToRun, Results found);

  Bounds emptyBounds() const { return {study.times.size(), study.outputs.size()}; }
  /// What tells the user how far a task is.
  std::function<void(double)> progressOf(const std::string& task) const;

  const Machine& machine;
  const Study& study;  ///< the machine's
  const RunOptions& options;
  Watch watch;
  UncertainMotion motion;  ///< the machine's, with switching courses that the run finds
  Results results;
  Spent spent;                           ///< by the units, as they end
  Seen seen;                             ///< filled by `lookAtMachine`
  Enclosed enclosed;                     ///< filled by `enclose`
  std::vector<OutputScale> scales;       ///< filled by `takeFirstSamples`; empty where samples do not show them
  std::vector<Suspects> suspects;        ///< of each requirement
  std::vector<FirstOrder> worstMargins;  ///< of each requirement, by the first samples of the plan
  std::optional<JointMasses> masses;     ///< of the quantities in the symbols of models; by `jointMasses`
  std::vector<FlowSymbol> symbols;       ///< those symbols
  std::string failure;                   ///< of the program itself, behind what was proved; empty if there was none
  std::optional<FormerSamples> former;   ///< that are to come again; none unless the run goes on from others
  std::optional<EnsembleRun> ensemble;   ///< there from `takeFirstSamples` on, unless it found no room
};

// Units, in the list below behind what they need. An analysis of its own files (studies/analysis.hpp) needs none.

/// The machine's parts and its nominal motion, for the picture; what is seen of it is known from then on.
void lookAtMachine(Run& run);
/// A first block, before the enclosure, so that one that ends early has something to be compared with.
void takeFirstSamples(Run& run);
/// The flow, or the image, that all proved bounds come from.
void enclose(Run& run);
void guarantee(Run& run);
void findPossibilities(Run& run);
/// Settles what leaves the proved bounds, then counts it.
void takeOtherSamples(Run& run);
/// What kept all units before from doing what they could.
void noteStop(Run& run);
void compareAnswers(Run& run);
/// What is asked of the motion; then, of each requirement, how many samples meet it, and what is proved.
void stateRequirements(Run& run);
void countRequirements(Run& run);
/// How probable it is that those are met whose windows last longer than anything is proved: by independent samples.
void estimateRequirements(Run& run);
/// Where the enclosure ended early: what would have let it come to the horizon, tried.
void seekAdvice(Run& run);
void checkRequirements(Run& run);
/// Where nothing was proved, but a sample violates a requirement: proves that it does.
void refuteRequirements(Run& run);
/// How probable values of the outputs are, and whose doing their variance is; then the samples' shares beside that.
void boundProbabilities(Run& run);
void compareShares(Run& run);
/// Analyses of their own files, where they are asked for.
void findFurther(Run& run);
/// A few of them, for the picture.
void showSamples(Run& run);

/// All units, in the order in which they run.
inline constexpr void (*units[])(Run&) = {stateRequirements, lookAtMachine,     takeFirstSamples,
                                          enclose,           guarantee,         findPossibilities,
                                          takeOtherSamples,  countRequirements, estimateRequirements,
                                          seekAdvice,        checkRequirements, boundProbabilities,
                                          compareShares,     findFurther,       noteStop,
                                          compareAnswers,    showSamples};

/// Those that samples ask for, where all else is there.
inline constexpr void (*unitsOfSamples[])(Run&) = {
    takeFirstSamples,   takeOtherSamples, countRequirements, estimateRequirements,
    refuteRequirements, compareShares,    noteStop,          compareAnswers};

/// Of the study's enclosure, as far as it decides how far that comes: without progress, models and alpha-cuts.
FlowOptions enclosureOptions(const Run& run);

/// Seeks worst courses of what varies in time, and lets samples follow them; into the results too, by their order. The
/// values of these samples.
std::vector<std::vector<double>> takeWorstCourses(Run& run);

/// What the first samples show of the outputs: sizes that are to be compared with; up to the horizon or not at all.
std::vector<OutputScale> scalesOf(const Run& run);

/// The output times at which it is asked where outputs are extreme, rising.
std::vector<std::size_t> rowsOfExtremes(const Study& study);
/// Values of the uncertain quantities where the enclosure's polynomials tell that outputs are extreme, at some times,
/// and corners come least near; hardly two alike.
std::vector<std::vector<double>> extremePoints(const Run& run);

/// Differences of an output up to this count for nothing: what was stated, and a millionth of what samples span.
std::vector<double> floorsOf(const Run& run);

/// Where points certainly are, by the flow's tube, or, where nothing moves, by the image of the box.
void enclosePlaces(Run& run, const Tube& tube);
void enclosePlaces(Run& run);

/// The joint distribution of the quantities that are constant, in these symbols of theirs: until it is asked for with
/// others.
const JointMasses& jointMasses(Run& run, int symbols, const std::vector<FlowSymbol>& quantities);

/// Whether all that is constant is independent, and of known distributions.
bool isPlain(const Study& study);

/// The output times, rising, at which these are bounded.
std::vector<std::size_t> distributionRows(const Study& study);

/// Whether probabilities of the outputs' values are to be bounded.
bool asksForDistributions(const Study& study);

/// Bytes that models of outputs may take, but at the times of distributions: of more output times there are fewer.
inline constexpr double mostModelBytes = 1.28e8;

/// What a flow may keep of the outputs, and when first of all.
void boundModels(const Run& run, FlowOptions& options);

/// Other models of margins and, where distributions are asked for, of all outputs, by a flow that is to be so tight,
/// with at most so much work, in steps no longer than that (s). They take the place of those that there are. False if
/// it comes less far than these, or that is not worth the try.
bool tightenModels(Run& run, double tightness, double work, double longestStep, const char* task);

/// So much work may still be done for requirements, or for probabilities: their share of what enclosure and samples
/// took, and what answers before them have left. Counted, so that it is the same in every run.
double workForRequirements(const Run& run);
double workForProbabilities(const Run& run);

/// While it lives, the work of this thread, and of those that it waits for, counts as spent there.
class Spending {
 public:
  explicit Spending(double& on) : on_(on) {}
  ~Spending() { on_ += static_cast<double>(Work::counted() - began_); }
  Spending(const Spending&) = delete;
  Spending& operator=(const Spending&) = delete;

 private:
  double& on_;
  const std::uint64_t began_ = Work::counted();
};

/// Counts a block of samples that are settled.
void noteRequirements(Run& run, const SampleBlock& block);

/// Takes what a comparison with an alpha-cut found, or, level -1, with the enclosure.
void takeDisputes(Run& run, const Comparison& found, int level);

}  // namespace gamut
