// What is probable: samples, a first block of them before all that is proved, the others after it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "analyses/checkpoints.hpp"
#include "analyses/comparison/settlement.hpp"
#include "analyses/samples/cvode.hpp"
#include "analyses/samples/influence.hpp"
#include "analyses/samples/order_statistics.hpp"
#include "scalars/archive.hpp"
#include "studies/running/dead_point.hpp"
#include "studies/running/run_memory.hpp"
#include "studies/running/sample_keeper.hpp"
#include "studies/running/sampled_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

/// What finds no room is given up.
template <class Sample>
void sampleWhileThereIsRoom(Run& run, Watch::Stage stage, SampledMotion& samples, StochasticResult& result,
                            const Sample& sample) {
  const Charge charge(&run.spent.samples, &result.cpu);
  run.watch.begin(stage);
  if (hasRoomFor(run, sample)) return;
  samples.ensemble.reset();
  result.kept = {};
  result.stopped = run.watch.why();
}

ComparisonOptions comparisonOptions(const Run& run) {
  ComparisonOptions options;
  options.jobs = run.options.jobs;
  options.progress = run.progressOf("comparison");
  options.cancelled = run.watch.stop();
  return options;
}

/// While one lives, the ensemble pauses now and then, and its state is recorded.
class Pauses {
 public:
  Pauses(EnsembleRun& ensemble, CheckpointedTask& checkpoint, const CheckpointedTask::Content& state)
      : ensemble_(ensemble) {
    ensemble.pauseWhen([&checkpoint] { return checkpoint.isDue(); },
                       [&checkpoint, state] { checkpoint.record(state); });
  }
  ~Pauses() { ensemble_.pauseWhen({}, {}); }
  Pauses(const Pauses&) = delete;
  Pauses& operator=(const Pauses&) = delete;

 private:
  EnsembleRun& ensemble_;
};

/// Averages over the times that all samples reached.
void describeConvergence(const EnsembleRun& ensemble, std::size_t outputs, StochasticResult& stochastic) {
  const std::vector<Convergence>& found = ensemble.convergence();
  ConvergenceResult& result = stochastic.convergence;
  const std::size_t times = ensemble.reachedTimes();
  if (found.empty() || ensemble.options().plan == Plan::grid) return;  // the first of a grid lie on one side
  result.present = true;
  const auto average = [&](std::size_t output, const auto& ratio) {
    double sum = 0, count = 0;
    for (std::size_t t = 0; t < times; ++t)
      if (const double each = ratio(t, output); std::isfinite(each)) sum += each, ++count;
    return sum / count;
  };
  for (const Convergence& first : found) {
    result.samples.push_back(static_cast<std::int64_t>(first.samples));
    for (std::size_t k = 0; k < outputs; ++k) {
      const Envelope& all = stochastic.envelope;
      result.spanned.push_back(average(k, [&](std::size_t t, std::size_t o) {
        return std::min(first.width(t, o) / (all.upper(t, o) - all.lower(t, o)), 1.0);
      }));
      result.meanError.push_back(average(k, [&](std::size_t t, std::size_t o) {
        const double error = stochastic.meanError(t, o);  // NaN where none holds of these samples
        return std::isnan(error) ? error : first.meanError(t, o) / stochastic.deviation(t, o);
      }));
    }
  }
}

/// What samples of loops that are placed are followed by ends nowhere but where one of these is no longer regular.
std::string whyEnded(const Machine& machine, std::string why) {
  if (!machine.placed) return why;
  std::vector<std::string> all;
  bool isOfAngles = false;
  for (const std::string& each : machine.regular.otherwise)
    if (each.find("half a turn") != std::string::npos)
      isOfAngles = true;
    else if (std::ranges::find(all, each) == all.end())
      all.push_back(each);
  if (isOfAngles) all.emplace_back("one of its angles comes to half a turn from where it is in the nominal machine");
  for (const std::string_view singular : {Integration::stepsTooShort, Integration::ratesNotFinite})
    if (const std::size_t place = why.find(singular); place != std::string::npos)
      why.replace(place, singular.size(), fmt::format("{}", fmt::join(all, ", or ")));
  return why;
}

