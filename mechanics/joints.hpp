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

  void doMotion(MotionLevel level = MotionLevel::all) override {
    const Frame<S>& k = this->from_;
    Frame<S>& moved = this->to_;
    const Vector3<S> u = axis_.template unit<S>();
    if (level != MotionLevel::acceleration) {
      rotation_ = Rotation<S>(axis_, angle_.position);
      moved.R = rotation_.after(k.R);
      moved.r = rotation_.toChild(k.r);
    }
    if (level == MotionLevel::position) return;
    moved.omegaDot = rotation_.toChild(k.omegaDot) + u * angle_.acceleration;
    moved.a = rotation_.toChild(k.a);
    if (level == MotionLevel::acceleration) return;
    const Vector3<S> carried = rotation_.toChild(k.omega), own = u * angle_.rate;
    moved.omega = carried + own;
    moved.v = rotation_.toChild(k.v);
    moved.omegaDot += carried.cross(own);
  }

  void doForce(ForceKind = ForceKind::all) override {
    this->from_.f += rotation_.toParent(this->to_.f);
    this->from_.tau += rotation_.toParent(this->to_.tau);
    angle_.force += axis_.template unit<S>().dot(this->to_.tau);
  }

  std::vector<Speed<S>*> speeds() const override { return {&angle_}; }

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override {
    const Vector3<S> turning = axis_.template unit<S>() * angle_.rate;
    return {rotation_.toParent(point.position), rotation_.toParent(point.velocity + turning.cross(point.position))};
  }
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override { return rotation_.toParent(inertia); }

 private:
  Variable<S>& angle_;
  Axis axis_;
  Rotation<S> rotation_;
};

/// Slides frame `to` along an axis: prismatic joint, slider.
template <class S>
class PrismaticJoint final : public Transmission<S> {
 public:
  PrismaticJoint(Frame<S>& from, Frame<S>& to, Variable<S>& displacement, const Axis& axis)
      : Transmission<S>(from, to), path_(displacement), axis_(axis) {}

  void doMotion(MotionLevel level = MotionLevel::all) override {
    const Frame<S>& k = this->from_;
    Frame<S>& moved = this->to_;
    const Vector3<S> u = axis_.template unit<S>(), d = u * path_.position;
    if (level != MotionLevel::acceleration) {
      moved.R = k.R;
      moved.r = k.r + d;
    }
    if (level == MotionLevel::position) return;
    moved.omegaDot = k.omegaDot;
    if (level == MotionLevel::acceleration) {
      moved.a = k.a + k.omegaDot.cross(d) + u * path_.acceleration;
      return;
    }
    const Vector3<S> slid = u * path_.rate;
    moved.omega = k.omega;
    moved.v = k.v + k.omega.cross(d) + slid;
    moved.a = k.a + offsetAcceleration(k.omega, k.omegaDot) * d + S(2.0) * k.omega.cross(slid) + u * path_.acceleration;
  }

  void doForce(ForceKind = ForceKind::all) override {
    const Vector3<S> u = axis_.template unit<S>(), d = u * path_.position;
    this->from_.f += this->to_.f;
    this->from_.tau += this->to_.tau + d.cross(this->to_.f);
    path_.force += u.dot(this->to_.f);
  }

  std::vector<Speed<S>*> speeds() const override { return {&path_}; }

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override {
    const Vector3<S> u = axis_.template unit<S>();
    return {point.position + u * path_.position, point.velocity + u * path_.rate};
  }
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override {
    return inertia.shifted(axis_.template unit<S>() * path_.position);
  }

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

  void doMotion(MotionLevel level = MotionLevel::all) override {
    const Frame<S>& k = this->from_;
    Frame<S>& moved = this->to_;
    const Vector3<S> u = axis_.template unit<S>();
    if (level != MotionLevel::acceleration) {
      rotation_ = Rotation<S>(axis_, angle_.position);
      moved.R = rotation_.after(k.R);
      moved.r = rotation_.toChild(k.r) + path();
    }
    if (level == MotionLevel::position) return;
    const Vector3<S> turned = rotation_.toChild(k.omegaDot);
    moved.omegaDot = turned + u * angle_.acceleration;
    moved.a = rotation_.toChild(k.a) + u * S(lead_ * angle_.acceleration);
    if (level == MotionLevel::acceleration) {
      moved.a += turned.cross(path());
      return;
    }
    const Vector3<S> carried = rotation_.toChild(k.omega), own = u * angle_.rate, slid = u * S(lead_ * angle_.rate);
    moved.omega = carried + own;
    moved.v = rotation_.toChild(k.v) + carried.cross(path()) + slid;
    moved.omegaDot += carried.cross(own);
    moved.a += offsetAcceleration(carried, turned) * path() + S(2.0) * carried.cross(slid);
  }

  void doForce(ForceKind = ForceKind::all) override {
    const Vector3<S> u = axis_.template unit<S>(), f = rotation_.toParent(this->to_.f);
    this->from_.f += f;
    this->from_.tau += rotation_.toParent(this->to_.tau) + path().cross(f);
    angle_.force += u.dot(this->to_.tau) + lead_ * u.dot(this->to_.f);
  }

  std::vector<Speed<S>*> speeds() const override { return {&angle_}; }

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override {
    const Vector3<S> u = axis_.template unit<S>(), turning = u * angle_.rate;
    return {rotation_.toParent(point.position) + path(),
            rotation_.toParent(point.velocity + turning.cross(point.position)) + u * S(lead_ * angle_.rate)};
  }
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override {
    return rotation_.toParent(inertia).shifted(path());
  }

 private:
  Vector3<S> path() const { return axis_.template unit<S>() * S(lead_ * angle_.position); }

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

  void doMotion(MotionLevel level = MotionLevel::all) override {
    const Frame<S>& k = this->from_;
    Frame<S>& moved = this->to_;
    if (level != MotionLevel::acceleration) {
      rotation_ = Rotation<S>(own_.value());
      moved.R = rotation_.after(k.R);
      moved.r = rotation_.toChild(k.r);
    }
    if (level == MotionLevel::position) return;
    moved.omegaDot = rotation_.toChild(k.omegaDot) + own_.acceleration();
    moved.a = rotation_.toChild(k.a);
    if (level == MotionLevel::acceleration) return;
    const Vector3<S> carried = rotation_.toChild(k.omega), own = own_.rate();
    moved.omega = carried + own;
    moved.v = rotation_.toChild(k.v);
    moved.omegaDot += carried.cross(own);
  }

  void doForce(ForceKind = ForceKind::all) override {
    this->from_.f += rotation_.toParent(this->to_.f);
    this->from_.tau += rotation_.toParent(this->to_.tau);
    for (int i = 0; i < 3; ++i) own_.speeds[static_cast<std::size_t>(i)]->force += this->to_.tau[i];
  }

  std::vector<Speed<S>*> speeds() const override { return {own_.speeds.begin(), own_.speeds.end()}; }

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override {
    return {rotation_.toParent(point.position), rotation_.toParent(point.velocity + own_.rate().cross(point.position))};
  }
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override { return rotation_.toParent(inertia); }

 private:
  Orientation<S> own_;
  Rotation<S> rotation_;
};

}  // namespace gamut
