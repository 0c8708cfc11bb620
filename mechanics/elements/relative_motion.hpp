// How a frame, or a point of it, moves as another frame sees it: a measurement.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct RelativeMotion {
  static constexpr const char* type = "relative-motion";
  static constexpr int order = 310;  ///< in the documentation
  static constexpr const char* summary =
      "measures how a frame, or a point of it, moves and is turned as another frame sees it";

  std::string name, from, to;
  Axis axis = axisZ;                                                        ///< of both
  ExpressionVector fromPoint = {0.0, 0.0, 0.0}, toPoint = {0.0, 0.0, 0.0};  ///< m

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
