// Lexer and evaluation of quantities. Rationals are GMP's, pi is MPFR's with 320 bits, rounded in the direction asked
// for.
#include "studies/units.hpp"

#include <fmt/format.h>
#include <mpfr.h>

#include <array>
#include <cctype>
#include <optional>
#include <vector>

namespace gamut {
namespace {

/// value * pi^piPower SI units make one of these.
struct Unit {
  std::string_view symbol;
  const char* value;
  int piPower;
  Dimension dimension;
};

constexpr Dimension none{};
constexpr Dimension angle{0, 0, 0, 1}, perSecond{0, 0, -1, 1}, newton{1, 1, -2, 0}, joule{1, 2, -2, 0},
    memory{0, 0, 0, 0, 1};

constexpr std::array units{
    Unit{"rad", "1", 0, angle},
    Unit{"deg", "1/180", 1, angle},
    Unit{"°", "1/180", 1, angle},
    Unit{"mrad", "1/1000", 0, angle},
    Unit{"rpm", "1/30", 1, perSecond},
    Unit{"m", "1", 0, {0, 1, 0, 0}},
    Unit{"km", "1000", 0, {0, 1, 0, 0}},
    Unit{"cm", "1/100", 0, {0, 1, 0, 0}},
    Unit{"mm", "1/1000", 0, {0, 1, 0, 0}},
    Unit{"um", "1/1000000", 0, {0, 1, 0, 0}},
    Unit{"kg", "1", 0, {1, 0, 0, 0}},
    Unit{"g", "1/1000", 0, {1, 0, 0, 0}},
    Unit{"t", "1000", 0, {1, 0, 0, 0}},
    Unit{"s", "1", 0, {0, 0, 1, 0}},
    Unit{"ms", "1/1000", 0, {0, 0, 1, 0}},
    Unit{"min", "60", 0, {0, 0, 1, 0}},
    Unit{"h", "3600", 0, {0, 0, 1, 0}},
    Unit{"N", "1", 0, newton},
    Unit{"kN", "1000", 0, newton},
    Unit{"J", "1", 0, joule},
    Unit{"kJ", "1000", 0, joule},
    Unit{"W", "1", 0, {1, 2, -3, 0}},
    Unit{"GB", "1", 0, memory},
    Unit{"MB", "1/1000", 0, memory},
    Unit{"GiB", "2097152/1953125", 0, memory},  // 2^30 / 10^9
    Unit{"MiB", "2048/1953125", 0, memory},     // 2^20 / 10^9
    Unit{"%", "1/100", 0, none},
};

/// SI units with a name that people know better than their product of base units.
struct NamedUnit {
  std::string_view name;
  Dimension dimension;
};
constexpr std::array namedUnits{
    NamedUnit{"N", newton},
    NamedUnit{"J", joule},
    NamedUnit{"W", {1, 2, -3, 0}},
    NamedUnit{"N/m", {1, 0, -2, 0}},
    NamedUnit{"N s/m", {1, 0, -1, 0}},
    NamedUnit{"N m/rad", {1, 2, -2, -1}},
    NamedUnit{"N m s/rad", {1, 2, -1, -1}},
};

void add(Dimension& sum, const Dimension& term, int times) {
  sum.mass += times * term.mass;
  sum.length += times * term.length;
  sum.time += times * term.time;
  sum.angle += times * term.angle;
  sum.memory += times * term.memory;
}

[[noreturn]] void fail(const std::string& what, const std::string& expected) {
  throw UnitError(what + "; expected " + expected);
}

std::string knownUnits() {
  std::string list;
  for (const Unit& unit : units) list += (list.empty() ? "" : ", ") + std::string(unit.symbol);
  return list;
}

/// 10^power.
mpz_class powerOfTen(unsigned long power) {
  mpz_class result;
  mpz_ui_pow_ui(result.get_mpz_t(), 10, power);
  return result;
}

/// Reads the text from left to right.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  Amount read() {
    Amount result;
    skipBlanks();
    const bool negative = take("-") || take("−");
    if (!negative) take("+");
    result.value = 1;
    bool first = true, divide = false;
    for (skipBlanks(); !atEnd(); first = false) {
      if (!first) divide = readOperator();
      readFactor(result, divide);
      skipBlanks();
    }
    if (first) fail(fmt::format("'{}' holds no number", text_), example);
    if (!hasNumber_) fail(fmt::format("'{}' holds a unit but no number", text_), example);
    if (negative) result.value = -result.value;
    checkSize(result);
    return result;
  }

