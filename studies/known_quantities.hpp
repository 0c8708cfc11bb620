// What of a mechanism can be uncertain, and what can be looked at.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"

namespace gamut {

struct KnownQuantity {
  std::string name, unit;
  double nominal = 0;  ///< in the SI unit
};

/// Numbers of the mechanism, with their nominal values.
std::vector<KnownQuantity> numbersOf(const Mechanism& mechanism);

/// What can be an output, with its value at the start; NaN where it has none, as the acceleration of what moves no
/// mass. Throws std::invalid_argument where the mechanism cannot be assembled.
std::vector<KnownQuantity> measurableOf(const Mechanism& mechanism);

}  // namespace gamut
