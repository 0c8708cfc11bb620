// What is measured of frames and bodies, as values: orientations by three numbers, and the motion of one frame as
// another one sees it.
#pragma once

#include <cmath>

#include "mechanics/element.hpp"

namespace gamut {

/// Roll, pitch and yaw [rad] of a rotation R = Rz(yaw) Ry(pitch) Rx(roll): turned about the fixed axes x, y and z, in
/// this order. Singular where pitch is ±π/2; roll and yaw jump at ±π, and are π where they are either (so zeros lose
/// their signs).
template <class S>
Vector3<S> rollPitchYaw(const Matrix3<S>& r) {
  using std::atan2, std::sqrt;
  return {S(atan2(S(r(2, 1) + S(0.0)), r(2, 2))), S(atan2(S(-r(2, 0)), S(sqrt(square(r(0, 0)) + square(r(1, 0)))))),
          S(atan2(S(r(1, 0) + S(0.0)), r(0, 0)))};
}

/// θ u [rad] of a rotation by the angle θ, from 0 to π, about the unit vector u. Singular at θ = 0 and at θ = π: with
/// w = 2 sin θ u, it is w θ/|w|.
template <class S>
Vector3<S> rotationVector(const Matrix3<S>& r) {
  using std::atan2, std::sqrt;
  const Vector3<S> w(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  const S length = sqrt(square(w[0]) + square(w[1]) + square(w[2]));
  const S factor = atan2(length, S(r(0, 0) + r(1, 1) + r(2, 2) - S(1.0))) / length;
  return w * factor;
}

/// The acceleration of a point fixed in the frame, in its axes.
template <class S>
Vector3<S> accelerationOf(const Frame<S>& frame, const Vector3<S>& point) {
  return frame.a + offsetAcceleration(frame.omega, frame.omegaDot) * point;
}

/// A frame as another one sees it. With p the points looked at, r, v, a, ω resolved in each frame and A = R₁ᵀ R₂:
///   x = A(r₂ + p₂) − r₁ − p₁          ẋ = A(v₂ + ω₂ × p₂) − v₁ − ω₁ × (x + p₁)
///   ẍ = A a₂(p₂) − a₁ − W₁(x + p₁) − 2 ω₁ × ẋ     (W: offsetAcceleration)
///   ω = A ω₂ − ω₁                     ω̇ = A ω̇₂ − ω̇₁ − ω₁ × A ω₂
template <class S>
class RelativeMotionOf {
 public:
  RelativeMotionOf(const Frame<S>& from, Vector3<S> fromPoint, const Frame<S>& to, Vector3<S> toPoint)
      : from_(from), to_(to), fromPoint_(std::move(fromPoint)), toPoint_(std::move(toPoint)) {}

  Vector3<S> position() const { return fromOrigin() - fromPoint_; }
  Vector3<S> velocity() const {
    return seen(to_.v + to_.omega.cross(toPoint_)) - from_.v - from_.omega.cross(fromOrigin());
  }
  Vector3<S> acceleration() const {
    return seen(accelerationOf(to_, toPoint_)) - accelerationOf(from_, fromOrigin()) -
           S(2.0) * from_.omega.cross(velocity());
  }
  Vector3<S> angularVelocity() const { return seen(to_.omega) - from_.omega; }
  Vector3<S> angularAcceleration() const {
    return seen(to_.omegaDot) - from_.omegaDot - from_.omega.cross(seen(to_.omega));
  }
  Matrix3<S> orientation() const { return from_.R.transpose() * to_.R; }
  /// A vector of `to` in the axes of `from`.
  Vector3<S> seen(const Vector3<S>& x) const { return from_.R.transpose() * Vector3<S>(to_.R * x); }

 private:
  /// Of the point looked at.
  Vector3<S> fromOrigin() const { return seen(to_.r + toPoint_) - from_.r; }

  const Frame<S>& from_;
  const Frame<S>& to_;
  Vector3<S> fromPoint_, toPoint_;
};

/// What a body adds to the momentum of the whole, in the inertial frame.
template <class S>
struct Momentum {
  S mass = S(0.0);                            ///< kg
  Vector3<S> moment = zeroVector<S>();        ///< mass times the position of its centre [kg m]
  Vector3<S> linear = zeroVector<S>();        ///< kg m/s
  Vector3<S> angular = zeroVector<S>();       ///< about the inertial origin [kg m²/s]
  Vector3<S> linearChange = zeroVector<S>();  ///< of `linear`, by the frame's present acceleration [N]

  Momentum& operator+=(const Momentum& other) {
    mass = mass + other.mass;
    moment += other.moment;
    linear += other.linear;
    angular += other.angular;
    linearChange += other.linearChange;
    return *this;
  }
};

/// Of an inertia by what it is about its frame's origin: with A, B, C of SpatialInertia, p = Bᵀ ω + C v and
/// L = A ω + B v, about the origin; B = m [c]×.
template <class S>
Momentum<S> momentumOf(const Inertia<S>& inertia) {
  const Frame<S>& k = inertia.frame();
  const SpatialInertia<S> m = inertia.spatial();
  const Vector3<S> first(m.coupling(2, 1), m.coupling(0, 2), m.coupling(1, 0));  // m c
  const Vector3<S> linear = m.coupling.transpose() * k.omega + m.linear * k.v;
  const Vector3<S> angular = m.angular * k.omega + m.coupling * k.v;
  Momentum<S> result;
  result.mass = m.linear(0, 0);
  result.moment = k.R * Vector3<S>(first + k.r * result.mass);
  result.linear = k.R * linear;
  result.angular = k.R * Vector3<S>(angular + k.r.cross(linear));
  result.linearChange = k.R * Vector3<S>(k.a * result.mass + offsetAcceleration(k.omega, k.omegaDot) * first);
  return result;
}

}  // namespace gamut
