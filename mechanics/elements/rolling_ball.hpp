// A ball that rolls on a plane without slip.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/described.hpp"
#include "mechanics/description/orientation.hpp"

namespace gamut {

struct RollingBall {
  static constexpr const char* type = "rolling-ball";
  static constexpr int order = 100;  ///< in the documentation
  static constexpr const char* summary =
      "a ball that rolls without slip on the plane of x and y of `from`, above it, and turns on the spot without "
      "resistance. `to` is in its centre; its orientation is a unit quaternion, `NAME.quaternion.w` … "
      "`NAME.quaternion.z`. Neither lifting nor slipping is in it: see that `normal_force` stays above 0, and "
      "`squared_grip` below the square of the coefficient of friction";

  std::string name, from, to;
  Expression radius = 0.0;  ///< m
  // Initial values: where it touches the plane [m], the orientation, and the angular velocity in the axes of `from`
  // [rad/s].
  Expression x = 0.0, y = 0.0;
  std::vector<FixedRotation> orientation = rollPitchYaw();
  ExpressionVector rate = {0.0, 0.0, 0.0};

  void describe(Fields& f);
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
