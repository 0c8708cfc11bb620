// Prismatic joint or slider: `to` slides along an axis.
#pragma once

#include <array>

#include "mechanics/description/described.hpp"

namespace gamut {

struct Prismatic {
  static constexpr const char* type = "prismatic";
  static constexpr int order = 20;  ///< in the documentation
  static constexpr std::array urdf = {"prismatic"};
  static constexpr const char* summary = "a slider: `to` slides along an axis";

  std::string name, from, to;
  Axis axis = axisX;
  Expression displacement = 0.0, rate = 0.0;  ///< initial values [m, m/s]

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
