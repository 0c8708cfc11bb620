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

void takeDisputes(Run& run, const Comparison& found, int level) {
  ComparisonResult& comparison = run.results.comparison;
  for (const Dispute& d : found.disputes) {
    comparison.disputed.push_back({static_cast<std::int64_t>(d.number), d.time, d.output, d.value, d.lower, d.upper,
                                   d.distance, d.error, d.decided, d.outside, level, d.farthest});
    if (isInterrupted(comparison.disputed.back())) comparison.why = run.watch.why();
  }
  comparison.excursion = std::max(comparison.excursion, found.excursion);
}

/// A run that goes on from one that was stopped brings the samples to their end, and proves nothing anew.
void noteStop(Run& run) {
  std::string stop = run.failure.empty() ? run.watch.firstStop() : std::string(internalFailure) + run.failure;
  for (const FailedSampleResult& sample : run.results.stochastic.failed)
    if (stop.empty() && sample.why.ends_with("CPU for a sample was reached")) stop = sample.why;
  if (!stop.empty() || !isProvedInPart(run.results)) run.results.stopped = std::move(stop);
}

void compareAnswers(Run& run) {
  const Study& study = run.study;
  if (!study.asksFor<StochasticResult>() || !(study.asksFor<IntervalResult>() || study.asksFor<FuzzyResult>())) return;
  Results& results = run.results;
  ComparisonResult& comparison = results.comparison;
  comparison.present = true;
  const std::size_t sampled = run.ensemble && run.ensemble->integrated() > 0 ? run.ensemble->reachedTimes() : 0;
  const std::size_t compared = std::min(run.enclosed.reachedTimes, sampled);
  const bool isOfTheStartAlone = study.times.size() > 1 && compared <= 1;
  if (study.asksFor<IntervalResult>() && sampled > 0 && !isOfTheStartAlone) {
    Overestimation found = measureOverestimation({results.interval.at, run.enclosed.reachedTimes},
                                                 results.stochastic.envelope, results.stochastic.error, floorsOf(run));
    comparison.overestimation = std::move(found.ratio);
    comparison.excess = std::move(found.excess);
    comparison.maximum = found.maximum;
    comparison.median = found.median;
    comparison.maximumOf = std::move(found.maximumOf);
  }
  TransformationResult& transformation = results.fuzzy.transformation;
  if (transformation.present && !results.fuzzy.inner.empty()) {
    const CutGaps gaps = measureGaps(results.fuzzy.outer, results.fuzzy.inner, results.stochastic.error, compared);
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    transformation.gap = gaps.gap;
    transformation.gapTime.clear();
    for (std::size_t i = 0; i < gaps.row.size(); ++i) {
      const bool isNothing = !run.scales.empty() && run.scales[i % run.scales.size()].isNothing();
      if (isNothing) transformation.gap[i] = unknown;  // there is nothing that could be filled
      transformation.gapTime.push_back(gaps.row[i] < results.time.size() && !isNothing ? results.time[gaps.row[i]]
                                                                                       : unknown);
    }
  }
  comparison.verdict = findVerdict(results).word;
}

}  // namespace gamut
