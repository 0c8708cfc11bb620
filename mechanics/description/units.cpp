// The table of units, and exact arithmetic. Rationals are GMP's, pi is MPFR's with 320 bits, rounded in the direction
// asked for.
#include "mechanics/description/units.hpp"

#include <fmt/format.h>
#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace gamut {
namespace {

/// value * pi^piPower SI units make one of these; and so many thousandths, thousands, … of them, by prefixes.
struct Unit {
  std::string_view symbol;
  const char* value;
  int piPower;
  Dimension dimension;
  std::string_view prefixes = "";
};

constexpr Dimension none{};
constexpr Dimension angle{0, 0, 0, 1}, perSecond{0, 0, -1, 1}, newton{1, 1, -2, 0}, joule{1, 2, -2, 0},
    watt{1, 2, -3, 0}, pascal{1, -1, -2, 0}, metre{0, 1, 0, 0}, memory{0, 0, 0, 0, 1}, ampere{.current = 1},
    volt{.mass = 1, .length = 2, .time = -3, .current = -1}, ohm{.mass = 1, .length = 2, .time = -3, .current = -2},
    henry{.mass = 1, .length = 2, .time = -2, .current = -2}, farad{.mass = -1, .length = -2, .time = 4, .current = 2},
    weber{.mass = 1, .length = 2, .time = -2, .current = -1}, tesla{.mass = 1, .time = -2, .current = -1};

/// The letter u stands for the micro sign and the Greek letter as well.
constexpr std::array units{
    Unit{"rad", "1", 0, angle, "mu"},
    Unit{"deg", "1/180", 1, angle},
    Unit{"°", "1/180", 1, angle},
    Unit{"rpm", "1/30", 1, perSecond},
    Unit{"m", "1", 0, metre, "kcmunp"},
    Unit{"in", "127/5000", 0, metre},
    Unit{"ft", "381/1250", 0, metre},
    Unit{"kg", "1", 0, {1, 0, 0, 0}},
    Unit{"g", "1/1000", 0, {1, 0, 0, 0}, "munpfa"},
    Unit{"t", "1000", 0, {1, 0, 0, 0}},
    Unit{"lb", "45359237/100000000", 0, {1, 0, 0, 0}},
    Unit{"s", "1", 0, {0, 0, 1, 0}, "mun"},
    Unit{"min", "60", 0, {0, 0, 1, 0}},
    Unit{"h", "3600", 0, {0, 0, 1, 0}},
    Unit{"Hz", "1", 0, {0, 0, -1, 0}, "kMG"},
    Unit{"N", "1", 0, newton, "kMmunp"},
    Unit{"lbf", "8896443230521/2000000000000", 0, newton},  // lb times 9.80665 m/s^2
    Unit{"J", "1", 0, joule, "kMGmun"},
    Unit{"W", "1", 0, watt, "kMGmun"},
    Unit{"Pa", "1", 0, pascal, "kMGm"},
    Unit{"bar", "100000", 0, pascal, "m"},
    Unit{"V", "1", 0, volt, "kmu"},
    Unit{"A", "1", 0, ampere, "kmun"},
    Unit{"ampere", "1", 0, ampere},
    Unit{"Ohm", "1", 0, ohm, "kMm"},
    Unit{"Ω", "1", 0, ohm, "kMm"},       // Greek capital letter omega
    Unit{"\u2126", "1", 0, ohm, "kMm"},  // ohm sign
    Unit{"H", "1", 0, henry, "mun"},
    Unit{"F", "1", 0, farad, "munp"},
    Unit{"C", "1", 0, {.time = 1, .current = 1}, "munp"},
    Unit{"Wb", "1", 0, weber, "m"},
    Unit{"T", "1", 0, tesla, "mu"},
    Unit{"K", "1", 0, {.temperature = 1}, "m"},
    Unit{"kelvin", "1", 0, {.temperature = 1}},
    Unit{"GB", "1", 0, memory},
    Unit{"MB", "1/1000", 0, memory},
    Unit{"GiB", "2097152/1953125", 0, memory},  // 2^30 / 10^9
    Unit{"MiB", "2048/1953125", 0, memory},     // 2^20 / 10^9
    Unit{"%", "1/100", 0, none},
};

/// What nothing else is named by. (Letters as A, C, K and T, and parts as mA and nm, are names of numbers too, and
/// which of both is meant is for a study to say.)
constexpr std::array reservedUnits = std::to_array<std::string_view>(
    {"rad", "mrad", "deg", "°",  "rpm", "m",   "km", "cm",  "mm", "um",     "in",    "ft",  "kg",
     "g",   "mg",   "t",   "lb", "s",   "ms",  "us", "min", "h",  "Hz",     "kHz",   "N",   "mN",
     "kN",  "MN",   "lbf", "J",  "kJ",  "MJ",  "mW", "W",   "kW", "MW",     "Pa",    "kPa", "MPa",
     "GPa", "bar",  "GB",  "MB", "GiB", "MiB", "%",  "Ohm", "Ω",  "ampere", "kelvin"});

struct Prefix {
  char letter;
  const char* value;
};
constexpr std::array prefixes{
    Prefix{'G', "1000000000"},
    Prefix{'M', "1000000"},
    Prefix{'k', "1000"},
    Prefix{'c', "1/100"},
    Prefix{'m', "1/1000"},
    Prefix{'u', "1/1000000"},
    Prefix{'n', "1/1000000000"},
    Prefix{'p', "1/1000000000000"},
    Prefix{'f', "1/1000000000000000"},
    Prefix{'a', "1/1000000000000000000"},
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
    NamedUnit{"N m/A", weber},
};
constexpr std::array namedUnits{
    NamedUnit{"N", newton},
    NamedUnit{"J", joule},
    NamedUnit{"W", watt},
    NamedUnit{"Pa", pascal},
    NamedUnit{"N/s", {1, 1, -3, 0}},
    NamedUnit{"N/m", {1, 0, -2, 0}},
    NamedUnit{"N s/m", {1, 0, -1, 0}},
    NamedUnit{"N rad", {1, 1, -2, 1}},
    NamedUnit{"N/rad", {1, 1, -2, -1}},
    NamedUnit{"N s/rad", {1, 1, -1, -1}},
    NamedUnit{"N m/rad", {1, 2, -2, -1}},
    NamedUnit{"N m s/rad", {1, 2, -1, -1}},
    NamedUnit{"V", volt},
    NamedUnit{"V/s", {.mass = 1, .length = 2, .time = -4, .current = -1}},
    NamedUnit{"V s", weber},
    NamedUnit{"V s/rad", {.mass = 1, .length = 2, .time = -2, .angle = -1, .current = -1}},
    NamedUnit{"Ω", ohm},
    NamedUnit{"H", henry},
    NamedUnit{"F", farad},
    NamedUnit{"C", {.time = 1, .current = 1}},
    NamedUnit{"T", tesla},
};

Amount checked(Amount amount) {
  static const mpq_class largest = [] {
    mpz_class power;
    mpz_ui_pow_ui(power.get_mpz_t(), 10, 300);
    return mpq_class(power);
  }();
  const mpq_class size = abs(amount.value);
  if (std::abs(amount.piPower) > 20 || size > largest || (size != 0 && size * largest < 1))
    throw UnitError("a number is too large or too small", "a magnitude between 1e-300 and 1e300, or 0");
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
  Dimension result{a.mass + sign * b.mass,
                   a.length + sign * b.length,
                   a.time + sign * b.time,
                   a.angle + sign * b.angle,
                   a.memory + sign * b.memory,
                   a.current + sign * b.current,
                   a.temperature + sign * b.temperature};
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
                    {"A", dimension.current},
                    {"K", dimension.temperature},
                    {"GB", dimension.memory}});
}

