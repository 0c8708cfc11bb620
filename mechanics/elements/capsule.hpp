// A capsule that a frame carries: a shape.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Capsule {
  static constexpr const char* type = "capsule";
  static constexpr int order = 330;  ///< in the documentation
  static constexpr const char* summary =
      "a shape that a frame carries, for `separation`: a cylinder with a half sphere on either end, which is all that "
      "lies within `radius` of a segment. It has neither mass nor contact, and is a frame itself, of its own name, at "
      "its centre";

  std::string name, at;
  Expression radius = 0.0, length = 0.0;      ///< m
  Axis axis = axisZ;                          ///< in `at`
  ExpressionVector centre = {0.0, 0.0, 0.0};  ///< in `at` [m]

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

}  // namespace gamut
