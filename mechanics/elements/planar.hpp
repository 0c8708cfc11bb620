// Planar joint: `to` slides in a plane and turns about its normal.
#pragma once

#include <array>

#include "mechanics/description/described.hpp"

namespace gamut {

struct Planar {
  static constexpr const char* type = "planar";
  static constexpr int order = 60;  ///< in the documentation
  static constexpr std::array urdf = {"planar"};
  static constexpr const char* summary =
      "a planar joint: `to` slides in a plane of the axes of `from` and turns about its normal";

  std::string name, from, to;
  Axis axis = axisZ;
  /// Initial values: along the two axes that follow the normal cyclically (of z: x, then y), and about it.
  Expression displacement1 = 0.0, displacement1Rate = 0.0, displacement2 = 0.0, displacement2Rate = 0.0, angle = 0.0,
             angleRate = 0.0;

  void describe(Fields& f);
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
