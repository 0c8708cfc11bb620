// Columns of grids, their hulls over windows, and the reference that narrow bands are drawn around.
#include "reports/curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/words.hpp"

namespace gamut {
namespace {

using Line = std::vector<double>;

Line lineOf(const Grid& grid, std::size_t output) {
  Line line(grid.empty() ? 0 : grid.times);
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = grid(i, output);
  return line;
}

Band bandOf(const Bounds& bounds, std::size_t output) {
  return {lineOf(bounds.lower, output), lineOf(bounds.upper, output)};
}

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

std::size_t nearestQuantile(const Line& probabilities, double wanted) {
  const auto closer = [&](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); };
  return static_cast<std::size_t>(std::min_element(probabilities.begin(), probabilities.end(), closer) -
                                  probabilities.begin());
}

void addQuantiles(const StochasticResult& stochastic, std::size_t output, Curves& curves) {
  const Line& probabilities = stochastic.probabilities;
  if (probabilities.empty() || stochastic.quantiles.size() != probabilities.size()) return;
  const std::size_t low = nearestQuantile(probabilities, 0.05), high = nearestQuantile(probabilities, 0.95);
  if (probabilities[low] < probabilities[high]) {
    curves.probable = {lineOf(stochastic.quantiles[low], output), lineOf(stochastic.quantiles[high], output)};
    curves.lowest = probabilities[low];
    curves.highest = probabilities[high];
  }
  const std::size_t middle = nearestQuantile(probabilities, 0.5);
  if (probabilities[middle] == 0.5) curves.median = lineOf(stochastic.quantiles[middle], output);
}

Line middleOf(const Band& band) {
  Line middle(band.lower.size());
  for (std::size_t i = 0; i < middle.size(); ++i) middle[i] = 0.5 * band.lower[i] + 0.5 * band.upper[i];
  return middle;
}

/// Digits by the widest bounded band against the greatest magnitude; 5 digits of the width are more than any pixel.
int digitsOf(const Curves& curves) {
  double width = 0, magnitude = 0;
  for (const Band* band : {&curves.guaranteed, &curves.sampled}) {
    for (std::size_t i = 0; i < band->lower.size(); ++i) {
      if (!std::isfinite(band->lower[i]) || !std::isfinite(band->upper[i])) continue;
      width = std::max(width, band->upper[i] - band->lower[i]);
      magnitude = std::max({magnitude, std::abs(band->lower[i]), std::abs(band->upper[i])});
    }
  }
  return std::max(8, digitsFor(magnitude, width, 5));
}

void subtract(Line& line, const Line& reference) {
  for (std::size_t i = 0; i < line.size(); ++i) line[i] -= reference[i];
}

void subtract(Band& band, const Line& reference) {
  subtract(band.lower, reference);
  subtract(band.upper, reference);
}

/// Kept times: every stride-th and the last.
std::vector<std::size_t> keptTimes(std::size_t count, std::size_t points) {
  const std::size_t stride = (count - 1 + points - 2) / (points - 1);
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i + 1 < count; i += stride) kept.push_back(i);
  kept.push_back(count - 1);
  return kept;
}

Line picked(const Line& line, const std::vector<std::size_t>& kept) {
  Line result;
  for (const std::size_t i : kept) {
    if (i < line.size()) result.push_back(line[i]);
  }
  return result;
}

Band picked(const Band& band, const std::vector<std::size_t>& kept) {
  return {picked(band.lower, kept), picked(band.upper, kept)};
}

/// Each segment between two kept times lies outside the band: both its ends are at least as far out as every point of
/// the band there. A kept time without a bound stays without.
Band outerHull(const Band& band, const std::vector<std::size_t>& kept) {
  Band hull = picked(band, kept);
  for (std::size_t j = 0; j < hull.lower.size(); ++j) {
    if (std::isnan(hull.lower[j])) continue;
    const std::size_t from = kept[j == 0 ? 0 : j - 1], to = kept[std::min(j + 1, kept.size() - 1)];
    for (std::size_t i = from; i <= to; ++i) {
      hull.lower[j] = std::fmin(hull.lower[j], band.lower[i]);
      hull.upper[j] = std::fmax(hull.upper[j], band.upper[i]);
    }
  }
  return hull;
}

}  // namespace

Curves curvesOf(const Results& results, std::size_t output) {
  Curves curves;
  curves.name = results.outputs[output].name;
  curves.unit = results.outputs[output].unit;
  curves.time = results.time;
  if (results.interval.present) {
    curves.guaranteed = bandOf(results.interval.at, output);
    curves.direct = bandOf(results.interval.direct, output);
    curves.tube = tubeOf(results.interval.over, output);
  }
  if (results.stochastic.present) {
    curves.sampled = bandOf(results.stochastic.envelope, output);
    addQuantiles(results.stochastic, output, curves);
  }
  if (results.fuzzy.present) {
    const std::size_t levels = std::min(results.fuzzy.alpha.size(), results.fuzzy.outer.size());
    for (std::size_t level = 0; level < levels; ++level) {
      if (results.fuzzy.outer[level].empty()) continue;
      curves.alpha.push_back(results.fuzzy.alpha[level]);
      curves.possible.push_back(bandOf(results.fuzzy.outer[level], output));
    }
  }
  curves.overestimation = lineOf(results.comparison.overestimation, output);
  curves.digits = digitsOf(curves);
  return curves;
}

Curves aroundReference(Curves curves) {
  Line reference = curves.median;
  if (reference.empty()) {
    const Band* band = !curves.sampled.empty() ? &curves.sampled : &curves.guaranteed;
    if (band->empty() && !curves.possible.empty()) band = &curves.possible.back();
    reference = middleOf(*band);
  }
  if (reference.empty()) return curves;
  curves.tube = {};
  for (Band* band : {&curves.guaranteed, &curves.direct, &curves.sampled, &curves.probable}) subtract(*band, reference);
  for (Band& cut : curves.possible) subtract(cut, reference);
  subtract(curves.median, reference);
  return curves;
}

Curves thinned(const Curves& curves, std::size_t points) {
  points = std::max<std::size_t>(points, 2);
  if (curves.time.size() <= points) return curves;
  const auto kept = keptTimes(curves.time.size(), points);
  Curves result = curves;
  result.time = picked(curves.time, kept);
  result.tube = outerHull(curves.tube, kept);
  result.guaranteed = outerHull(curves.guaranteed, kept);
  result.direct = outerHull(curves.direct, kept);
  result.sampled = picked(curves.sampled, kept);
  result.probable = picked(curves.probable, kept);
  result.median = picked(curves.median, kept);
  result.overestimation = picked(curves.overestimation, kept);
  for (Band& cut : result.possible) cut = outerHull(cut, kept);
  return result;
}

}  // namespace gamut
