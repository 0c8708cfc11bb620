// A section an output: its numbers, the place of its interactive plot, and the drawings for paper. One key for all.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reports/drawing/paper.hpp"
#include "reports/drawing/screen.hpp"
#include "reports/drawing/style.hpp"
#include "reports/page/page.hpp"
#include "reports/page/table.hpp"
#include "reports/sections/contribution.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

/// "angle, at the output times guaranteed within [-2.5, 2.4] rad, sampled within .." for those who cannot see the
/// drawing.
std::string description(const Plot& plot) {
  std::string words = plot.name;
  const char* when = plot.isOverTime() ? "at the output times " : "";
  for (const Layer& layer : plot.layers) {
    if (layer.kind != Layer::Kind::band || layer.readout.empty()) continue;
    double low = INFINITY, high = -INFINITY;
    for (const double x : layer.bands.front().lower) low = std::fmin(low, x);
    for (const double x : layer.bands.front().upper) high = std::fmax(high, x);
    if (!(low <= high)) continue;
    const auto [least, greatest] = boundsText(low, high);
    words += fmt::format(", {}{} within [{}, {}]{}{}", std::exchange(when, ""), layer.readout, least, greatest,
                         plot.unit.empty() ? "" : " ", plot.unit);
  }
  return words;
}

/// The view that is seen first is a figure, the others wait behind their names; with the script all are one figure.
std::string figure(const char* view, const std::string& name, const std::string& drawing, bool isFirst) {
  const std::string shown =
      fmt::format("<figure data-view=\"{}\">{}<figcaption>{}</figcaption></figure>\n", view, drawing, escapeHtml(name));
  return isFirst ? shown : fmt::format("<details><summary>{}</summary>{}</details>\n", escapeHtml(name), shown);
}

Plot spreadOf(const Plot& plot, std::size_t times) {
  Plot around = thinned(aroundMiddle(plot), times);
  around.unit = plot.unit.empty() ? "deviation" : fmt::format("deviation ({})", plot.unit);
  return around;
}

/// Whether it is anywhere wider than roundings make it; around the middle of others only these would be seen.
bool hasSpread(const Plot& plot) {
  double size = 0, width = 0;
  for (const Layer& layer : plot.layers) {
    if (!layer.isInSpread || layer.kind == Layer::Kind::line || layer.bands.empty()) continue;
    const Band& band = layer.bands.front();
    for (std::size_t i = 0; i < std::min(band.lower.size(), band.upper.size()); ++i) {
      size = std::fmax(size, std::fmax(std::abs(band.lower[i]), std::abs(band.upper[i])));
      width = std::fmax(width, band.upper[i] - band.lower[i]);
    }
  }
  return !isLittle(width, size);
}

std::string motionSection(const Plot& plot, std::size_t output, const Detail& detail) {
  const std::string words = description(plot);
  const Plot thin = thinned(plot, detail.paperTimes);
  const bool isSpread = plot.isThin();
  const std::string absolute = figure("absolute", "Absolute", drawPlot(thin, "Plot over time of " + words), !isSpread),
                    spread = !hasSpread(plot) ? std::string()
                                              : figure("spread", "Spread around " + plot.middleName(),
                                                       drawPlot(spreadOf(plot, detail.paperTimes),
                                                                "Plot of the spread around the middle of " + words),
                                                       isSpread),
                    ratios = drawRatios(thin, "Plot of the overestimation of " + plot.name);
  return fmt::format(
      "<section class=\"output\" data-output=\"{0}\" data-view=\"{1}\" id=\"output-{0}\">\n<h3>{2}</h3>\n"
      "<script type=\"application/json\">{3}</script>\n"
      "<div class=\"live\" role=\"group\" aria-label=\"{4}\"></div>\n<div "
      "class=\"static\">\n{5}{6}{7}</div>\n</section>\n",
      output, isSpread ? "spread" : "absolute", escapeHtml(plot.name), plotData(plot, detail.times),
      escapeHtml("Interactive plot of " + words), isSpread ? spread : absolute, isSpread ? absolute : spread,
      ratios.empty() ? "" : figure("ratio", "Overestimation", ratios, false));
}

/// The numbers of the bars, as they can be copied.
std::string barNumbers(const Plot& plot) {
  NumbersText numbers;
  std::vector<std::string> names;
  std::vector<double> lower, upper;
  for (const Layer& layer : plot.layers)
    for (std::size_t i = 0; i < layer.bands.size(); ++i) {
      const Band& band = layer.bands[i];
      if (band.lower.empty()) continue;
      names.push_back(layer.kind == Layer::Kind::stack ? fmt::format("{}, level {:g}", layer.name, layer.levels[i])
                                                       : layer.words);
      lower.push_back(band.lower[0]);
      upper.push_back(band.upper.empty() ? band.lower[0] : band.upper[0]);
    }
  numbers.words("", names);
  numbers.column("from", plot.unit, lower, NumbersText::Rounded::down);
  numbers.column("to", plot.unit, upper, NumbersText::Rounded::up);
  return numbers.html();
}

