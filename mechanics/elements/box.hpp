// A box that a frame carries: a shape.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Cuboid {
  static constexpr const char* type = "box";
  static constexpr int order = 340;  ///< in the documentation
  static constexpr const char* summary =
      "a shape that a frame carries, for `separation`: a box with right angles. It has neither mass nor contact, and "
      "is "
      "a frame itself, of its own name, at its centre, with axes along its edges";

  std::string name, at;
  ExpressionVector size = {0.0, 0.0, 0.0}, centre = {0.0, 0.0, 0.0};  ///< m, in `at` [m]
  std::vector<FixedRotation> rotation = {};

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

}  // namespace gamut
