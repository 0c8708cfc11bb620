// Lines of limits, and which of them is nearest.
#include "reports/sections/limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

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

void drawRequired(const Results& results, std::size_t output, Plot& plot) {
  Layer layer{.name = "limit",
              .words = "limit of a requirement",
              .style = {colour::red, 0, 1.8, true},
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
  }
  if (!layer.bands.empty()) plot.layers.push_back(std::move(layer));
}

std::vector<Column> requiredColumns(const Results&, const Finding&) { return {}; }

}  // namespace

const Contribution required{requiredColumns, drawRequired};

std::vector<Limit> limitsOf(const Results& results) {
  std::vector<Limit> limits;
  for (std::size_t r = 0; r < results.requirements.size(); ++r)
    for (const MarginInfo& margin : marginsOf(results, results.requirements[r]))
      limits.push_back({r, margin.output, margin.limited, margin.limit});
  return limits;
}

std::optional<Limit> nearestLimit(const Results& results) {
  const std::vector<Limit> limits = limitsOf(results);
  const Bounds* bounds = bestKnown(results);
  std::optional<Limit> nearest;
  double least = INFINITY;
  for (std::size_t r = 0; bounds != nullptr && r < results.requirements.size(); ++r) {
    const RequirementResult& requirement = results.requirements[r];
    double slack = requirement.isAlways ? INFINITY : -INFINITY;
    const Limit* decisive = nullptr;
    for (std::size_t i = 0; i < results.time.size(); ++i) {
      if (results.horizon > 0 && (results.time[i] < requirement.from || results.time[i] > requirement.until)) continue;
      const Limit* tightest = nullptr;
      for (const Limit& limit : limits)
        if (limit.requirement == r && std::isfinite(bounds->lower(i, limit.margin)) &&
            (tightest == nullptr || bounds->lower(i, limit.margin) < bounds->lower(i, tightest->margin)))
          tightest = &limit;
      if (tightest == nullptr) continue;
      const double margin = bounds->lower(i, tightest->margin);
      if (decisive != nullptr && !(requirement.isAlways ? margin < slack : margin > slack)) continue;
      slack = margin;
      decisive = tightest;
    }
    if (decisive == nullptr) continue;
    double low = INFINITY, high = -INFINITY;
    for (std::size_t i = 0; i < results.time.size(); ++i) {
      low = std::fmin(low, bounds->lower(i, decisive->margin));
      high = std::fmax(high, bounds->upper(i, decisive->margin));
    }
    const double share = slack / std::max(high - low, std::numeric_limits<double>::min());
    if (nearest && share >= least) continue;
    least = share;
    nearest = *decisive;
  }
  if (!nearest && !limits.empty()) nearest = limits.front();
  return nearest;
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
