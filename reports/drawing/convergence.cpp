// The axis of counts is logarithmic, with the counts themselves for ticks.
#include "reports/drawing/convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/drawing/axes.hpp"

namespace gamut {
namespace {

void drawCounts(const Frame& frame, const std::vector<double>& counts, std::string& svg) {
  constexpr double room = 44;  // for the digits of a count
  const double end = frame.height - marginBottom;
  double last = INFINITY;
  Pen grid;
  for (std::size_t i = counts.size(); i-- > 0;) {
    const double x = frame.across(std::log2(counts[i]));
    if (last - x < room) continue;
    last = x;
    grid.stroke(x, marginTop, x, end);
    drawText("tick middle", x, end + 14, fmt::format("{:.0f}", counts[i]), svg);
  }
  drawPath("grid", grid, svg);
  drawText("axis end", frame.width - marginRight, frame.height - 5, "samples", svg);
}

}  // namespace

std::string drawConvergence(const std::vector<double>& counts, const std::vector<Line>& lines, std::size_t main,
                            const std::string& axisName, const std::string& label) {
  Range along, up;
  for (const double count : counts) along.hold(std::log2(count));
  up.hold(0.0);
  bool isLine = false;
  for (const Line& line : lines) {
    up.hold(line);
    isLine = isLine || std::ranges::count_if(line, [](double x) { return std::isfinite(x); }) > 1;
  }
  if (!isLine) return {};
  const Frame frame{along.padded(0.06), {0, up.high > 0 ? 1.04 * up.high : 1}, smallHeight, smallWidth};
  std::string svg = openedDrawing(frame.height, label, frame.width);
  drawCounts(frame, counts, svg);
  drawVerticalAxis(frame, axisName, 5, svg);
  Pen pen;
  const auto draw = [&](const Line& line, const char* kind) {
    for (std::size_t i = 0; i < line.size(); ++i)
      pen.go(frame.across(std::log2(counts[i])), isDrawn(line[i]) ? frame.down(line[i]) : NAN);
    drawPath(kind, pen, svg);
  };
  for (std::size_t o = 0; o < lines.size(); ++o)
    if (o != main) draw(lines[o], "others");
  if (main < lines.size()) draw(lines[main], "main");
  return svg + "</svg>\n";
}

}  // namespace gamut
