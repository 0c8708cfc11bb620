// SVG by hand: axes with round ticks, bands that break where numbers are missing.
#include "reports/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <string_view>
#include <vector>

#include "reports/words.hpp"

namespace gamut {
namespace {

constexpr double frameWidth = 720, left = 66, right = 10, top = 20, bottom = 34;

/// Least and greatest finite number seen.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

  void hold(double x) {
    if (!std::isfinite(x)) return;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  void hold(const Band& band) {
    for (const double x : band.lower) hold(x);
    for (const double x : band.upper) hold(x);
  }
  void hold(const std::vector<double>& line) {
    for (const double x : line) hold(x);
  }
  /// With room around it, and never without width.
  Range padded(double share) const {
    if (!(low <= high)) return {0, 1};
    const double width = high - low;
    const double pad = width > 0 ? share * width : std::max(0.5 * std::abs(low), 1e-12);
    return {low - pad, high + pad};
  }
};

/// Round numbers in a range, about `wanted` of them: steps of 1, 2 or 5 times a power of ten.
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

/// Where numbers lie on the paper.
struct Frame {
  Range x, y;
  double height = 0;

  double across(double value) const { return left + (value - x.low) / (x.high - x.low) * (frameWidth - left - right); }
  double down(double value) const {
    return height - bottom - (value - y.low) / (y.high - y.low) * (height - top - bottom);
  }
};

std::string opened(double height, const std::string& label) {
  return fmt::format("<svg class=\"drawing\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", frameWidth,
                     height, escapeHtml(label));
}

void drawHorizontalAxis(const Frame& frame, const std::string& name, int wanted, std::string& svg) {
  const auto out = std::back_inserter(svg);
  const double end = frame.height - bottom;
  const auto ticks = roundTicks(frame.x, wanted);
  for (const double tick : ticks) {
    const double x = frame.across(tick);
    fmt::format_to(out, "<path class=\"grid\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>", x, top, end);
    fmt::format_to(out, "<text class=\"tick middle\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x, end + 14,
                   tickText(tick, ticks));
  }
  fmt::format_to(out, "<text class=\"axis end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", frameWidth - right,
                 frame.height - 5, escapeHtml(name));
}

void drawVerticalAxis(const Frame& frame, const std::string& name, int wanted, std::string& svg) {
  const auto out = std::back_inserter(svg);
  const auto ticks = roundTicks(frame.y, wanted);
  for (const double tick : ticks) {
    const double y = frame.down(tick);
    fmt::format_to(out, "<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", left, y, frameWidth - right);
    fmt::format_to(out, "<text class=\"tick end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", left - 6, y + 3.5,
                   tickText(tick, ticks));
  }
  fmt::format_to(out, "<text class=\"axis\" x=\"4\" y=\"12\">{}</text>\n", escapeHtml(name));
}

/// Infinite bounds end at the frame's edge; NaN stays NaN.
double clipped(double value, const Range& range) {
  return std::isnan(value) ? value : std::clamp(value, range.low, range.high);
}

void drawLine(const std::vector<double>& time, const std::vector<double>& line, const Frame& frame,
              std::string_view name, std::string& svg) {
  std::string path;
  bool down = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (!std::isfinite(line[i])) {
      down = false;
      continue;
    }
    fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", down ? "L" : "M", frame.across(time[i]),
                   frame.down(line[i]));
    down = true;
  }
  if (!path.empty()) fmt::format_to(std::back_inserter(svg), "<path class=\"{}\" d=\"{}\"/>\n", name, path);
}

