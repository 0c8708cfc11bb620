// What is probable: samples, a first block of them before all that is proved, the others after it.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <new>
#include <numeric>
#include <optional>
#include <utility>

#include "analyses/comparison/settlement.hpp"
#include "analyses/samples/influence.hpp"
#include "analyses/samples/order_statistics.hpp"
#include "studies/running/sample_keeper.hpp"
#include "studies/running/sampled_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

/// What finds no room is given up.
template <class Sample>
void sampleWhileThereIsRoom(Run& run, Watch::Stage stage, const Sample& sample) {
  const double start = processCpuSeconds();
  const Spending spending(run.spent.samples);
  run.watch.begin(stage);
  try {
    sample();
  } catch (const std::bad_alloc&) {
    run.watch.memoryFailed();
    run.ensemble.reset();
    run.results.stochastic.kept = {};
    run.results.stochastic.stopped = run.watch.why();
  }
  run.results.stochastic.cpu += processCpuSeconds() - start;
}

EnsembleOptions ensembleOptions(const Run& run) {
  EnsembleOptions options =
      ensembleOptions(run.machine, run.results, run.options.samples.value_or(run.study.ensemble.samples));
  options.jobs = run.options.jobs;
  options.secondsPerSample = run.results.limits.sampleTime;
  options.progress = run.progressOf("samples");
  options.cancelled = run.watch.stop();
  return options;
}

ComparisonOptions comparisonOptions(const Run& run) {
  ComparisonOptions options;
  options.jobs = run.options.jobs;
  options.progress = run.progressOf("comparison");
  options.cancelled = run.watch.stop();
  return options;
}

