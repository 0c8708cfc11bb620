// A sphere, or a point, that a frame carries: a shape.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Sphere {
  static constexpr const char* type = "sphere";
  static constexpr int order = 320;  ///< in the documentation
  static constexpr const char* summary =
      "a shape that a frame carries, for `separation`: a sphere, or a point. It has neither mass nor contact, and is a "
      "frame itself, of its own name, at its centre";

  std::string name, at;
  Expression radius = 0.0;                    ///< m
  ExpressionVector centre = {0.0, 0.0, 0.0};  ///< in `at` [m]

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

}  // namespace gamut
