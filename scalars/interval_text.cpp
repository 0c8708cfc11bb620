// Intervals as text, outward in both directions: what is read holds the number that was written, and what is written
// holds the interval. Numbers are read as exact rationals (GMP) and rounded once, by MPFR, since strtod and printf
// round to nearest. Forms: IEEE 1788-2015, 9.7 (interval literals), and midpoint with radius.
#include <gmp.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <clocale>
#include <optional>
#include <ostream>
#include <stdexcept>

#include "scalars/elementary/mpfr_bounds.hpp"
#include "scalars/interval.hpp"

namespace gamut {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

[[noreturn]] void throwMalformed(std::string_view text, const char* why = "") {
  throw std::invalid_argument("not a number or interval: '" + std::string(text) + "'" + why +
                              " (accepted are 0.1, -1.5e3, 1/3, 0x1.8p3, [0.1, 0.2], [0.1], [1, inf], [,3], [], "
                              "[empty], [entire], 0.1 ± 0.02 or 0.1 +- 0.02, and 1.5?, 1.5?2, 1.5?u, 1.5?d, 1.5?"
                              "?)");
}

// ---- Exact numbers --------------------------------------------------------------------------------------------------

/// A rational of GMP.
class Rational {
 public:
  Rational() { mpq_init(value_); }
  Rational(const Rational& other) : Rational() { mpq_set(value_, other.value_); }
  Rational& operator=(const Rational& other) {
    mpq_set(value_, other.value_);
    return *this;
  }
  ~Rational() { mpq_clear(value_); }

  /// An integer from its digits (at least one).
  static Rational integer(const std::string& digits, int base = 10) {
    Rational r;
    mpz_set_str(mpq_numref(r.value_), digits.c_str(), base);
    return r;
  }
  static Rational half() {
    Rational r;
    mpq_set_ui(r.value_, 1, 2);
    return r;
  }

  friend Rational operator+(const Rational& x, const Rational& y) { return x.with(mpq_add, y); }
  friend Rational operator-(const Rational& x, const Rational& y) { return x.with(mpq_sub, y); }
  friend Rational operator*(const Rational& x, const Rational& y) { return x.with(mpq_mul, y); }
  friend Rational operator/(const Rational& x, const Rational& y) { return x.with(mpq_div, y); }
  Rational operator-() const { return Rational() - *this; }
  bool operator<(const Rational& other) const { return mpq_cmp(value_, other.value_) < 0; }
  bool isZero() const { return mpq_sgn(value_) == 0; }

  static Rational power(unsigned long base, unsigned long exponent) {
    Rational r;
    mpz_ui_pow_ui(mpq_numref(r.value_), base, exponent);
    return r;
  }

  /// The nearest double on one side: rounded to 53 bits, of which doubles are a subset, and then in the same direction
  /// once more where doubles are subnormal or overflow.
  double rounded(mpfr_rnd_t direction) const {
    const detail::WideExponents wide;
    detail::Number<53> number;
    mpfr_set_q(number, value_, direction);
    const double rounded = mpfr_get_d(number, direction);
    return rounded == 0 ? 0.0 : rounded;  // +0
  }

 private:
  Rational with(void (*operation)(mpq_ptr, mpq_srcptr, mpq_srcptr), const Rational& other) const {
    Rational result;
    operation(result.value_, value_, other.value_);
    return result;
  }

