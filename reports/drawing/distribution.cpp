// Bounds are stairs: from one value to the next the lower bound of the one and the upper bound of the other. Fewer
// values make stairs that lie outside.
#include "reports/drawing/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "reports/drawing/axes.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

constexpr std::size_t drawnValues = 100;

}  // namespace

Stairs stairsOf(const Results& results, std::size_t at, std::size_t output) {
  const DistributionResult& d = results.distribution;
  const std::span<const double> values = d.values(at, output);
  const std::size_t count = values.size();
  Stairs stairs;
  const std::size_t stride = std::max<std::size_t>(1, count / drawnValues);
  for (std::size_t i = 0; i < count; i = i + stride < count || i + 1 == count ? i + stride : count - 1) {
    stairs.value.push_back(values[i]);
    stairs.lower.push_back(d.lower(at, output, i));
    stairs.upper.push_back(d.upper(at, output, i));
    stairs.sampled.push_back(d.sampled(at, output, i));
  }
  return stairs;
}

std::string drawDistribution(const Results& results, std::size_t at, std::size_t output, const std::string& label) {
  const Stairs stairs = stairsOf(results, at, output);
  const std::size_t count = stairs.value.size();
  if (count < 2) return {};
  Range values;
  values.hold(stairs.value);
  const Frame frame{values.padded(0.02), {0, 1}, smallHeight, smallWidth};
  std::string svg = openedDrawing(frame.height, label, frame.width);
  Pen pen;
  drawHorizontalAxis(frame, headingOf(results.outputs[output].name, results.outputs[output].unit), 4, svg);
  drawVerticalAxis(frame, "cumulative probability", 5, svg);
  const auto go = [&](double value, double probability) {
    pen.go(frame.across(clipped(value, frame.x)), frame.down(std::clamp(probability, 0.0, 1.0)));
  };
  for (std::size_t i = 0; i + 1 < count; ++i) {
    go(stairs.value[i], stairs.upper[i + 1]);
    go(stairs.value[i + 1], stairs.upper[i + 1]);
  }
  for (std::size_t i = count - 1; i-- > 0;) {
    go(stairs.value[i + 1], stairs.lower[i]);
    go(stairs.value[i], stairs.lower[i]);
  }
  pen.close();
  drawPath("bounds", pen, svg);
  if (!std::isnan(stairs.sampled.front())) {
    const auto line = [&](double beside) {
      pen.lift();
      for (std::size_t i = 0; i < count; ++i) go(stairs.value[i], stairs.sampled[i] + beside);
    };
    line(0);
    drawPath("share", pen, svg);
    if (const double band = results.distribution.band; band > 0) {
      line(-band);
      line(band);
      drawPath("band", pen, svg);
    }
  }
  return svg + "</svg>\n";
}

}  // namespace gamut
