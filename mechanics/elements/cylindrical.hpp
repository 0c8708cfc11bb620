// Cylindrical joint: `to` slides along an axis and turns about it, each as it likes.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Cylindrical {
  static constexpr const char* type = "cylindrical";
  static constexpr int order = 40;  ///< in the documentation
  static constexpr const char* summary = "a sleeve: `to` slides along an axis and turns about it";

  std::string name, from, to;
  Axis axis = axisX;
  Expression displacement = 0.0, displacementRate = 0.0, angle = 0.0, angleRate = 0.0;  ///< initial values

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
