// Quantities as people write them, read without rounding: "135 deg", "3/4 pi", "-11/20 pi rad", "250 g", "9.81 m/s^2".
// An Amount is rational * pi^k with a dimension, in SI units, so that 135 deg and 3/4 pi are the same number and an
// interval around either is the tightest there is.
//
// Grammar: a product of factors, read from left to right, joined by a blank, '*' or '/' (which divides by the next
// factor alone); a factor is a decimal, pi (or π) or a unit, a unit perhaps with a power ("m^2", "m²"). One sign in
// front.
#pragma once

#include <gmpxx.h>

#include <stdexcept>
#include <string>
#include <string_view>

#include "scalars/interval.hpp"

namespace gamut {

/// Powers of kilogram, metre, second, radian and gigabyte.
struct Dimension {
  int mass = 0, length = 0, time = 0, angle = 0, memory = 0;
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

/// The dimension's SI unit in words, e.g. "kg m^2", "rad/s", "N/m" where it has a name of its own; "1" without one.
std::string unitOf(const Dimension& dimension);

/// The dimension of a unit: "kg m^2", "N/m", "rad/s"; "" and "1" have none. Throws UnitError.
Dimension dimensionOf(std::string_view unit);

/// True where `found` may be written for `expected`: radians may be left out or put in beside other units
/// (N m is N m/rad), but an angle is no plain number.
bool isCompatible(const Dimension& found, const Dimension& expected);

/// Text that is no amount; what() says what is wrong and what was expected, as "…; expected …".
class UnitError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// An exactly known number with a dimension: value * pi^piPower, in SI units.
struct Amount {
  mpq_class value;
  int piPower = 0;
  Dimension dimension;
  bool hasUnit = false;     ///< a unit was written, "rad" included; a plain number takes the unit that is expected
  bool isRelative = false;  ///< written in percent
};

/// Reads an amount. Throws UnitError for malformed text, unknown units, division by zero and magnitudes beyond 1e±300.
Amount parseAmount(std::string_view text);

/// The tightest interval around the number.
Interval enclose(const Amount& amount);

/// The double nearest to the number.
double nearest(const Amount& amount);

}  // namespace gamut
