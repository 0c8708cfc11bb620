// Dimensions, units, and numbers that are known exactly: an Amount is rational * pi^k with a dimension, in SI units, so
// that 135 deg and 3/4 pi are the same number and an interval around either is the tightest there is. How people write
// them: expression.hpp.
#pragma once

#include <gmpxx.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "mechanics/description/refusal.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// Powers of kilogram, metre, second, radian, gigabyte, ampere and kelvin.
struct Dimension {
  int mass = 0, length = 0, time = 0, angle = 0, memory = 0, current = 0, temperature = 0;
  bool isOfMoment = false;  ///< N m is meant and not J, as far as it is known; for display, no part of the kind
  friend constexpr bool operator==(const Dimension& a, const Dimension& b) {
    return a.mass == b.mass && a.length == b.length && a.time == b.time && a.angle == b.angle && a.memory == b.memory &&
           a.current == b.current && a.temperature == b.temperature;
  }
};

/// The dimension of a · b^sign. What is made of a moment is of a moment where that can be: per radian, times seconds.
Dimension joined(const Dimension& a, const Dimension& b, int sign);

/// The dimension's SI unit in words, e.g. "kg m^2", "rad/s", "N/m" where it has a name of its own; "1" without one.
/// "N m" of what is known to be a moment, else "J".
std::string unitOf(const Dimension& dimension);

/// The same in symbols that nothing else can be named by, for texts that are read as formulas.
std::string unitInFormulas(const Dimension& dimension);

/// The dimension of a unit: "kg m^2", "N/m", "rad/s"; "" and "1" have none. Throws UnitError.
Dimension dimensionOf(std::string_view unit);

/// Of what changes by so much in a second: "N/s", "m/s^3".
std::string rateUnitOf(std::string_view unit);

/// Whether they differ in radians at most.
bool isAlike(Dimension a, const Dimension& b);

/// True where `found` may be written for `expected`: radians may be left out or put in beside other units
/// (N m is N m/rad), but an angle is no plain number.
bool isCompatible(const Dimension& found, const Dimension& expected);

/// Text that is no amount.
class UnitError : public Refusal {
 public:
  using Refusal::Refusal;
};

/// An exactly known number with a dimension: value * pi^piPower, in SI units.
struct Amount {
  mpq_class value;
  int piPower = 0;
  Dimension dimension;
  bool hasUnit = false;     ///< a unit was written, "rad" included; a plain number takes the unit that is expected
  bool isRelative = false;  ///< written in percent
};

/// Reads an amount: an expression without names. Throws UnitError, also for one that is not rational * pi^k.
Amount parseAmount(std::string_view text);

/// One of a unit: "kg m^2", "1/s"; of "" and "1" the number. Throws UnitError.
Amount oneOfUnit(std::string_view unit);

/// One of the unit with this symbol: "mm", "deg", "%". Null if there is none.
const Amount* unitNamed(std::string_view symbol);
/// Whether a parameter or a state may have the name all the same, which then is meant: T, mA, ns; but not s, kg, mm.
bool mayBeName(std::string_view unit);

/// What would do instead of a word that is no unit: "'N m', with a blank between units" for "Nm"; else the unit
/// that is named so in words, or with other capitals, if there is one, and "one of rad, deg, …".
std::string unitInsteadOf(const std::string& word);
/// Empty if there is none.
std::string nearestUnit(const std::string& word);

/// "N m" of "Nm": a unit of force, power, mass, voltage or current and one written to it, apart; empty of anything
/// else.
std::string unitsApart(const std::string& word);

/// a * b, a / b and a^power. Units and percent carry over. Throw UnitError for 0 as a divisor and beyond 1e±300.
Amount product(const Amount& a, const Amount& b);
Amount quotient(const Amount& a, const Amount& b);
Amount power(const Amount& a, int exponent);
Amount negative(Amount a);
/// a + b, if both are rationals times the same power of pi and have one dimension.
std::optional<Amount> sum(const Amount& a, const Amount& b);

/// The tightest interval around the number.
Interval enclose(const Amount& amount);

/// The double nearest to the number.
double nearest(const Amount& amount);

}  // namespace gamut
