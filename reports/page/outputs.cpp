// A row an output, which unfolds: its numbers, the place of its interactive plot, and the drawings for paper. One key
// for all.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "reports/drawing/paper.hpp"
#include "reports/drawing/screen.hpp"
#include "reports/drawing/spark.hpp"
#include "reports/drawing/style.hpp"
#include "reports/page/instant.hpp"
#include "reports/page/page.hpp"
#include "reports/page/table.hpp"
#include "reports/sections/contribution.hpp"
#include "reports/sections/limits.hpp"
#include "reports/words.hpp"
#include "studies/results/extremes.hpp"

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

// ---- Rows -----------------------------------------------------------------------------------------------------------

/// What is told of an output while it is folded away.
struct PanelRow {
  std::string unit, least, whenLeast, greatest, whenGreatest;
  double low = std::numeric_limits<double>::quiet_NaN(), high = low, peak = low;  ///< the latter in s: when
  std::optional<OutputState> state;
};

PanelRow rowOf(const Results& results, std::size_t output) {
  const std::string& unit = results.outputs[output].unit;
  PanelRow row;
  row.unit = unit == "1" ? "" : unit;
  row.state = stateOfOutput(results, output);
  const std::optional<MotionRange> range = bestMotionRange(results, output);
  if (!range) return row;
  std::tie(row.least, row.greatest) = peaksText(range->least.value, range->greatest.value);
  const double size = range->size();
  row.low = isLittle(range->least.value, size) ? 0 : range->least.value;
  row.high = isLittle(range->greatest.value, size) ? 0 : range->greatest.value;
  row.whenLeast = whenLeast(results, *range);
  row.whenGreatest = whenGreatest(results, *range);
  row.peak = std::abs(row.low) > std::abs(row.high) ? range->least.until : range->greatest.until;
  return row;
}

/// "at 0.3 s" without the first word: the column says it.
std::string shortWhen(std::string when) {
  if (when.starts_with("at ")) return when.substr(3);
  if (!when.starts_with("between ")) return when;
  when = when.substr(8);
  const auto between = when.find(" s and ");
  return between == std::string::npos ? when : when.replace(between, 7, " to ");
}

std::string rowHtml(const Plot& plot, const PanelRow& row) {
  const bool isLower = std::abs(row.low) > std::abs(row.high);
  const auto cell = [](const char* name, const char* head, const std::string& text) {
    return fmt::format("<span class=\"{}\" data-head=\"{}\">{}</span>", name, head, escapeHtml(text));
  };
  return fmt::format("<summary class=\"row\"><h3>{}</h3>{}<span class=\"curve\">{}</span>{}{}{}{}</summary>\n",
                     escapeHtml(plot.name), cell("unit", "", row.unit), drawSpark(plot),
                     cell("least", "least", row.least), cell("greatest", "greatest", row.greatest),
                     cell("peak", "peak", shortWhen(isLower ? row.whenLeast : row.whenGreatest)),
                     row.state ? fmt::format("<b class=\"state marked {}\">{}</b>", row.state->tone, row.state->words)
                               : "<b class=\"state\"></b>");
}

/// Numbers by which a reader may order the rows; none where nothing is known.
std::string orderKeys(const PanelRow& row) {
  std::string keys;
  const auto add = [&](const char* name, double number) {
    if (std::isfinite(number)) keys += fmt::format(" data-{}=\"{}\"", name, numberText(number, 9));
  };
  add("least", row.low);
  add("greatest", row.high);
  add("peak", row.peak);
  add("state", row.state ? row.state->severity : std::numeric_limits<double>::quiet_NaN());
  return keys;
}

/// "guaranteed from 0 s to 1 s: least -5.775 m/s^2 between 0.21 s and 0.22 s, greatest …"
std::string rangeSentence(const Results& results, std::size_t output, const PanelRow& row) {
  const std::optional<MotionRange> range = bestMotionRange(results, output);
  if (!range) return "Nothing is known.";
  const char* word = range->source == MotionRange::Source::ofProof     ? "Guaranteed"
                     : range->source == MotionRange::Source::ofSamples ? "Sampled"
                                                                       : "Possible";
  const auto with = [](const std::string& when) { return when.empty() ? "" : " " + when; };
  return fmt::format("{}{}: least {}{}, greatest {}{}.", word,
                     results.horizon == 0 ? std::string() : fmt::format(" up to {}", reachedText(range->until)),
                     inUnit(row.least, row.unit), with(row.whenLeast), inUnit(row.greatest, row.unit),
                     with(row.whenGreatest));
}

