// An elastic bushing: six springs and dampers between two frames.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

/// With x the place of `to_point` against `from_point` and A the orientation of `to`, both as `from` sees them, the
/// energy is ½ Σ k_i x_i² + Σ c_i (1 − A_ii), c_x = ½ (κ_y + κ_z − κ_x) and so on: turned by φ about x alone, the
/// moment is −κ_x sin φ; for small turns about any axes, −κ_i φ_i. Regular everywhere.
struct Bushing {
  static constexpr const char* type = "bushing";
  static constexpr int order = 170;  ///< in the documentation
  static constexpr const char* summary =
      "an elastic bushing, with springs and dampers along and about the axes of `from`; about an axis the moment is "
      "`angular_stiffness` times the sine of the turn: linear while turns are small; turns about several axes have the "
      "energy Σ c_i (1 − A_ii), c_i = (κ_j + κ_k − κ_i)/2, with A the orientation of `to` in `from`";

  std::string name, from, to;
  ExpressionVector stiffness = {0.0, 0.0, 0.0}, damping = {0.0, 0.0, 0.0};                ///< N/m, N s/m
  ExpressionVector angularStiffness = {0.0, 0.0, 0.0}, angularDamping = {0.0, 0.0, 0.0};  ///< N m/rad, N m s/rad
  ExpressionVector fromPoint = {0.0, 0.0, 0.0}, toPoint = {0.0, 0.0, 0.0};                ///< m

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
