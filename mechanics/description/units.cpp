// The table of units, and exact arithmetic. Rationals are GMP's, pi is MPFR's with 320 bits, rounded in the direction
// asked for.
#include "mechanics/description/units.hpp"

#include <fmt/format.h>
#include <mpfr.h>

#include <array>
#include <map>
#include <utility>
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
    watt{1, 2, -3, 0}, pascal{1, -1, -2, 0}, metre{0, 1, 0, 0}, memory{0, 0, 0, 0, 1};

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
    Unit{"in", "127/5000", 0, {0, 1, 0, 0}},
    Unit{"ft", "381/1250", 0, {0, 1, 0, 0}},
    Unit{"kg", "1", 0, {1, 0, 0, 0}},
    Unit{"g", "1/1000", 0, {1, 0, 0, 0}},
    Unit{"mg", "1/1000000", 0, {1, 0, 0, 0}},
    Unit{"t", "1000", 0, {1, 0, 0, 0}},
    Unit{"lb", "45359237/100000000", 0, {1, 0, 0, 0}},
    Unit{"s", "1", 0, {0, 0, 1, 0}},
    Unit{"ms", "1/1000", 0, {0, 0, 1, 0}},
    Unit{"us", "1/1000000", 0, {0, 0, 1, 0}},
    Unit{"min", "60", 0, {0, 0, 1, 0}},
    Unit{"h", "3600", 0, {0, 0, 1, 0}},
    Unit{"Hz", "1", 0, {0, 0, -1, 0}},
    Unit{"kHz", "1000", 0, {0, 0, -1, 0}},
    Unit{"N", "1", 0, newton},
    Unit{"mN", "1/1000", 0, newton},
    Unit{"kN", "1000", 0, newton},
    Unit{"MN", "1000000", 0, newton},
    Unit{"lbf", "8896443230521/2000000000000", 0, newton},  // lb times 9.80665 m/s^2
    Unit{"J", "1", 0, joule},
    Unit{"kJ", "1000", 0, joule},
    Unit{"MJ", "1000000", 0, joule},
    Unit{"mW", "1/1000", 0, watt},
    Unit{"W", "1", 0, watt},
    Unit{"kW", "1000", 0, watt},
    Unit{"MW", "1000000", 0, watt},
    Unit{"Pa", "1", 0, pascal},
    Unit{"kPa", "1000", 0, pascal},
    Unit{"MPa", "1000000", 0, pascal},
    Unit{"GPa", "1000000000", 0, pascal},
    Unit{"bar", "100000", 0, pascal},
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
constexpr std::array namedUnitsOfMoments{
    NamedUnit{"N m", joule},
    NamedUnit{"N m/s", {1, 2, -3, 0}},
    NamedUnit{"N m rad", {1, 2, -2, 1}},
    NamedUnit{"N m rad/s", {1, 2, -3, 1}},
};
constexpr std::array namedUnits{
    NamedUnit{"N", newton},
    NamedUnit{"J", joule},
    NamedUnit{"W", watt},
    NamedUnit{"Pa", pascal},
    NamedUnit{"N/s", {1, 1, -3, 0}},
    NamedUnit{"N/m", {1, 0, -2, 0}},
    NamedUnit{"N s/m", {1, 0, -1, 0}},
    NamedUnit{"N m/rad", {1, 2, -2, -1}},
    NamedUnit{"N m s/rad", {1, 2, -1, -1}},
};

Amount checked(Amount amount) {
  static const mpq_class largest = [] {
    mpz_class power;
    mpz_ui_pow_ui(power.get_mpz_t(), 10, 300);
    return mpq_class(power);
  }();
  const mpq_class size = abs(amount.value);
  if (std::abs(amount.piPower) > 20 || size > largest || (size != 0 && size * largest < 1))
    throw UnitError("a number is too large or too small; expected a magnitude between 1e-300 and 1e300, or 0");
  return amount;
}

/// Dimensions and flags of a · b^sign. Who writes N m means a moment.
Amount joined(const Amount& a, const Amount& b, int sign) {
  Amount result = a;
  result.piPower += sign * b.piPower;
  result.dimension = joined(a.dimension, b.dimension, sign);
  const bool isLever =
      (a.dimension == newton && b.dimension == metre) || (a.dimension == metre && b.dimension == newton);
  if (isLever && sign > 0) result.dimension.isOfMoment = true;
  result.hasUnit = a.hasUnit || b.hasUnit;
  result.isRelative = a.isRelative || b.isRelative;
  return result;
}

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

