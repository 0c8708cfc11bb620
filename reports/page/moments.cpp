// Hidden figures cost a page little: their paths are short, and nothing is laid out.
#include "reports/page/moments.hpp"

#include <fmt/format.h>

#include "reports/words.hpp"

namespace gamut {

std::string momentsControl(const std::string& kind, const std::string& label, const std::vector<double>& times) {
  if (times.size() < 2) return {};
  std::string list;
  for (const double time : times) list += (list.empty() ? "" : ",") + jsonText(timeText(time));
  return fmt::format("<div class=\"controls moments\" data-of=\"{}\" data-label=\"{}\" data-times=\"{}\"></div>\n",
                     kind, escapeHtml(label), escapeHtml("[" + list + "]"));
}

std::string momentFigures(const std::string& kind, const std::vector<std::string>& drawings,
                          const std::vector<std::string>& captions, const std::vector<std::string>& numbers) {
  std::string html;
  for (std::size_t at = 0; at < drawings.size(); ++at)
    html += fmt::format("<figure class=\"{}{}\" data-at=\"{}\"{}>{}<figcaption>{}</figcaption>{}</figure>\n", kind,
                        drawings[at].empty() ? "" : " kept", at, at + 1 == drawings.size() ? "" : " hidden",
                        drawings[at], escapeHtml(captions[at]), drawings[at].empty() ? "" : numbers[at]);
  return html;
}

}  // namespace gamut
