// A number, then what units.hpp takes for a unit; formulas are none.
#include "mechanics/description/written_units.hpp"

#include <cctype>
#include <regex>

#include "mechanics/description/units.hpp"

namespace gamut {
namespace {

/// One unit, or some and their powers: signs and numbers are of exponents alone.
bool holdsUnitsAlone(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], before = i > 0 ? text[i - 1] : ' ';
    const bool isInExponent = before == '^' || (before == '-' && i > 1 && text[i - 2] == '^');
    if ((c == '-' || std::isdigit(static_cast<unsigned char>(c)) != 0) && !isInExponent) return false;
    if (c == '+' || c == '(' || c == '\'') return false;
  }
  return text.find("pi") == text.npos && text.find("π") == text.npos;
}

}  // namespace

std::string unitBehindNumber(std::string_view text) {
  constexpr std::size_t longest = 120;
  static const std::regex number(
      R"(\s*(?:[-+]|−)?\s*[0-9.]{1,40}(?:[eE][-+]?[0-9]{1,3})?(?:\s*/\s*[0-9.]{1,40})?\s*([^-+*/(0-9\s].{0,40}?)\s*)");
  std::match_results<std::string_view::const_iterator> parts;
  if (text.size() > longest || !std::regex_match(text.begin(), text.end(), parts, number)) return {};
  const std::string unit = parts[1];
  if (!holdsUnitsAlone(unit)) return {};
  try {
    const Amount one = parseAmount("1 " + unit);
    return one.hasUnit && !one.isRelative ? unit : "";
  } catch (const UnitError&) {  // a formula
    return {};
  }
}

}  // namespace gamut
