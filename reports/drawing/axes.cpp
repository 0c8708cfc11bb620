// Steps of 1, 2 or 5 times a power of ten.
#include "reports/drawing/axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "reports/words.hpp"

namespace gamut {
namespace {

/// "-12.3", ".4": tenths as a path takes them.
void append(std::string& path, long long tenths, bool isFirst) {
  if (tenths < 0) {
    path += '-';
  } else if (!isFirst) {
    path += ' ';
  }
  const long long size = tenths < 0 ? -tenths : tenths;
  if (size >= 10 || size == 0) path += std::to_string(size / 10);
  if (size % 10 != 0) path += "." + std::to_string(size % 10);
}

int orderOf(double x) { return static_cast<int>(std::floor(std::log10(x) + 1e-9)); }

/// Round, so that about `wanted` fit into the width, and two at least.
double roundStep(double width, int wanted) {
  const double raw = width / wanted, power = std::pow(10.0, std::floor(std::log10(raw)));
  constexpr double least = 2.5;
  double fitting = power;
  for (const double step : {1.0, 2.0, 5.0, 10.0}) {
    if (step > 1 && width < least * step * power) break;
    fitting = step * power;
    if (raw <= fitting) break;
  }
  return fitting;
}

std::string powerOfTen(int exponent) {
  constexpr const char* raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) text += raised[digit - '0'];
  return text;
}

/// A number in whole multiples of a power of ten: "1234.5678", "1.00000002 \u00d7 10\u2079".
std::string offsetText(double from, double size, double power) {
  const int order = orderOf(size);
  constexpr int small = -4, large = 7;
  if (order >= small && order < large) return fmt::format("{:.{}f}", from, std::clamp(-orderOf(power), 0, 17));
  return fmt::format("{:.{}f} \u00d7 {}", from / std::pow(10.0, order), std::clamp(order - orderOf(power), 0, 17),
                     powerOfTen(order));
}

}  // namespace

void Range::hold(double x) {
  if (!isDrawn(x)) return;
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
  const double width = high - low, size = std::max(std::abs(low), std::abs(high));
  constexpr double rounding = 1e-12;  // what is narrower is a constant
  constexpr double least = 1e-300;    // what is smaller is 0
  const double pad = width > std::max(rounding * size, least) ? share * width : size > least ? 0.5 * size : 1;
  return {low - pad, high + pad};
}

Ticks ticksOf(const Range& range, int wanted) {
  Ticks ticks;
  const double step = roundStep(range.high - range.low, wanted),
               size = std::max(std::abs(range.low), std::abs(range.high));
  if (!(step > 0) || !std::isfinite(step) || !std::isfinite(size)) return ticks;
  constexpr int mostDigits = 6;
  double from = 0;
  if (orderOf(size) - orderOf(step) >= mostDigits) {  // counted from a number with as few digits as the range allows
    const double power = std::pow(10.0, orderOf(range.high - range.low) + 1);
    from = std::floor(0.5 * (range.low + range.high) / power + 0.5) * power;
    ticks.aside = offsetText(from, size, power) + " + \u2026";
  }
  const double first = std::ceil((range.low - from) / step), last = std::floor((range.high - from) / step);
  const double greatest = step * std::max(std::abs(first), std::abs(last));
  int exponent = greatest > 0 ? orderOf(greatest) : 0;
  const bool isLong = exponent >= 5 || exponent < -3 || (exponent < 0 && orderOf(step) < -5);
  exponent = isLong ? 3 * static_cast<int>(std::floor(exponent / 3.0)) : 0;
  if (exponent != 0) ticks.aside += (ticks.aside.empty() ? "× " : " × ") + powerOfTen(exponent);
  const int decimals = std::clamp(exponent - orderOf(step), 0, 12);
  for (double k = first; k <= last && k <= first + 4 * wanted; ++k) {
    ticks.at.push_back(from + k * step);
    ticks.text.push_back(k == 0 ? "0" : fmt::format("{:.{}f}", k * step / std::pow(10.0, exponent), decimals));
  }
  return ticks;
}

std::string axisName(const std::string& name, const Ticks& ticks) {
  return ticks.aside.empty() ? name : name.empty() ? ticks.aside : name + ", " + ticks.aside;
}

/// Far outside no paper is so large that anybody could tell.
void Pen::go(double x, double y) {
  if (std::isnan(x) || std::isnan(y)) return lift();
  constexpr double farthest = 1e6;
  const long long toX = std::llround(10 * std::clamp(x, -farthest, farthest)),
                  toY = std::llround(10 * std::clamp(y, -farthest, farthest));
  path_ += isDown_ ? 'l' : 'M';
  append(path_, isDown_ ? toX - x_ : toX, true);
  append(path_, isDown_ ? toY - y_ : toY, false);
  isDown_ = true;
  x_ = toX;
  y_ = toY;
}

void Pen::stroke(double fromX, double fromY, double toX, double toY) {
  lift();
  go(fromX, fromY);
  go(toX, toY);
  lift();
}

void Pen::close() {
  if (!isDown_) return;
  path_ += 'Z';
  isDown_ = false;
}

std::string Pen::take() {
  isDown_ = false;
  return std::exchange(path_, {});
}

double clipped(double value, const Range& range) {
  return std::isnan(value) ? value : std::clamp(value, range.low, range.high);
}

std::string openedDrawing(double height, const std::string& label, double width) {
  return fmt::format("<svg class=\"drawing\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", width, height,
                     escapeHtml(label));
}

void drawHorizontalAxis(const Frame& frame, const std::string& name, int wanted, std::string& svg) {
  const double end = frame.height - marginBottom;
  const Ticks ticks = ticksOf(frame.x, wanted);
  Pen grid;
  for (std::size_t i = 0; i < ticks.at.size(); ++i) {
    const double x = frame.across(ticks.at[i]);
    grid.stroke(x, marginTop, x, end);
    // Whole, at the drawing's end too.
    const double half = 3.2 * static_cast<double>(ticks.text[i].size());
    drawText("tick middle", std::min(x, frame.width - half), end + 14, ticks.text[i], svg);
  }
  drawPath("grid", grid, svg);
  drawText("axis end", frame.width - marginRight, frame.height - 5, axisName(name, ticks), svg);
}

void drawVerticalAxis(const Frame& frame, const std::string& name, int wanted, std::string& svg) {
  const Ticks ticks = ticksOf(frame.y, wanted);
  Pen grid;
  for (std::size_t i = 0; i < ticks.at.size(); ++i) {
    const double y = frame.down(ticks.at[i]);
    grid.stroke(marginLeft, y, frame.width - marginRight, y);
    drawText("tick end", marginLeft - 6, y + 3.5, ticks.text[i], svg);
  }
  drawPath("grid", grid, svg);
  drawText("axis", 4, 12, axisName(name, ticks), svg);
}

void drawPath(std::string_view kind, Pen& pen, std::string& svg) {
  if (!pen.isEmpty()) fmt::format_to(std::back_inserter(svg), "<path class=\"{}\" d=\"{}\"/>\n", kind, pen.take());
}

void drawText(std::string_view kind, double x, double y, const std::string& text, std::string& svg) {
  if (!std::isfinite(x) || !std::isfinite(y)) return;
  fmt::format_to(std::back_inserter(svg), "<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", kind, x, y,
                 escapeHtml(text));
}

}  // namespace gamut
