// SVG by hand: bands that break where numbers are missing.
#include "reports/drawing/paper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "reports/drawing/axes.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

/// `kind`: a second class, after a blank.
void drawPath(Pen& pen, const Layer& layer, std::string& svg, const char* kind = "") {
  if (!pen.isEmpty())
    fmt::format_to(std::back_inserter(svg), "<path class=\"{}{}\" d=\"{}\"/>\n", layer.name, kind, pen.take());
}

void drawLine(const std::vector<double>& time, const Line& line, const Frame& frame, const Layer& layer,
              std::string& svg) {
  Pen pen;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (isDrawn(line[i])) {
      pen.go(frame.across(time[i]), frame.down(line[i]));
    } else {
      pen.lift();
    }
  }
  drawPath(pen, layer, svg, layer.style.fill > 0 ? " alone" : "");
}

/// One closed outline for each stretch without gaps.
void drawBand(const std::vector<double>& time, const Band& band, const Frame& frame, const Layer& layer,
              std::string& svg) {
  const auto missing = [&](std::size_t i) { return std::isnan(band.lower[i]) || std::isnan(band.upper[i]); };
  const std::size_t count = band.lower.size();
  Pen pen;
  const auto add = [&](std::size_t i, double value) {
    pen.go(frame.across(time[i]), frame.down(clipped(value, frame.y)));
  };
  for (std::size_t from = 0; from < count; ++from) {
    if (missing(from)) continue;
    std::size_t to = from;
    while (to + 1 < count && !missing(to + 1)) ++to;
    for (std::size_t i = from; i <= to; ++i) add(i, band.upper[i]);
    for (std::size_t i = to + 1; i-- > from;) add(i, band.lower[i]);
    pen.close();
    from = to;
  }
  drawPath(pen, layer, svg);
}

/// Where the interval is too short to be seen, its middle is.
void drawWhiskers(const std::vector<double>& time, const Band& band, const Frame& frame, const Layer& layer,
                  std::string& svg) {
  constexpr double half = 3;
  Pen pen;
  for (std::size_t i = 0; i < band.lower.size(); ++i) {
    if (!std::isfinite(band.lower[i]) || !std::isfinite(band.upper[i])) continue;
    const double x = frame.across(time[i]), y = frame.down(clipped(0.5 * band.lower[i] + 0.5 * band.upper[i], frame.y));
    pen.go(x, frame.down(clipped(band.lower[i], frame.y)));
    pen.go(x, frame.down(clipped(band.upper[i], frame.y)));
    pen.lift();
    pen.go(x - half, y);
    pen.go(x + half, y);
    pen.lift();
  }
  drawPath(pen, layer, svg, " estimate");
}

/// How many pieces of lines go through a rectangle of the paper; limits themselves do not count.
std::size_t crossings(const std::vector<double>& time, const std::vector<Layer>& layers, const Layer& own,
                      const Frame& frame, double left, double right, double top, double bottom) {
  std::size_t found = 0;
  for (const Layer& layer : layers) {
    if (layer.name == own.name) continue;
    for (const std::size_t i : layer.shown())
      for (const Line* line : {&layer.bands[i].lower, &layer.bands[i].upper})
        for (std::size_t t = 1; t < line->size(); ++t) {
          const double from = (*line)[t - 1], to = (*line)[t];
          if (!isDrawn(from) || !isDrawn(to)) continue;
          if (frame.across(time[t]) < left || frame.across(time[t - 1]) > right) continue;
          const double above = frame.down(std::max(from, to)), below = frame.down(std::min(from, to));
          if (below >= top && above <= bottom) ++found;
        }
  }
  return found;
}

