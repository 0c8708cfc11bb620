// Spherical joint: `to` turns as it likes, by a unit quaternion and body rates.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/described.hpp"
#include "mechanics/description/orientation.hpp"

namespace gamut {

struct Spherical {
  static constexpr const char* type = "spherical";
  static constexpr int order = 70;  ///< in the documentation
  static constexpr const char* summary =
      "a ball and socket: `to` turns as it likes; its orientation is a unit quaternion, `NAME.quaternion.w` … "
      "`NAME.quaternion.z`, which is nowhere singular";

  std::string name, from, to;
  std::vector<FixedRotation> orientation = rollPitchYaw();  ///< initial
  ExpressionVector rate = {0.0, 0.0, 0.0};                  ///< initial angular velocity, in the axes of `to` [rad/s]

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
