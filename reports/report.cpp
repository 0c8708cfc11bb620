// Sections, and what of scripts and styles they need.
#include "reports/report.hpp"

#include <fmt/format.h>

#include <string_view>

#include "reports/page/glossary.hpp"
#include "reports/page/page.hpp"
#include "reports/page/parts.hpp"
#include "reports/page/skeleton.hpp"
#include "reports/plain.hpp"
#include "reports/words.hpp"
#include "studies/atomic_file.hpp"

namespace gamut {
namespace {

/// What has a section of its own has its row here; one without content is left out.
struct Section {
  std::string_view title, name;  ///< the name in the style sheet
  std::string (*html)(const Report& report);
  std::string_view folded = {};  ///< what is behind the fold; empty: it is not folded
};

constexpr Section sections[] = {
    {"Outputs", "outputs", outputsSection},
    {"The machine", "moving", machineSection},
    {"Explorer", "explorer", explorerSection, "Samples one by one: choose among them by their quantities and outputs"},
    {"What was asked", "asked", askedSection},
    {"Workspace", "workspaces", workspaceSection},
    {"Modes", "modes", modesSection},
    {"Membership", "memberships", membershipSection},
    {"Probabilities", "probabilities", probabilitySection},
    {"Sensitivity", "sensitivities", sensitivitySection},
    {"Figures", "numbers", figuresSection, "Numbers of all outputs, and what each analysis cost"},
    {"Samples", "samples", samplesSection, "What the samples tell, and what not"},
    {"Provenance", "origin", provenanceSection, "Where the numbers come from, and the study word for word"}};

/// The sections, and links to them, the summary first.
struct SectionTexts {
  std::string html, links = "<a href=\"#found\">Summary</a>";
};

SectionTexts sectionsOf(const Report& report) {
  SectionTexts texts;
  for (const auto& [title, name, html, folded] : sections)
    if (const std::string content = html(report); !content.empty()) {
      texts.html +=
          fmt::format("<section class=\"{0}\" id=\"{0}\">\n<h2>{1}</h2>\n{2}{3}{4}{5}</section>\n", name, title,
                      folded.empty() ? "" : fmt::format("<details class=\"method\"><summary>{}</summary>\n", folded),
                      termsOf(name, content), content, folded.empty() ? "" : "</details>\n");
      texts.links += fmt::format("<a href=\"#{}\">{}</a>", name, title);
    }
  texts.html += meanings(texts.html);
  return texts;
}

/// What chooses times and copies figures; on pages with plots over time the numbers and what draws them; what moves the
/// picture of the machine.
std::string scriptsOf(const Report& report, bool isExplored) {
  std::string scripts = scriptElement(page::domScript) + scriptElement(page::outputsScript) +
                        scriptElement(page::keepScript) + scriptElement(page::momentsScript);
  if (const std::string& data = report.outputs.data; !data.empty())
    scripts += fmt::format("<script type=\"application/json\" id=\"times\">{}</script>\n<!--\n{}\n-->\n", data,
                           page::plottingLicence) +
               scriptElement(page::plottingScript) + scriptElement(page::axesScript) +
               scriptElement(page::besideScript) + scriptElement(page::pageScript);
  if (report.results.picture.present) scripts += scriptElement(page::sceneScript) + scriptElement(page::machineScript);
  if (isExplored) scripts += scriptElement(page::choiceScript) + scriptElement(page::exploreScript);
  return scripts + scriptElement(page::listScript) + scriptElement(page::clockScript);
}

/// With so much detail.
std::string rendered(const Results& results, const Verdict& verdict, const Detail& detail) {
  const Report report{results,
                      detail,
                      verdict,
                      outputPlots(results, detail),
                      membershipFigures(results, detail),
                      probabilityPlots(results, detail),
                      sensitivityPlots(results, detail)};
  const SectionTexts texts = sectionsOf(report);
  return filledPage({{"run", results.stopped.empty() ? "whole" : "partial"},
                     {"title", escapeHtml(titleOf(results))},
                     {"summary", escapeHtml(summaryLine(results))},
                     {"style", std::string(page::style)},
                     {"layers", report.outputs.style + report.probabilities.style + report.sensitivities.style},
                     {"plottingStyle", report.outputs.data.empty() ? "" : std::string(page::plottingStyle)},
                     {"first", firstSection(report)},
                     {"chips", chipsOf(report)},
                     {"links", texts.links},
                     {"clock", clockOf(results)},
                     {"sections", texts.html},
                     {"scripts", scriptsOf(report, texts.html.find("class=\"explored\"") != std::string::npos)}});
}

}  // namespace

std::string renderReport(const Results& results) { return renderReport(results, judge(results)); }

std::string renderReport(const Results& results, const Verdict& verdict) {
  constexpr int levels = 8;
  for (int level = 0;; ++level) {
    std::string page = rendered(results, verdict, detailOf(results, level));
    if (page.size() < largestPage || level == levels) return page;
  }
}

std::string leadOf(const Results& results, const Verdict& verdict) {
  return plainSummary(results, verdict, foremostOutput(results));
}

void writeReport(const Results& results, const std::string& path) { replaceFile(path, renderReport(results)); }

}  // namespace gamut
