// A wheel that rolls on a plane without slip.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/described.hpp"

namespace gamut {

struct RollingWheel {
  static constexpr const char* type = "rolling-wheel";
  static constexpr int order = 90;  ///< in the documentation
  static constexpr const char* summary =
      "a wheel, a coin, a hoop that rolls without slip on the plane of x and y of `from`, above it, and turns on the "
      "spot without resistance. `to` is in its centre, with y as its axle; all of it may lean, by less than 90 "
      "degrees: "
      "its coordinates are singular where it lies flat. Neither lifting nor slipping is in it: see that `normal_force` "
      "stays above 0, and `squared_grip` below the square of the coefficient of friction. Loads on its coordinates "
      "react "
      "on `from`: the motor of what rides on the wheel drives a hinge between them. One that rolls in a vertical plane "
      "has "
      "`lean` and `heading` driven at 0, or is a `coupling` of a slide and a turn";

  std::string name, from, to;
  Expression radius = 0.0, crownRadius = 0.0;  ///< m
  // Initial values: where it touches the plane [m], its direction, lean and turn [rad], and their rates [rad/s].
  Expression x = 0.0, y = 0.0, heading = 0.0, headingRate = 0.0, lean = 0.0, leanRate = 0.0, angle = 0.0,
             angleRate = 0.0;

  void describe(Fields& f);
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