/// Averages over the times that all samples reached.
void describeConvergence(Run& run) {
  const std::vector<Convergence>& found = run.ensemble->convergence();
  const StochasticResult& stochastic = run.results.stochastic;
  ConvergenceResult& result = run.results.stochastic.convergence;
  const std::size_t outputs = run.study.outputs.size(), times = run.ensemble->reachedTimes();
  if (found.empty() || run.ensemble->options().plan == Plan::grid) return;  // the first of a grid lie on one side
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

void describeSamples(Run& run) {
  StochasticResult& stochastic = run.results.stochastic;
  const EnsembleRun& ensemble = *run.ensemble;
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
  for (const FailedSample& sample : ensemble.failed())
    stochastic.failed.push_back({static_cast<std::int64_t>(sample.number), sample.reached, sample.why});
  if (ensemble.options().plan == Plan::random && ensemble.isComplete() && stochastic.why.empty() &&
      ensemble.sampling().quantities() > 0)
    stochastic.covered = coveredShare(ensemble.counted(), 0.95);
  describeConvergence(run);
  if (run.study.asksFor<FuzzyResult>()) run.results.fuzzy.inner = ensemble.innerCuts();
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
void describeTransformation(Run& run) {
  const EnsembleRun& ensemble = *run.ensemble;
  const Transformation method = ensemble.options().transformation;
  TransformationResult& result = run.results.fuzzy.transformation;
  const std::size_t quantities = run.study.uncertain.size();
  StochasticResult& stochastic = run.results.stochastic;
  stochastic.alphaPoints = static_cast<std::int64_t>(ensemble.sampling().points() - ensemble.extremes());
  std::vector<std::int64_t>& numbers = stochastic.extremes.number;
  numbers.resize(ensemble.options().extremes.size());
  stochastic.extremes.present = !numbers.empty();
  std::iota(numbers.begin(), numbers.end(), stochastic.firstExtreme());
  numberSwitching(stochastic);
  if (!run.study.asksFor<FuzzyResult>()) return;
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
std::vector<std::size_t> rowsOfInfluence(const Run& run) {
  constexpr std::size_t most = 64;
  const std::size_t last = run.study.times.size() - 1, count = std::clamp<std::size_t>(last, 1, most);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i <= count; ++i)
    if (const std::size_t row = i * last / count; rows.empty() || row > rows.back()) rows.push_back(row);
  return rows;
}

/// Where there are alpha-cuts with corners.
std::optional<InfluenceMeasures> measureInfluence(const Run& run) {
  if (!run.study.asksFor<FuzzyResult>() || run.ensemble->sampling().boxes().empty()) return {};
  return std::optional<InfluenceMeasures>(std::in_place, run.ensemble->sampling(), run.ensemble->cornerLevels(),
                                          rowsOfInfluence(run), run.study.outputs.size());
}

/// At the times that all samples reached.
void describeInfluence(Run& run, const InfluenceMeasures& measures) {
  InfluenceResult& result = run.results.fuzzy.influence;
  const std::vector<std::size_t> rows = rowsOfInfluence(run);
  for (std::size_t at = 0; at < rows.size() && rows[at] < run.ensemble->reachedTimes(); ++at) {
    result.time.push_back(run.study.times[rows[at]]);
    for (std::size_t output = 0; output < run.study.outputs.size(); ++output)
      std::ranges::copy(measures.shares(at, output), std::back_inserter(result.share));
  }
  result.present = !result.time.empty();
}

}  // namespace

void takeFirstSamples(Run& run) {
  if (!run.study.asksFor<StochasticResult>()) return;
  const EnsembleOptions options = ensembleOptions(run);
  StochasticResult& stochastic = run.results.stochastic;
  stochastic.present = true;
  stochastic.plan = std::string(nameOf(options.plan));
  stochastic.samples = static_cast<std::int64_t>(options.samples);
  if (run.study.analysis != Study::Analysis::kinematics && !run.study.isMotionGiven()) {
    stochastic.relativeTolerance = options.tolerance.relative;
    stochastic.absoluteTolerance = options.tolerance.absolute;
  }
  const bool isAllThereIs = run.former || (!run.study.asksFor<IntervalResult>() && !run.study.asksFor<FuzzyResult>());
  sampleWhileThereIsRoom(run, isAllThereIs ? Watch::Stage::rest : Watch::Stage::firstSamples, [&] {
    EnsembleRun& ensemble = run.ensemble.emplace(run.motion, options);
    stochastic.samples = static_cast<std::int64_t>(ensemble.sampling().samples());
    stochastic.corners = static_cast<std::int64_t>(ensemble.sampling().corners());
    stochastic.alphaCorners = static_cast<std::int64_t>(ensemble.sampling().boxCorners());
    stochastic.packWidth = static_cast<std::int64_t>(ensemble.packWidth());
    describeTransformation(run);
    ensemble.integrateFirst();
    if (*run.watch.stop()) stochastic.stopped = run.watch.why();
    if (run.study.asksFor<IntervalResult>()) run.scales = scalesOf(run);
  });
}

void takeOtherSamples(Run& run) {
  if (!run.ensemble) return;
  sampleWhileThereIsRoom(run, Watch::Stage::rest, [&] {
    const Proved proved{run.results.interval.at, run.results.fuzzy.outer, run.enclosed.reachedTimes};
    Settlement settlement(proved, run.motion, comparisonOptions(run));
    const std::size_t last = run.ensemble->sampling().centre();
    SampleKeeper keeper(last + 1, run.study.uncertain.size(), run.study.times.size() * run.study.outputs.size(),
                        run.study.storage);
    std::optional<InfluenceMeasures> influence = measureInfluence(run);
    if (!run.former) {
      std::vector<std::vector<double>> extremes = extremePoints(run);
      std::ranges::move(takeWorstCourses(run), std::back_inserter(extremes));
      for (const std::vector<double>& values : extremes)
        std::ranges::copy(values, std::back_inserter(run.results.stochastic.extremes.values));
      run.ensemble->setExtremes(std::move(extremes));
    }
    run.ensemble->integrateOthers(settlement.bounds(), [&](SampleBlock& block) {
      if (run.study.analysis == Study::Analysis::kinematics) moveSamples(run.machine, block);
      settlement.settle(block, [&](const Comparison& found, int level) { takeDisputes(run, found, level); });
      if (run.former) run.former->meet(block, run.results.comparison.disputed);
      noteRequirements(run, block);
      if (influence) influence->include(block);
      if (block.first() <= last) keeper.keep(block);
    });
    describeTransformation(run);
    describeSamples(run);
    if (influence) describeInfluence(run, *influence);
    run.results.stochastic.kept = keeper.take();
    run.ensemble->keepShares(distributionRows(run.study));
  });
}

}  // namespace gamut
