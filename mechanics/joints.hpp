// Elementary joints between two frames K (from) and K' (to), with A the rotation from K to K':
//
//   revolute (axis u, angle β)     R' = R A   r' = Aᵀ r       ω' = Aᵀω + u β̇   v' = Aᵀ v
//                                  ω̇' = Aᵀω̇ + Aᵀω × u β̇ + u β̈   a' = Aᵀ a
//                                  f += A f'   τ += A τ'      Q += u·τ'
//   prismatic (axis u, path s)     R' = R     r' = r + u s    ω' = ω           v' = v + ω × u s + u ṡ
//                                  ω̇' = ω̇    a' = a + ω̇ × u s + ω × (ω × u s) + 2 ω × u ṡ + u s̈
//                                  f += f'     τ += τ' + u s × f'              Q += u·f'
//   screw (axis u, angle β, lead h)  both at once, with s = h β and Q += u·τ' + h u·f'
//   spherical (quaternion e, rates u)   R' = R A(e)  r' = Aᵀ r       ω' = Aᵀω + u     v' = Aᵀ v
//                                  ω̇' = Aᵀω̇ + Aᵀω × u + u̇         a' = Aᵀ a
//                                  f += A f'   τ += A τ'      Q += τ'
//
// Axes u have the same components in K and K'. Source: MOBILE's elementary joint, LNCS 5045 (2008), eq. 25.
#pragma once

#include "mechanics/element.hpp"
#include "mechanics/rotation.hpp"

namespace gamut {

/// Turns frame `to` about an axis fixed in both frames: revolute joint, hinge, pin.
template <class S>
class RevoluteJoint final : public Transmission<S> {
 public:
  RevoluteJoint(Frame<S>& from, Frame<S>& to, Variable<S>& angle, const Axis& axis)
      : Transmission<S>(from, to), angle_(angle), axis_(axis) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  std::vector<Speed<S>*> speeds() const override;

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override;
  TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const override;
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override;

  Variable<S>& angle() const { return angle_; }
  const Axis& axis() const { return axis_; }
  /// From now on the speed is that of another element, which moves all inertia that there was behind (spin.hpp).
  void handOverSpeed() { hasSpeed_ = false; }

 private:
  Variable<S>& angle_;
  Axis axis_;
  Rotation<S> rotation_;
  bool hasSpeed_ = true;
};

/// Slides frame `to` along an axis: prismatic joint, slider.
template <class S>
class PrismaticJoint final : public Transmission<S> {
 public:
  PrismaticJoint(Frame<S>& from, Frame<S>& to, Variable<S>& displacement, const Axis& axis)
      : Transmission<S>(from, to), path_(displacement), axis_(axis) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  std::vector<Speed<S>*> speeds() const override;

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override;
  TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const override;
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override;

 private:
  Variable<S>& path_;
  Axis axis_;
};

/// Turns frame `to` about an axis fixed in both frames, and slides it along that by `lead` [m/rad] times the angle:
/// screw joint.
template <class S>
class ScrewJoint final : public Transmission<S> {
 public:
  ScrewJoint(Frame<S>& from, Frame<S>& to, Variable<S>& angle, S lead, const Axis& axis)
      : Transmission<S>(from, to), angle_(angle), lead_(std::move(lead)), axis_(axis) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  std::vector<Speed<S>*> speeds() const override;

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override;
  TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const override;
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override;

 private:
  Vector3<S> path() const;

  Variable<S>& angle_;
  S lead_;
  Axis axis_;
  Rotation<S> rotation_;
};

/// Turns frame `to` as it likes: spherical joint, ball and socket.
template <class S>
class SphericalJoint final : public Transmission<S> {
 public:
  SphericalJoint(Frame<S>& from, Frame<S>& to, Orientation<S> orientation)
      : Transmission<S>(from, to), own_(std::move(orientation)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind = ForceKind::all) override;

  std::vector<Speed<S>*> speeds() const override;

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override;
  TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const override;
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override;

 private:
  Orientation<S> own_;
  Rotation<S> rotation_;
};

GAMUT_COMPILED_ELSEWHERE(RevoluteJoint)
GAMUT_COMPILED_ELSEWHERE(PrismaticJoint)
GAMUT_COMPILED_ELSEWHERE(ScrewJoint)
GAMUT_COMPILED_ELSEWHERE(SphericalJoint)

}  // namespace gamut
