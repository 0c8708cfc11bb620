// The units of a run: each says in its arguments what it needs, and gives what it finds to those behind it. What the
// study does not ask for, they do not do. `run` (run.cpp) calls all but one of them, `extend` those that samples ask
// for.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analyses/comparison/comparison.hpp"
#include "analyses/flow/tightened_models.hpp"
#include "analyses/probability/model_masses.hpp"
#include "analyses/samples/ensemble.hpp"
#include "analyses/samples/first_order.hpp"
#include "studies/running/context.hpp"
#include "studies/running/former_samples.hpp"
#include "studies/running/picture_programs.hpp"
#include "studies/running/violations.hpp"

namespace gamut {

/// An output as the first samples show it.
struct OutputScale {
  double size = 0, span = 0;  ///< the greatest that it is; the farthest that samples are apart at one time
  bool vanishes = false;      ///< it is zero but for roundings and the samples' errors
  bool isSteady = false;      ///< nothing that is uncertain moves it by more than these

  /// Nothing is to be compared.
  bool isNothing() const { return vanishes || isSteady; }
};

/// One an output; none where samples do not show them.
using OutputScales = std::vector<OutputScale>;

/// The samples on their way, and what they show besides their part of the results.
struct SampledMotion {
  explicit SampledMotion(const Machine& machine)
      : motion(machine.motion),
        suspects(machine.study.requirements.size()),
        worstMargins(machine.study.requirements.size(), FirstOrder(motion.uncertain)) {}

