// Guaranteed, probable and possible side by side, in the colours that they have in a study's report. A map is of cells
// about the values; where it has many, those of one look that lie side by side are drawn as one.
#include "reports/sweep_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "reports/drawing/axes.hpp"
#include "reports/page/parts.hpp"
#include "reports/page/skeleton.hpp"
#include "reports/page/table.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

constexpr std::size_t mostSlices = 24, mostOutputs = 20, mostPointRows = 200, mostTold = 5000;

constexpr std::string_view looks = R"(
.trio { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 17rem), 1fr)); gap: 0 1.2rem; }
.sweep .single { max-width: 34rem; }
.trio figcaption { font-weight: 600; color: var(--ink); }
.sweep .met { fill: var(--inside); background: var(--inside); }
.sweep .violated { fill: var(--outside); background: var(--outside); }
.sweep .partly { fill: var(--drawn); background: var(--drawn); }
.sweep .open { fill: var(--soft); fill-opacity: 0.35; background: color-mix(in srgb, var(--soft) 35%, transparent); }
.sweep .none { fill: none; stroke: var(--rule); border: 1px solid var(--rule); }
.sweep .share { fill: var(--drawn); background: var(--drawn); }
.sweep .necessity { fill: var(--likely); background: var(--likely); }
.sweep .value { fill: var(--sure); background: var(--sure); }
.sweep path.share, .sweep path.necessity, .sweep path.value { fill-opacity: 0.35; stroke-width: 1.4; }
.sweep path.share { stroke: var(--drawn); }
.sweep path.necessity { stroke: var(--likely); }
.sweep path.value { stroke: var(--sure); }
.sweep path.sampled { stroke: var(--drawn); stroke-width: 1.2; }
.sweep rect { stroke: none; }
.sweep rect.none { stroke: var(--rule); stroke-width: 0.5; }
.sweep .swatch.sampled { height: 0; border-top: 2px solid var(--drawn); }
)";

constexpr std::array<std::string_view, 4> decisionLooks{"open", "met", "violated", "partly"};

/// "rod.length (m)".
std::string axisTitle(const SweepAxis& axis) { return headingOf(axis.name, axis.toldUnit()); }

/// Points of which the axes beside the drawn ones have one value each.
struct SweepSlice {
  std::vector<std::size_t> points;  ///< the first drawn axis runs slowest
  std::string told;                 ///< "speed = 2"; empty of one slice alone
};

/// The axes that are drawn come first.
std::vector<SweepSlice> slicesOf(const SweepPlan& plan, std::size_t drawn) {
  std::size_t within = 1;
  for (std::size_t a = 0; a < drawn; ++a) within *= plan.axes[a].values.size();
  const std::size_t count = plan.points() / within;
  std::vector<SweepSlice> slices(count);
  for (std::size_t s = 0; s < count; ++s) {
    for (std::size_t i = 0; i < within; ++i) slices[s].points.push_back(i * count + s);
    for (std::size_t a = drawn; a < plan.axes.size(); ++a)
      slices[s].told += fmt::format("{}{} = {}", slices[s].told.empty() ? "" : ", ", plan.axes[a].name,
                                    inUnit(numberText(plan.value(s, a), 6), plan.axes[a].toldUnit()));
  }
  return slices;
}

/// Half way to the neighbours, as far on the outside.
std::vector<double> edgesOf(const std::vector<double>& values) {
  if (values.size() == 1) {
    const double half = values[0] == 0 ? 0.5 : 0.5 * std::abs(values[0]);
    return {values[0] - half, values[0] + half};
  }
  std::vector<double> edges{values[0] - 0.5 * (values[1] - values[0])};
  for (std::size_t i = 1; i < values.size(); ++i) edges.push_back(0.5 * (values[i - 1] + values[i]));
  edges.push_back(values.back() + (values.back() - edges.back()));
  return edges;
}

/// How a cell looks: a class, how strong it is (0 to 1), and what is said of it.
struct MapCell {
  std::string_view look;
  double strength = 1;
  std::string told;
};
using MapCellOf = std::function<MapCell(std::size_t point)>;

std::string entryOf(std::string_view look, std::string_view words, double strength = 1) {
  return fmt::format("<li><span class=\"swatch {}\"{}></span>{}</li>\n", look,
                     strength < 1 ? fmt::format(" style=\"opacity:{:.2f}\"", strength) : "", words);
}

