// Universal joint, cardan or Hooke's joint: two hinges whose axes meet.
#pragma once

#include <vector>

#include "mechanics/description/described.hpp"

namespace gamut {

struct Universal {
  static constexpr const char* type = "universal";
  static constexpr int order = 50;  ///< in the documentation
  static constexpr const char* summary =
      "a universal (cardan) joint: `to` turns about `axis`, fixed in `from`, then about `second_axis`, fixed in `to`";

  std::string name, from, to;
  Axis axis = axisX, secondAxis = axisY;
  Expression angle1 = 0.0, rate1 = 0.0, angle2 = 0.0, rate2 = 0.0;  ///< initial values [rad, rad/s]

  void describe(Fields& f);
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
