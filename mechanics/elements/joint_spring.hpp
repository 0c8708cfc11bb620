// Spring and viscous friction on a joint's own coordinate.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct JointSpring {
  static constexpr const char* type = "joint-spring";
  static constexpr int order = 160;  ///< in the documentation
  static constexpr const char* summary = "a spring and viscous friction on a joint";

  std::string name, joint;
  Expression stiffness = 0.0, rest = 0.0, damping = 0.0;  ///< N m/rad or N/m, rad or m, N m s/rad or N s/m

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