/// `why` or, of a sample of loops that are not placed, what dead point of its own it comes to, if that is told.
std::string whyEnded(const Run& run, const EnsembleOptions& options, const FailedSample& sample) {
  const Machine& machine = run.machine;
  const bool isSingular = sample.why == Integration::stepsTooShort || sample.why == Integration::ratesNotFinite;
  if (isSingular && !machine.placed && run.study.mechanism.isClosed() && machine.courses.empty()) try {
      constexpr double about = 1.01, seconds = 5;
      const SampleBlock block = replaySample(machine.motion, options, sample.number);
      const auto dead = deadPointOf(machine, block.values(0), sample.reached, seconds);
      if (dead && sample.reached < about * dead->to)
        return fmt::format("{}; what helps: {}", dead->sentence("its motion"), dead->advice());
    } catch (const std::domain_error&) {      // that motion has no value somewhere
    } catch (const std::invalid_argument&) {  // it cannot be held
    }
  return whyEnded(machine, sample.why);
}

void describeSamples(const Run& run, const EnsembleRun& ensemble, Results& results) {
  StochasticResult& stochastic = results.stochastic;
  Statistics numbers = ensemble.statistics();
  stochastic.mean = std::move(numbers.mean);
  stochastic.deviation = std::move(numbers.deviation);
  stochastic.probabilities = std::move(numbers.probabilities);
  stochastic.meanError = std::move(numbers.meanError);
  stochastic.deviationError = std::move(numbers.deviationError);
  stochastic.quantiles = std::move(numbers.quantiles);
  stochastic.quantileLower = std::move(numbers.lower);
  stochastic.quantileUpper = std::move(numbers.upper);
  stochastic.resolution = std::move(numbers.resolution);
  stochastic.error = ensemble.error();
  stochastic.why = ensemble.why();
  stochastic.envelope = ensemble.envelope();
  stochastic.reached = ensemble.reached();
  stochastic.integrated = static_cast<std::int64_t>(ensemble.integrated());
  stochastic.failures = static_cast<std::int64_t>(ensemble.failures());
  constexpr std::size_t few = 16;  // each takes another integration
  for (const FailedSample& sample : ensemble.failed()) {
    const bool isOfFew = stochastic.failed.size() < few;
    const std::string why = isOfFew ? whyEnded(run, ensemble.options(), sample) : whyEnded(run.machine, sample.why);
    if (const std::size_t place = stochastic.why.find(sample.why);
        stochastic.failed.empty() && place != std::string::npos)
      stochastic.why.replace(place, sample.why.size(), why);
    stochastic.failed.push_back({static_cast<std::int64_t>(sample.number), sample.reached, why});
  }
  if (ensemble.options().plan == Plan::random && ensemble.isComplete() && stochastic.why.empty() &&
      ensemble.sampling().quantities() > 0)
    stochastic.covered = coveredShare(ensemble.counted(), 0.95);
  describeConvergence(ensemble, run.study.outputs.size(), stochastic);
  if (run.study.asksFor<FuzzyResult>()) results.fuzzy.inner = ensemble.innerCuts();
  if (ensemble.isComplete()) {
    stochastic.stopped.clear();
  } else if (*run.watch.stop()) {
    stochastic.stopped = run.watch.why();
  }
}

/// Switching courses are of the last of all samples, in their order.
void numberSwitching(StochasticResult& stochastic) {
  SwitchingResult& switching = stochastic.switching;
  std::int64_t courses = 0, last = -1;
  for (const std::int64_t number : switching.number) {
    courses += number != last ? 1 : 0;
    last = number;
  }
  std::int64_t next = stochastic.planned() - courses - 1;
  last = -1;
  for (std::int64_t& number : switching.number) {
    next += number != last ? 1 : 0;
    last = std::exchange(number, next);
  }
}

