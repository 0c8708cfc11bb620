// A wheel that rolls on a plane without slip.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/described.hpp"

namespace gamut {

struct RollingWheel {
  static constexpr const char* type = "rolling-wheel";
  static constexpr const char* summary =
      "a wheel, a coin, a hoop that rolls without slip on the plane of x and y of `from`, above it, and turns on the "
      "spot without resistance. `to` is in its centre, with y as its axle; all of it may lean, but not lie flat, where "
      "its coordinates are singular. Neither lifting nor slipping is in it: see that `normal_force` stays above 0, and "
      "`squared_grip` below the square of the coefficient of friction. Of a wheel that rolls in one vertical plane, a "
      "`coupling` of its "
      "slide "
      "and its turn has fewer states";

  std::string name, from, to;
  Expression radius = 0.0, tread = 0.0;
  // Initial values: where it touches the plane, its direction, lean and turn, and their rates.
  Expression x = 0.0, y = 0.0, heading = 0.0, headingRate = 0.0, lean = 0.0, leanRate = 0.0, angle = 0.0,
             angleRate = 0.0;

  void describe(Fields& f);
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
