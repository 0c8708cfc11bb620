#include "reports/page/skeleton.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "reports/page/parts.hpp"

namespace gamut {

std::string filledPage(const PagePlaces& places) {
  std::string_view skeleton = page::skeleton;
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

std::string scriptElement(std::string_view text) { return fmt::format("<script>{}</script>\n", text); }

}  // namespace gamut
