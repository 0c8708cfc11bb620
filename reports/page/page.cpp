// The head of a page, what was asked and where the numbers come from.
#include "reports/page/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ranges>
#include <utility>

#include "reports/drawing/spark.hpp"
#include "reports/page/table.hpp"
#include "reports/requirements.hpp"
#include "reports/sections/limits.hpp"
#include "reports/summary.hpp"
#include "reports/words.hpp"
#include "studies/printable.hpp"
#include "studies/told.hpp"

namespace gamut {
namespace {

std::string uncertainTable(const Results& results, std::size_t rows) {
  const bool isStated = std::ranges::any_of(results.uncertain, [](const auto& info) { return !info.stated.empty(); });
  std::vector<std::string> heads{"name", "quantity", "interval", "nominal", "probable", "possible"};
  if (isStated) heads.insert(heads.begin() + 2, "as stated");
  TableText table("Uncertain quantities", heads);
  for (const UncertainInfo& info : results.uncertain | std::views::take(rows)) {
    const int digits =
        std::max(6, digitsFor(std::max(std::abs(info.lower), std::abs(info.upper)), info.upper - info.lower, 4));
    const Told told(info);
    const auto [lower, upper] = told.of(info.lower, info.upper);
    std::vector<std::string> cells{headingOf(info.quantity, told.unit()), rangeText(lower, upper, digits),
                                   numberText(told.of(info.nominal), digits),
                                   shapeText(results, info, ShapeKind::distribution),
                                   shapeText(results, info, ShapeKind::membership)};
    std::vector<std::string> drawings{"", "", "", drawShape(results, info, ShapeKind::distribution),
                                      drawShape(results, info, ShapeKind::membership)};
    if (isStated) {
      cells.insert(cells.begin() + 1, info.stated);
      drawings.insert(drawings.begin(), "");
    }
    table.row(info.name, cells, drawings);
  }
  return table.html() + hintOfRows(results.uncertain.size(), rows);
}

/// "30 November 2026, 00:27 UTC" of "2026-11-30T00:27:39Z"; others as they are.
std::string dateText(const std::string& date) {
  constexpr std::array months{"January", "February", "March",     "April",   "May",      "June",
                              "July",    "August",   "September", "October", "November", "December"};
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  if (std::sscanf(date.c_str(), "%4d-%2d-%2dT%2d:%2d", &year, &month, &day, &hour, &minute) != 5 || month < 1 ||
      month > 12)
    return date;
  return fmt::format("{} {} {}, {:02}:{:02} UTC", day, months[static_cast<std::size_t>(month - 1)], year, hour, minute);
}

std::string settledList(const Verdict& verdict) {
  if (verdict.settled.empty()) return {};
  std::string list = "<details><summary>Which</summary><ul>\n";
  for (const std::string& sentence : verdict.settled) list += "<li>" + escapeHtml(sentence) + "</li>\n";
  return list + "</ul></details>";
}

/// What analyses beside the answers have found, that is not drawn.
std::string foundLists(const Results& results) {
  std::string html;
  for (const Boxed<FurtherPart>& part : results.further) {
    const std::vector<std::string> lines = part->told();
    if (!part->present || lines.empty()) continue;
    html += fmt::format("<h3>Also {}: {}</h3>\n<ul>\n", part->verb(), escapeHtml(part->title()));
    for (const std::string& line : lines) html += "<li>" + escapeHtml(line) + "</li>\n";
    html += "</ul>\n";
  }
  return html;
}

}  // namespace

std::string titleOf(const Results& results) {
  if (!results.title.empty()) return results.title;
  return results.studyFile.empty() ? "Untitled study" : results.studyFile;
}

std::string summaryLine(const Results& results) {
  std::string line = results.analysis;
  if (results.horizon > 0) line += fmt::format(", 0 s to {} s", numberText(results.horizon, 6));
  line += ", " + (results.uncertain.size() == 1 ? std::string("1 uncertain quantity")
                                                : fmt::format("{} uncertain quantities", results.uncertain.size()));
  std::size_t margins = 0;
  for (const RequirementResult& requirement : results.requirements)
    margins += static_cast<std::size_t>(requirement.margins);
  line += ", " + countText(static_cast<long long>(results.outputs.size() - std::min(margins, results.outputs.size())),
                           "output");
  if (!results.date.empty()) line += ", " + dateText(results.date);
  return line;
}

/// "1 of 3 can fail", "fails in every case": of requirements of which so many do.
std::string failingText(const Results& results, std::size_t failing) {
  const auto always =
      static_cast<std::size_t>(std::ranges::count(results.requirements, Decision::violated, &RequirementResult::word));
  const std::size_t all = results.requirements.size();
  const std::string verb = always < failing ? "can fail"
                           : failing == 1   ? "fails"
                                            : "fail",
                    when = always < failing ? "" : " in every case";
  return all == 1 ? verb + when : fmt::format("{} of {} {}{}", failing, all, verb, when);
}

/// "400 simulated and 105 extreme cases"
std::string simulatedText(const StochasticResult& of) {
  const std::int64_t drawn = std::min(of.integrated, of.samples), extreme = of.integrated - drawn;
  return extreme == 0 ? countText(drawn, "simulated case")
                      : fmt::format("{} simulated and {}", drawn, countText(extreme, "extreme case"));
}

std::string chipsOf(const Report& report) {
  const Results& results = report.results;
  std::string html;
  if (const std::size_t all = results.requirements.size(); all > 0 && report.verdict.word != Agreement::outside) {
    constexpr int simulated = 2, open = 3;
    const auto upTo = [&](int severity) {
      return static_cast<std::size_t>(std::ranges::count_if(
          results.requirements, [&](const RequirementResult& r) { return severityOf(r) <= severity; }));
    };
    const std::size_t failing = upTo(simulated), undecided = upTo(open) - failing;
    const auto [tone, words] = failing > 0 ? std::pair("violated", failingText(results, failing))
                               : undecided > 0
                                   ? std::pair("open", fmt::format("{} of {} not decided", undecided, all))
                                   : std::pair("met", all == 1 ? std::string("met in every case")
                                                               : fmt::format("all {} met in every case", all));
    html += fmt::format("<a class=\"chip {}\" href=\"#found\">{}</a> ", tone, words);
  } else if (all == 0) {
    html += "<a class=\"chip none\" href=\"#asked\">no requirement is stated</a> ";
  }
  if (report.verdict.gap != Finding::Gap::noAnswers)
    html += fmt::format("<a class=\"chip {0}\" href=\"#verdict\">self-check of the computation: {1}</a>",
                        wordOf(report.verdict.word),
                        report.verdict.word == Agreement::inside && results.stochastic.integrated > 0
                            ? fmt::format("all {} within what is guaranteed", simulatedText(results.stochastic))
                            : std::string(wordOf(report.verdict.word)));
  return html;
}

std::string clockOf(const Results& results) {
  if (!(results.horizon > 0) || results.time.size() < 2) return {};
  const std::size_t foremost = foremostOutput(results);
  const double instant = foremost < results.outputs.size() ? instantOf(results, foremost) : std::nan("");
  return fmt::format("<div class=\"controls clock\" data-until=\"{}\" data-instant=\"{}\"></div>",
                     numberText(results.horizon, 12), numberText(std::isfinite(instant) ? instant : 0.0, 12));
}

std::string notesList(const Verdict& verdict) {
  if (verdict.notes.empty()) return {};
  std::string list = "<ul class=\"notes\">\n";
  for (std::size_t i = 0; i < verdict.notes.size(); ++i)
    list += "<li>" + escapeHtml(verdict.notes[i]) +
            (static_cast<std::int64_t>(i) == verdict.settledNote ? settledList(verdict) : "") + "</li>\n";
  return list + "</ul>\n";
}

/// The quantities, and how they hang together.
std::string askedSection(const Report& report) {
  std::string html = uncertainTable(report.results, report.detail.rows);
  if (const std::string& dependence = report.results.dependence; !dependence.empty())
    html += fmt::format("<p class=\"hint\">The quantities: {}.</p>\n", escapeHtml(dependence));
  if (const std::string& assembly = report.results.assembly; !assembly.empty())
    html += fmt::format("<p class=\"hint\">Assembled at the nominal start: {}.</p>\n", escapeHtml(assembly));
  if (const std::string& assumptions = report.results.assumptions; !assumptions.empty())
    html += fmt::format("<p class=\"hint\">Assumed, not proved: {}.</p>\n", escapeHtml(assumptions));
  return html;
}

std::string outputsSection(const Report& report) { return foundLists(report.results) + report.outputs.html; }

std::string membershipSection(const Report& report) { return report.memberships; }

std::string provenanceSection(const Report& report) {
  const Results& results = report.results;
  TableText table("Origin of the numbers", {"what", "value"});
  table.row("Gamut", {results.version});
  table.row("study file", {results.studyFile});
  table.row("computed", {results.date});
  table.row("computer", {results.host});
  table.row("seed", {fmt::format("{}", results.seed)});
  std::string libraries;
  for (const auto& [name, version] : results.libraries)
    libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
  table.row("libraries", {libraries});
  for (const ExtensionInfo& e : results.extensions)
    table.row("extended", {fmt::format("from {}, by Gamut {} on {}, {}", countText(e.before, "sample"), e.version,
                                       e.host, e.date)});
  return table.html() + "<details><summary>The study as it was written</summary><pre tabindex=\"0\">" +
         escapeHtml(printableLines(shortened(results.studyText, report.detail.textBytes))) + "</pre></details>\n";
}

}  // namespace gamut
