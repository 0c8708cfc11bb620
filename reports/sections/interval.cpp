// What is guaranteed.
#include <cmath>

#include "reports/sections/contribution.hpp"

namespace gamut {
namespace {

/// The tube's bound at time i covers both intervals that meet there, so straight lines between such points stay outside
/// the tube on every interval.
Band tubeOf(const Bounds& over, std::size_t output) {
  const Band rows = bandOf(over, output);
  Band tube = rows;
  for (std::size_t i = 0; i + 1 < rows.lower.size(); ++i) {
    tube.lower[i] = std::fmin(rows.lower[i], rows.lower[i + 1]);  // fmin, fmax: a missing row does not count
    tube.upper[i] = std::fmax(rows.upper[i], rows.upper[i + 1]);
  }
  return tube;
}

std::vector<Column> guaranteedColumns(const Results& results, const Finding&) {
  if (!results.interval.present) return {};
  return {{"guaranteed", &results.interval.at, {}}};
}

void drawGuaranteed(const Results& results, std::size_t output, Plot& plot) {
  const IntervalResult& interval = results.interval;
  if (!interval.present) return;
  if (!interval.over.empty())
    plot.layers.push_back({.name = "tube",
                           .words = "guaranteed at every instant",
                           .style = {colour::grey, 0, 0.7},
                           .isProved = true,
                           .isInSpread = false,
                           .bands = {tubeOf(interval.over, output)}});
  if (!interval.direct.empty())
    plot.layers.push_back({.name = "direct",
                           .words = "plain intervals",
                           .readout = "plain intervals",
                           .style = {colour::grey, 0, 1, true},
                           .isProved = true,
                           .bands = {bandOf(interval.direct, output)}});
  if (!interval.at.empty())
    plot.layers.push_back({.name = "guaranteed",
                           .words = plot.isOverTime() ? "guaranteed at the output times" : "guaranteed",
                           .readout = "guaranteed",
                           .style = {colour::grey, 0, 1.5},
                           .isProved = true,
                           .bands = {bandOf(interval.at, output)}});
}

}  // namespace

const Contribution guaranteed{guaranteedColumns, drawGuaranteed};

}  // namespace gamut