std::string positionSection(const Plot& plot, std::size_t output) {
  return fmt::format(
      "<section class=\"output\" id=\"output-{}\">\n<h3>{}</h3>\n<figure class=\"kept\">{}{}</figure>\n</section>\n",
      output, escapeHtml(plot.name), drawBars(plot, "Bars of " + description(plot)), barNumbers(plot));
}

/// The layers of all plots, each once.
void gather(std::vector<Layer>& key, const Plot& plot) {
  for (const Layer& layer : plot.layers)
    if (std::ranges::find(key, layer.name, &Layer::name) == key.end())
      key.push_back({.name = layer.name, .words = layer.words});
}

/// A drawing that a browser makes when it is unfolded.
std::string foldedFigure(const Plot& plot, const Detail& detail) {
  if (!plot.isOverTime()) return {};
  const std::string heading = escapeHtml(headingOf(plot.name, plot.unit)), words = description(plot);
  const bool isSpread = plot.isThin();
  const std::string drawing =
      isSpread ? drawPlot(spreadOf(plot, detail.paperTimes), "Plot of the spread around the middle of " + words)
               : drawPlot(thinned(plot, detail.paperTimes), "Plot over time of " + words);
  return fmt::format(
      "<details class=\"more folded\"><summary>{0}</summary><figure class=\"kept\">{1}<figcaption>{0}{2}</figcaption>"
      "</figure></details>\n",
      heading, drawing, isSpread ? escapeHtml(", spread around " + plot.middleName()) : "");
}

/// What there is no room to show at once: of each output how far it goes, in numbers, and the drawings of some.
std::string furtherOutputs(const Results& results, const Detail& detail, StyleSheet& style) {
  if (detail.leftOut == 0) return {};
  const std::vector<std::pair<const char*, const Bounds*>> known{{"guaranteed", &results.interval.at},
                                                                 {"sampled", &results.stochastic.envelope}};
  std::vector<std::string> heads{"output"};
  for (const auto& [head, bounds] : known)
    if (!bounds->empty()) heads.emplace_back(head);
  TableText table("Further outputs: the least and the greatest at all output times", heads);
  std::string figures;
  std::size_t rows = 0, folded = 0;
  for (std::size_t k = 0; k < results.outputs.size(); ++k) {
    if (detail.plots(k) || isMargin(results, k)) continue;
    if (++rows > detail.rows) break;
    std::vector<std::string> cells;
    for (const auto& [head, bounds] : known) {
      if (bounds->empty()) continue;
      double low = INFINITY, high = -INFINITY;
      for (std::size_t i = 0; i < bounds->lower.times; ++i) {
        low = std::fmin(low, bounds->lower(i, k));
        high = std::fmax(high, bounds->upper(i, k));
      }
      const auto [least, greatest] = boundsText(low, high);
      cells.push_back(low <= high ? fmt::format("[{}, {}]", least, greatest) : "none");
    }
    table.row(headingOf(results.outputs[k].name, results.outputs[k].unit), cells);
    if (++folded > detail.folded) continue;
    const Plot plot = plotOf(results, k);
    style.add(plot);
    figures += foldedFigure(plot, detail);
  }
  return fmt::format(
      "<p class=\"hint\">{} more {} not shown here, so that the page stays small; the results hold {} at all "
      "times.</p>\n"
      "<details class=\"more\"><summary>What is known of {}</summary>\n{}{}</details>\n",
      detail.leftOut, detail.leftOut == 1 ? "output is" : "outputs are", detail.leftOut == 1 ? "it" : "them",
      detail.leftOut == 1 ? "it" : "them", table.html(), figures);
}

}  // namespace

OutputPlots outputPlots(const Results& results, const Detail& detail) {
  OutputPlots outputs;
  if (results.time.empty()) return outputs;
  StyleSheet style;
  std::vector<Layer> key;
  std::string plots;
  for (std::size_t k = 0; k < results.outputs.size(); ++k) {
    if (!detail.plots(k)) continue;
    const Plot plot = plotOf(results, k);
    style.add(plot);
    gather(key, plot);
    plots += plot.isOverTime() ? motionSection(plot, k, detail) : positionSection(plot, k);
    if (plot.isOverTime() && outputs.data.empty()) outputs.data = timeData(plot, detail.times);
  }
  if (!outputs.data.empty()) outputs.html = drawKey(key, "Key to all plots over time");
  outputs.html += plots + furtherOutputs(results, detail, style);
  outputs.style = style.css();
  return outputs;
}

}  // namespace gamut
