// Revolute joint, hinge or pin: `to` turns about an axis fixed in both frames.
#pragma once

#include <array>

#include "mechanics/description/described.hpp"

namespace gamut {

struct Revolute {
  static constexpr const char* type = "revolute";
  static constexpr int order = 10;  ///< in the documentation
  static constexpr std::array urdf = {"revolute", "continuous"};
  static constexpr const char* summary = "a hinge: `to` turns about an axis fixed in both frames";

  std::string name, from, to;
  Axis axis = axisX;
  Expression angle = 0.0, rate = 0.0;  ///< initial values [rad, rad/s]

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
