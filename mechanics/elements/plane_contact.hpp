// A point or a sphere that touches a plane: elastic, with friction.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

/// With n the plane's normal, x the sphere's centre against a point of the plane and r its radius, gap = n·x − r,
/// depth = max(0, −gap), u the velocity of the sphere's point c = x − r n against the plane, u_t what of it is along
/// the plane, d = `damping`, v = `slip_rate`:
///
///   N = k depth max(0, 1 − d n·u)     T = −μ N u_t / √(|u_t|² + v²)     F = N n + T, both bodies feel it at c
///
/// (K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42, 1975, with exponent 1). It does not jump at contact.
struct PlaneContact {
  static constexpr const char* type = "plane-contact";
  static constexpr int order = 220;  ///< in the documentation
  static constexpr const char* summary =
      "a point, or a sphere, of `to` that touches a plane fixed in `from`. It is pushed out by `stiffness` times depth "
      "times (1 + `damping` times the speed of entering), and never pulled in. Friction is against the slip u of the "
      "sphere's point that touches, `friction` times that force times u/√(u² + `slip_rate`²): under load it creeps "
      "where it would stick, by `slip_rate` times the share of friction that the load takes, nearly. Of a wheel that "
      "rolls in a plane and never slips, a `coupling` of its slide and its turn has no creep, and costs less";

  std::string name, from, to;
  ExpressionVector fromPoint = {0.0, 0.0, 0.0}, toPoint = {0.0, 0.0, 0.0};                  ///< m
  Axis normal = axisZ;                                                                      ///< in `from`, outwards
  Expression radius = 0.0, stiffness = 0.0, damping = 0.0, friction = 0.0, slipRate = 0.0;  ///< m, N/m, s/m, 1, m/s

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

}  // namespace gamut
