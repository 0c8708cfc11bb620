// A body fixed to a frame: mass, centre of mass, inertia about that centre.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Mass {
  static constexpr const char* type = "mass";
  static constexpr int order = 140;  ///< in the documentation
  static constexpr const char* summary = "a body fixed to a frame; without `inertia` a point mass";

  std::string name, at;
  Expression mass = 0.0;                                               ///< kg
  ExpressionVector centre = {0.0, 0.0, 0.0};                           ///< in `at` [m]
  std::array<Expression, 6> inertia = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};  ///< xx, yy, zz, xy, yz, zx [kg m²]
  std::vector<FixedRotation> rotation = {};                            ///< of the inertia's axes against `at`

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

}  // namespace gamut
