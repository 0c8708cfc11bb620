// Columns of grids, their hulls over windows, and the middle that narrow bands are drawn around.
#include "reports/drawing/plot.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reports/words.hpp"

namespace gamut {
namespace {

void subtract(Line& line, const Line& middle) {
  for (std::size_t i = 0; i < line.size(); ++i) line[i] -= middle[i];
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
  for (const std::size_t i : kept)
    if (i < line.size()) result.push_back(line[i]);
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

/// Where a window goes farther than its ends and its two kept times do, the farthest stand at these, in the order in
/// which they came; elsewhere what is kept is what was: a line that rises is none of steps. The first and the last
/// number stay.
Line extremesOf(const Line& line, const std::vector<std::size_t>& kept) {
  Line result = picked(line, kept);
  for (std::size_t j = 1; j + 2 < result.size(); j += 2) {
    std::size_t least = kept[j], greatest = kept[j];
    for (std::size_t i = kept[j - 1] + 1; i < kept[j + 2]; ++i) {
      if (line[i] < line[least]) least = i;
      if (line[i] > line[greatest]) greatest = i;
    }
    if (std::isnan(result[j]) || std::isnan(result[j + 1])) continue;
    double low = INFINITY, high = -INFINITY;
    for (std::size_t i = j - 1; i <= j + 2; ++i)
      low = std::fmin(low, line[kept[i]]), high = std::fmax(high, line[kept[i]]);
    const bool isLower = line[least]<low, isHigher = line[greatest]> high;
    if (isLower && isHigher) {
      result[j] = line[std::min(least, greatest)];
      result[j + 1] = line[std::max(least, greatest)];
    } else if (isLower || isHigher) {
      const std::size_t farthest = isLower ? least : greatest;
      result[2 * farthest < kept[j] + kept[j + 1] ? j : j + 1] = line[farthest];
    }
  }
  return result;
}

const Layer* frontMost(const std::vector<Layer>& layers, bool isLine) {
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer)
    if (layer->isInSpread && (layer->kind == Layer::Kind::line) == isLine) return &*layer;
  return nullptr;
}

}  // namespace

Line lineOf(const Table& grid, std::size_t output) {
  Line line(grid.empty() ? 0 : grid.times);
  for (std::size_t i = 0; i < line.size(); ++i) line[i] = grid(i, output);
  return line;
}

Band bandOf(const Bounds& bounds, std::size_t output) {
  return {lineOf(bounds.lower, output), lineOf(bounds.upper, output)};
}

Line Plot::middle() const {
  if (const Layer* line = frontMost(layers, true)) return line->bands.front().lower;
  const Layer* layer = frontMost(layers, false);
  if (layer == nullptr) return {};
  const Band& band = layer->bands.back();
  Line middle(band.lower.size());
  for (std::size_t i = 0; i < middle.size(); ++i) middle[i] = 0.5 * band.lower[i] + 0.5 * band.upper[i];
  return middle;
}

std::string Plot::middleName() const {
  const Layer* line = frontMost(layers, true);
  return line == nullptr ? "the middle" : "the " + line->words;
}

/// By the widest bounded band against the greatest magnitude; 5 digits of the width are more than any pixel.
int Plot::digits() const {
  double width = 0, magnitude = 0;
  for (const Layer& layer : layers) {
    if (!layer.isInSpread || layer.kind == Layer::Kind::line) continue;
    const Band& band = layer.bands.front();  // the widest
    for (std::size_t i = 0; i < band.lower.size(); ++i) {
      if (!std::isfinite(band.lower[i]) || !std::isfinite(band.upper[i])) continue;
      width = std::max(width, band.upper[i] - band.lower[i]);
      magnitude = std::max({magnitude, std::abs(band.lower[i]), std::abs(band.upper[i])});
    }
  }
  return std::max(8, digitsFor(magnitude, width, 5));
}

bool Plot::isThin() const {
  constexpr double hairline = 0.1;    // of the height
  constexpr double rounding = 1e-12;  // of the numbers
  const Line centre = middle();
  const auto [low, high] = [&] {
    double least = INFINITY, greatest = -INFINITY;
    for (const double x : centre)
      if (std::isfinite(x)) least = std::min(least, x), greatest = std::max(greatest, x);
    return std::pair(least, greatest);
  }();
  double width = 0;
  for (const Layer& layer : layers) {
    if (!layer.isInSpread || layer.kind == Layer::Kind::line || width > 0) continue;
    const Band& band = layer.bands.front();
    for (std::size_t i = 0; i < band.lower.size(); ++i)
      if (std::isfinite(band.upper[i] - band.lower[i])) width = std::max(width, band.upper[i] - band.lower[i]);
  }
  return low <= high && width > rounding * std::max(std::abs(low), std::abs(high)) && width < hairline * (high - low);
}

std::vector<std::size_t> Layer::shown() const {
  constexpr std::size_t most = 6;
  std::vector<std::size_t> numbers;
  const std::size_t count = std::min(bands.size(), most);
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(count == 1 ? 0 : (i * (bands.size() - 1) + (count - 1) / 2) / (count - 1));
  return numbers;
}

Plot aroundMiddle(const Plot& plot) {
  Plot around = plot;
  const Line middle = plot.middle();
  std::erase_if(around.layers, [](const Layer& layer) { return !layer.isInSpread; });
  for (Layer& layer : around.layers)
    for (Band& band : layer.bands) {
      subtract(band.lower, middle);
      subtract(band.upper, middle);
    }
  return around;
}

Plot thinned(const Plot& plot, std::size_t points) {
  points = std::max<std::size_t>(points, 2);
  if (plot.time.size() <= points) return plot;
  const auto kept = keptTimes(plot.time.size(), points);
  Plot result = plot;
  result.time = picked(plot.time, kept);
  for (auto* layers : {&result.layers, &result.ratios})
    for (Layer& layer : *layers)
      for (Band& band : layer.bands) {
        const bool isBand = layer.kind != Layer::Kind::line && !band.upper.empty();
        band = isBand ? outerHull(band, kept) : Band{extremesOf(band.lower, kept), {}};
      }
  return result;
}

}  // namespace gamut
