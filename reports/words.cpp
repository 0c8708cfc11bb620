// Numbers by fmt (to nearest) and by Interval's text (outward, exact); escapes by nlohmann and by hand.
#include "reports/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "scalars/interval.hpp"

namespace gamut {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The text as UTF-8 in a JSON string: what is not UTF-8 is replaced.
std::string validUtf8(std::string_view text) {
  using Json = nlohmann::json;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace)).get<std::string>();
}

}  // namespace

std::string numberText(double x, int digits) { return std::isnan(x) ? "none" : fmt::format("{:.{}g}", x, digits); }

std::string atMostText(double x, int digits) {
  if (std::isnan(x)) return "none";
  return std::isinf(x) ? numberText(x) : outwardText(x, x, digits).second;
}

std::pair<std::string, std::string> outwardText(double lower, double upper, int digits) {
  if (!(lower <= upper)) return {"none", "none"};
  if (std::isinf(lower) && std::isinf(upper)) return {numberText(lower), numberText(upper)};
  const std::string text = toString(Interval(lower, upper), digits);  // "[lower, upper]"
  const auto comma = text.find(',');
  return {text.substr(1, comma - 1), text.substr(comma + 2, text.size() - comma - 3)};
}

std::string intervalText(double lower, double upper, int digits) {
  const auto [below, above] = outwardText(lower, upper, digits);
  return below == "none" ? below : "[" + below + ", " + above + "]";
}

int digitsFor(double magnitude, double width, int resolved) {
  if (!(width > 0) || !(magnitude > 0) || magnitude == infinity || width == infinity)
    return std::clamp(resolved, 4, 17);
  const double leading = std::ceil(std::log10(magnitude / width));
  return std::clamp(resolved + static_cast<int>(std::clamp(leading, -20.0, 20.0)), 4, 17);
}

std::string countText(long long count, std::string_view singular) {
  return fmt::format("{} {}{}", count, singular, count == 1 ? "" : "s");
}

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
