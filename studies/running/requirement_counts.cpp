// What the samples say of each requirement: how many violate it, and which comes closest to that.
#include <algorithm>
#include <cmath>
#include <limits>

#include "analyses/samples/binomial.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

/// The margin that counts at one time: the least of all.
double marginOf(const SampleBlock& block, std::size_t i, std::size_t row, const Requirement& requirement) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t output : requirement.margins) {
    const double margin = block(i, row, output);
    if (std::isnan(margin)) return margin;
    least = std::min(least, margin);
  }
  return least;
}

bool isMet(const SampleBlock& block, std::size_t i, std::size_t row, const Requirement& requirement) {
  for (std::size_t k = 0; k < requirement.margins.size(); ++k) {
    const double margin = block(i, row, requirement.margins[k]);
    if (!(requirement.isMetAtZero[k] != 0 ? margin >= 0 : margin > 0)) return false;
  }
  return true;
}

struct Margin {
  double value;
  std::size_t row;
};

/// The worst over the window of what must be always met, the best of what must be once.
Margin worstOf(const SampleBlock& block, std::size_t i, std::size_t from, std::size_t until,
               const Requirement& requirement) {
  Margin worst{marginOf(block, i, from, requirement), from};
  for (std::size_t row = from + 1; row <= until; ++row) {
    const double margin = marginOf(block, i, row, requirement);
    if (requirement.isAlways ? margin < worst.value : margin > worst.value) worst = {margin, row};
  }
  return worst;
}

}  // namespace

void noteRequirements(Run& run, const SampleBlock& block) {
  for (std::size_t r = 0; r < run.study.requirements.size(); ++r) {
    const Requirement& requirement = run.study.requirements[r];
    RequirementResult& result = run.results.requirements[r];
    const std::size_t from = rowOf(run.study.motion.times, requirement.from),
                      until = rowOf(run.study.motion.times, requirement.until);
    for (std::size_t i = 0; i < block.size(); ++i) {
      if (std::isnan(block(i, until, requirement.margins.front()))) continue;  // it did not arrive
      bool always = true, once = false;
      for (std::size_t row = from; row <= until; ++row) {
        const bool isMetNow = isMet(block, i, row, requirement);
        always = always && isMetNow;
        once = once || isMetNow;
      }
      const bool violates = !(requirement.isAlways ? always : once);
      if (block.hasWeight()) {
        ++result.samples;
        if (violates) ++result.violating;
      }
      const Margin worst = worstOf(block, i, from, until, requirement);
      if (std::isnan(worst.value)) continue;
      const auto sample = static_cast<std::int64_t>(block.first() + i);
      const bool isWorst = result.worstSample < 0 || worst.value < result.worstMargin;
      if (isWorst || violates)
        run.suspects[r].add({{block.values(i).begin(), block.values(i).end()}, sample, worst.value, violates});
      if (!isWorst) continue;
      result.worstSample = sample;
      result.worstMargin = worst.value;
      result.worstTime = run.study.motion.times[worst.row];
    }
  }
}

void countRequirements(Run& run) {
  for (RequirementResult& result : run.results.requirements) {
    if (run.study.ensemble.plan != Plan::random || result.samples == 0 ||
        result.samples < run.results.stochastic.samples)
      continue;
    const Interval share = confidenceOfShare(result.samples - result.violating, result.samples);
    result.shareLower = share.lower();
    result.shareUpper = share.upper();
  }
}

}  // namespace gamut
