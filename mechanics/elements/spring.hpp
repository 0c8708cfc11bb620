// Spring and damper in parallel between points of two frames.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Spring {
  static constexpr const char* type = "spring-damper";
  static constexpr int order = 150;  ///< in the documentation
  static constexpr const char* summary =
      "a spring and a damper in parallel between points of two frames, which must never meet";

  std::string name, from, to;
  Expression stiffness = 0.0, restLength = 0.0, damping = 0.0;              ///< N/m, m, N s/m
  ExpressionVector fromPoint = {0.0, 0.0, 0.0}, toPoint = {0.0, 0.0, 0.0};  ///< m

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