std::string unitInFormulas(const Dimension& dimension) {
  if (dimension.current == 0 && dimension.temperature == 0) return unitOf(dimension);
  return productOf({{"kg", dimension.mass},
                    {"m", dimension.length},
                    {"rad", dimension.angle},
                    {"s", dimension.time},
                    {"ampere", dimension.current},
                    {"kelvin", dimension.temperature},
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

namespace {

/// All symbols, prefixes in front of them included.
const std::map<std::string, Amount, std::less<>>& amountsOfUnits() {
  static const std::map<std::string, Amount, std::less<>> amounts = [] {
    std::map<std::string, Amount, std::less<>> result;
    for (const Unit& unit : units) {
      Amount one{mpq_class(unit.value), unit.piPower, unit.dimension, unit.symbol != "%", unit.symbol == "%"};
      const std::string symbol(unit.symbol);
      result[symbol] = one;
      const mpq_class value = one.value;
      for (const char letter : unit.prefixes) {
        const auto prefix = std::ranges::find(prefixes, letter, &Prefix::letter);
        one.value = mpq_class(prefix->value) * value;
        result[letter + symbol] = one;
        if (letter == 'u')
          for (const char* micro : {"\u00b5", "\u03bc"}) result[micro + symbol] = one;
      }
    }
    return result;
  }();
  return amounts;
}

}  // namespace

const Amount* unitNamed(std::string_view symbol) {
  const auto found = amountsOfUnits().find(symbol);
  return found == amountsOfUnits().end() ? nullptr : &found->second;
}

bool mayBeName(std::string_view unit) { return std::ranges::find(reservedUnits, unit) == reservedUnits.end(); }

std::string unitsApart(const std::string& word) {
  if (word.size() > 1 && (word.back() == '2' || word.back() == '3')) {  // m2, kgm2
    const std::string unit = word.substr(0, word.size() - 1), power = std::string("^") + word.back();
    const std::string apart = unitsApart(unit);
    return unitNamed(unit) != nullptr ? unit + power : apart.empty() ? "" : apart + power;
  }
  for (const std::string first : {"N", "kN", "mN", "MN", "lbf", "W", "kW", "kg", "V", "mV", "A", "mA"})
    if (word.starts_with(first) && unitNamed(word.substr(first.size())) != nullptr)
      return first + " " + word.substr(first.size());
  return "";
}

/// By its name in words, or written with other capitals. (What is only spelt alike is another unit.)
std::string nearestUnit(const std::string& word) {
  static const std::map<std::string_view, const char*> words = {
      {"meter", "m"},     {"metre", "m"},    {"inch", "in"},    {"foot", "ft"},    {"gram", "g"},
      {"kilogram", "kg"}, {"sec", "s"},      {"second", "s"},   {"minute", "min"}, {"hour", "h"},
      {"hertz", "Hz"},    {"radian", "rad"}, {"degree", "deg"}, {"newton", "N"},   {"joule", "J"},
      {"watt", "W"},      {"pascal", "Pa"},  {"volt", "V"},     {"amp", "A"},      {"henry", "H"},
      {"farad", "F"},     {"coulomb", "C"},  {"weber", "Wb"},   {"tesla", "T"},    {"percent", "%"}};
  static const std::map<std::string_view, const char*> prefixesInWords = {
      {"milli", "m"}, {"micro", "u"}, {"nano", "n"}, {"centi", "c"}, {"kilo", "k"}, {"mega", "M"}, {"giga", "G"}};
  std::string small = word;
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const std::string& one : {small, small.ends_with('s') ? small.substr(0, small.size() - 1) : small}) {
    if (const auto found = words.find(one); found != words.end()) return found->second;
    for (const auto& [prefix, letter] : prefixesInWords)
      if (const auto found = words.find(one.substr(std::min(prefix.size(), one.size())));
          one.starts_with(prefix) && found != words.end() && unitNamed(std::string(letter) + found->second) != nullptr)
        return std::string(letter) + found->second;
  }
  for (const auto& [symbol, amount] : amountsOfUnits())
    if (symbol.size() > 1 && std::ranges::equal(
                                 symbol, word, {}, [](unsigned char c) { return std::tolower(c); },
                                 [](unsigned char c) { return std::tolower(c); }))
      return symbol;
  return "";
}

std::string unitInsteadOf(const std::string& word) {
  if (const std::string apart = unitsApart(word); !apart.empty())
    return "'" + apart + (apart.find(' ') == std::string::npos ? "'" : "', with a blank between units");
  std::string list;
  for (const Unit& unit : units)
    if (unit.symbol != "\u2126" && unit.symbol != "ampere" && unit.symbol != "kelvin")
      list += (list.empty() ? "" : ", ") + std::string(unit.symbol);
  const std::string nearest = nearestUnit(word);
  return (nearest.empty() ? "" : "'" + nearest + "'? (") + "one of " + list +
         ", or a part or multiple such as mm, kN, mA" + (nearest.empty() ? "" : ")");
}

Amount product(const Amount& a, const Amount& b) {
  if (a.isRelative && b.isRelative) throw UnitError("there is more than one '%'", "one '%'");
  Amount result = joined(a, b, 1);
  result.value *= b.value;
  return checked(result);
}

Amount quotient(const Amount& a, const Amount& b) {
  if (b.value == 0) throw UnitError("a division by zero", "a nonzero divisor");
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

Amount negative(Amount a) {
  a.value = -a.value;
  return a;
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
