// The page is a skeleton with named places ({{title}}, ...); each is filled once, so text from a study is never
// searched.
#include "reports/report.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>
#include <string_view>

#include "reports/page/page.hpp"
#include "reports/page/parts.hpp"
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

/// What has a section of its own has its row here; one without content is left out.
struct Section {
  std::string_view title, name;  ///< the name in the style sheet
  std::string (*html)(const Report& report);
};

constexpr Section sections[] = {{"Requirements", "demands", requirementsSection},
                                {"What was asked", "asked", askedSection},
                                {"The machine", "moving", machineSection},
                                {"Workspace", "workspaces", workspaceSection},
                                {"Figures", "numbers", figuresSection},
                                {"Outputs", "outputs", outputsSection},
                                {"Membership", "memberships", membershipSection},
                                {"Probabilities", "probabilities", probabilitySection},
                                {"Sensitivity", "sensitivities", sensitivitySection},
                                {"Samples", "samples", samplesSection},
                                {"Provenance", "origin", provenanceSection}};

std::string sectionsOf(const Report& report) {
  std::string text;
  for (const auto& [title, name, html] : sections)
    if (const std::string content = html(report); !content.empty())
      text += fmt::format("<section class=\"{}\">\n<h2>{}</h2>\n{}</section>\n", name, title, content);
  return text;
}

/// What chooses times and copies figures; on pages with plots over time the numbers and what draws them; what moves the
/// picture of the machine.
std::string scriptsOf(const Report& report) {
  const auto script = [](std::string_view text) { return fmt::format("<script>{}</script>\n", text); };
  std::string scripts =
      script(page::domScript) + script(page::outputsScript) + script(page::keepScript) + script(page::momentsScript);
  if (const std::string& data = report.outputs.data; !data.empty())
    scripts += fmt::format("<script type=\"application/json\" id=\"times\">{}</script>\n<!--\n{}\n-->\n", data,
                           page::plottingLicence) +
               script(page::plottingScript) + script(page::axesScript) + script(page::pageScript);
  return report.results.picture.present ? scripts + script(page::sceneScript) + script(page::machineScript) : scripts;
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
  return filled(page::skeleton,
                {{"run", results.stopped.empty() ? "whole" : "partial"},
                 {"title", escapeHtml(titleOf(results))},
                 {"summary", escapeHtml(summaryLine(results))},
                 {"style", std::string(page::style)},
                 {"layers", report.outputs.style + report.probabilities.style + report.sensitivities.style},
                 {"plottingStyle", report.outputs.data.empty() ? "" : std::string(page::plottingStyle)},
                 {"first", firstSection(report)},
                 {"sections", sectionsOf(report)},
                 {"scripts", scriptsOf(report)}});
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

void writeReport(const Results& results, const std::string& path) { replaceFile(path, renderReport(results)); }

}  // namespace gamut
