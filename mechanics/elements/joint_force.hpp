// A force or moment on a joint's coordinate, as an expression of the motion: nonlinear spring, friction, control.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct JointForce {
  static constexpr const char* type = "joint-force";
  static constexpr int order = 250;  ///< in the documentation
  static constexpr const char* summary =
      "a force (N), or a moment (N m), that drives a joint: a nonlinear spring, friction, a controller";

  std::string name, joint;
  Expression force = 0.0;

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
