// The distance of two points, and its rate: a measurement.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Distance {
  static constexpr const char* type = "distance";
  static constexpr int order = 300;  ///< in the documentation
  static constexpr const char* summary = "measures the distance between points of two frames, which must never meet";

  std::string name, from, to;
  ExpressionVector fromPoint = {0.0, 0.0, 0.0}, toPoint = {0.0, 0.0, 0.0};  ///< m

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