  UncertainMotion motion;  ///< the machine's, with switching courses as they are found
  OutputScales scales;
  std::vector<Suspects> suspects;        ///< of each requirement
  std::vector<FirstOrder> worstMargins;  ///< of each requirement, by the first samples of the plan
  std::optional<FormerSamples> former;   ///< that are to come again; none unless the run goes on from others
  std::optional<EnsembleRun> ensemble;   ///< there once the first are taken, unless it found no room
};

/// What one flow, or one image, proved of the whole box and of the boxes of the alpha-cuts, besides its parts of the
/// results.
struct Enclosure {
  std::size_t reachedTimes = 0;
  double reached = 0;             ///< s
  std::string why, advice;        ///< of an early end, or of what is loose
  FlowCause cause;                ///< of an early end
  std::vector<double> nonlinear;  ///< Tube::nonlinear
  TightenedModels models;         ///< of the margins, and, where distributions are asked for, of all other outputs
  std::vector<std::vector<OutputExtremes>> extremes;       ///< [time][output], as in Tube; none of some times
  std::vector<std::vector<OutputExtremes>> levelExtremes;  ///< [alpha-cut][output], as in Image
};

// In the order in which they run.

/// What is asked of the motion.
void stateRequirements(const Study& study, Results& results);
/// The machine's parts and its nominal motion, for the picture.
Seen lookAtMachine(Run& run, PictureResult& picture);
/// A first block, before the enclosure, so that one that ends early has something to be compared with.
void takeFirstSamples(Run& run, SampledMotion& samples, Results& results);
/// The flow, or the image, that all proved bounds come from: what is guaranteed and what is possible, and where points
/// certainly are.
Enclosure enclose(Run& run, const Seen& seen, const OutputScales& scales, Results& results);
/// Settles what leaves the proved bounds, then counts it.
void takeOtherSamples(Run& run, const Enclosure& enclosure, SampledMotion& samples, Results& results);
/// Of each requirement, how many samples meet it.
void countRequirements(const Study& study, Results& results);
/// How probable it is that those are met whose windows last longer than anything is proved: by independent samples.
void estimateRequirements(Run& run, std::size_t reachedTimes, SampledMotion& samples, Results& results);
/// Where the enclosure ended early: what would have let it come to the horizon, tried.
void seekAdvice(Run& run, const OutputScales& scales, Enclosure& enclosure, Results& results);
/// Of each requirement, what is proved.
void checkRequirements(Run& run, const SampledMotion& samples, Enclosure& enclosure, ModelMasses& masses,
                       Results& results);
/// Where nothing was proved, but a sample violates a requirement: proves that it does. Of an extension, for
/// checkRequirements proves that too.
void refuteRequirements(Run& run, const SampledMotion& samples, Results& results);
/// How probable values of the outputs are, and whose doing their variance is. Nobody needs the models any more.
void boundProbabilities(Run& run, const OutputScales& scales, Enclosure& enclosure, ModelMasses& masses,
                        Results& results);
/// The samples' shares beside that.
void compareShares(const Study& study, const SampledMotion& samples, Results& results);
/// Analyses of their own files, where they are asked for.
void findFurther(Run& run, Results& results);
/// What kept all units before from doing what they could; `failure`: of the program itself, if there was one.
void noteStop(const Run& run, const std::string& failure, Results& results);
/// How the answers agree.
void compareAnswers(const Run& run, std::size_t reachedTimes, const SampledMotion& samples, Results& results);
/// A few samples, for the picture.
void showSamples(Run& run, const Seen& seen, const std::string& whyEnclosureEnded, const UncertainMotion& motion,
                 Results& results);

// What several of them need.

/// Of the study's enclosure, as far as it decides how far that comes: without progress, models and alpha-cuts.
FlowOptions enclosureOptions(const Run& run, const OutputScales& scales);
/// A flow of the margins alone, or of all outputs; empty where nothing moves.
TightenedModels::Enclose tighterFlow(const Run& run);
/// How the study's samples are integrated in this run.
EnsembleOptions ensembleOptions(const Run& run, const Results& results);
/// What a flow may keep of the outputs, and when first of all.
void boundModels(const Run& run, FlowOptions& options);
/// Of flows that tighten its models.
FlowOptions tighterOptions(const Run& run, double longestStep, const char* task);

/// Worst courses of what varies in time, sought, which samples then follow; into the results too, by their order. The
/// values of these samples.
std::vector<std::vector<double>> takeWorstCourses(const Run& run, const OutputScales& scales, UncertainMotion& motion,
                                                  SwitchingResult& found);

/// What the first samples show of the outputs: sizes that are to be compared with; up to the horizon or not at all.
OutputScales scalesOf(const Run& run, const UncertainMotion& motion, const EnsembleRun& ensemble);
/// Differences of an output up to this count for nothing: what was stated, and a millionth of what samples span.
std::vector<double> floorsOf(const Study& study, const OutputScales& scales);

/// The output times at which it is asked where outputs are extreme, rising.
std::vector<std::size_t> rowsOfExtremes(const Study& study);
/// Values of the uncertain quantities where the enclosure's polynomials tell that outputs are extreme, at some times,
/// and corners come least near; hardly two alike.
std::vector<std::vector<double>> extremePoints(const Study& study, const Enclosure& enclosure,
                                               const SampledMotion& samples);

/// Where points certainly are, by the flow's tube, or, where nothing moves, by the image of the box.
void enclosePlaces(const Run& run, const Seen& seen, const Tube& tube, Places& places);
void enclosePlaces(const Run& run, const Seen& seen, Places& places);

/// What is possible, of cuts that the image bounds: narrowed by fuzzy numbers that move the assembly.
void narrowByAssembly(Run& run, FuzzyResult& fuzzy);

/// The joint distribution of the quantities that are constant.
ModelMasses massesOf(const Machine& machine);
/// Whether all that is constant is independent, and of known distributions.
bool isPlain(const Study& study);
/// The output times, rising, at which outputs' distributions are bounded.
std::vector<std::size_t> distributionRows(const Study& study);
/// Whether probabilities of the outputs' values are to be bounded.
bool asksForDistributions(const Study& study);

/// Counts a block of samples that are settled.
void noteRequirements(const Run& run, const SampleBlock& block, SampledMotion& samples, Results& results);
/// Takes what a comparison with an alpha-cut found, or, level -1, with the enclosure.
void takeDisputes(const Watch& watch, const Comparison& found, int level, ComparisonResult& comparison);

}  // namespace gamut
