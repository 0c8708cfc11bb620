// Escapes by nlohmann and by hand.
#include "reports/words.hpp"

#include <nlohmann/json.hpp>

namespace gamut {
namespace {

/// The text as UTF-8 in a JSON string: what is not UTF-8 is replaced.
std::string validUtf8(std::string_view text) {
  using Json = nlohmann::json;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

}  // namespace

std::string escapeHtml(std::string_view text) {
  std::string safe;
  for (const char c : validUtf8(text)) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

std::string jsonText(std::string_view text) {
  const std::string quoted = nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string safe;
  for (const char c : quoted) {
    if (c == '<') {
      safe += "\\u003c";  // no "</script>", no "<!--" inside the page
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace gamut
