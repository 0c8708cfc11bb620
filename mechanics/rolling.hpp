// Joints whose points move along a plane by speeds that add up to no coordinates: what rolls without slip, what has an
// edge (nonholonomic constraints; J. I. Neimark, N. A. Fufaev, Dynamics of Nonholonomic Systems, 1972, chapters 1 and
// 3).
//
//   gliding (angle ψ about z, place x, y; along, across: the velocity of the origin in the axes of K')
//       ẋ = along cos ψ − across sin ψ     ẏ = along sin ψ + across cos ψ     d = (x, y, 0)   w = (along, across, 0)
//       R' = R A    r' = Aᵀ(r + d)         ω' = Aᵀω + z ψ̇                    v' = Aᵀ(v + ω × d) + w
//       ω̇' = Aᵀω̇ + Aᵀω × z ψ̇ + z ψ̈      a' = Aᵀ(a + ω̇ × d + ω × (ω × d)) + 2 Aᵀω × w + z ψ̇ × w + ẇ
//       f += A f'   τ += A τ' + d × A f'   Q_ψ += τ'_z   Q_along += f'_x   Q_across += f'_y
//
// x and y are in the place of K' alone: a machine on a plane that stands still does not depend on them.
#pragma once

#include "mechanics/element.hpp"
#include "mechanics/rotation.hpp"

namespace gamut {

/// A motion in the plane of x and y: by a direction ψ and the velocity [m/s] in the axes that have it.
template <class S>
struct Gliding {
  Variable<S>* angle;
  Speed<S>* along;
  Speed<S>* across = nullptr;          ///< none: it never glides sideways
  std::array<const S*, 2> place = {};  ///< x and y [m], which start anywhere

  Vector3<S> velocity() const { return {along->rate, across ? across->rate : S(0.0), S(0.0)}; }
  /// ẋ (0) or ẏ (1).
  S placeRate(int i) const { return Rotation<S>(axisZ, angle->position).toParent(velocity())[i]; }
};

/// Moves frame `to` so.
template <class S>
class GlidingJoint final : public Transmission<S> {
 public:
  GlidingJoint(Frame<S>& from, Frame<S>& to, Gliding<S> gliding) : Transmission<S>(from, to), own_(gliding) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  std::vector<Speed<S>*> speeds() const override;

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override;
  TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const override;
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override;

 private:
  Vector3<S> offset() const { return {*own_.place[0], *own_.place[1], S(0.0)}; }
  Vector3<S> turning() const { return {S(0.0), S(0.0), own_.angle->rate}; }

  Gliding<S> own_;
  Rotation<S> rotation_;
};

/// How a wheel that rolls moves the point where it touches a plane, by its lean θ about x and its turn φ about its axle
/// y. With R the radius at which its tread is centred and ρ that of the tread itself, v + ω × (touching − centre) = 0
/// is
///
///   along = (R + ρ cos θ) φ̇     across = −ρ θ̇
///
/// Ahead of the joints.
template <class S>
class WheelRolling final : public Gearing<S> {
 public:
  /// `radius`: R, `tread`: ρ [m].
  WheelRolling(Variable<S>& lean, Variable<S>& angle, S radius, S tread)
      : lean_(lean), angle_(angle), radius_(std::move(radius)), tread_(std::move(tread)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  Speed<S>& along() { return along_; }
  Speed<S>& across() { return across_; }

 private:
  Variable<S>& lean_;
  Variable<S>& angle_;
  S radius_, tread_;
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
  RollingBallJoint(Frame<S>& from, Frame<S>& to, std::array<Speed<S>*, 3> rates, std::array<const S*, 2> place,
                   S radius)
      : Transmission<S>(from, to), rates_(rates), place_(place), radius_(std::move(radius)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  std::vector<Speed<S>*> speeds() const override { return {rates_.begin(), rates_.end()}; }

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override;
  TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const override;
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override;

 private:
  Vector3<S> offset() const { return {*place_[0], *place_[1], radius_}; }
  Vector3<S> turning() const { return {rates_[0]->rate, rates_[1]->rate, rates_[2]->rate}; }
  Vector3<S> gliding(const Vector3<S>& w) const { return {S(radius_ * w[1]), S(-(radius_ * w[0])), S(0.0)}; }

  std::array<Speed<S>*, 3> rates_;
  std::array<const S*, 2> place_;
  S radius_;
};

/// The axes of a ball, as frame `to`, that turns as `from` does already, but for its axes: A of a unit quaternion.
template <class S>
class BallAxes final : public Transmission<S> {
 public:
  BallAxes(Frame<S>& from, Frame<S>& to, Quaternion<const S*> quaternion)
      : Transmission<S>(from, to), quaternion_(quaternion) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override;
  TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const override;
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override;

  const Rotation<S>& rotation() const { return rotation_; }

 private:
  Quaternion<const S*> quaternion_;
  Rotation<S> rotation_;
};

/// (friction/normal force)² of a force that acts on what touches the plane of x and y, and is held there: smooth where
/// there is no friction, as its root is not.
template <class S>
S squaredGripOf(const Vector3<S>& force) {
  return S(S(square(force[0]) + square(force[1])) / S(square(force[2])));
}

GAMUT_COMPILED_ELSEWHERE(GlidingJoint)
GAMUT_COMPILED_ELSEWHERE(WheelRolling)
GAMUT_COMPILED_ELSEWHERE(RollingBallJoint)
GAMUT_COMPILED_ELSEWHERE(BallAxes)

}  // namespace gamut