  mpq_t value_;
};

// ---- Reading --------------------------------------------------------------------------------------------------------

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string lowerCase(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

/// Takes the text away from its front.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : rest_(text) {}
  bool atEnd() const { return rest_.empty(); }
  bool take(char c) {
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// True for '-'; takes a '+' too.
  bool takeMinus() { return !take('+') && take('-'); }
  std::string takeDigits(const char* digits = "0123456789") {
    const std::string_view found = rest_.substr(0, rest_.find_first_not_of(digits));
    rest_.remove_prefix(found.size());
    return std::string(found);
  }
  /// The exponent after its letter, held between +-10^9; nothing if malformed.
  std::optional<long> takeExponent() {
    constexpr long most = 1000000000;
    const bool negative = takeMinus();
    const std::string digits = takeDigits();
    if (digits.empty()) return {};
    long exponent = 0;
    for (const char digit : digits) exponent = std::min(most, 10 * exponent + (digit - '0'));
    return negative ? -exponent : exponent;
  }

 private:
  std::string_view rest_;
};

/// mantissa * base^exponent. Beyond base^+-100000 the exponent is cut off there, with `places` room for the mantissa's
/// digits: the value stays above every double, or nearer to zero than every other one, so it is rounded alike.
struct Number {
  Rational mantissa;
  unsigned base = 10;
  long exponent = 0;
  std::size_t places = 0;

  static constexpr long most = 100000;
  long least() const { return -most - static_cast<long>(places); }
  bool isCutOff() const { return !mantissa.isZero() && (exponent > most || exponent < least()); }

  Rational value() const {
    if (mantissa.isZero()) return mantissa;
    const long used = std::clamp(exponent, least(), most);
    const Rational scale = Rational::power(base, static_cast<unsigned long>(used < 0 ? -used : used));
    return used < 0 ? mantissa / scale : mantissa * scale;
  }
};

/// digits [. digits], with a digit before or after the point; nothing if malformed. A place after a hexadecimal point
/// counts for four binary ones.
std::optional<Number> takeMantissa(Cursor& text, bool hexadecimal) {
  const char* const allowed = hexadecimal ? "0123456789abcdef" : "0123456789";
  std::string digits = text.takeDigits(allowed);
  const std::size_t whole = digits.size();
  if (text.take('.')) digits += text.takeDigits(allowed);
  if (digits.empty()) return {};
  const long each = hexadecimal ? 4 : 1;
  return Number{Rational::integer(digits, hexadecimal ? 16 : 10), hexadecimal ? 2u : 10u,
                -each * static_cast<long>(digits.size() - whole), static_cast<std::size_t>(each) * digits.size()};
}

/// One number, in small letters: decimal, p/q of integers, or hexadecimal with an exponent of two; nothing if
/// malformed.
std::optional<Number> readNumber(const std::string& text) {
  Cursor cursor(text);
  const bool negative = cursor.takeMinus();
  const bool hexadecimal = text.find("0x") != std::string::npos && cursor.take('0') && cursor.take('x');
  std::optional<Number> number = takeMantissa(cursor, hexadecimal);
  if (!number) return {};
  if (cursor.take(hexadecimal ? 'p' : 'e')) {
    const auto exponent = cursor.takeExponent();
    if (!exponent) return {};
    number->exponent += *exponent;
  } else if (hexadecimal) {
    return {};
  } else if (text.find('.') == std::string::npos && cursor.take('/')) {
    const std::string digits = cursor.takeDigits();
    if (digits.find_first_not_of('0') == std::string::npos) return {};
    number->mantissa = number->mantissa / Rational::integer(digits);
  }
  if (!cursor.atEnd()) return {};
  if (negative) number->mantissa = -number->mantissa;
  return number;
}

Interval between(const Rational& lower, const Rational& upper) {
  return {lower.rounded(MPFR_RNDD), upper.rounded(MPFR_RNDU)};
}

/// IEEE 1788's uncertain form: mantissa ? [radius in units of the last place | ?] [u | d] [e exponent].
std::optional<Interval> readUncertain(const std::string& text) {
  Cursor cursor(text);
  const bool negative = cursor.takeMinus();
  const std::optional<Number> middle = takeMantissa(cursor, false);
  if (!middle || !cursor.take('?')) return {};
  const bool unbounded = cursor.take('?');
  const std::string digits = unbounded ? "" : cursor.takeDigits();
  const bool up = cursor.take('u'), down = !up && cursor.take('d');
  long exponent = middle->exponent;
  if (cursor.take('e')) {
    const auto written = cursor.takeExponent();
    if (!written) return {};
    exponent += *written;
  }
  if (!cursor.atEnd()) return {};

  const Rational mantissa = negative ? -middle->mantissa : middle->mantissa;
  const Rational radius = digits.empty() ? Rational::half() : Rational::integer(digits);
  // One place more than the longer of the two for a carry, one for the half.
  const std::size_t places = std::max(middle->places, digits.size()) + 2;
  const auto scaled = [&](const Rational& m) { return Number{m, 10, exponent, places}.value(); };
  const double lower = up          ? scaled(mantissa).rounded(MPFR_RNDD)
                       : unbounded ? -infinity
                                   : scaled(mantissa - radius).rounded(MPFR_RNDD);
  const double upper = down        ? scaled(mantissa).rounded(MPFR_RNDU)
                       : unbounded ? infinity
                                   : scaled(mantissa + radius).rounded(MPFR_RNDU);
  return Interval(lower, upper);
}

/// midpoint ± radius, both numbers, the radius not negative; nothing if there is no such sign.
std::optional<Interval> readMidpointAndRadius(const std::string& text, std::string_view whole) {
  for (const std::string_view sign : {"±", "+-", "+/-"}) {
    const auto at = text.find(sign);
    if (at == std::string::npos) continue;
    const auto middle = readNumber(std::string(trimmed(std::string_view(text).substr(0, at))));
    const auto radius = readNumber(std::string(trimmed(std::string_view(text).substr(at + sign.size()))));
    if (!middle || !radius) throwMalformed(whole);
    if (radius->mantissa < Rational()) throwMalformed(whole, ": the radius is negative");
    if (middle->isCutOff() || radius->isCutOff()) throwMalformed(whole, ": an exponent is beyond 100000");
    const Rational m = middle->value(), r = radius->value();
    return between(m - r, m + r);
  }
  return {};
}

/// An endpoint of [lower, upper]; nothing if it is the infinity that `sign` says: left out, inf or infinity.
std::optional<Number> readEndpoint(const std::string& text, char sign, std::string_view whole) {
  std::string_view word = text;
  if (word.starts_with(sign)) word.remove_prefix(1);
  if (text.empty() || ((sign == '+' || text.starts_with('-')) && (word == "inf" || word == "infinity"))) return {};
  const auto number = readNumber(text);
  if (!number) throwMalformed(whole);
  return number;
}

/// What stands between brackets.
Interval readBrackets(const std::string& inside, std::string_view whole) {
  if (inside.empty() || inside == "empty") return Interval::empty();
  if (inside == "entire") return Interval::entire();
  const auto comma = inside.find(',');
  if (comma == std::string::npos) {
    const auto number = readNumber(inside);
    if (!number) throwMalformed(whole);
    return between(number->value(), number->value());
  }
  const auto lower = readEndpoint(std::string(trimmed(std::string_view(inside).substr(0, comma))), '-', whole);
  const auto upper = readEndpoint(std::string(trimmed(std::string_view(inside).substr(comma + 1))), '+', whole);
  if (lower && upper) {
    if (lower->isCutOff() && upper->isCutOff())  // then they cannot be compared
      throwMalformed(whole, ": both exponents are beyond 100000");
    if (upper->value() < lower->value()) throwMalformed(whole, ": the lower endpoint is above the upper one");
  }
  return {lower ? lower->value().rounded(MPFR_RNDD) : -infinity, upper ? upper->value().rounded(MPFR_RNDU) : infinity};
}

// ---- Writing --------------------------------------------------------------------------------------------------------

/// `format` takes a number of digits, a direction and a number. The decimal point is a point in every locale.
std::string writeDirected(const char* format, double value, int digits, mpfr_rnd_t direction) {
  const detail::WideExponents wide;
  detail::Number<53> number;
  mpfr_set_d(number, value == 0 ? 0.0 : value, MPFR_RNDN);  // exact; 0, not -0
  char* text = nullptr;
  mpfr_asprintf(&text, format, digits, direction, static_cast<mpfr_ptr>(number));
  std::string result(text);
  mpfr_free_str(text);
  const std::string_view point = std::localeconv()->decimal_point;
  if (const auto at = result.find(point); point != "." && at != std::string::npos)
    result.replace(at, point.size(), ".");
  return result;
}

template <class Lower, class Upper>
std::string writeBrackets(const Interval& x, const Lower& lower, const Upper& upper) {
  if (isEmpty(x)) return "[empty]";
  if (isEntire(x)) return "[entire]";
  return "[" + lower(x.lower()) + ", " + upper(x.upper()) + "]";
}

std::string writeOutward(const char* format, const Interval& x, int digits) {
  return writeBrackets(
      x, [&](double value) { return writeDirected(format, value, digits, MPFR_RNDD); },
      [&](double value) { return writeDirected(format, value, digits, MPFR_RNDU); });
}

}  // namespace

Interval Interval::parse(std::string_view whole) {
  const std::string text = lowerCase(trimmed(whole));
  if (text.starts_with('[') && text.ends_with(']'))
    return readBrackets(std::string(trimmed(std::string_view(text).substr(1, text.size() - 2))), whole);
  if (const auto number = readNumber(text)) return between(number->value(), number->value());
  if (const auto uncertain = readUncertain(text)) return *uncertain;
  if (const auto x = readMidpointAndRadius(text, whole)) return *x;
  throwMalformed(whole);
}

std::string toString(const Interval& x, int digits) {
  if (digits < 1) throw std::invalid_argument("an interval is printed with at least one digit");
  return writeOutward("%.*R*g", x, digits);
}

std::string toFixedString(const Interval& x, int decimals) {
  if (decimals < 0) throw std::invalid_argument("an interval is printed with at least no decimals");
  return writeOutward("%.*R*f", x, decimals);
}

std::string toExactString(const Interval& x) {
  const auto exact = [](double value) { return toExactString(value); };
  return writeBrackets(x, exact, exact);
}

std::string toExactString(double x) {
  if (!std::isfinite(x)) return toString(x);
  std::array<char, 32> text{};  // 14 digits, a point, p and an exponent of five
  const auto end = std::to_chars(text.data(), text.data() + text.size(), std::abs(x), std::chars_format::hex).ptr;
  return (x < 0 ? "-0x" : "0x") + std::string(text.data(), end);
}

std::ostream& operator<<(std::ostream& stream, const Interval& x) { return stream << toString(x); }

std::string toString(double x) {
  std::array<char, 32> text{};  // a sign, 17 digits, a point and an exponent of five
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), x).ptr};
}

}  // namespace gamut