/// Where the transformation put its points.
void describeTransformation(const Study& study, const EnsembleRun& ensemble, Results& results) {
  const Transformation method = ensemble.options().transformation;
  TransformationResult& result = results.fuzzy.transformation;
  const std::size_t quantities = study.uncertain.size();
  StochasticResult& stochastic = results.stochastic;
  stochastic.alphaPoints = static_cast<std::int64_t>(ensemble.sampling().points() - ensemble.extremes());
  std::vector<std::int64_t>& numbers = stochastic.extremes.number;
  numbers.resize(ensemble.options().extremes.size());
  stochastic.extremes.present = !numbers.empty();
  std::iota(numbers.begin(), numbers.end(), stochastic.firstExtreme());
  numberSwitching(stochastic);
  if (!study.asksFor<FuzzyResult>()) return;
  result.present = true;
  result.method = std::string(nameOf(method));
  result.turns = ensemble.turns();
  if (method != Transformation::extended) {
    result.stepped.assign(quantities, method == Transformation::general ? 1 : 0);
  } else if (ensemble.turning()) {
    result.stepped.assign(quantities, 0);
    for (const std::size_t q : *ensemble.turning()) result.stepped[q] = 1;
  } else {
    result.turns.clear();
  }
}

/// Some output times.
std::vector<std::size_t> rowsOfInfluence(const Study& study) {
  constexpr std::size_t most = 64;
  const std::size_t last = study.times.size() - 1, count = std::clamp<std::size_t>(last, 1, most);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i <= count; ++i)
    if (const std::size_t row = i * last / count; rows.empty() || row > rows.back()) rows.push_back(row);
  return rows;
}

/// Where there are alpha-cuts with corners.
std::optional<InfluenceMeasures> measureInfluence(const Study& study, const EnsembleRun& ensemble) {
  if (!study.asksFor<FuzzyResult>() || ensemble.sampling().boxes().empty()) return {};
  return std::optional<InfluenceMeasures>(std::in_place, ensemble.sampling(), ensemble.cornerLevels(),
                                          rowsOfInfluence(study), study.outputs.size());
}

/// At the times that all samples reached.
void describeInfluence(const Study& study, const InfluenceMeasures& measures, std::size_t reachedTimes,
                       InfluenceResult& result) {
  const std::vector<std::size_t> rows = rowsOfInfluence(study);
  for (std::size_t at = 0; at < rows.size() && rows[at] < reachedTimes; ++at) {
    result.time.push_back(study.times[rows[at]]);
    for (std::size_t output = 0; output < study.outputs.size(); ++output)
      std::ranges::copy(measures.shares(at, output), std::back_inserter(result.share.data));
  }
  result.share.extents = {result.time.size(), study.outputs.size(), study.uncertain.size()};
  result.present = !result.time.empty();
}

}  // namespace

EnsembleOptions ensembleOptions(const Run& run, const Results& results) {
  EnsembleOptions options =
      ensembleOptions(run.machine, results, run.options.samples.value_or(run.study.ensemble.samples));
  options.jobs = run.options.jobs;
  options.secondsPerSample = run.limits.sampleTime;
  options.progress = run.progressOf("samples");
  options.cancelled = run.watch.stop();
  options.communicator = run.options.communicator;
  options.spreads = run.moves();
  return options;
}

void takeFirstSamples(Run& run, SampledMotion& samples, Results& results) {
  if (!run.study.asksFor<StochasticResult>()) return;
  const EnsembleOptions options = ensembleOptions(run, results);
  StochasticResult& stochastic = results.stochastic;
  stochastic.present = true;
  Choice::of(stochastic.plan).take(nameOf(options.plan));  // the words are the same
  stochastic.samples = static_cast<std::int64_t>(options.samples);
  if (run.moves() && !run.machine.isMotionGiven()) {
    stochastic.relativeTolerance = options.tolerance.relative;
    stochastic.absoluteTolerance = options.tolerance.absolute;
  }
  const Watch::Stage stage =
      samples.former || !run.isEnclosed() ? Watch::Stage::rest : Watch::Stage::firstSamples;  // all there is
  sampleWhileThereIsRoom(run, stage, samples, stochastic, [&] {
    EnsembleRun& ensemble = samples.ensemble.emplace(samples.motion, options);
    stochastic.samples = static_cast<std::int64_t>(ensemble.sampling().samples());
    stochastic.corners = static_cast<std::int64_t>(ensemble.sampling().corners());
    stochastic.alphaCorners = static_cast<std::int64_t>(ensemble.sampling().boxCorners());
    stochastic.packWidth = static_cast<std::int64_t>(ensemble.packWidth());
    describeTransformation(run.study, ensemble, results);
    CheckpointedTask checkpoint(run.options.checkpoints);
    const auto state = [&](Archive& all) { all(ensemble); };
    checkpoint.recall({}, state);
    const Pauses pauses(ensemble, checkpoint, state);
    ensemble.integrateFirst();
    if (*run.watch.stop()) stochastic.stopped = run.watch.why();
    if (run.study.asksFor<IntervalResult>()) samples.scales = scalesOf(run, samples.motion, ensemble);
  });
}

