// How the answers agree: what the samples' comparison with all that is proved found, and how wide that is against them.
#include "analyses/comparison/comparison.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "studies/results/verdict.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

/// What was proved may be less than could be, if the run was stopped.
bool isProvedInPart(const Results& results) {
  return !results.interval.why.empty() || !results.interval.shortfall.empty() || !results.fuzzy.why.empty() ||
         !results.distribution.stopped.empty() ||
         std::ranges::any_of(results.further, [](const auto& part) { return !part->stopped.empty(); }) ||
         std::ranges::any_of(results.requirements,
                             [](const RequirementResult& r) { return r.word == Decision::open && !r.why.empty(); });
}

}  // namespace

void takeDisputes(const Watch& watch, const Comparison& found, int level, ComparisonResult& comparison) {
  for (const Dispute& d : found.disputes) {
    Decider decided = Decider::unresolved;
    Choice::of(decided).take(d.decided);  // the words are the same
    comparison.disputed.push_back({static_cast<std::int64_t>(d.number), d.time, d.output, d.value, d.lower, d.upper,
                                   d.distance, d.error, decided, d.outside, level, d.farthest});
    if (isInterrupted(comparison.disputed.back())) comparison.why = watch.why();
  }
  comparison.excursion = std::max(comparison.excursion, found.excursion);
}

/// A run that goes on from one that was stopped brings the samples to their end, and proves nothing anew.
void noteStop(const Run& run, const std::string& failure, Results& results) {
  std::string stop = failure.empty() ? run.watch.firstStop() : std::string(internalFailure) + failure;
  for (const FailedSampleResult& sample : results.stochastic.failed)
    if (stop.empty() && sample.why.ends_with("CPU for a sample was reached")) stop = sample.why;
  if (!stop.empty() || !isProvedInPart(results)) results.stopped = std::move(stop);
}

void compareAnswers(const Run& run, std::size_t reachedTimes, const SampledMotion& samples, Results& results) {
  const Study& study = run.study;
  if (!study.asksFor<StochasticResult>() || !run.isEnclosed()) return;
  ComparisonResult& comparison = results.comparison;
  comparison.present = true;
  const std::size_t sampled =
      samples.ensemble && samples.ensemble->integrated() > 0 ? samples.ensemble->reachedTimes() : 0;
  const std::size_t compared = std::min(reachedTimes, sampled);
  const bool isOfTheStartAlone = study.times.size() > 1 && compared <= 1;
  if (study.asksFor<IntervalResult>() && sampled > 0 && !isOfTheStartAlone) {
    Overestimation found = measureOverestimation({results.interval.at, reachedTimes}, results.stochastic.envelope,
                                                 results.stochastic.error, floorsOf(study, samples.scales));
    comparison.overestimation = std::move(found.ratio);
    comparison.excess = std::move(found.excess);
    comparison.maximum = found.maximum;
    comparison.median = found.median;
    comparison.maximumOf = std::move(found.maximumOf);
  }
  TransformationResult& transformation = results.fuzzy.transformation;
  if (transformation.present && !results.fuzzy.inner.empty()) {
    const CutGaps gaps = measureGaps(results.fuzzy.outer, results.fuzzy.inner, results.stochastic.error, compared);
    const GridShape shape{results.fuzzy.alpha.size(), results.outputs.size()};
    transformation.gap = Grid(shape, gaps.gap);
    transformation.gapTime = Grid(shape);
    for (std::size_t i = 0; i < gaps.row.size(); ++i)
      if (!samples.scales.empty() && samples.scales[i % samples.scales.size()].isNothing())
        transformation.gap.data[i] = std::numeric_limits<double>::quiet_NaN();  // there is nothing that could be filled
      else if (gaps.row[i] < results.time.size())
        transformation.gapTime.data[i] = results.time[gaps.row[i]];
  }
  comparison.verdict = findVerdict(results).word;
}

}  // namespace gamut
