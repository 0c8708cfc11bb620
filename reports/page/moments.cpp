// Hidden figures cost a page little: their paths are short, and nothing is laid out.
#include "reports/page/moments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/words.hpp"

namespace gamut {

std::string momentsControl(const std::string& kind, const std::string& label, const std::vector<double>& times) {
  if (times.size() < 2) return {};
  std::vector<std::string> texts, seconds;
  for (const double time : times) {
    texts.push_back(jsonText(timeText(time)));
    seconds.push_back(numberText(time, 12));
  }
  return fmt::format(
      "<div class=\"controls moments\" data-of=\"{}\" data-label=\"{}\" data-times=\"{}\" "
      "data-seconds=\"[{}]\"></div>\n",
      kind, escapeHtml(label), escapeHtml(fmt::format("[{}]", fmt::join(texts, ","))), fmt::join(seconds, ","));
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
