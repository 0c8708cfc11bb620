// A joint says what it is; what it does to motion, force and inertia follows. With K the frame that carries it, K' the
// frame that it moves, A the rotation from K to K', d the origin of K' in the axes of K, and each speed u that it has
// moving K' by s = (s_ω, s_v), in the axes of K' (R. Featherstone, Rigid Body Dynamics Algorithms, 2008, section 4.4:
// X, S, c):
//
//   w = Σ s_ω u    g = Σ s_v u    c = Aᵀω       b: what (w, g) change by as K' is carried along, at u̇ = 0
//   R' = R A       ω' = c + w                   ω̇' = Aᵀω̇ + Σ s_ω u̇ + b_ω
//   r' = Aᵀ(r + d) v' = Aᵀ(v + ω × d) + g       a' = Aᵀ(a + ω̇ × d + ω × (ω × d)) + b_v + Σ s_v u̇
//   f += A f'      τ += A τ' + d × A f'         Q += s·(τ', f')
//
// Source: MOBILE's elementary joint, LNCS 5045 (2008), eq. 25.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "mechanics/element.hpp"
#include "mechanics/rotation.hpp"

namespace gamut {

/// Where K' stands in K: its axes are turned by `rotation`, and its origin lies at `offset` [m, axes of K].
template <class S>
struct Place {
  Rotation<S> rotation = {};
  Vector3<S> offset = zeroVector<S>();

  bool isKnownConcentric() const { return isKnownZero(offset[0]) && isKnownZero(offset[1]) && isKnownZero(offset[2]); }
};

/// An angular velocity [rad/s] and a velocity [m/s], or what a unit of a speed is of both.
template <class S>
struct Twist {
  Vector3<S> angular = zeroVector<S>();
  Vector3<S> linear = zeroVector<S>();
};

template <class S>
class Joint : public Transmission<S> {
 public:
  /// A joint without speeds fixes K' to K, or moves it by what is not its own.
  Joint(Frame<S>& from, Frame<S>& to, std::vector<Speed<S>*> speeds = {})
      : Transmission<S>(from, to), speeds_(std::move(speeds)) {}

  void doMotion(MotionLevel level = MotionLevel::all) final;
  void doForce(ForceKind = ForceKind::all) final;
  std::vector<Speed<S>*> speeds() const final { return hasSpeeds_ ? speeds_ : std::vector<Speed<S>*>{}; }
  MovingPoint<S> inFrom(const MovingPoint<S>& point) const final;
  TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const final;
  Vector3<S> accelerationBeyond(MotionLevel level) const final;
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) final;

  /// From now on the speeds are those of another element, which moves all inertia that there was behind (spin.hpp).
  void handOverSpeeds() { hasSpeeds_ = false; }

 protected:
  /// At the present positions.
  virtual Place<S> place() const = 0;
  /// s of each speed, in their order.
  virtual std::vector<Twist<S>> motions() const { return {}; }
  /// b, by `carried`, c, and `own`, (w, g). Unless said otherwise that of s which keep their directions as K sees them,
  /// as an axis does that K' turns about and slides along: c × w, 2 c × g. Others add what s change by; s_v that turn
  /// with K', w × g.
  virtual Twist<S> bias(const Vector3<S>& carried, const Twist<S>& own) const;

  /// R' where it is known by other means than R A.
  std::optional<Matrix3<S>> standing_;

 private:
  /// Σ s x, x the rate or the acceleration of each speed.
  Twist<S> sum(const std::vector<Twist<S>>& s, S Speed<S>::*x) const;

  std::vector<Speed<S>*> speeds_;
  bool hasSpeeds_ = true;
  Place<S> place_;  // at the last motion
};

GAMUT_COMPILED_ELSEWHERE(Joint)

}  // namespace gamut
