// SVG by hand: bands that break where numbers are missing.
#include "reports/drawing/paper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "reports/drawing/axes.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

Range valuesOf(const std::vector<Layer>& layers) {
  Range values;
  for (const Layer& layer : layers)
    for (const Band& band : layer.bands) values.hold(band);
  return values;
}

class TimeChart {
 public:
  TimeChart(const Plot& plot, const std::vector<Layer>& layers, const Range& y, double height, double width)
      : time_(plot.time), layers_(layers), frame_{{}, y, height, width} {
    frame_.x.hold(plot.time);
  }

  std::string svg(const std::string& axisName, const std::string& label) {
    svg_ = openedDrawing(frame_.height, label, frame_.width);
    draw(axisName);
    return svg_ + "</svg>\n";
  }

  /// On paper that is so wide; behind a gap there is what is known at an instant.
  std::string svgWith(const BesideMoment& moment, double around, const std::string& axisName, const std::string& label,
                      double width) {
    constexpr double gap = 22;
    const double from = frame_.width - marginRight + gap, until = width - marginRight;
    svg_ = openedDrawing(frame_.height, label, width);
    draw(axisName);
    drawBeside(moment, frame_, from, until, around, svg_);
    if (around == 0) drawLimitsAcross(from, until);
    const double now = frame_.across(moment.time);
    Pen pen;
    pen.stroke(now, marginTop, now, frame_.height - marginBottom);
    drawPath("instant", pen, svg_);
    return svg_ + "</svg>\n";
  }

  void marked(const std::vector<Span>& missed) { missed_ = &missed; }

 private:
  void draw(const std::string& axisName) {
    drawHorizontalAxis(frame_, "time (s)", frame_.width < paperWidth ? 5 : 8, svg_);
    drawVerticalAxis(frame_, axisName, 5, svg_);
    for (const bool isFilled : {true, false})  // lines are seen on fills
      for (const Layer& layer : layers_)
        if ((layer.style.fill > 0 && layer.kind != Layer::Kind::line) == isFilled) drawLayer(layer);
    if (missed_ != nullptr) drawMissed(*missed_);
  }

  void drawLayer(const Layer& layer) {
    for (const std::size_t i : layer.shown()) {
      const Band& band = layer.bands[i];
      if (layer.kind == Layer::Kind::whisker) {
        drawWhiskers(band, layer);
      } else if (layer.style.fill > 0 && layer.kind != Layer::Kind::line) {
        drawBand(band, layer);
      } else {
        drawLine(band.lower, layer);
        drawLine(band.upper, layer);
      }
      if (i < layer.labels.size()) drawLabel(layer, i);
    }
  }

  /// Along the lower end of the drawing, wide enough to be seen.
  void drawMissed(const std::vector<Span>& missed) {
    constexpr double thickness = 5, least = 2.5;
    for (const Span& span : missed) {
      const double left = frame_.across(std::max(span.from, time_.front())),
                   right = frame_.across(std::min(span.until, time_.back()));
      if (!(right >= left)) continue;
      const double wide = std::max(right - left, least);
      svg_ += fmt::format("<rect class=\"missed\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\"/>\n",
                          std::clamp(0.5 * (left + right - wide), marginLeft, frame_.width - marginRight - wide),
                          frame_.height - marginBottom - thickness, wide, thickness);
    }
  }

  void drawLimitsAcross(double from, double until) {
    for (const Layer& layer : layers_) {
      if (layer.kind != Layer::Kind::line || layer.labels.empty()) continue;
      Pen pen;
      for (const Band& band : layer.bands)
        if (const auto value = std::ranges::find_if(band.lower, isDrawn); value != band.lower.end())
          pen.stroke(from, frame_.down(*value), until, frame_.down(*value));
      drawPath(layer.name, pen, svg_);
    }
  }

  double across(std::size_t i) const { return frame_.across(time_[i]); }
  double down(double value) const { return frame_.down(clipped(value, frame_.y)); }

  void drawLine(const Line& line, const Layer& layer) {
    Pen pen;
    for (std::size_t i = 0; i < line.size(); ++i) pen.go(across(i), isDrawn(line[i]) ? frame_.down(line[i]) : NAN);
    drawPath(layer.name + (layer.style.fill > 0 ? " alone" : ""), pen, svg_);
  }

  /// One closed outline for each stretch without gaps.
  void drawBand(const Band& band, const Layer& layer) {
    const auto missing = [&](std::size_t i) { return std::isnan(band.lower[i]) || std::isnan(band.upper[i]); };
    const std::size_t count = band.lower.size();
    Pen pen;
    for (std::size_t from = 0; from < count; ++from) {
      if (missing(from)) continue;
      std::size_t to = from;
      while (to + 1 < count && !missing(to + 1)) ++to;
      for (std::size_t i = from; i <= to; ++i) pen.go(across(i), down(band.upper[i]));
      for (std::size_t i = to + 1; i-- > from;) pen.go(across(i), down(band.lower[i]));
      pen.close();
      from = to;
    }
    drawPath(layer.name, pen, svg_);
  }

  /// Where the interval is too short to be seen, its middle is.
  void drawWhiskers(const Band& band, const Layer& layer) {
    constexpr double half = 3;
    Pen pen;
    for (std::size_t i = 0; i < band.lower.size(); ++i) {
      if (!std::isfinite(band.lower[i]) || !std::isfinite(band.upper[i])) continue;
      const double x = across(i), y = down(0.5 * band.lower[i] + 0.5 * band.upper[i]);
      pen.stroke(x, down(band.lower[i]), x, down(band.upper[i]));
      pen.stroke(x - half, y, x + half, y);
    }
    drawPath(layer.name + " estimate", pen, svg_);
  }

