// Bounds over an output interval are those of one of its ends where that comes as far: of the one that comes nearer.
#include "studies/results/extremes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/words.hpp"

namespace gamut {
namespace {

using Source = MotionRange::Source;

const Bounds* boundsOf(const Results& results, Source source) {
  switch (source) {
    case Source::ofProof:
      return results.interval.present ? &results.interval.at : nullptr;
    case Source::ofSamples:
      return results.stochastic.present ? &results.stochastic.envelope : nullptr;
    case Source::ofCuts:
      return results.fuzzy.present && !results.fuzzy.outer.empty() ? &results.fuzzy.outer.front() : nullptr;
  }
  return nullptr;
}

}  // namespace

std::optional<MotionRange> motionRange(const Results& results, std::size_t output, Source source) {
  const Bounds* at = boundsOf(results, source);
  if (at == nullptr || at->empty()) return {};
  const Bounds* over = source == Source::ofProof && !results.interval.over.empty() && results.horizon > 0
                           ? &results.interval.over
                           : nullptr;
  MotionRange range;
  range.source = source;
  range.isBetween = over != nullptr;
  std::size_t known = 0;
  double low = INFINITY, high = -INFINITY;
  for (std::size_t i = 0; i < at->lower.times; ++i) {
    const double lower = at->lower(i, output), upper = at->upper(i, output);
    if (std::isfinite(lower) && std::isfinite(upper)) {
      ++known;
      range.until = results.time[i];
      range.width = std::max(range.width, upper - lower);
      low = std::min(low, lower);
      high = std::max(high, upper);
    }
  }
  if (known == 0) return {};
  range.widthAtTimes = high - low;
  const auto take = [&](MotionExtreme& extreme, std::size_t i, double bound, double here, double before, bool isLower) {
    if (std::isnan(bound) || (isLower ? bound >= extreme.value : bound <= extreme.value)) return;
    constexpr double alike = 1e-3, shown = 1e-4;  // of the range; of the number that is told, with four digits
    const double near = std::min(alike * (high - low), shown * std::abs(bound));
    const double fromHere = std::abs(here - bound), fromBefore = i > 0 ? std::abs(before - bound) : INFINITY;
    const bool isBefore = fromBefore <= near && fromBefore <= fromHere, isHere = !isBefore && fromHere <= near;
    extreme.value = bound;
    extreme.from = results.time[isHere || i == 0 ? i : i - 1];
    extreme.until = results.time[isBefore ? i - 1 : i];
  };
  for (std::size_t i = 0; i < at->lower.times; ++i) {
    const Bounds& of = over != nullptr ? *over : *at;
    take(range.least, i, of.lower(i, output), at->lower(i, output), i > 0 ? at->lower(i - 1, output) : 0, true);
    take(range.greatest, i, of.upper(i, output), at->upper(i, output), i > 0 ? at->upper(i - 1, output) : 0, false);
  }
  const auto spread = [&](MotionExtreme& extreme, const Table& bounds,
                          double farthest) {  // as far nearly all of the time
    constexpr double alike = 0.05, nearlyAll = 0.9;
    std::size_t near = 0;
    for (std::size_t i = 0; i < bounds.times; ++i)
      if (std::abs(bounds(i, output) - farthest) <= alike * (high - low)) ++near;
    if (known < 3 || static_cast<double>(near) < nearlyAll * static_cast<double>(known)) return;
    extreme.from = results.time.front();
    extreme.until = range.until;
  };
  spread(range.least, at->lower, low);
  spread(range.greatest, at->upper, high);
  range.isAtAllTimes = known == results.time.size();
  return range;
}

std::optional<MotionRange> bestMotionRange(const Results& results, std::size_t output) {
  for (const Source source : {Source::ofProof, Source::ofSamples, Source::ofCuts})
    if (std::optional<MotionRange> range = motionRange(results, output, source)) return range;
  return {};
}

double motionSize(const Results& results, std::size_t output) {
  for (const Source source : {Source::ofSamples, Source::ofProof, Source::ofCuts})
    if (const std::optional<MotionRange> range = motionRange(results, output, source))
      if (const double size = std::max(std::abs(range->least.value), std::abs(range->greatest.value));
          std::isfinite(size))
        return size;
  return 0;
}

bool isOneValue(const Results& results, double time, std::size_t output) {
  const Bounds& bounds = results.interval.at;
  const auto row = static_cast<std::size_t>(std::ranges::lower_bound(results.time, time) - results.time.begin());
  return results.interval.present && row < bounds.lower.times &&
         isLittle(bounds.upper(row, output) - bounds.lower(row, output), motionSize(results, output));
}

std::string rangesCaption(const Results& results) {
  std::optional<MotionRange> any;
  for (std::size_t o = 0; o < results.outputs.size() && !any; ++o) any = bestMotionRange(results, o);
  if (!any) return {};
  const std::string word = any->source == Source::ofProof     ? "guaranteed"
                           : any->source == Source::ofSamples ? "sampled"
                                                              : "possible";
  return results.horizon == 0 ? word
                              : fmt::format("{} from {} to {}{}", word, timeText(results.time.front()),
                                            reachedText(any->until), any->isBetween ? "" : ", at the output times");
}

std::string whenText(const Results& results, const MotionExtreme& extreme) {
  if (results.horizon == 0 || std::isnan(extreme.value)) return {};
  const bool isAlways = results.time.size() > 2 && extreme.from == results.time.front() &&
                        std::ranges::count_if(results.time, [&](double t) { return t <= extreme.until; }) > 2;
  if (isAlways) return "throughout";
  return extreme.from == extreme.until
             ? "at " + timeText(extreme.until)
             : fmt::format("between {} and {}", timeText(extreme.from), timeText(extreme.until));
}

std::string whenLeast(const Results& results, const MotionRange& range) {
  const bool isOfRounding = range.least.value < 0 && isLittle(range.least.value, range.size());
  return isOfRounding ? "" : whenText(results, range.least);
}

std::string whenGreatest(const Results& results, const MotionRange& range) {
  const bool isOfRounding = range.greatest.value > 0 && isLittle(range.greatest.value, range.size());
  return isOfRounding ? "" : whenText(results, range.greatest);
}

}  // namespace gamut