std::string panel(const Results& results, const Plot& plot, std::size_t output, const std::string& inside) {
  const PanelRow row = rowOf(results, output);
  return fmt::format(
      "<section class=\"output\"{}{} id=\"output-{}\">\n<details class=\"panel\">{}<p class=\"hint\">{}</p>\n{}"
      "</details>\n</section>\n",
      plot.isOverTime() ? fmt::format(" data-output=\"{}\" data-view=\"absolute\"", output) : "", orderKeys(row),
      output, rowHtml(plot, row), escapeHtml(rangeSentence(results, output, row)), inside);
}

// ---- Panels ---------------------------------------------------------------------------------------------------------

std::string motionSection(const Results& results, const Plot& plot, std::size_t output, const Detail& detail) {
  const std::string words = description(plot);
  const Plot thin = thinned(plot, detail.paperTimes);
  const std::vector<BesideMoment> moments = besideOf(results, output);
  const double instant = instantOf(results, output);
  const BesideMoment* moment = moments.empty() ? nullptr : &nearestTo(moments, std::isnan(instant) ? 0 : instant);
  const auto drawn = [&](const Plot& motion, double around, const std::string& label) {
    return moment == nullptr || std::isnan(around) ? drawPlot(motion, label)
                                                   : drawPlotWith(*moment, around, motion, label);
  };
  const std::string absolute = figure("absolute", "Motion", drawn(thin, 0, "Plot over time of " + words), true),
                    spread =
                        !hasSpread(plot)
                            ? std::string()
                            : figure("spread", "Spread around " + plot.middleName(),
                                     drawn(spreadOf(plot, detail.paperTimes), moment == nullptr ? 0 : moment->middle,
                                           "Plot of the spread around the middle of " + words),
                                     false),
                    ratios = drawRatios(thin, "Plot of the overestimation of " + plot.name);
  return panel(results, plot, output,
               fmt::format("<script type=\"application/json\">{}</script>\n{}"
                           "<div class=\"live\" role=\"group\" aria-label=\"{}\"></div>\n"
                           "<div class=\"static\"><noscript>\n{}{}{}</noscript></div>\n",  // else read when unfolded
                           plotData(plot, detail.times),
                           besideTemplate(moments, "Plot of what is known of " + plot.name + " at an instant"),
                           escapeHtml("Interactive plot of " + words), absolute, spread,
                           ratios.empty() ? "" : figure("ratio", "Overestimation", ratios, false)));
}

/// What the columns of the rows are; a script makes buttons of them, which order the rows.
std::string headsOf(const Results& results) {
  std::string heads = "<div class=\"heads\" aria-hidden=\"true\">";
  for (const auto& [key, words] : {std::pair("name", "output"),
                                   {"", "unit"},
                                   {"", "motion"},
                                   {"least", "least"},
                                   {"greatest", "greatest"},
                                   {"peak", "peak"},
                                   {"state", "requirement"}})
    heads += fmt::format("<span{}>{}</span>", *key == '\0' ? std::string() : fmt::format(" data-key=\"{}\"", key),
                         results.horizon == 0 && words == std::string_view("motion") ? "range"
                         : results.horizon == 0 && words == std::string_view("peak") ? ""
                                                                                     : words);
  return heads + "</div>\n";
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

std::string positionSection(const Results& results, const Plot& plot, std::size_t output) {
  return panel(results, plot, output,
               fmt::format("<figure class=\"kept\">{}{}</figure>\n", drawBars(plot, "Bars of " + description(plot)),
                           barNumbers(plot)));
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
    plots += plot.isOverTime() ? motionSection(results, plot, k, detail) : positionSection(results, plot, k);
    if (plot.isOverTime() && outputs.data.empty()) outputs.data = timeData(plot, detail.times);
  }
  if (!outputs.data.empty()) outputs.html = drawKey(key, "Key to all plots over time");
  if (!plots.empty()) outputs.html += fmt::format("<div class=\"listed\">\n{}{}</div>\n", headsOf(results), plots);
  outputs.html += furtherOutputs(results, detail, style);
  outputs.style = style.css();
  return outputs;
}

}  // namespace gamut
