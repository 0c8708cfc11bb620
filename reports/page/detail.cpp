// Shares of a page: at level 0 some eight megabytes at most for usual results.
#include "reports/page/detail.hpp"

#include <algorithm>
#include <cmath>

#include "reports/page/page.hpp"
#include "reports/sections/limits.hpp"

namespace gamut {
namespace {

constexpr std::size_t mostPlotted = 60, mostFolded = 320, mostCarded = 20, mostTimes = 2000, mostPaperTimes = 200,
                      fullPlots = 8, mostRows = 2000, mostMachineNumbers = 400'000, mostText = 2'000'000;

/// Outputs whose plots may be shown, the most telling first.
std::vector<std::size_t> byInterest(const Results& results) {
  const std::vector<Limit> limits = limitsOf(results);
  std::vector<std::size_t> order;
  std::vector<char> isThere(results.outputs.size(), 0);
  const auto add = [&](std::size_t output) {
    if (output < isThere.size() && isThere[output] == 0) order.push_back(output);
    if (output < isThere.size()) isThere[output] = 1;
  };
  add(foremostOutput(results));
  for (const Limit& limit : limits) add(limit.output);
  for (std::size_t k = 0; k < results.outputs.size(); ++k)
    // A margin of which a plot of its output shows the limit needs none of its own.
    if (std::ranges::none_of(limits, [&](const Limit& limit) { return limit.margin == k && limit.output != k; }))
      add(k);
  return order;
}

/// What is known to vary by more than roundings. Of anything else there is one value at a time, which neither
/// membership nor distribution nor cause would say more of.
bool spreads(const Results& results, std::size_t output) {
  constexpr double rounding = 1e-10;  // of the greatest number
  const Bounds* bounds = bestKnown(results);
  double width = 0, size = 0;
  bool isKnown = false;
  for (std::size_t i = 0; bounds != nullptr && i < bounds->lower.times; ++i) {
    const double lower = bounds->lower(i, output), upper = bounds->upper(i, output);
    if (!std::isfinite(lower) || !std::isfinite(upper)) continue;
    isKnown = true;
    width = std::max(width, upper - lower);
    size = std::max({size, std::abs(lower), std::abs(upper)});
  }
  return !isKnown || width > rounding * size;
}

}  // namespace

Detail detailOf(const Results& results, int level) {
  const auto share = [&](std::size_t most, std::size_t least) { return std::max(most >> level, least); };
  Detail detail;
  const std::vector<std::size_t> order = byInterest(results);
  const std::size_t plotted = std::min(order.size(), share(mostPlotted, 1));
  detail.isPlotted.assign(results.outputs.size(), 0);
  detail.hasCards.assign(results.outputs.size(), 0);
  for (std::size_t i = 0; i < plotted; ++i) detail.isPlotted[order[i]] = 1;
  std::size_t cards = share(mostCarded, 1);
  for (const std::size_t output : order)
    if (!isMargin(results, output) && spreads(results, output) && cards > 0) detail.hasCards[output] = 1, --cards;
  const std::size_t many = std::max(plotted, fullPlots);
  detail.times = share(mostTimes * fullPlots / many, 50);
  detail.paperTimes = share(mostPaperTimes * fullPlots / many, 25);
  detail.rows = share(mostRows, 20);
  detail.machineNumbers = mostMachineNumbers >> level;
  detail.textBytes = share(mostText, 1000);
  detail.leftOut = order.size() - plotted;
  detail.folded = std::min(detail.leftOut, share(mostFolded, 0));
  return detail;
}

}  // namespace gamut