namespace {

/// What a rank that was to stop left undecided is in its times of the statistics, so all are to know it.
void archiveInterrupted(Archive& all, const Watch& watch, ComparisonResult& comparison) {
  std::vector<DisputedSample> own;
  if (!all.isReading()) std::ranges::copy_if(comparison.disputed, std::back_inserter(own), isInterrupted);
  std::size_t count = own.size();
  all(count);
  own.resize(count);
  for (DisputedSample& d : own) {
    all(d.number, d.time, d.output, d.value, d.lower, d.upper, d.distance, d.error, d.decided, d.outside, d.level,
        d.farthest);
    if (all.isReading()) comparison.disputed.push_back(std::move(d));
  }
  if (all.isReading() && count > 0) comparison.why = watch.why();
}

}  // namespace

void takeOtherSamples(Run& run, const Enclosure& enclosure, SampledMotion& samples, Results& results) {
  if (!samples.ensemble) return;
  const Study& study = run.study;
  StochasticResult& stochastic = results.stochastic;
  sampleWhileThereIsRoom(run, Watch::Stage::rest, samples, stochastic, [&] {
    EnsembleRun& ensemble = *samples.ensemble;
    const Proved proved{results.interval.at, results.fuzzy.outer, enclosure.reachedTimes};
    Settlement settlement(proved, samples.motion, comparisonOptions(run));
    const std::size_t last = ensemble.sampling().centre();
    SampleKeeper keeper(last + 1, study.uncertain.size(), study.times.size() * study.outputs.size(), study.storage);
    std::optional<InfluenceMeasures> influence = measureInfluence(study, ensemble);
    CheckpointedTask checkpoint(run.options.checkpoints);
    const auto state = [&](Archive& all) {
      archiveSamples(all, run, samples, results);
      all(settlement, keeper);
      if (influence) all(*influence);
    };
    const bool isGoneOn = checkpoint.recall({}, state) == CheckpointedTask::Recalled::state;
    if (!samples.former && !isGoneOn) {
      std::vector<std::vector<double>> extremes = extremePoints(study, enclosure, samples);
      std::ranges::move(takeWorstCourses(run, samples.scales, samples.motion, stochastic.switching),
                        std::back_inserter(extremes));
      for (const std::vector<double>& values : extremes)
        std::ranges::copy(values, std::back_inserter(stochastic.extremes.values));
      ensemble.setExtremes(std::move(extremes));
    }
    const Pauses pauses(ensemble, checkpoint, state);
    ensemble.integrateOthers(
        settlement.bounds(),
        [&](SampleBlock& block) {
          if (!run.moves()) moveSamples(run.machine, block);
          settlement.settle(block, [&](const Comparison& found, int level) {
            takeDisputes(run.watch, found, level, results.comparison);
          });
          if (samples.former) samples.former->meet(block, results.comparison.disputed);
          noteRequirements(run, block, samples, results);
          if (influence) influence->include(block);
          if (block.first() <= last) keeper.keep(block);
        },
        [&](Archive& all) { archiveInterrupted(all, run.watch, results.comparison); });
    describeTransformation(study, ensemble, results);
    describeSamples(run, ensemble, results);
    if (influence) describeInfluence(study, *influence, ensemble.reachedTimes(), results.fuzzy.influence);
    stochastic.kept = keeper.take();
    ensemble.keepShares(distributionRows(study));
  });
}

}  // namespace gamut