/// One closed outline for each stretch without gaps.
void drawBand(const std::vector<double>& time, const Band& band, const Frame& frame, std::string_view name,
              std::string& svg) {
  const auto missing = [&](std::size_t i) { return std::isnan(band.lower[i]) || std::isnan(band.upper[i]); };
  const std::size_t count = band.lower.size();
  std::string path;
  const auto add = [&](std::string_view move, std::size_t i, double value) {
    fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", move, frame.across(time[i]),
                   frame.down(clipped(value, frame.y)));
  };
  for (std::size_t from = 0; from < count; ++from) {
    if (missing(from)) continue;
    std::size_t to = from;
    while (to + 1 < count && !missing(to + 1)) ++to;
    for (std::size_t i = from; i <= to; ++i) add(i == from ? "M" : "L", i, band.upper[i]);
    for (std::size_t i = to + 1; i-- > from;) add("L", i, band.lower[i]);
    path += "Z";
    from = to;
  }
  if (!path.empty()) fmt::format_to(std::back_inserter(svg), "<path class=\"{}\" d=\"{}\"/>\n", name, path);
}

/// Five levels tell the shape on paper: drawing more would only make the page heavier.
std::vector<std::size_t> drawnLevels(std::size_t levels) {
  std::vector<std::size_t> drawn;
  const std::size_t stride = std::max<std::size_t>(1, (levels + 3) / 5);
  for (std::size_t level = 0; level < levels; level += stride) drawn.push_back(level);
  return drawn;
}

/// One horizontal bar; name and numbers are written above it.
struct Bar {
  std::string name, kind;
  double lower, upper;
};

void addBar(const std::string& name, const std::string& kind, const Band& band, std::vector<Bar>& bars) {
  if (!band.empty() && band.lower[0] <= band.upper[0]) bars.push_back({name, kind, band.lower[0], band.upper[0]});
}

std::vector<Bar> answersOf(const Curves& curves) {
  std::vector<Bar> bars;
  addBar("plain intervals", "direct", curves.direct, bars);
  addBar("guaranteed", "guaranteed", curves.guaranteed, bars);
  addBar("sampled", "sampled", curves.sampled, bars);
  addBar(fmt::format("probable: {:g} to {:g} % of the samples", 100 * curves.lowest, 100 * curves.highest), "probable",
         curves.probable, bars);
  return bars;
}

/// Alpha-cuts from the most possible, on top, down to the widest; each named by its level.
std::vector<Bar> cutsOf(const Curves& curves) {
  std::vector<std::size_t> levels(curves.possible.size());
  std::iota(levels.begin(), levels.end(), std::size_t{0});
  std::sort(levels.begin(), levels.end(), [&](auto a, auto b) { return curves.alpha[a] > curves.alpha[b]; });
  std::vector<Bar> cuts;
  for (const std::size_t level : levels) {
    addBar(fmt::format("{:g}", curves.alpha[level]), "possible", curves.possible[level], cuts);
  }
  return cuts;
}

class BarChart {
 public:
  BarChart(const Curves& curves, const std::string& label)
      : curves_(curves), answers_(answersOf(curves)), cuts_(cutsOf(curves)) {
    Range values;
    for (const auto* bars : {&answers_, &cuts_}) {
      for (const Bar& bar : *bars) {
        values.hold(bar.lower);
        values.hold(bar.upper);
      }
    }
    const double height = top + rowHeight * static_cast<double>(answers_.size()) +
                          (cuts_.empty() ? 0 : 24 + cutHeight * static_cast<double>(cuts_.size())) + bottom + 6;
    frame_ = {values.padded(0.04), {0, 1}, height};
    svg_ = opened(height, label);
  }

  std::string draw() {
    drawHorizontalAxis(frame_, curves_.unit, 7, svg_);
    double y = top + 6;
    for (const Bar& bar : answers_) {
      drawAnswer(bar, y);
      y += rowHeight;
    }
    if (!cuts_.empty()) drawCuts(y);
    return svg_ + "</svg>\n";
  }

 private:
  static constexpr double barHeight = 14, rowHeight = 40, cutHeight = 12;

  std::string numbersOf(const Bar& bar) const {
    const std::string unit = curves_.unit.empty() ? "" : " " + curves_.unit;
    return intervalText(bar.lower, bar.upper, curves_.digits) + unit;
  }

