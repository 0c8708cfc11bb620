// Intervals as decimal text, outward in both directions: what is read holds the number that was written, and what is
// written holds the interval. MPFR converts, since strtod and printf round to nearest.
#include <mpfr.h>

#include <array>
#include <charconv>
#include <ostream>
#include <stdexcept>

#include "scalars/interval.hpp"

namespace gamut {
namespace {

[[noreturn]] void throwMalformed(std::string_view text) {
  throw std::invalid_argument("not a decimal number or interval: '" + std::string(text) + "'");
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::size_t countDigits(std::string_view text) {
  const auto end = text.find_first_not_of("0123456789");
  return end == std::string_view::npos ? text.size() : end;
}

/// [+-] digits [. digits] [(e|E) [+-] digits], with a digit before or after the point.
bool isDecimal(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  std::size_t digits = countDigits(text);
  text.remove_prefix(digits);
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    const std::size_t fraction = countDigits(text);
    text.remove_prefix(fraction);
    digits += fraction;
  }
  if (digits == 0) return false;
  if (text.empty()) return true;
  if (text.front() != 'e' && text.front() != 'E') return false;
  text.remove_prefix(1);
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && countDigits(text) == text.size();
}

/// The nearest double on the given side of a decimal: 53 bits, then once more in the same direction if subnormal.
double readDirected(std::string_view decimal, mpfr_rnd_t direction) {
  mpfr_t number;
  mpfr_init2(number, 53);
  mpfr_set_str(number, std::string(decimal).c_str(), 10, direction);
  const double value = mpfr_get_d(number, direction);
  mpfr_clear(number);
  return value;
}

/// One endpoint, an infinity included.
double readEndpoint(std::string_view text, mpfr_rnd_t direction, std::string_view whole) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (text == "inf" || text == "+inf") return infinity;
  if (text == "-inf") return -infinity;
  if (!isDecimal(text)) throwMalformed(whole);
  return readDirected(text, direction);
}

/// `format` takes a number of digits, a direction and a number.
std::string writeDirected(const char* format, double value, int digits, mpfr_rnd_t direction) {
  mpfr_t number;
  mpfr_init2(number, 53);
  mpfr_set_d(number, value, MPFR_RNDN);  // exact
  char* text = nullptr;
  mpfr_asprintf(&text, format, digits, direction, number);
  std::string result(text);
  mpfr_free_str(text);
  mpfr_clear(number);
  return result;
}

std::string writeOutward(const char* format, const Interval& x, int digits) {
  if (isEmpty(x)) return "[empty]";
  if (isEntire(x)) return "[entire]";
  return "[" + writeDirected(format, x.lower(), digits, MPFR_RNDD) + ", " +
         writeDirected(format, x.upper(), digits, MPFR_RNDU) + "]";
}

}  // namespace

Interval Interval::parse(std::string_view whole) {
  const std::string_view text = trimmed(whole);
  if (!text.starts_with('[')) {
    if (!isDecimal(text)) throwMalformed(whole);
    return {readDirected(text, MPFR_RNDD), readDirected(text, MPFR_RNDU)};
  }
  if (!text.ends_with(']')) throwMalformed(whole);
  const std::string_view inside = trimmed(text.substr(1, text.size() - 2));
  if (inside == "empty") return empty();
  if (inside == "entire") return entire();
  const auto comma = inside.find(',');
  if (comma == std::string_view::npos) {
    if (!isDecimal(inside)) throwMalformed(whole);
    return parse(inside);
  }
  const double lower = readEndpoint(trimmed(inside.substr(0, comma)), MPFR_RNDD, whole);
  const double upper = readEndpoint(trimmed(inside.substr(comma + 1)), MPFR_RNDU, whole);
  return {lower, upper};
}

std::string toString(const Interval& x, int digits) {
  if (digits < 1) throw std::invalid_argument("an interval is printed with at least one digit");
  return writeOutward("%.*R*g", x, digits);
}

std::string toFixedString(const Interval& x, int decimals) {
  if (decimals < 0) throw std::invalid_argument("an interval is printed with at least no decimals");
  return writeOutward("%.*R*f", x, decimals);
}

std::ostream& operator<<(std::ostream& stream, const Interval& x) { return stream << toString(x); }

std::string toString(double x) {
  std::array<char, 32> text{};  // a sign, 17 digits, a point and an exponent of five
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), x).ptr};
}

}  // namespace gamut