  /// How many pieces of lines go through a rectangle of the paper; limits themselves do not count.
  std::size_t crossings(const Layer& own, double left, double right, double top, double bottom) const {
    std::size_t found = 0;
    for (const Layer& layer : layers_) {
      if (layer.name == own.name) continue;
      for (const std::size_t i : layer.shown())
        for (const Line* line : {&layer.bands[i].lower, &layer.bands[i].upper})
          for (std::size_t t = 1; t < line->size(); ++t) {
            const double from = (*line)[t - 1], to = (*line)[t];
            if (!isDrawn(from) || !isDrawn(to) || across(t) < left || across(t - 1) > right) continue;
            if (frame_.down(std::min(from, to)) >= top && frame_.down(std::max(from, to)) <= bottom) ++found;
          }
    }
    return found;
  }

  /// At the last or at the first number of the band, above or below it, over no other label if that can be, where the
  /// fewest lines are: the first of these places if all are alike; of several the others begin below.
  void drawLabel(const Layer& layer, std::size_t i) {
    const Line& line = layer.bands[i].lower;
    const auto first = std::ranges::find_if(line, isDrawn);
    if (first == line.end()) return;
    const auto last = std::find_if(line.rbegin(), line.rend(), isDrawn).base() - 1;
    constexpr double letter = 6.2, size = 11, beside = 4;
    const double wide = letter * static_cast<double>(layer.labels[i].size());
    std::size_t least = std::numeric_limits<std::size_t>::max();
    std::string text;
    Label label;
    for (const bool atEnd : {true, false}) {
      const auto at = atEnd ? last : first;
      const double on = frame_.down(*at),
                   edge = across(static_cast<std::size_t>(at - line.begin())) + (atEnd ? -beside : beside);
      const bool isBelowFirst = i % 2 != 0 || on < marginTop + 16;
      for (const bool isBelow : {isBelowFirst, !isBelowFirst}) {
        const double base = on + (isBelow ? 13 : -4), right = frame_.width - marginRight,
                     left = std::max(marginLeft, std::min(atEnd ? edge - wide : edge, right - wide));
        if (base - size < 0 || base > frame_.height - marginBottom) continue;
        const Label place{left, left + wide, base - size, base + 2};
        constexpr std::size_t unreadable = 1'000'000;
        const std::size_t others = static_cast<std::size_t>(
                              std::ranges::count_if(labels_, [&](const Label&other) { return place.meets(other); })),
                          lines =
                              crossings(layer, place.left, place.right, place.top, place.bottom) + unreadable * others;
        if (lines >= least) continue;
        least = lines;
        text.clear();
        label = place;
        const bool isAtRight = atEnd || left < edge;  // letters may be wider than they are taken for
        drawText(isAtRight ? "end label" : "label", isAtRight ? left + wide : left, base, layer.labels[i], text);
      }
    }
    if (!text.empty()) labels_.push_back(label);
    svg_ += text;
  }

  /// What a label covers.
  struct Label {
    double left = 0, right = 0, top = 0, bottom = 0;

    bool meets(const Label& other) const {
      return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
  };

  const std::vector<double>& time_;
  const std::vector<Layer>& layers_;
  const std::vector<Span>* missed_ = nullptr;
  Frame frame_;
  std::string svg_;
  std::vector<Label> labels_;  ///< that are written
};

}  // namespace

std::string drawPlot(const Plot& plot, const std::string& label) {
  TimeChart chart(plot, plot.layers, valuesOf(plot.layers).padded(0.04), 280, paperWidth);
  chart.marked(plot.missed);
  return chart.svg(plot.unit, label);
}

std::string drawPlotWith(const BesideMoment& moment, double around, const Plot& plot, const std::string& label) {
  constexpr double besideMotion = 220;
  TimeChart chart(plot, plot.layers, valuesOf(plot.layers).padded(0.04), 280, paperWidth - besideMotion);
  chart.marked(plot.missed);
  return chart.svgWith(moment, around, plot.unit, label, paperWidth);
}

std::string drawSmall(const Plot& plot, const std::string& label, bool isShare) {
  const Range y = isShare ? Range{0, 1} : valuesOf(plot.layers).padded(0.04);
  return TimeChart(plot, plot.layers, y, smallHeight, smallWidth).svg(plot.unit, label);
}

std::string drawRatios(const Plot& plot, const std::string& label) {
  if (plot.ratios.empty()) return {};
  Range values = valuesOf(plot.ratios);
  values.hold(1.0);
  return TimeChart(plot, plot.ratios, values.padded(0.08), 280, paperWidth).svg(plot.ratios.front().words, label);
}

std::string drawKey(const std::vector<Layer>& layers, const std::string& label) {
  std::string key = fmt::format("<ul class=\"keys\" aria-label=\"{}\">\n", escapeHtml(label));
  for (const Layer& layer : layers)
    key += fmt::format("<li data-layer=\"{0}\"><span class=\"swatch {0}\"></span>{1}</li>\n", layer.name,
                       escapeHtml(layer.words));
  return key + "</ul>\n";
}

}  // namespace gamut