  void drawAnswer(const Bar& bar, double y) {
    const std::string text = bar.name + "  " + numbersOf(bar);
    drawText("bar", left, y + 8, text);
    drawBar(bar, y + 13, barHeight, text);
    if (bar.kind == "probable" && !curves_.median.empty() && std::isfinite(curves_.median[0])) {
      fmt::format_to(std::back_inserter(svg_), "<path class=\"median\" d=\"M{:.1f} {:.1f}v{}\"/>\n",
                     frame_.across(curves_.median[0]), y + 11, barHeight + 4);
    }
  }

  void drawCuts(double y) {
    drawText("bar", left, y + 8, "possible: alpha-cuts, the narrowest the most possible");
    y += 13;
    for (const Bar& cut : cuts_) {
      drawBar(cut, y, cutHeight - 1.5, "alpha " + cut.name + ": " + numbersOf(cut));
      drawText("tick end", left - 6, y + 9, cut.name);
      y += cutHeight;
    }
  }

  void drawText(std::string_view kind, double x, double y, const std::string& text) {
    fmt::format_to(std::back_inserter(svg_), "<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", kind, x, y,
                   escapeHtml(text));
  }

  /// Thin bars stay visible: at least one unit wide.
  void drawBar(const Bar& bar, double y, double thickness, const std::string& title) {
    const double from = frame_.across(clipped(bar.lower, frame_.x)), to = frame_.across(clipped(bar.upper, frame_.x));
    fmt::format_to(
        std::back_inserter(svg_),
        "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{}</title></rect>\n",
        bar.kind, from, y, std::max(to - from, 1.0), thickness, escapeHtml(title));
  }

  const Curves& curves_;
  std::vector<Bar> answers_, cuts_;
  Frame frame_{};
  std::string svg_;
};

}  // namespace

std::string drawCurves(const Curves& curves, const std::string& label) {
  constexpr double height = 280;
  Range times, values;
  times.hold(curves.time);
  for (const Band* band : {&curves.tube, &curves.guaranteed, &curves.sampled, &curves.probable}) values.hold(*band);
  for (const Band& cut : curves.possible) values.hold(cut);
  const Frame frame{times, values.padded(0.04), height};

  std::string svg = opened(height, label);
  drawHorizontalAxis(frame, "time (s)", 8, svg);
  drawVerticalAxis(frame, curves.unit, 5, svg);
  drawBand(curves.time, curves.tube, frame, "tube", svg);
  drawBand(curves.time, curves.guaranteed, frame, "guaranteed", svg);
  for (const std::size_t level : drawnLevels(curves.possible.size())) {
    drawBand(curves.time, curves.possible[level], frame, "possible", svg);
  }
  drawBand(curves.time, curves.probable, frame, "probable", svg);
  drawLine(curves.time, curves.median, frame, "median", svg);
  drawLine(curves.time, curves.sampled.lower, frame, "sampled", svg);
  drawLine(curves.time, curves.sampled.upper, frame, "sampled", svg);
  return svg + "</svg>\n";
}

std::string drawOverestimation(const Curves& curves, const std::string& label) {
  constexpr double height = 130;
  Range times, values;
  times.hold(curves.time);
  values.hold(curves.overestimation);
  if (!(values.low <= values.high)) return {};
  values.hold(1.0);
  const Frame frame{times, values.padded(0.08), height};
  std::string svg = opened(height, label);
  drawHorizontalAxis(frame, "time (s)", 8, svg);
  drawVerticalAxis(frame, "overestimation (width guaranteed / width sampled)", 3, svg);
  drawLine(curves.time, curves.overestimation, frame, "overestimation", svg);
  return svg + "</svg>\n";
}

std::string drawBars(const Curves& curves, const std::string& label) { return BarChart(curves, label).draw(); }

}  // namespace gamut
