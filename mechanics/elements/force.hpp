// An applied force and moment at a point of a frame.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Force {
  static constexpr const char* type = "force";
  static constexpr int order = 240;  ///< in the documentation
  static constexpr const char* summary =
      "a force and a moment on a frame, constant or expressions of time and of the motion";

  std::string name, at;
  ExpressionVector force = {0.0, 0.0, 0.0}, moment = {0.0, 0.0, 0.0};  ///< N, N m
  ExpressionVector point = {0.0, 0.0, 0.0};                            ///< in `at` [m]
  std::string in = "inertial";                                         ///< or "frame": whose axes the components have

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