// ---- Maps -----------------------------------------------------------------------------------------------------------

void drawCell(const Frame& frame, const Range& x, const Range& y, const MapCell& cell, const std::string& told,
              std::string& svg) {
  svg += fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"", cell.look,
                     frame.across(x.low), frame.down(y.high), frame.across(x.high) - frame.across(x.low),
                     frame.down(y.low) - frame.down(y.high));
  if (cell.strength < 1) svg += fmt::format(" fill-opacity=\"{:.2f}\"", cell.strength);
  svg += told.empty() ? "/>\n" : fmt::format("><title>{}</title></rect>\n", escapeHtml(told));
}

std::string mapOf(const SweepPlan& plan, const SweepSlice& slice, const MapCellOf& of, const std::string& label) {
  const SweepAxis &across = plan.axes[0], &up = plan.axes[1];
  const std::vector<double> x = edgesOf(across.values), y = edgesOf(up.values);
  const Frame frame{{x.front(), x.back()}, {y.front(), y.back()}, 300, 340};
  std::string svg = openedDrawing(frame.height, label, frame.width);
  drawHorizontalAxis(frame, axisTitle(across), 4, svg);
  drawVerticalAxis(frame, axisTitle(up), 5, svg);
  const bool isTold = slice.points.size() <= mostTold;
  const std::size_t rows = up.values.size();
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < across.values.size();) {
      const std::size_t point = slice.points[i * rows + j], from = i++;
      const MapCell cell = of(point);
      while (!isTold && i < across.values.size()) {
        const MapCell next = of(slice.points[i * rows + j]);
        if (next.look != cell.look || std::abs(next.strength - cell.strength) > 0.005) break;
        ++i;
      }
      drawCell(frame, {x[from], x[i]}, {y[j], y[j + 1]}, cell, isTold ? plan.told(point) + ": " + cell.told : "", svg);
    }
  return svg + "</svg>\n";
}

// ---- Curves ---------------------------------------------------------------------------------------------------------

/// What is drawn over one number.
struct SweepCurve {
  std::string_view look;
  std::vector<double> lower, upper;
};

void drawCurve(const Frame& frame, const std::vector<double>& x, const SweepCurve& curve, std::string& svg) {
  const auto isThere = [&](std::size_t i) { return isDrawn(curve.lower[i]) && isDrawn(curve.upper[i]); };
  Pen pen;
  for (std::size_t from = 0, until; from < x.size(); from = until + 1) {
    for (until = from; until < x.size() && isThere(until); ++until) {
    }
    if (until == from) continue;
    pen.lift();
    for (std::size_t i = from; i < until; ++i) pen.go(frame.across(x[i]), frame.down(curve.upper[i]));
    for (std::size_t i = until; i-- > from;) pen.go(frame.across(x[i]), frame.down(curve.lower[i]));
    pen.close();
  }
  drawPath(curve.look, pen, svg);
}

/// Curves in a frame as high as they are, unless it is stated.
std::string curvesOf(const SweepAxis& axis, const std::vector<SweepCurve>& curves, const std::string& name,
                     const std::string& label, std::optional<Range> height) {
  Range x, y;
  x.hold(axis.values);
  for (const SweepCurve& curve : curves) y.hold(Band{curve.lower, curve.upper});
  const Frame frame{x.padded(0.02), height.value_or(y.padded(0.06)), smallHeight, smallWidth};
  std::string svg = openedDrawing(frame.height, label, frame.width);
  drawHorizontalAxis(frame, axisTitle(axis), 6, svg);
  drawVerticalAxis(frame, name, 5, svg);
  for (const SweepCurve& curve : curves) drawCurve(frame, axis.values, curve, svg);
  return svg + "</svg>\n";
}

/// Cells in a row over one number.
std::string stripOf(const SweepPlan& plan, const SweepSlice& slice, const MapCellOf& of, const std::string& label) {
  const SweepAxis& axis = plan.axes[0];
  const std::vector<double> edges = edgesOf(axis.values);
  const Frame frame{{edges.front(), edges.back()}, {0, 1}, 110, smallWidth};
  std::string svg = openedDrawing(frame.height, label, frame.width);
  drawHorizontalAxis(frame, axisTitle(axis), 6, svg);
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    const MapCell cell = of(slice.points[i]);
    drawCell(frame, {edges[i], edges[i + 1]}, {0, 1}, cell, plan.told(slice.points[i]) + ": " + cell.told, svg);
  }
  return svg + "</svg>\n";
}

