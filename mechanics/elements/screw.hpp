// Screw joint: `to` turns about an axis and slides along it in proportion.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Screw {
  static constexpr const char* type = "screw";
  static constexpr int order = 30;  ///< in the documentation
  static constexpr const char* summary = "a screw: `to` turns about an axis and slides along it in proportion";

  std::string name, from, to;
  Axis axis = axisX;
  Expression lead = 0.0;               ///< [m] a turn
  Expression angle = 0.0, rate = 0.0;  ///< initial values [rad, rad/s]

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
