// SVG by hand: bands that break where numbers are missing.
#include "reports/drawing/paper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "reports/drawing/axes.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

void drawPath(const std::string& path, const Layer& layer, std::string& svg) {
  if (!path.empty()) fmt::format_to(std::back_inserter(svg), "<path class=\"{}\" d=\"{}\"/>\n", layer.name, path);
}

void drawLine(const std::vector<double>& time, const Line& line, const Frame& frame, const Layer& layer,
              std::string& svg) {
  std::string path;
  bool isDown = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (std::isfinite(line[i]))
      fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", isDown ? "L" : "M", frame.across(time[i]),
                     frame.down(line[i]));
    isDown = std::isfinite(line[i]);
  }
  drawPath(path, layer, svg);
}

/// One closed outline for each stretch without gaps.
void drawBand(const std::vector<double>& time, const Band& band, const Frame& frame, const Layer& layer,
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
  drawPath(path, layer, svg);
}

/// Of a stack a few bands tell the shape on paper: drawing more would only make the page heavier.
void drawLayer(const std::vector<double>& time, const Layer& layer, const Frame& frame, std::string& svg) {
  const std::size_t stride = std::max<std::size_t>(1, (layer.bands.size() + 3) / 5);
  for (std::size_t i = 0; i < layer.bands.size(); i += stride) {
    const Band& band = layer.bands[i];
    if (layer.style.fill > 0) {
      drawBand(time, band, frame, layer, svg);
    } else {
      drawLine(time, band.lower, frame, layer, svg);
      drawLine(time, band.upper, frame, layer, svg);
    }
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
  std::string svg = openedDrawing(frame.height, label);
  drawHorizontalAxis(frame, "time (s)", 8, svg);
  drawVerticalAxis(frame, axisName, ticks, svg);
  for (const Layer& layer : layers) drawLayer(plot.time, layer, frame, svg);
  return svg + "</svg>\n";
}

}  // namespace

std::string drawPlot(const Plot& plot, const std::string& label) {
  const Frame frame{timesOf(plot), valuesOf(plot.layers).padded(0.04), 280};
  return drawLayers(plot, plot.layers, frame, plot.unit, 5, label);
}

std::string drawRatios(const Plot& plot, const std::string& label) {
  if (plot.ratios.empty()) return {};
  Range values = valuesOf(plot.ratios);
  values.hold(1.0);
  const Frame frame{timesOf(plot), values.padded(0.08), 130};
  return drawLayers(plot, plot.ratios, frame, plot.ratios.front().words, 3, label);
}

std::string drawKey(const Plot& plot) {
  std::string key = "<ul class=\"keys\" aria-label=\"Key to the plot\">\n";
  for (const Layer& layer : plot.layers)
    key += fmt::format("<li data-layer=\"{0}\"><span class=\"swatch {0}\"></span>{1}</li>\n", layer.name,
                       escapeHtml(layer.words));
  return key + "</ul>\n";
}

}  // namespace gamut
