// The page is a skeleton with named places ({{title}}, ...); each is filled once, so text from a study is never
// searched.
#include "reports/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string_view>

#include "reports/curves.hpp"
#include "reports/figures.hpp"
#include "reports/page_data.hpp"
#include "reports/page_parts.hpp"
#include "reports/tables.hpp"
#include "reports/verdict.hpp"
#include "reports/words.hpp"
#include "studies/atomic_file.hpp"

namespace gamut {
namespace {

using Places = std::map<std::string, std::string, std::less<>>;

std::string filled(std::string_view skeleton, const Places& places) {
  std::string text;
  for (;;) {
    const auto open = skeleton.find("{{");
    if (open == std::string_view::npos) return text += skeleton;
    const auto close = skeleton.find("}}", open);
    if (close == std::string_view::npos) throw std::logic_error("the page's skeleton has an unclosed place");
    const auto place = places.find(skeleton.substr(open + 2, close - open - 2));
    if (place == places.end()) throw std::logic_error("the page's skeleton names an unknown place");
    text += skeleton.substr(0, open);
    text += place->second;
    skeleton.remove_prefix(close + 2);
  }
}

/// Paper shows no more points than this.
constexpr std::size_t drawnTimes = 240;

bool moves(const Results& results) { return results.horizon > 0 && results.time.size() > 1; }

std::string titleOf(const Results& results) {
  if (!results.title.empty()) return results.title;
  return results.studyFile.empty() ? "Untitled study" : results.studyFile;
}

std::string summaryLine(const Results& results) {
  std::string line = results.analysis;
  if (moves(results)) line += fmt::format(", 0 s to {} s", numberText(results.horizon, 6));
  line += ", " + (results.uncertain.size() == 1 ? std::string("1 uncertain quantity")
                                                : fmt::format("{} uncertain quantities", results.uncertain.size()));
  line += ", " + countText(static_cast<long long>(results.outputs.size()), "output");
  if (!results.date.empty()) line += ", " + results.date;
  return escapeHtml(line);
}

std::string notesList(const Verdict& verdict) {
  if (verdict.notes.empty()) return {};
  std::string list = "<ul class=\"notes\">\n";
  for (const std::string& note : verdict.notes) list += "<li>" + escapeHtml(note) + "</li>\n";
  return list + "</ul>\n";
}

/// One key: a colour and what it stands for. The script makes it a switch.
std::string keyText(std::string_view layer, const std::string& words) {
  return fmt::format("<li data-layer=\"{0}\"><span class=\"swatch {0}\"></span>{1}</li>\n", layer, words);
}

std::string keysOf(const Curves& curves) {
  std::string keys = "<ul class=\"keys\" aria-label=\"Key to the plot\">\n";
  if (!curves.tube.empty()) keys += keyText("tube", "guaranteed at every instant");
  if (!curves.guaranteed.empty()) keys += keyText("guaranteed", "guaranteed at the output times");
  if (!curves.possible.empty()) keys += keyText("possible", "possible: alpha-cuts, the darker the more possible");
  if (!curves.probable.empty()) {
    keys += keyText("probable",
                    fmt::format("probable: {:g} to {:g} % of the samples", 100 * curves.lowest, 100 * curves.highest));
  }
  if (!curves.median.empty()) keys += keyText("median", "median");
  if (!curves.sampled.empty()) keys += keyText("sampled", "least and greatest sample");
  return keys + "</ul>\n";
}

/// "guaranteed between -2.5 and 2.4 rad, sampled between .." for those who cannot see the drawing.
std::string description(const Curves& curves) {
  std::string words = curves.name;
  const auto add = [&](std::string_view what, const Band& band) {
    double low = INFINITY, high = -INFINITY;
    for (std::size_t i = 0; i < band.lower.size(); ++i) {
      low = std::fmin(low, band.lower[i]);
      high = std::fmax(high, band.upper[i]);
    }
    if (low <= high) words += fmt::format(", {} {} {}", what, intervalText(low, high, 4), curves.unit);
  };
  add("guaranteed within", curves.guaranteed);
  add("sampled within", curves.sampled);
  return words;
}

std::string motionSection(const Curves& curves, std::size_t output) {
  const std::string words = description(curves);
  std::string html =
      fmt::format("<section class=\"output\" data-output=\"{}\">\n<h3>{}</h3>\n", output, escapeHtml(curves.name));
  html += keysOf(curves);
  html += fmt::format("<div class=\"live\" role=\"group\" aria-label=\"{}\"></div>\n",
                      escapeHtml("Interactive plot of " + words));
  html += "<div class=\"static\">\n<figure>" + drawCurves(thinned(curves, drawnTimes), "Plot over time of " + words) +
          "<figcaption>Over time</figcaption></figure>\n";
  html += "<figure>" +
          drawCurves(thinned(aroundReference(curves), drawnTimes), "Plot of the spread around the middle of " + words) +
          fmt::format("<figcaption>Spread around {}</figcaption></figure>\n",
                      curves.median.empty() ? "the middle" : "the median");
  const std::string ratio =
      drawOverestimation(thinned(curves, drawnTimes), "Plot of the overestimation of " + curves.name);
  if (!ratio.empty()) html += "<figure>" + ratio + "</figure>\n";
  return html + "</div>\n</section>\n";
}

std::string positionSection(const Curves& curves) {
  return fmt::format("<section class=\"output\">\n<h3>{}</h3>\n<figure>{}</figure>\n</section>\n",
                     escapeHtml(curves.name), drawBars(curves, "Bars of " + description(curves)));
}

std::string outputSections(const Results& results) {
  std::string html;
  if (results.time.empty()) return html;
  for (std::size_t k = 0; k < results.outputs.size(); ++k) {
    const Curves curves = curvesOf(results, k);
    html += moves(results) ? motionSection(curves, k) : positionSection(curves);
  }
  return html;
}

/// What only pages with plots over time need: the numbers and what draws them.
std::string plottingPart(const Results& results) {
  if (!moves(results)) return {};
  return fmt::format(
      "<script type=\"application/json\" id=\"numbers\">{}</script>\n<!--\n{}\n-->\n<script>{}</script>\n",
      pageData(results), page::plottingLicence, page::plottingScript);
}

}  // namespace

std::string renderReport(const Results& results) {
  const Verdict verdict = judge(results);
  return filled(page::skeleton, {{"title", escapeHtml(titleOf(results))},
                                 {"summary", summaryLine(results)},
                                 {"style", std::string(page::style)},
                                 {"plottingStyle", moves(results) ? std::string(page::plottingStyle) : ""},
                                 {"word", verdict.word},
                                 {"sentence", escapeHtml(verdict.sentence)},
                                 {"notes", notesList(verdict)},
                                 {"uncertain", uncertainTable(results)},
                                 {"study", escapeHtml(results.studyText)},
                                 {"figures", figuresTable(results, verdict)},
                                 {"cost", costTable(results)},
                                 {"outputs", outputSections(results)},
                                 {"provenance", provenanceTable(results)},
                                 {"plotting", plottingPart(results)},
                                 {"script", std::string(page::script)}});
}

void writeReport(const Results& results, const std::string& path) { replaceFile(path, renderReport(results)); }

}  // namespace gamut