/// At the last or at the first number of the band, above or below it, where the fewest lines are: the first of these
/// places if all are alike; of several the others begin below.
void drawLabel(const std::vector<double>& time, const std::vector<Layer>& layers, const Layer& layer, std::size_t i,
               const Frame& frame, std::string& svg) {
  const Line& line = layer.bands[i].lower;
  const auto isThere = [](double x) { return isDrawn(x); };
  const auto first = std::ranges::find_if(line, isThere);
  if (first == line.end()) return;
  std::size_t last = line.size();
  while (!isThere(line[last - 1])) --last;
  constexpr double letter = 6.2, size = 11, beside = 4;
  const double wide = letter * static_cast<double>(layer.labels[i].size());
  std::size_t least = std::numeric_limits<std::size_t>::max();
  bool isEnd = true;
  double x = 0, y = 0;
  for (const bool atEnd : {true, false}) {
    const std::size_t at = atEnd ? last - 1 : static_cast<std::size_t>(first - line.begin());
    const double on = frame.down(line[at]), edge = frame.across(time[at]) + (atEnd ? -beside : beside);
    const bool isBelowFirst = i % 2 != 0 || on < marginTop + 16;
    for (const bool isBelow : {isBelowFirst, !isBelowFirst}) {
      const double base = on + (isBelow ? 13 : -4), left = atEnd ? edge - wide : edge;
      if (base - size < 0 || base > frame.height - marginBottom) continue;
      const std::size_t lines = crossings(time, layers, layer, frame, left, left + wide, base - size, base + 2);
      if (lines >= least) continue;
      least = lines;
      isEnd = atEnd;
      x = edge;
      y = base;
    }
  }
  if (least < std::numeric_limits<std::size_t>::max())
    drawText(isEnd ? "end label" : "label", x, y, layer.labels[i], svg);
}

void drawLayer(const std::vector<double>& time, const std::vector<Layer>& layers, const Layer& layer,
               const Frame& frame, std::string& svg) {
  for (const std::size_t i : layer.shown()) {
    const Band& band = layer.bands[i];
    if (layer.kind == Layer::Kind::whisker) {
      drawWhiskers(time, band, frame, layer, svg);
    } else if (layer.style.fill > 0 && layer.kind != Layer::Kind::line) {
      drawBand(time, band, frame, layer, svg);
    } else {
      drawLine(time, band.lower, frame, layer, svg);
      drawLine(time, band.upper, frame, layer, svg);
    }
    if (i < layer.labels.size()) drawLabel(time, layers, layer, i, frame, svg);
  }
}

Range timesOf(const Plot& plot) {
  Range times;
  times.hold(plot.time);
  return times;
}

Range valuesOf(const std::vector<Layer>& layers) {
  Range values;
  for (const Layer& layer : layers)
    for (const Band& band : layer.bands) values.hold(band);
  return values;
}

std::string drawLayers(const Plot& plot, const std::vector<Layer>& layers, const Frame& frame,
                       const std::string& axisName, int ticks, const std::string& label) {
  std::string svg = openedDrawing(frame.height, label, frame.width);
  drawHorizontalAxis(frame, "time (s)", frame.width < paperWidth ? 5 : 8, svg);
  drawVerticalAxis(frame, axisName, ticks, svg);
  for (const Layer& layer : layers) drawLayer(plot.time, layers, layer, frame, svg);
  return svg + "</svg>\n";
}

}  // namespace

std::string drawPlot(const Plot& plot, const std::string& label) {
  const Frame frame{timesOf(plot), valuesOf(plot.layers).padded(0.04), 280};
  return drawLayers(plot, plot.layers, frame, plot.unit, 5, label);
}

std::string drawShares(const Plot& plot, const std::string& label) {
  const Frame frame{timesOf(plot), {0, 1}, smallHeight, smallWidth};
  return drawLayers(plot, plot.layers, frame, plot.unit, 5, label);
}

std::string drawSmall(const Plot& plot, const std::string& label) {
  const Frame frame{timesOf(plot), valuesOf(plot.layers).padded(0.04), smallHeight, smallWidth};
  return drawLayers(plot, plot.layers, frame, plot.unit, 5, label);
}

std::string drawRatios(const Plot& plot, const std::string& label) {
  if (plot.ratios.empty()) return {};
  Range values = valuesOf(plot.ratios);
  values.hold(1.0);
  const Frame frame{timesOf(plot), values.padded(0.08), 280};
  return drawLayers(plot, plot.ratios, frame, plot.ratios.front().words, 5, label);
}

std::string drawKey(const std::vector<Layer>& layers, const std::string& label) {
  std::string key = fmt::format("<ul class=\"keys\" aria-label=\"{}\">\n", escapeHtml(label));
  for (const Layer& layer : layers)
    key += fmt::format("<li data-layer=\"{0}\"><span class=\"swatch {0}\"></span>{1}</li>\n", layer.name,
                       escapeHtml(layer.words));
  return key + "</ul>\n";
}

}  // namespace gamut
