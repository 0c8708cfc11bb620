// Lines of limits, and which of them is nearest.
#include "reports/sections/limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

#include "reports/requirements.hpp"
#include "reports/sections/contribution.hpp"
#include "reports/words.hpp"
#include "studies/told.hpp"

namespace gamut {
namespace {

/// "limit 0.7 rad", and as it is stated, if in another unit: "limit 40 deg (0.698132 rad)"; "limit 40 deg" of a number
/// of degrees.
std::string labelOf(const Results& results, const Limit& limit) {
  const MarginInfo& margin = *std::ranges::find(results.margins, limit.margin, &MarginInfo::output);
  const std::string &unit = results.outputs[limit.output].unit, number = numberText(limit.value, 6);
  const bool isPlain = unit.empty() || unit == "1";
  if (isPlain && inUnit(number, margin.unit) == margin.limitText) return "limit " + margin.limitText;
  const Told stated(unit, margin.unit);
  if (stated.of(1.0) == 1 || limit.value == 0) return "limit " + inUnit(number, unit);
  return fmt::format("limit {} ({})", inUnit(numberText(stated.of(limit.value), 6), stated.unit()),
                     inUnit(number, unit));
}

/// Where a margin that is to be above zero throughout may not be: between output times where all instants are known,
/// else at them.
void addMissed(const Results& results, const Limit& limit, std::vector<Span>& missed) {
  const RequirementResult& requirement = results.requirements[limit.requirement];
  const Bounds* bounds = bestKnown(results);
  if (bounds == nullptr || !requirement.isAlways || requirement.word == Decision::met || results.horizon == 0) return;
  const Bounds& over = results.interval.over;
  const bool isOver = bounds == &results.interval.at && !over.empty();
  for (std::size_t i = 0; i < std::min(results.time.size(), bounds->lower.times); ++i) {
    const double until = results.time[i];
    if (until < requirement.from || until > requirement.until) continue;
    if (isOver && i > 0 && results.time[i - 1] >= requirement.from && over.lower(i, limit.margin) < 0)
      missed.push_back({results.time[i - 1], until});
    else if (bounds->lower(i, limit.margin) < 0)
      missed.push_back({until, until});
  }
}

/// In order, those that meet as one.
std::vector<Span> joined(std::vector<Span> spans) {
  std::ranges::sort(spans, {}, &Span::from);
  std::vector<Span> all;
  for (const Span& span : spans)
    if (!all.empty() && span.from <= all.back().until)
      all.back().until = std::max(all.back().until, span.until);
    else
      all.push_back(span);
  return all;
}

void drawRequired(const Results& results, std::size_t output, Plot& plot) {
  Layer layer{.name = "limit",
              .words = "limit of a requirement",
              .style = {colour::red, 0, 1.8, true},  // by more than a colour told from alpha-cuts
              .kind = Layer::Kind::line,
              .isInSpread = false};
  for (const Limit& limit : limitsOf(results)) {
    if (limit.output != output) continue;
    const RequirementResult& requirement = results.requirements[limit.requirement];
    Line line(results.time.size(), std::nan(""));
    for (std::size_t i = 0; i < line.size(); ++i)
      if (results.horizon == 0 || (results.time[i] >= requirement.from && results.time[i] <= requirement.until))
        line[i] = limit.value;
    layer.bands.push_back({std::move(line), {}});
    layer.labels.push_back(labelOf(results, limit));
    addMissed(results, limit, plot.missed);
  }
  plot.missed = joined(std::move(plot.missed));
  if (!layer.bands.empty()) plot.layers.push_back(std::move(layer));
}

std::vector<Column> requiredColumns(const Results&, const Finding&) { return {}; }

/// The least is the worst: how bad what is known is, how probable, if some values violate it, that it is met, and how
/// near it comes to its limit.
using Badness = std::tuple<int, double, double>;

Badness badnessOf(const RequirementResult& requirement, double share) {
  return {severityOf(requirement), requirement.word == Decision::partly ? requirement.probabilityLower : 0.0, share};
}

}  // namespace

const Contribution required{requiredColumns, drawRequired};

std::vector<Limit> limitsOf(const Results& results) {
  std::vector<Limit> limits;
  for (std::size_t r = 0; r < results.requirements.size(); ++r)
    for (const MarginInfo& margin : marginsOf(results, results.requirements[r]))
      limits.push_back({r, margin.output, margin.limited, margin.limit});
  return limits;
}

std::optional<NearLimit> nearestOf(const Results& results, std::size_t number) {
  const Bounds* bounds = bestKnown(results);
  const RequirementResult& requirement = results.requirements[number];
  std::vector<Limit> limits = limitsOf(results);
  std::erase_if(limits, [&](const Limit& limit) { return limit.requirement != number; });
  double slack = requirement.isAlways ? INFINITY : -INFINITY;
  const Limit* decisive = nullptr;
  for (std::size_t i = 0; bounds != nullptr && i < results.time.size(); ++i) {
    if (results.horizon > 0 && (results.time[i] < requirement.from || results.time[i] > requirement.until)) continue;
    const Limit* tightest = nullptr;
    for (const Limit& limit : limits)
      if (std::isfinite(bounds->lower(i, limit.margin)) &&
          (tightest == nullptr || bounds->lower(i, limit.margin) < bounds->lower(i, tightest->margin)))
        tightest = &limit;
    if (tightest == nullptr) continue;
    const double margin = bounds->lower(i, tightest->margin);
    if (decisive != nullptr && !(requirement.isAlways ? margin < slack : margin > slack)) continue;
    slack = margin;
    decisive = tightest;
  }
  if (decisive == nullptr) return std::nullopt;
  double low = INFINITY, high = -INFINITY;
  for (std::size_t i = 0; i < results.time.size(); ++i) {
    low = std::fmin(low, bounds->lower(i, decisive->margin));
    high = std::fmax(high, bounds->upper(i, decisive->margin));
  }
  return NearLimit{*decisive, slack / std::max(high - low, std::numeric_limits<double>::min())};
}

std::vector<std::size_t> worstFirst(const Results& results) {
  std::vector<Badness> badness;
  for (std::size_t r = 0; r < results.requirements.size(); ++r) {
    const std::optional<NearLimit> nearest = nearestOf(results, r);
    badness.push_back(badnessOf(results.requirements[r], nearest ? nearest->share : INFINITY));
  }
  std::vector<std::size_t> order = shownRequirements(results);
  std::ranges::stable_sort(order, {}, [&](std::size_t r) { return badness[r]; });
  return order;
}

std::optional<Limit> nearestLimit(const Results& results) {
  for (const std::size_t r : worstFirst(results))
    if (const std::optional<NearLimit> nearest = nearestOf(results, r)) return nearest->limit;
  const std::vector<Limit> limits = limitsOf(results);
  return limits.empty() ? std::nullopt : std::optional(limits.front());
}

double instantOf(const Results& results, std::size_t output) {
  std::optional<Limit> found = nearestLimit(results);
  if (!found || found->output != output) {
    const std::vector<Limit> limits = limitsOf(results);
    const auto first = std::ranges::find(limits, output, &Limit::output);
    found = first == limits.end() ? std::nullopt : std::optional<Limit>(*first);
  }
  const double time = found ? decisiveTime(results, results.requirements[found->requirement]) : std::nan("");
  return std::isnan(time) ? widestTime(results, output) : time;
}

}  // namespace gamut
