// What is measured of frames and bodies, as values: orientations by three numbers, and the motion of one frame as
// another one sees it.
#pragma once

#include <array>
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

namespace detail {

/// c_0 … c_n with asin(x)/x = Σ c_k x^(2k) for |x| ≤ sin(π/16): c_k = c_(k-1) (2k - 1)²/(2k (2k + 1)), which fall, so
/// that all terms from x^(2n) on are within c_n x^(2n) [1, 1/(1 - x²)].
inline std::array<Interval, 11> arcSineCoefficients() {
  std::array<Interval, 11> c{Interval(1.0)};
  for (std::size_t k = 1; k < c.size(); ++k) {
    const double even = 2.0 * static_cast<double>(k);
    c[k] = c[k - 1] * Interval((even - 1) * (even - 1)) / Interval(even * (even + 1));
  }
  c.back() *= Interval(1.0, 1.04);  // sin²(π/16) < 0.0381
  return c;
}

}  // namespace detail

/// θ u [rad] of a rotation by the angle θ, from 0 to π, about the unit vector u. Singular at θ = π. With w = 2 sin θ u,
/// which R - Rᵀ holds, it is w (θ/sin θ)/2, and
///   θ/sin θ = asin(x)/x / (cos(θ/2) cos(θ/4) cos(θ/8) cos(θ/16)),   x = sin(θ/16)   (F. Viète, 1593).
/// Half of each component is from -π/2 to π/2, so that it is the arc sine of its sine, which says no more than that of
/// what is not known.
template <class S>
Vector3<S> rotationVector(const Matrix3<S>& r) {
  using std::asin, std::sin, std::sqrt;
  const S half(0.5);
  const Vector3<S> w(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
  // cos²(θ/2) = A = A² + A (1 - A), of which near θ = π the second keeps its digits.
  const S a = S(0.25) * S(r(0, 0) + r(1, 1) + r(2, 2) + S(1.0));
  S cosine = sqrt(S(square(a) + S(0.0625) * S(square(w[0]) + square(w[1]) + square(w[2])))), product = cosine;
  for (int halving = 1; halving < 4; ++halving) {
    cosine = sqrt(S(half + half * cosine));
    product = product * cosine;
  }
  const std::array<Interval, 11> c = detail::arcSineCoefficients();
  const S xx = S(1.0) - cosine * cosine;
  S series = constant<S>(c.back());
  for (std::size_t k = c.size() - 1; k-- > 0;) series = constant<S>(c[k]) + xx * series;
  const S quarter = half * half * series / product;
  Vector3<S> turn;
  for (int i = 0; i < 3; ++i) turn[i] = S(2.0) * S(asin(S(sin(S(w[i] * quarter)))));
  return turn;
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
