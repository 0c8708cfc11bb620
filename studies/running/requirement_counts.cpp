// What the samples say of each requirement: how many violate it, and which comes closest to that; and where the proof
// ends before the window does, what independent ones say of the probability that it is met.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "analyses/communicator.hpp"
#include "analyses/samples/binomial.hpp"
#include "analyses/workers.hpp"
#include "scalars/archive.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

/// The margin that counts at one time: the least of all.
double marginOf(const SampleBlock& block, std::size_t i, std::size_t row, const Requirement& requirement) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t output : requirement.marginOutputs()) {
    const double margin = block(i, row, output);
    if (std::isnan(margin)) return margin;
    least = std::min(least, margin);
  }
  return least;
}

bool isMet(const SampleBlock& block, std::size_t i, std::size_t row, const Requirement& requirement) {
  for (std::size_t k = 0; k < requirement.margins(); ++k) {
    const double margin = block(i, row, requirement.firstMargin + k);
    if (!(requirement.demand.terms[k].isStrict ? margin > 0 : margin >= 0)) return false;
  }
  return true;
}

/// At the output times of its window.
bool isMetThroughout(const SampleBlock& block, std::size_t i, std::size_t from, std::size_t until,
                     const Requirement& requirement) {
  bool always = true, once = false;
  for (std::size_t row = from; row <= until; ++row) {
    const bool isMetNow = isMet(block, i, row, requirement);
    always = always && isMetNow;
    once = once || isMetNow;
  }
  return requirement.demand.isAlways ? always : once;
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
    if (requirement.demand.isAlways ? margin < worst.value : margin > worst.value) worst = {margin, row};
  }
  return worst;
}

constexpr std::size_t mostFitted = 4096, mostIndependent = 4096;

/// Whether the quantities have one joint distribution: else a probability of what is met is none.
bool haveOneDistribution(const Study& study) {
  return study.dependence.unknown.empty() && std::ranges::all_of(study.uncertain, [](const UncertainQuantity& q) {
           return !q.varies && q.uncertain.distribution.isPrecise();
         });
}

/// Each bound holds whatever those that did not arrive would have done.
void boundShare(RequirementEstimate& estimate) {
  if (estimate.samples == 0) return;
  estimate.lower = confidenceOfShare(estimate.met, estimate.samples).lower();
  estimate.upper = confidenceOfShare(estimate.samples - estimate.violated, estimate.samples).upper();
}

/// Independent samples, besides those of another plan, of these requirements.
void sampleIndependently(const Run& run, const std::vector<std::size_t>& requirements, SampledMotion& samples,
                         Results& results) {
  EnsembleOptions options = samples.ensemble->options();
  options.samples = std::min(samples.ensemble->sampling().samples(), mostIndependent);
  options.seed ^= 0x9e3779b97f4a7c15;  // others than those of the plan
  options.progress = {};
  options.cancelled = run.watch.stop();
  integrateIndependent(samples.motion, options, [&](const SampleBlock& block) {
    for (const std::size_t r : requirements) {
      const Requirement& requirement = run.study.requirements[r];
      RequirementEstimate& estimate = results.requirements[r].estimate;
      const std::size_t from = rowOf(run.study.times, requirement.demand.from),
                        until = rowOf(run.study.times, requirement.demand.until);
      for (std::size_t i = 0; i < block.size(); ++i) {
        ++estimate.samples;
        if (std::isnan(block(i, until, requirement.firstMargin))) continue;  // it did not arrive
        if (isMetThroughout(block, i, from, until, requirement)) {
          ++estimate.met;
          continue;
        }
        ++estimate.violated;
        const Margin worst = worstOf(block, i, from, until, requirement);
        samples.suspects[r].add({{block.values(i).begin(), block.values(i).end()}, -1, worst.value, true});
      }
    }
  });
}

/// What a sample says of a requirement.
struct Judgement {
  bool hasArrived = false, violates = false;
  Margin worst{};
};

/// Of motions that other ranks have.
void tellJudgements(const SampleBlock& block, std::vector<Judgement>& judgements) {
  constexpr int judged = 101;
  const auto archive = [&](Archive& all, int rank) {
    for (std::size_t pack = rank; pack < block.packs(); pack += block.spread->count()) {
      const std::size_t first = pack * packWidth, count = std::min<std::size_t>(packWidth, block.size() - first);
      all.bytes(std::span(judgements).subspan(first, count));
    }
  };
  block.spread->exchange(
      judged, [&](Archive& all) { archive(all, block.spread->rank()); },
      [&](int rank, Archive& all) { archive(all, rank); });
}

