// Free joint: `to` moves as it likes, in six degrees of freedom.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanics/description/described.hpp"
#include "mechanics/description/orientation.hpp"

namespace gamut {

struct Free {
  static constexpr const char* type = "free";
  static constexpr int order = 110;  ///< in the documentation
  static constexpr std::array urdf = {"floating"};
  static constexpr const char* summary =
      "no joint: `to` moves as it likes; its orientation is a unit quaternion, `NAME.quaternion.w` … "
      "`NAME.quaternion.z`, which is nowhere singular";

  std::string name, from, to;
  // Initial values: the place of `to` in `from` [m] and its rate [m/s], the orientation, and the angular velocity in
  // the axes of `to` [rad/s].
  ExpressionVector position = {0.0, 0.0, 0.0}, velocity = {0.0, 0.0, 0.0};
  std::vector<FixedRotation> orientation = rollPitchYaw();
  ExpressionVector rate = {0.0, 0.0, 0.0};

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
