// What is drawn at an instant stands in units of its own, so that a script can move it with the axis of its plot.
#include "reports/drawing/beside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reports/words.hpp"

namespace gamut {

const BesideMoment& nearestTo(const std::vector<BesideMoment>& moments, double time) {
  return *std::ranges::min_element(moments, {}, [&](const BesideMoment& m) { return std::abs(m.time - time); });
}

void drawBeside(const BesideMoment& moment, const Frame& frame, double from, double until, double around,
                std::string& svg) {
  const double end = frame.height - marginBottom, middle = 0.5 * from + 0.5 * until, side = 0.5 * (until - from);
  Pen grid;
  for (const double x : {from, middle, until}) grid.stroke(x, marginTop, x, end);
  drawPath("grid", grid, svg);
  for (const auto& [x, text] : {std::pair(from, "1"), std::pair(middle, "0"), std::pair(until, "1")})
    drawText("tick middle", x, end + 14, text, svg);
  drawText("axis middle", middle - 0.5 * side, frame.height - 5, "membership", svg);
  drawText("axis middle", middle + 0.5 * side, frame.height - 5, "probability", svg);
  drawText("axis middle", middle, 12, "at " + timeText(moment.time), svg);
  const double bottom = frame.down(moment.low - around), top = frame.down(moment.high - around);
  constexpr double farthest = 1e5;
  if (!(std::abs(bottom) < farthest && std::abs(top) < farthest)) return;
  svg += fmt::format("<g class=\"moment\" transform=\"matrix({:.6g} 0 0 {:.6g} {:.2f} {:.6g})\">\n{}</g>\n",
                     side / besideWidth, (bottom - top) / besideHeight, middle, bottom, moment.shapes);
}

std::string besideTemplate(const std::vector<BesideMoment>& moments, const std::string& label) {
  if (moments.empty()) return {};
  std::string html = fmt::format(
      "<script type=\"image/svg+xml\" class=\"beside\"><svg class=\"drawing beside\" role=\"img\" aria-label=\"{}\">\n",
      escapeHtml(label));
  for (const BesideMoment& moment : moments) {
    constexpr double rounding = 1e-12;  // of the height
    const double finest = rounding * (moment.high - moment.low);
    const auto number = [&](double x) { return numberText(std::abs(x) < finest ? 0 : x, 17); };
    html += fmt::format(
        "<g class=\"moment\" data-at=\"{}\" data-when=\"{}\" data-low=\"{}\" data-high=\"{}\"{}>\n{}</g>\n",
        numberText(moment.time, 12), escapeHtml(timeText(moment.time)), number(moment.low), number(moment.high),
        std::isfinite(moment.middle) ? fmt::format(" data-middle=\"{}\"", number(moment.middle)) : std::string(),
        moment.shapes);
  }
  return html + "</svg></script>\n";
}

}  // namespace gamut