// ---- Requirements ---------------------------------------------------------------------------------------------------

/// The three answers of one requirement.
class DemandOverSweep {
 public:
  DemandOverSweep(const SweepResults& sweep, std::size_t requirement) : sweep_(sweep), requirement_(requirement) {}

  double at(OfRequirement column, std::size_t point) const { return sweep_.at(column, point, requirement_); }

  MapCell guaranteed(std::size_t p) const {
    const double word = at(OfRequirement::word, p);
    if (std::isnan(word)) return missing(p);
    const auto decision = static_cast<std::size_t>(word);
    constexpr std::array told{"open", "met for all values", "violated for all values", "violated for some values"};
    return {decisionLooks.at(decision), 1, told.at(decision)};
  }
  MapCell probable(std::size_t p) const {
    const double lower = at(OfRequirement::probabilityLower, p), upper = at(OfRequirement::probabilityUpper, p);
    if (std::isnan(lower)) return missing(p);
    const auto [low, high] = outwardText(lower, upper, 4);
    return {"share", lower, fmt::format("met with a probability of {} to {}", low, high)};
  }
  MapCell possible(std::size_t p) const {
    const double lower = at(OfRequirement::possibilityLower, p), upper = at(OfRequirement::possibilityUpper, p);
    if (std::isnan(lower)) return missing(p);
    const auto [low, high] = outwardText(1 - upper, 1 - lower, 4);
    return {"necessity", 1 - upper, fmt::format("met with a necessity of {} to {}", low, high)};
  }
  SweepCurve probability(const SweepSlice& slice) const {
    return curve("share", slice, [&](std::size_t p) {
      return std::pair(at(OfRequirement::probabilityLower, p), at(OfRequirement::probabilityUpper, p));
    });
  }
  SweepCurve necessity(const SweepSlice& slice) const {
    return curve("necessity", slice, [&](std::size_t p) {
      return std::pair(1 - at(OfRequirement::possibilityUpper, p), 1 - at(OfRequirement::possibilityLower, p));
    });
  }

 private:
  MapCell missing(std::size_t point) const {
    const SweepPoint& p = sweep_.points[point];
    return {"none", 1, p.state == PointState::open ? "not run" : p.why};
  }
  template <class Of>
  static SweepCurve curve(std::string_view look, const SweepSlice& slice, const Of& of) {
    SweepCurve curve{look, {}, {}};
    for (const std::size_t point : slice.points) {
      const auto [lower, upper] = of(point);
      curve.lower.push_back(lower);
      curve.upper.push_back(upper);
    }
    return curve;
  }

  const SweepResults& sweep_;
  std::size_t requirement_;
};

std::string keyToDemands(bool isMap) {
  const std::string strength = isMap ? "; the stronger, the nearer to 1 its lower bound" : "";
  return "<ul class=\"keys\" aria-label=\"Key\">\n" + entryOf("met", "guaranteed: met for all values") +
         entryOf("violated", "violated for all") + entryOf("partly", "violated for some") + entryOf("open", "open") +
         entryOf("share", "probable: between proved bounds of the probability that it is met" + strength) +
         entryOf("necessity", "possible: between proved bounds of the necessity that it is met" + strength) +
         entryOf("none", "no results") + "</ul>\n" +
         fmt::format("<p class=\"hint\">What lies between two points was not run: {}.</p>\n",
                     isMap ? "cells reach half way to the next ones" : "lines only join them");
}

std::string captioned(const std::string& drawing, std::string_view caption) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", drawing, escapeHtml(caption));
}

