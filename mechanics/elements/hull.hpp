// A convex polyhedron that a frame carries: a shape.
#pragma once

#include <optional>

#include "mechanics/description/described.hpp"
#include "mechanics/polyhedron.hpp"

namespace gamut {

struct Hull {
  static constexpr const char* type = "hull";
  static constexpr int order = 345;  ///< in the documentation
  static constexpr const char* summary =
      "a shape that a frame carries, for `separation`: a convex polyhedron, the hull of points, which are exact. It "
      "has "
      "neither mass nor contact, and is a frame itself, of its own name, with the axes of `at`";

  std::string name, at;
  std::vector<ExpressionVector> points;       ///< from `centre` [m]
  Expression radius = 0.0;                    ///< m
  ExpressionVector centre = {0.0, 0.0, 0.0};  ///< in `at` [m]

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

}  // namespace gamut
