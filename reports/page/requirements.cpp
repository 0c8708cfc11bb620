// The requirements, each with its three answers side by side.
#include <fmt/format.h>

#include "reports/page/page.hpp"
#include "reports/requirements.hpp"
#include "reports/words.hpp"

namespace gamut {
namespace {

std::string answer(const char* title, const std::string& text) {
  return text.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>\n", title, escapeHtml(text));
}

}  // namespace

std::string requirementsSection(const Report& report) {
  const Results& results = report.results;
  if (results.requirements.empty()) return {};
  std::string html = fmt::format("<p>{}</p>\n", escapeHtml(sentenceOfRequirements(results)));
  const std::vector<RequirementWords> all = wordsOfRequirements(results);
  for (const std::size_t r : shownRequirements(results)) {
    const RequirementWords& words = all[r];
    html += fmt::format(
        "<article class=\"requirement {}\">\n<h3><span>{}</span> <b>{}</b></h3>\n<p "
        "class=\"demand\">{}</p>\n<dl>\n{}{}{}{}</dl>\n"
        "</article>\n",
        words.word, escapeHtml(words.name), escapeHtml(words.verdict), escapeHtml(words.demand),
        answer("guaranteed", words.guaranteed), answer("probable", words.probable),
        words.estimated.empty() ? ""
                                : fmt::format("<dt class=\"estimated\">estimated</dt><dd class=\"estimated\">{}</dd>\n",
                                              escapeHtml(words.estimated)),
        answer("possible", words.possible));
  }
  if (const std::string more = unshownRequirements(results); !more.empty())
    html += fmt::format("<p class=\"hint\">{}</p>\n", more);
  return html;
}

}  // namespace gamut