std::string trioOf(const SweepResults& sweep, const DemandOverSweep& demand, const SweepSlice& slice,
                   std::size_t drawn) {
  const auto guaranteed = [&](std::size_t p) { return demand.guaranteed(p); };
  if (drawn == 1)
    return "<div class=\"trio\">\n" +
           captioned(stripOf(sweep.plan, slice, guaranteed, "What is guaranteed"), "guaranteed") +
           captioned(curvesOf(sweep.plan.axes[0], {demand.probability(slice)}, "probability that it is met",
                              "Probability that it is met", Range{0, 1}),
                     "probable") +
           captioned(curvesOf(sweep.plan.axes[0], {demand.necessity(slice)}, "necessity that it is met",
                              "Necessity that it is met", Range{0, 1}),
                     "possible") +
           "</div>\n";
  return "<div class=\"trio\">\n" +
         captioned(mapOf(sweep.plan, slice, guaranteed, "What is guaranteed"), "guaranteed") +
         captioned(
             mapOf(
                 sweep.plan, slice, [&](std::size_t p) { return demand.probable(p); }, "Probability that it is met"),
             "probable") +
         captioned(
             mapOf(
                 sweep.plan, slice, [&](std::size_t p) { return demand.possible(p); }, "Necessity that it is met"),
             "possible") +
         "</div>\n";
}

/// One slice below the other, as `draw` draws it; of many the first.
std::string sliced(const SweepPlan& plan, std::size_t drawn,
                   const std::function<std::string(const SweepSlice&)>& draw) {
  const std::vector<SweepSlice> slices = slicesOf(plan, drawn);
  std::string html;
  for (std::size_t s = 0; s < std::min(slices.size(), mostSlices); ++s)
    html += (slices[s].told.empty() ? "" : fmt::format("<h4>{}</h4>\n", escapeHtml(slices[s].told))) + draw(slices[s]);
  return html + hintOfRows(slices.size(), std::min(slices.size(), mostSlices));
}

std::string countsOf(const SweepResults& sweep, const DemandOverSweep& demand) {
  std::array<std::size_t, 4> counts{};
  for (std::size_t p = 0; p < sweep.points.size(); ++p)
    if (const double word = demand.at(OfRequirement::word, p); !std::isnan(word))
      ++counts.at(static_cast<std::size_t>(word));
  return fmt::format(
      "{} points: met at {}, violated at {}, for some values at {}, open at {}", sweep.points.size(),
      counts[static_cast<std::size_t>(Decision::met)], counts[static_cast<std::size_t>(Decision::violated)],
      counts[static_cast<std::size_t>(Decision::partly)], counts[static_cast<std::size_t>(Decision::open)]);
}

std::string demandsSection(const SweepResults& sweep, std::size_t drawn) {
  if (sweep.requirements.empty()) return {};
  std::string html = "<section class=\"sweep\">\n<h2>Requirements</h2>\n" + keyToDemands(drawn == 2);
  for (std::size_t r = 0; r < sweep.requirements.size(); ++r) {
    const DemandOverSweep demand(sweep, r);
    html += fmt::format("<h3>{}</h3>\n<p class=\"hint\">{}</p>\n<p>{}</p>\n", escapeHtml(sweep.requirements[r].name),
                        escapeHtml(sweep.requirements[r].statement), countsOf(sweep, demand));
    if (drawn > 0)
      html += sliced(sweep.plan, drawn, [&](const SweepSlice& slice) { return trioOf(sweep, demand, slice, drawn); });
  }
  return html + "</section>\n";
}

// ---- Outputs --------------------------------------------------------------------------------------------------------

SweepCurve outputCurve(const SweepResults& sweep, const SweepSlice& slice, std::string_view look, OfOutput lower,
                       OfOutput upper, std::size_t output) {
  SweepCurve curve{look, {}, {}};
  for (const std::size_t point : slice.points) {
    curve.lower.push_back(sweep.at(lower, point, output));
    curve.upper.push_back(sweep.at(upper, point, output));
  }
  return curve;
}

/// The edges of what samples did, as lines.
std::vector<SweepCurve> sampledLines(const SweepResults& sweep, const SweepSlice& slice, std::size_t output) {
  return {outputCurve(sweep, slice, "sampled", OfOutput::sampledLeast, OfOutput::sampledLeast, output),
          outputCurve(sweep, slice, "sampled", OfOutput::sampledGreatest, OfOutput::sampledGreatest, output)};
}