  /// Units alone; "1" stands for none and may be divided ("1/s").
  Dimension readUnit() {
    Amount result;
    result.value = 1;
    bool first = true, divide = false;
    for (skipBlanks(); !atEnd(); first = false) {
      if (!first) divide = readOperator();
      readFactor(result, divide);
      skipBlanks();
    }
    return result.dimension;
  }

 private:
  static constexpr const char* example = "a number with an optional unit, such as 0.5, \"135 deg\" or \"3/4 pi\"";

  bool atEnd() const { return position_ == text_.size(); }
  char here() const { return atEnd() ? '\0' : text_[position_]; }
  void skipBlanks() {
    while (here() == ' ' || here() == '\t') ++position_;
  }
  bool take(std::string_view token) {
    if (!text_.substr(position_).starts_with(token)) return false;
    position_ += token.size();
    return true;
  }

  bool readOperator() {
    skipBlanks();
    const bool divide = take("/");
    if (!divide && !take("*")) take("·");
    skipBlanks();
    if (atEnd()) fail(fmt::format("'{}' ends after an operator", text_), example);
    return divide;
  }

  void readFactor(Amount& result, bool divide) {
    if (std::isdigit(static_cast<unsigned char>(here())) != 0 || here() == '.')
      return multiply(result, readDecimal(), divide);
    if (take("π")) return multiplyPi(result, divide);
    const std::string_view symbol = readSymbol();
    if (symbol == "pi") return multiplyPi(result, divide);
    for (const Unit& unit : units)
      if (unit.symbol == symbol) return multiplyUnit(result, unit, (divide ? -1 : 1) * readPower());
    fail(fmt::format("unknown unit '{}' in '{}'", symbol, text_), "one of " + knownUnits());
  }

  void multiply(Amount& result, const mpq_class& factor, bool divide) {
    hasNumber_ = true;
    if (divide && factor == 0) fail(fmt::format("'{}' divides by zero", text_), "a nonzero divisor");
    if (divide) {
      result.value /= factor;
    } else {
      result.value *= factor;
    }
  }

  void multiplyPi(Amount& result, bool divide) {
    hasNumber_ = true;
    result.piPower += divide ? -1 : 1;
  }

  void multiplyUnit(Amount& result, const Unit& unit, int power) {
    const mpq_class value(unit.value);
    for (int i = 0; i < std::abs(power); ++i) {
      if (power > 0) {
        result.value *= value;
      } else {
        result.value /= value;
      }
    }
    result.piPower += power * unit.piPower;
    add(result.dimension, unit.dimension, power);
    if (unit.symbol == "%") {
      if (result.isRelative) fail(fmt::format("'{}' has more than one '%'", text_), "one '%'");
      result.isRelative = true;
    } else {
      result.hasUnit = true;
    }
  }

  /// Up to the next ASCII character that no unit contains; multi-byte characters belong to the symbol.
  std::string_view readSymbol() {
    const std::size_t begin = position_;
    if (take("%")) return "%";
    while (!atEnd() && !text_.substr(position_).starts_with("²") && !text_.substr(position_).starts_with("³") &&
           !text_.substr(position_).starts_with("·") &&
           (std::isalpha(static_cast<unsigned char>(here())) != 0 || static_cast<unsigned char>(here()) >= 0x80))
      ++position_;
    if (position_ == begin) fail(fmt::format("unexpected '{}' in '{}'", here(), text_), example);
    return text_.substr(begin, position_ - begin);
  }

  int readPower() {
    if (take("²")) return 2;
    if (take("³")) return 3;
    if (!take("^")) return 1;
    const bool negative = take("-");
    const std::size_t begin = position_;
    while (std::isdigit(static_cast<unsigned char>(here())) != 0) ++position_;
    const std::string_view digits = text_.substr(begin, position_ - begin);
    if (digits.size() != 1) fail(fmt::format("'{}' has no readable power after '^'", text_), "one digit, such as m^2");
    return (negative ? -1 : 1) * (digits[0] - '0');
  }

  std::string readDigits() {
    std::string digits;
    for (; std::isdigit(static_cast<unsigned char>(here())) != 0 || here() == '_'; ++position_)
      if (here() != '_') digits += here();
    return digits;
  }

