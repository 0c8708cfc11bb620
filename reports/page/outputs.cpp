// A section an output: its key, the place of its interactive plot, and the drawings for paper.
#include <fmt/format.h>

#include <cmath>

#include "reports/drawing/paper.hpp"
#include "reports/drawing/screen.hpp"
#include "reports/drawing/style.hpp"
#include "reports/page/page.hpp"
#include "reports/sections/contribution.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

/// Paper shows no more points than this.
constexpr std::size_t drawnTimes = 240;

/// "angle, guaranteed within [-2.5, 2.4] rad, sampled within .." for those who cannot see the drawing.
std::string description(const Plot& plot) {
  std::string words = plot.name;
  for (const Layer& layer : plot.layers) {
    if (layer.kind != Layer::Kind::band || layer.readout.empty()) continue;
    double low = INFINITY, high = -INFINITY;
    for (const double x : layer.bands.front().lower) low = std::fmin(low, x);
    for (const double x : layer.bands.front().upper) high = std::fmax(high, x);
    if (low <= high)
      words += fmt::format(", {} within {}{}{}", layer.readout, intervalText(low, high, 4),
                           plot.unit.empty() ? "" : " ", plot.unit);
  }
  return words;
}

std::string figure(const std::string& drawing, const std::string& caption) {
  return "<figure>" + drawing + (caption.empty() ? "" : "<figcaption>" + escapeHtml(caption) + "</figcaption>") +
         "</figure>\n";
}

std::string motionSection(const Plot& plot, std::size_t output) {
  const std::string words = description(plot);
  const Plot thin = thinned(plot, drawnTimes);
  std::string html =
      fmt::format("<section class=\"output\" data-output=\"{}\">\n<h3>{}</h3>\n", output, escapeHtml(plot.name));
  html += drawKey(plot);
  html += fmt::format("<div class=\"live\" role=\"group\" aria-label=\"{}\"></div>\n<div class=\"static\">\n",
                      escapeHtml("Interactive plot of " + words));
  html += figure(drawPlot(thin, "Plot over time of " + words), "Over time");
  html += figure(drawPlot(thinned(aroundMiddle(plot), drawnTimes), "Plot of the spread around the middle of " + words),
                 "Spread around " + plot.middleName());
  const std::string ratios = drawRatios(thin, "Plot of the overestimation of " + plot.name);
  return html + (ratios.empty() ? "" : figure(ratios, "")) + "</div>\n</section>\n";
}

std::string positionSection(const Plot& plot) {
  return fmt::format("<section class=\"output\">\n<h3>{}</h3>\n{}</section>\n", escapeHtml(plot.name),
                     figure(drawBars(plot, "Bars of " + description(plot)), ""));
}

}  // namespace

OutputPlots outputPlots(const Results& results) {
  OutputPlots outputs;
  if (results.time.empty()) return outputs;
  StyleSheet style;
  PlotData data;
  for (std::size_t k = 0; k < results.outputs.size(); ++k) {
    const Plot plot = plotOf(results, k);
    style.add(plot);
    if (plot.isOverTime()) {
      outputs.html += motionSection(plot, k);
      data.add(plot);
    } else {
      outputs.html += positionSection(plot);
    }
  }
  outputs.style = style.css();
  if (results.time.size() > 1) outputs.data = data.json();
  return outputs;
}

}  // namespace gamut