/// Strong where it is great, of all points alike.
MapCellOf valueCells(const SweepResults& sweep, OfOutput column, std::size_t output) {
  Range range;
  for (std::size_t p = 0; p < sweep.points.size(); ++p) range.hold(sweep.at(column, p, output));
  const std::string unit = sweep.outputs[output].unit;
  return [&sweep, column, output, range, unit](std::size_t p) {
    const double value = sweep.at(column, p, output);
    if (!isDrawn(value))
      return MapCell{"none", 1, sweep.points[p].state == PointState::open ? "not run" : "not bounded"};
    constexpr double faintest = 0.05;
    const double share = range.high > range.low ? (value - range.low) / (range.high - range.low) : 1;
    return MapCell{"value", faintest + (1 - faintest) * share, inUnit(numberText(value, 6), unit)};
  };
}

std::string rangeCaption(const SweepResults& sweep, OfOutput column, std::size_t output, const char* what) {
  Range range;
  for (std::size_t p = 0; p < sweep.points.size(); ++p) range.hold(sweep.at(column, p, output));
  if (range.low > range.high) return fmt::format("{}: nothing is known", what);
  return fmt::format("{}: from {} (faint) to {}", what, numberText(range.low, 5),
                     inUnit(numberText(range.high, 5), sweep.outputs[output].unit));
}

std::string outputFigures(const SweepResults& sweep, const SweepSlice& slice, std::size_t output, std::size_t drawn) {
  const OutputInfo& info = sweep.outputs[output];
  if (drawn == 1) {
    std::vector<SweepCurve> curves = sampledLines(sweep, slice, output);
    curves.insert(curves.begin(), outputCurve(sweep, slice, "value", OfOutput::least, OfOutput::greatest, output));
    return captioned(curvesOf(sweep.plan.axes[0], curves, headingOf(info.name, info.unit), info.name, {}),
                     "least and greatest of the whole motion");
  }
  return "<div class=\"trio\">\n" +
         captioned(mapOf(sweep.plan, slice, valueCells(sweep, OfOutput::least, output), "Never below this"),
                   rangeCaption(sweep, OfOutput::least, output, "never below")) +
         captioned(mapOf(sweep.plan, slice, valueCells(sweep, OfOutput::greatest, output), "Never above this"),
                   rangeCaption(sweep, OfOutput::greatest, output, "never above")) +
         "</div>\n";
}

std::string outputsOverSweep(const SweepResults& sweep, std::size_t drawn) {
  if (drawn == 0) return {};
  const std::size_t shown = std::min(sweep.outputs.size(), mostOutputs);
  std::string html = "<section class=\"sweep\">\n<h2>Outputs</h2>\n";
  if (drawn == 1)
    html += "<ul class=\"keys\" aria-label=\"Key\">\n" + entryOf("value", "guaranteed over the whole motion") +
            entryOf("sampled", "least and greatest of the samples") + "</ul>\n";
  for (std::size_t o = 0; o < shown; ++o)
    html += fmt::format("<h3>{}</h3>\n", escapeHtml(headingOf(sweep.outputs[o].name, sweep.outputs[o].unit))) +
            sliced(sweep.plan, drawn, [&](const SweepSlice& slice) { return outputFigures(sweep, slice, o, drawn); });
  return html + hintOfRows(sweep.outputs.size(), shown) + "</section>\n";
}

// ---- Points, and where the numbers come from ------------------------------------------------------------------------

/// Of a list all points; of a grid those that did not come to their end.
std::string pointsSection(const SweepResults& sweep) {
  std::vector<std::string> heads{"point", "state"};
  for (const SweepDemand& demand : sweep.requirements) heads.push_back(demand.name);
  heads.emplace_back("why");
  TableText table("", heads);
  std::size_t rows = 0;
  for (std::size_t p = 0; p < sweep.points.size(); ++p) {
    const SweepPoint& point = sweep.points[p];
    if (sweep.plan.isGrid && (point.state == PointState::done || point.state == PointState::open)) continue;
    if (++rows > mostPointRows) continue;
    std::vector<std::string> cells{std::string(wordOf(point.state))};
    for (std::size_t r = 0; r < sweep.requirements.size(); ++r)
      cells.push_back(DemandOverSweep(sweep, r).guaranteed(p).told);
    cells.push_back(point.why);
    table.row(sweep.plan.told(p), cells);
  }
  if (rows == 0) return {};
  return fmt::format("<section class=\"points\">\n<h2>{}</h2>\n{}{}</section>\n",
                     sweep.plan.isGrid ? "Points that did not come to their end" : "Points", table.html(),
                     hintOfRows(rows, mostPointRows));
}