std::vector<Judgement> judgementsOf(const Run& run, const SampleBlock& block, const Requirement& requirement) {
  const std::size_t from = rowOf(run.study.times, requirement.demand.from),
                    until = rowOf(run.study.times, requirement.demand.until);
  std::vector<Judgement> all(block.size());
  forEachIndex(run.options.jobs, block.packs(), nullptr, [&] {
    return [&](std::size_t pack) {
      for (std::size_t i = pack * packWidth; block.isHere(pack) && i < std::min(block.size(), (pack + 1) * packWidth);
           ++i)
        if (!std::isnan(block(i, until, requirement.firstMargin)))
          all[i] = {true, !isMetThroughout(block, i, from, until, requirement),
                    worstOf(block, i, from, until, requirement)};
    };
  });
  if (block.spread != nullptr) tellJudgements(block, all);
  return all;
}

}  // namespace

void noteRequirements(const Run& run, const SampleBlock& block, SampledMotion& samples, Results& results) {
  for (std::size_t r = 0; r < run.study.requirements.size(); ++r) {
    RequirementResult& result = results.requirements[r];
    const std::vector<Judgement> all = judgementsOf(run, block, run.study.requirements[r]);
    for (std::size_t i = 0; i < block.size(); ++i) {
      const auto& [hasArrived, violates, worst] = all[i];
      if (!hasArrived) continue;
      if (block.hasWeight()) {
        ++result.samples;
        if (violates) ++result.violating;
      }
      if (std::isnan(worst.value)) continue;
      if (block.hasWeight() && samples.worstMargins[r].count() < mostFitted)
        samples.worstMargins[r].include(block.values(i), worst.value);
      const auto sample = static_cast<std::int64_t>(block.first() + i);
      const bool isWorst = result.worstSample < 0 || worst.value < result.worstMargin;
      if (isWorst || violates)
        samples.suspects[r].add({{block.values(i).begin(), block.values(i).end()}, sample, worst.value, violates});
      if (!isWorst) continue;
      result.worstSample = sample;
      result.worstMargin = worst.value;
      result.worstTime = run.study.times[worst.row];
    }
  }
}

void estimateRequirements(Run& run, std::size_t reachedTimes, SampledMotion& samples, Results& results) {
  if (!samples.ensemble || run.study.uncertain.empty() || !haveOneDistribution(run.study)) return;
  if (!run.isEnclosed()) return;
  std::vector<std::size_t> open;
  for (std::size_t r = 0; r < run.study.requirements.size(); ++r)
    if (rowOf(run.study.times, run.study.requirements[r].demand.until) >= reachedTimes) open.push_back(r);
  if (open.empty() || run.study.horizon == 0) return;
  const Charge charge(&run.spent.samples, &results.stochastic.cpu);
  run.watch.begin(Watch::Stage::rest);
  if (run.study.ensemble.plan != Plan::random)
    hasRoomFor(run, [&] { sampleIndependently(run, open, samples, results); });  // else fewer are told of
  std::vector<std::vector<double>> coefficients;
  std::vector<char> atZero;
  for (const std::size_t r : open) {
    RequirementResult& result = results.requirements[r];
    const Requirement& requirement = run.study.requirements[r];
    if (run.study.ensemble.plan == Plan::random) {
      const std::int64_t followed = static_cast<std::int64_t>(samples.ensemble->counted());
      result.estimate = {followed, result.samples - result.violating, result.violating};
    }
    boundShare(result.estimate);
    coefficients.push_back(samples.worstMargins[r].coefficients());
    atZero.push_back(std::ranges::none_of(requirement.demand.terms, &DemandTerm::isStrict) ? 1 : 0);
  }
  const std::vector<double> shares =
      sharesAboveZero(coefficients, atZero, samples.motion.uncertain, run.study.dependence, results.seed);
  for (std::size_t i = 0; i < open.size(); ++i) results.requirements[open[i]].estimate.firstOrder = shares[i];
}

void countRequirements(const Study& study, Results& results) {
  for (RequirementResult& result : results.requirements) {
    if (study.ensemble.plan != Plan::random || result.samples == 0 || result.samples < results.stochastic.samples)
      continue;
    const Interval share = confidenceOfShare(result.samples - result.violating, result.samples);
    result.shareLower = share.lower();
    result.shareUpper = share.upper();
  }
}

}  // namespace gamut
