// Steps of 1, 2 or 5 times a power of ten.
#include "reports/drawing/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "reports/words.hpp"

namespace gamut {
namespace {

/// Round numbers in a range, about `wanted` of them.
std::vector<double> roundTicks(const Range& range, int wanted) {
  const double raw = (range.high - range.low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double step = power * (raw / power <= 1 ? 1 : raw / power <= 2 ? 2 : raw / power <= 5 ? 5 : 10);
  std::vector<double> ticks;
  if (!(step > 0) || !std::isfinite(step)) return ticks;
  const double first = std::ceil(range.low / step);
  for (int i = 0; i <= 3 * wanted && (first + i) * step <= range.high; ++i) ticks.push_back((first + i) * step + 0.0);
  return ticks;
}

/// Enough digits to tell neighbouring ticks apart.
std::string tickText(double tick, const std::vector<double>& ticks) {
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : std::abs(tick);
  if (std::abs(tick) < 1e-9 * step) return "0";
  const double magnitude = std::max(std::abs(ticks.front()), std::abs(ticks.back()));
  return numberText(tick, digitsFor(magnitude, step, 2));
}

}  // namespace

void Range::hold(double x) {
  if (!std::isfinite(x)) return;
  low = std::min(low, x);
  high = std::max(high, x);
}

void Range::hold(const Line& line) {
  for (const double x : line) hold(x);
}

void Range::hold(const Band& band) {
  hold(band.lower);
  hold(band.upper);
}

Range Range::padded(double share) const {
  if (!(low <= high)) return {0, 1};
  const double width = high - low;
  const double pad = width > 0 ? share * width : std::max(0.5 * std::abs(low), 1e-12);
  return {low - pad, high + pad};
}

double clipped(double value, const Range& range) {
  return std::isnan(value) ? value : std::clamp(value, range.low, range.high);
}

std::string openedDrawing(double height, const std::string& label) {
  return fmt::format("<svg class=\"drawing\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", paperWidth,
                     height, escapeHtml(label));
}

void drawHorizontalAxis(const Frame& frame, const std::string& name, int wanted, std::string& svg) {
  const double end = frame.height - marginBottom;
  const auto ticks = roundTicks(frame.x, wanted);
  for (const double tick : ticks) {
    const double x = frame.across(tick);
    fmt::format_to(std::back_inserter(svg), "<path class=\"grid\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>", x, marginTop, end);
    drawText("tick middle", x, end + 14, tickText(tick, ticks), svg);
  }
  drawText("axis end", paperWidth - marginRight, frame.height - 5, name, svg);
}

void drawVerticalAxis(const Frame& frame, const std::string& name, int wanted, std::string& svg) {
  const auto ticks = roundTicks(frame.y, wanted);
  for (const double tick : ticks) {
    const double y = frame.down(tick);
    fmt::format_to(std::back_inserter(svg), "<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", marginLeft, y,
                   paperWidth - marginRight);
    drawText("tick end", marginLeft - 6, y + 3.5, tickText(tick, ticks), svg);
  }
  drawText("axis", 4, 12, name, svg);
}

void drawText(std::string_view kind, double x, double y, const std::string& text, std::string& svg) {
  fmt::format_to(std::back_inserter(svg), "<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", kind, x, y,
                 escapeHtml(text));
}

}  // namespace gamut
