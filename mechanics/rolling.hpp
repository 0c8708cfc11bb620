// Joints that roll without slip, or glide along an edge: their quasi-velocities move a point along a plane, and add up
// to no coordinates (nonholonomic constraints; Ju. I. Neimark, N. A. Fufaev, Dynamics of Nonholonomic Systems, 1972).
//
//   gliding (angle ψ about z, place x, y; along, across: the velocity of the origin in the axes of K')
//       ẋ = along cos ψ − across sin ψ     ẏ = along sin ψ + across cos ψ     d = (x, y, 0)   w = (along, across, 0)
//       R' = R A    r' = Aᵀ(r + d)         ω' = Aᵀω + z ψ̇                    v' = Aᵀ(v + ω × d) + w
//       ω̇' = Aᵀω̇ + Aᵀω × z ψ̇ + z ψ̈      a' = Aᵀ(a + ω̇ × d + ω × (ω × d)) + 2 Aᵀω × w + z ψ̇ × w + ẇ
//       f += A f'   τ += A τ' + d × A f'   Q_ψ += τ'_z   Q_along += f'_x   Q_across += f'_y
//
// On a plane that stands still x and y are in the place of K' alone: without loads that depend on it, the equations of
// motion do not either.
#pragma once

#include "mechanics/element.hpp"
#include "mechanics/rotation.hpp"

namespace gamut {

/// A motion in the plane of x and y: by a direction ψ and the velocity [m/s] in the axes that have it.
template <class S>
struct Gliding {
  Variable<S>* angle;
  Speed<S>* along;
  Speed<S>* across = nullptr;  ///< none: it never glides sideways

  Vector3<S> velocity() const { return {along->rate, across ? across->rate : S(0.0), S(0.0)}; }
  /// ẋ (0) or ẏ (1).
  S placeRate(int i) const { return Rotation<S>(axisZ, angle->position).toParent(velocity())[i]; }
};

/// x and y [m] of what moves along a plane.
template <class S>
using PlaceInPlane = std::array<const S*, 2>;

/// Moves frame `to` so.
template <class S>
class GlidingJoint final : public Transmission<S> {
 public:
  GlidingJoint(Frame<S>& from, Frame<S>& to, Gliding<S> gliding, PlaceInPlane<S> place)
      : Transmission<S>(from, to), own_(gliding), place_(place) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  std::vector<Speed<S>*> speeds() const override;

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override;
  TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const override;
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override;

 private:
  Vector3<S> offset() const { return {*place_[0], *place_[1], S(0.0)}; }
  Vector3<S> turning() const { return {S(0.0), S(0.0), own_.angle->rate}; }

  Gliding<S> own_;
  PlaceInPlane<S> place_;
  Rotation<S> rotation_;
};

/// How a wheel that rolls moves the point where it touches a plane, by its lean θ about x and its turn φ about its axle
/// y. With ρ the radius to which its tread is crowned, and R that of the circle about which it is, v + ω × (touching −
/// centre) = 0, v the velocity of the centre, says
///
///   along = (R + ρ cos θ) φ̇     across = −ρ θ̇
///
/// Ahead of the joints.
template <class S>
class WheelRolling final : public Gearing<S> {
 public:
  /// `circle`: R, `crown`: ρ [m].
  WheelRolling(Variable<S>& lean, Variable<S>& angle, S circle, S crown)
      : lean_(lean), angle_(angle), circle_(std::move(circle)), crown_(std::move(crown)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  Speed<S>& along() { return along_; }
  Speed<S>& across() { return across_; }

 private:
  Variable<S>& lean_;
  Variable<S>& angle_;
  S circle_, crown_;
  S reach_ = S(0.0), slope_ = S(0.0);  // R + ρ cos θ, ρ sin θ
  Speed<S> along_, across_;
};

/// Carries frame `to` in the centre of a ball that rolls, in axes that do not turn with it: by the angular velocity w
/// against the plane, in the axes of `from`. With r its radius, d = (x, y, r) and g = r (w_y, −w_x, 0),
///
///   R' = R   r' = r + d   ω' = ω + w   v' = v + ω × d + g   ω̇' = ω̇ + ω × w + ẇ
///   a' = a + ω̇ × d + ω × (ω × d) + 2 ω × g + ġ   f += f'   τ += τ' + d × f'   Q += τ' + r (−f'_y, f'_x, 0)
template <class S>
class RollingBallJoint final : public Transmission<S> {
 public:
  /// `orientation` with rates in the axes of `from`; `radius`: r [m].
  RollingBallJoint(Frame<S>& from, Frame<S>& to, Orientation<S> orientation, PlaceInPlane<S> place, S radius)
      : Transmission<S>(from, to), own_(std::move(orientation)), place_(place), radius_(std::move(radius)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  std::vector<Speed<S>*> speeds() const override { return {own_.speeds.begin(), own_.speeds.end()}; }

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override;
  TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const override;
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override;

 private:
  Vector3<S> offset() const { return {*place_[0], *place_[1], radius_}; }
  Vector3<S> gliding(const Vector3<S>& w) const { return {S(radius_ * w[1]), S(-(radius_ * w[0])), S(0.0)}; }

  Orientation<S> own_;
  PlaceInPlane<S> place_;
  S radius_;
};

/// Turns the axes of what moves already, as a ball does in axes that do not turn with it: R' = R A, x' = Aᵀ x of every
/// vector, f += A f', τ += A τ'.
template <class S>
class BallAxes final : public Transmission<S> {
 public:
  BallAxes(Frame<S>& from, Frame<S>& to, Orientation<S> orientation)
      : Transmission<S>(from, to), own_(std::move(orientation)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override;
  TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const override;
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override;

  const Rotation<S>& rotation() const { return rotation_; }

 private:
  Orientation<S> own_;
  Rotation<S> rotation_;
};

GAMUT_COMPILED_ELSEWHERE(GlidingJoint)
GAMUT_COMPILED_ELSEWHERE(WheelRolling)
GAMUT_COMPILED_ELSEWHERE(RollingBallJoint)
GAMUT_COMPILED_ELSEWHERE(BallAxes)

}  // namespace gamut