Dimension joined(const Dimension& a, const Dimension& b, int sign) {
  Dimension result{a.mass + sign * b.mass, a.length + sign * b.length, a.time + sign * b.time, a.angle + sign * b.angle,
                   a.memory + sign * b.memory};
  result.isOfMoment = (a.isOfMoment || b.isOfMoment) && result.mass != 0 && result.length == 2 * result.mass;
  return result;
}

std::string unitOf(const Dimension& dimension) {
  for (const NamedUnit& named : namedUnitsOfMoments)
    if (dimension.isOfMoment && named.dimension == dimension) return std::string(named.name);
  for (const NamedUnit& named : namedUnits)
    if (named.dimension == dimension) return std::string(named.name);
  return productOf({{"kg", dimension.mass},
                    {"m", dimension.length},
                    {"rad", dimension.angle},
                    {"s", dimension.time},
                    {"GB", dimension.memory}});
}

std::string rateUnitOf(std::string_view unit) {
  Dimension dimension = dimensionOf(unit);
  --dimension.time;
  return dimension.mass == 0 ? unitOf(dimension) : std::string(unit) + "/s";
}

bool isAlike(Dimension a, const Dimension& b) {
  a.angle = b.angle;
  return a == b;
}

bool isCompatible(const Dimension& found, const Dimension& expected) {
  if (found == expected) return true;
  Dimension withoutAngle = found;
  withoutAngle.angle = expected.angle;
  return expected.mass != 0 && withoutAngle == expected;
}

const Amount* unitNamed(std::string_view symbol) {
  static const std::map<std::string_view, Amount> amounts = [] {
    std::map<std::string_view, Amount> result;
    for (const Unit& unit : units)
      result[unit.symbol] = {mpq_class(unit.value), unit.piPower, unit.dimension, unit.symbol != "%",
                             unit.symbol == "%"};
    return result;
  }();
  const auto found = amounts.find(symbol);
  return found == amounts.end() ? nullptr : &found->second;
}

std::string unitsApart(const std::string& word) {
  for (const std::string first : {"N", "kN", "mN", "MN", "lbf", "W", "kW", "kg"})
    if (word.starts_with(first) && unitNamed(word.substr(first.size())) != nullptr)
      return first + " " + word.substr(first.size());
  return "";
}

std::string unitInsteadOf(const std::string& word) {
  if (const std::string apart = unitsApart(word); !apart.empty()) return "'" + apart + "', with a blank between units";
  std::string list;
  for (const Unit& unit : units) list += (list.empty() ? "" : ", ") + std::string(unit.symbol);
  return "one of " + list;
}

Amount product(const Amount& a, const Amount& b) {
  if (a.isRelative && b.isRelative) throw UnitError("there is more than one '%'; expected one '%'");
  Amount result = joined(a, b, 1);
  result.value *= b.value;
  return checked(result);
}

Amount quotient(const Amount& a, const Amount& b) {
  if (b.value == 0) throw UnitError("a division by zero; expected a nonzero divisor");
  Amount result = joined(a, b, -1);
  result.value /= b.value;
  return checked(result);
}

Amount power(const Amount& a, int exponent) {
  Amount result;
  result.value = 1;
  for (int i = 0; i < std::abs(exponent); ++i) result = exponent > 0 ? product(result, a) : quotient(result, a);
  return result;
}

std::optional<Amount> sum(const Amount& a, const Amount& b) {
  const bool isAlike = a.dimension == b.dimension && a.hasUnit == b.hasUnit && a.isRelative == b.isRelative;
  if (!isAlike || a.piPower != b.piPower) return std::nullopt;
  Amount result = a;
  result.value += b.value;
  return checked(result);
}

Interval enclose(const Amount& amount) {
  const double below = magnitudeOf(amount, MPFR_RNDD), above = magnitudeOf(amount, MPFR_RNDU);
  return amount.value < 0 ? Interval(-above, -below) : Interval(below, above);
}

double nearest(const Amount& amount) {
  const double size = magnitudeOf(amount, MPFR_RNDN);
  return amount.value < 0 ? -size : size;
}

}  // namespace gamut