std::string originSection(const SweepResults& sweep) {
  double cpu = 0;
  for (const SweepPoint& point : sweep.points) cpu += point.cpu;
  TableText table("", {"", ""});
  for (const auto& [name, value] : {std::pair<const char*, std::string>{"study file", sweep.studyFile},
                                    {"Gamut", sweep.version},
                                    {"begun on", sweep.host + ", " + sweep.date},
                                    {"CPU time of all points", cpuText(cpu)}})
    table.row(name, {value});
  return fmt::format(
      "<section class=\"origin\">\n<h2>Provenance</h2>\n{}<details><summary>The study, word for word</summary>\n"
      "<pre tabindex=\"0\">{}</pre></details>\n</section>\n",
      table.html(), escapeHtml(sweep.studyText));
}

std::string leadOf(const SweepResults& sweep) {
  std::size_t met = 0;
  for (std::size_t p = 0; p < sweep.points.size(); ++p) {
    bool areMet = sweep.points[p].state == PointState::done || sweep.points[p].state == PointState::early;
    for (std::size_t r = 0; r < sweep.requirements.size(); ++r)
      areMet = areMet && sweep.at(OfRequirement::word, p, r) == static_cast<double>(Decision::met);
    met += areMet ? 1 : 0;
  }
  const std::string points = countText(static_cast<long long>(sweep.points.size()), "point");
  if (sweep.requirements.empty())
    return fmt::format("{} of {} were run.", sweep.points.size() - sweep.count(PointState::open), points);
  return fmt::format("{} guaranteed at {} of {}.",
                     sweep.requirements.size() == 1 ? "The requirement is" : "All requirements are", met, points);
}

std::string stateList(const SweepResults& sweep) {
  constexpr std::array told{"not run yet", "done", "ended early", "cannot be run", "failed"};
  std::string html;
  for (std::size_t state = 0; state < told.size(); ++state)
    if (const std::size_t count = sweep.count(static_cast<PointState>(state)); count > 0)
      html += fmt::format("{}{} {}", html.empty() ? "" : ", ", count, told.at(state));
  std::size_t refuted = 0;
  for (const SweepPoint& point : sweep.points)
    refuted += point.verdict == wordOf(Agreement::outside) || point.verdict == wordOf(Agreement::unresolved) ? 1 : 0;
  html = fmt::format("<p>{}.</p>\n", html);
  if (refuted > 0)
    html += fmt::format("<p class=\"verdict outside\">At {} a sample left its enclosure, or stayed unresolved.</p>\n",
                        countText(static_cast<long long>(refuted), "point"));
  return html;
}

std::string axesLine(const SweepResults& sweep) {
  std::string line;
  for (const SweepAxis& axis : sweep.plan.axes) {
    const auto [least, greatest] = std::ranges::minmax(axis.values);
    line += fmt::format("{}{} from {} to {}", line.empty() ? "Over " : ", ", axis.name, numberText(least, 6),
                        inUnit(numberText(greatest, 6), axis.toldUnit()));
  }
  return line;
}

}  // namespace

std::string renderSweep(const SweepResults& sweep) {
  const std::size_t drawn = sweep.plan.isGrid ? std::min<std::size_t>(sweep.plan.axes.size(), 2) : 0;
  const std::string title = sweep.title.empty() ? sweep.studyFile : sweep.title;
  return filledPage({{"run", sweep.count(PointState::open) == 0 ? "whole" : "partial"},
                     {"title", escapeHtml(title)},
                     {"summary", escapeHtml(axesLine(sweep))},
                     {"style", std::string(page::style)},
                     {"layers", std::string(looks)},
                     {"plottingStyle", ""},
                     {"first", fmt::format("<section class=\"first\">\n<h2 class=\"lead\">{}</h2>\n{}</section>\n",
                                           leadOf(sweep), stateList(sweep))},
                     {"chips", ""},
                     {"links", ""},
                     {"clock", ""},
                     {"sections", demandsSection(sweep, drawn) + outputsOverSweep(sweep, drawn) + pointsSection(sweep) +
                                      originSection(sweep)},
                     {"scripts", ""}});
}

}  // namespace gamut
