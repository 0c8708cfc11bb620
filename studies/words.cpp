// Numbers by fmt (to nearest) and by Interval's text (outward, exact).
#include "studies/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scalars/interval.hpp"

namespace gamut {

std::string numberText(double x, int digits) { return std::isnan(x) ? "none" : fmt::format("{:.{}g}", x, digits); }

std::string timeText(double time, int digits) { return numberText(time, digits) + " s"; }

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
  if (!(width > 0) || !(magnitude > 0) || std::isinf(magnitude) || std::isinf(width))
    return std::clamp(resolved, 4, 17);
  const double leading = std::ceil(std::log10(magnitude / width));
  return std::clamp(resolved + static_cast<int>(std::clamp(leading, -20.0, 20.0)), 4, 17);
}

std::string countText(long long count, std::string_view singular) {
  return fmt::format("{} {}{}", count, singular, count == 1 ? "" : "s");
}

std::string rangeText(double lower, double upper, int digits) {
  const auto [below, above] = outwardText(lower, upper, digits);
  const auto stated = [](double bound) -> std::string {
    constexpr double roundings = 8;  // of a number and its tolerance, outward
    for (int n = 1; n <= 12 && std::isfinite(bound); ++n) {
      const std::string text = fmt::format("{:.{}g}", bound, n);
      const Interval decimal(text);
      const double ulp = std::nextafter(std::abs(bound), std::numeric_limits<double>::infinity()) - std::abs(bound);
      if (std::abs(midpoint(decimal) - bound) <= roundings * ulp) return text;
    }
    return "";
  };
  const std::string least = stated(lower), greatest = stated(upper);
  return fmt::format("[{}, {}]", least.empty() ? below : least, greatest.empty() ? above : greatest);
}

std::string csvHeading(const std::string& name, const std::string& unit) {
  const std::string text = unit.empty() || unit == "1" ? name : fmt::format("{} ({})", name, unit);
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

}  // namespace gamut
