// What moves along a plane by quasi-velocities, which add up to no coordinates (nonholonomic constraints; Ju. I.
// Neimark, N. A. Fufaev, Dynamics of Nonholonomic Systems, 1972).
//
//   gliding (angle ψ about z, place x, y; along, across: the velocity of the origin in the axes of K')
//       ẋ = along cos ψ − across sin ψ     ẏ = along sin ψ + across cos ψ
//       A(z, ψ)   d = (x, y, 0)   s = (z, 0), (0, x'), (0, y'), of which the last two turn with K'
//
// On a plane that stands still x and y are in the place of K' alone: without loads that depend on it, the equations of
// motion do not either.
#pragma once

#include <array>

#include "mechanics/joint.hpp"

namespace gamut {

/// A motion in the plane of x and y: by a direction ψ and the velocity [m/s] in the axes that have it.
template <class S>
struct Gliding {
  Variable<S>* angle;
  Speed<S>* along;
  Speed<S>* across = nullptr;  ///< none: it never glides sideways

  std::vector<Speed<S>*> speeds() const {
    if (across) return {angle, along, across};
    return {angle, along};
  }
  /// ẋ (0) or ẏ (1).
  S placeRate(int i) const {
    const Vector3<S> velocity(along->rate, across ? across->rate : S(0.0), S(0.0));
    return Rotation<S>(axisZ, angle->position).toParent(velocity)[i];
  }
};

/// x and y [m] of what moves along a plane.
template <class S>
using PlaceInPlane = std::array<const S*, 2>;

/// Moves frame `to` so.
template <class S>
class GlidingJoint final : public Joint<S> {
 public:
  GlidingJoint(Frame<S>& from, Frame<S>& to, Gliding<S> gliding, PlaceInPlane<S> place)
      : Joint<S>(from, to, gliding.speeds()), gliding_(gliding), place_(place) {}

 private:
  Place<S> place() const override {
    return {Rotation<S>(axisZ, gliding_.angle->position), {*place_[0], *place_[1], S(0.0)}};
  }
  /// The last is of `across`, where that is.
  std::vector<Twist<S>> motions() const override {
    return {{axisZ.unit<S>()}, {zeroVector<S>(), axisX.unit<S>()}, {zeroVector<S>(), axisY.unit<S>()}};
  }
  Twist<S> bias(const Vector3<S>& carried, const Twist<S>& own) const override {
    return {carried.cross(own.angular), Vector3<S>(S(2.0) * carried + own.angular).cross(own.linear)};
  }

  Gliding<S> gliding_;
  PlaceInPlane<S> place_;
};

}  // namespace gamut
