// Numbers over time, as a table gives them.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/units.hpp"

namespace gamut {

struct TimeTable {
  std::string file, column;  ///< where it is from
  std::vector<mpq_class> times,
      values;  ///< s, rising; SI units, of which they are so many times π^piPower; two at least
  int piPower = 0;
};

/// The most rows that a table has: each is a piece of the motion's equations.
inline constexpr std::size_t maxTableRows = 1000;

}  // namespace gamut