  /// digits [. digits] [e[+-]digits] as the rational it stands for.
  mpq_class readDecimal() {
    std::string digits = readDigits();
    long exponent = 0;
    if (take(".")) {
      const std::string fraction = readDigits();
      exponent = -static_cast<long>(fraction.size());
      digits += fraction;
    }
    if (digits.empty()) fail(fmt::format("'{}' has a point without digits", text_), example);
    exponent += readExponent();
    if (digits.size() > 400 || exponent > 700 || exponent < -700) throwTooLarge();
    const mpz_class mantissa(digits, 10);
    mpq_class result(mantissa);
    if (exponent > 0) result *= powerOfTen(static_cast<unsigned long>(exponent));
    if (exponent < 0) result /= powerOfTen(static_cast<unsigned long>(-exponent));
    return result;
  }

  long readExponent() {
    const std::size_t begin = position_;
    if (!take("e") && !take("E")) return 0;
    const bool negative = take("-");
    if (!negative) take("+");
    const std::string digits = readDigits();
    if (digits.empty()) {  // no exponent after all: a symbol follows, which will be judged as a unit
      position_ = begin;
      return 0;
    }
    if (digits.size() > 4) throwTooLarge();
    return (negative ? -1 : 1) * std::stol(digits);
  }

  [[noreturn]] void throwTooLarge() const {
    fail(fmt::format("'{}' is too large or too small", text_), "a magnitude between 1e-300 and 1e300, or 0");
  }

  void checkSize(const Amount& result) const {
    static const mpq_class largest(powerOfTen(300));
    const mpq_class size = abs(result.value);
    if (std::abs(result.piPower) > 20 || size > largest || (size != 0 && size * largest < 1)) throwTooLarge();
  }

  std::string_view text_;
  std::size_t position_ = 0;
  bool hasNumber_ = false;
};

/// |value| pi^piPower to 53 bits in one direction: every step of the 320-bit computation is rounded that way, and a
/// divisor the other way.
double magnitudeOf(const Amount& amount, mpfr_rnd_t direction) {
  const mpfr_rnd_t opposite = direction == MPFR_RNDU ? MPFR_RNDD : direction == MPFR_RNDD ? MPFR_RNDU : MPFR_RNDN;
  const mpq_class size = abs(amount.value);
  mpfr_t x, pi;
  mpfr_inits2(320, x, pi, static_cast<mpfr_ptr>(nullptr));
  double result = 0;
  if (amount.piPower == 0) {  // one rounding, straight to 53 bits
    mpfr_set_prec(x, 53);
    mpfr_set_q(x, size.get_mpq_t(), direction);
  } else {
    mpfr_set_q(x, size.get_mpq_t(), direction);
    mpfr_const_pi(pi, amount.piPower > 0 ? direction : opposite);
    for (int i = 0; i < amount.piPower; ++i) mpfr_mul(x, x, pi, direction);
    for (int i = 0; i > amount.piPower; --i) mpfr_div(x, x, pi, direction);
  }
  result = mpfr_get_d(x, direction);
  mpfr_clears(x, pi, static_cast<mpfr_ptr>(nullptr));
  return result;
}

std::string productOf(const std::vector<std::pair<std::string, int>>& powers) {
  std::string above, below;
  for (const auto& [symbol, power] : powers) {
    std::string& side = power > 0 ? above : below;
    if (power == 0) continue;
    side += (power > 0 ? (side.empty() ? "" : " ") : "/") + symbol;
    if (std::abs(power) > 1) side += "^" + std::to_string(std::abs(power));
  }
  return (above.empty() ? "1" : above) + below;
}

}  // namespace

std::string unitOf(const Dimension& dimension) {
  for (const NamedUnit& named : namedUnits)
    if (named.dimension == dimension) return std::string(named.name);
  return productOf({{"kg", dimension.mass},
                    {"m", dimension.length},
                    {"rad", dimension.angle},
                    {"s", dimension.time},
                    {"GB", dimension.memory}});
}

Dimension dimensionOf(std::string_view unit) { return Reader(unit).readUnit(); }

bool isCompatible(const Dimension& found, const Dimension& expected) {
  if (found == expected) return true;
  Dimension withoutAngle = found;
  withoutAngle.angle = expected.angle;
  return expected.mass != 0 && withoutAngle == expected;
}

Amount parseAmount(std::string_view text) { return Reader(text).read(); }

Interval enclose(const Amount& amount) {
  const double below = magnitudeOf(amount, MPFR_RNDD), above = magnitudeOf(amount, MPFR_RNDU);
  return amount.value < 0 ? Interval(-above, -below) : Interval(below, above);
}

double nearest(const Amount& amount) {
  const double size = magnitudeOf(amount, MPFR_RNDN);
  return amount.value < 0 ? -size : size;
}

}  // namespace gamut
