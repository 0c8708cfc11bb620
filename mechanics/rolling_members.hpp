// Members of class templates, for those who compile them.
#pragma once

#include "mechanics/rolling.hpp"

namespace gamut {

template <class S>
void GlidingJoint<S>::doMotion(MotionLevel level) {
  const Frame<S>& k = this->from_;
  Frame<S>& moved = this->to_;
  const Vector3<S> d = offset();
  if (level != MotionLevel::acceleration) {
    rotation_ = Rotation<S>(axisZ, own_.angle->position);
    moved.R = rotation_.after(k.R);
    moved.r = rotation_.toChild(Vector3<S>(k.r + d));
  }
  if (level == MotionLevel::position) return;
  const Vector3<S> own(own_.along->acceleration, own_.across ? own_.across->acceleration : S(0.0), S(0.0));
  moved.omegaDot = rotation_.toChild(k.omegaDot) + Vector3<S>(S(0.0), S(0.0), own_.angle->acceleration);
  if (level == MotionLevel::acceleration) {
    moved.a = rotation_.toChild(Vector3<S>(k.a + k.omegaDot.cross(d))) + own;
    return;
  }
  const Vector3<S> carried = rotation_.toChild(k.omega), w = own_.velocity();
  moved.omega = carried + turning();
  moved.omegaDot += carried.cross(turning());
  moved.v = rotation_.toChild(Vector3<S>(k.v + k.omega.cross(d))) + w;
  moved.a = rotation_.toChild(Vector3<S>(k.a + offsetAcceleration(k.omega, k.omegaDot) * d)) +
            Vector3<S>(S(2.0) * carried + turning()).cross(w) + own;
}

template <class S>
void GlidingJoint<S>::doForce(ForceKind) {
  const Vector3<S> f = rotation_.toParent(this->to_.f);
  this->from_.f += f;
  this->from_.tau += rotation_.toParent(this->to_.tau) + offset().cross(f);
  own_.angle->force += this->to_.tau[2];
  own_.along->force += this->to_.f[0];
  if (own_.across) own_.across->force += this->to_.f[1];
}

template <class S>
std::vector<Speed<S>*> GlidingJoint<S>::speeds() const {
  if (own_.across) return {own_.angle, own_.along, own_.across};
  return {own_.angle, own_.along};
}

template <class S>
MovingPoint<S> GlidingJoint<S>::inFrom(const MovingPoint<S>& point) const {
  return {rotation_.toParent(point.position) + offset(),
          rotation_.toParent(Vector3<S>(point.velocity + own_.velocity() + turning().cross(point.position)))};
}

template <class S>
TurningAxes<S> GlidingJoint<S>::axesInFrom(const TurningAxes<S>& turning) const {
  return rotation_.toParent(TurningAxes<S>{turning.axes, turning.omega + this->turning()});
}

template <class S>
SpatialInertia<S> GlidingJoint<S>::inFrom(const SpatialInertia<S>& inertia) {
  return rotation_.toParent(inertia).shifted(offset());
}

template <class S>
void WheelRolling<S>::doMotion(MotionLevel level) {
  using std::cos, std::sin;
  if (level != MotionLevel::acceleration) {
    reach_ = circle_ + crown_ * S(cos(lean_.position));
    slope_ = crown_ * S(sin(lean_.position));
  }
  if (level == MotionLevel::position) return;
  along_.acceleration = reach_ * angle_.acceleration;
  across_.acceleration = -(crown_ * lean_.acceleration);
  if (level == MotionLevel::acceleration) return;
  along_.rate = reach_ * angle_.rate;
  across_.rate = -(crown_ * lean_.rate);
  along_.acceleration = along_.acceleration - slope_ * lean_.rate * angle_.rate;
}

template <class S>
void WheelRolling<S>::doForce(ForceKind) {
  angle_.force += reach_ * along_.force;
  lean_.force -= crown_ * across_.force;
}

template <class S>
void RollingBallJoint<S>::doMotion(MotionLevel level) {
  const Frame<S>& k = this->from_;
  Frame<S>& moved = this->to_;
  const Vector3<S> d = offset();
  if (level != MotionLevel::acceleration) {
    moved.R = k.R;
    moved.r = k.r + d;
  }
  if (level == MotionLevel::position) return;
  const Vector3<S> change = own_.acceleration();
  moved.omegaDot = k.omegaDot + change;
  if (level == MotionLevel::acceleration) {
    moved.a = k.a + k.omegaDot.cross(d) + gliding(change);
    return;
  }
  const Vector3<S> w = own_.rate(), g = gliding(w);
  moved.omega = k.omega + w;
  moved.omegaDot += k.omega.cross(w);
  moved.v = k.v + k.omega.cross(d) + g;
  moved.a = k.a + offsetAcceleration(k.omega, k.omegaDot) * d + S(2.0) * k.omega.cross(g) + gliding(change);
}

template <class S>
void RollingBallJoint<S>::doForce(ForceKind) {
  const Vector3<S>&f = this->to_.f, &tau = this->to_.tau;
  this->from_.f += f;
  this->from_.tau += tau + offset().cross(f);
  own_.speeds[0]->force += tau[0] - radius_ * f[1];
  own_.speeds[1]->force += tau[1] + radius_ * f[0];
  own_.speeds[2]->force += tau[2];
}

template <class S>
MovingPoint<S> RollingBallJoint<S>::inFrom(const MovingPoint<S>& point) const {
  const Vector3<S> w = own_.rate();
  return {point.position + offset(), point.velocity + gliding(w) + w.cross(point.position)};
}

template <class S>
TurningAxes<S> RollingBallJoint<S>::axesInFrom(const TurningAxes<S>& turning) const {
  return {turning.axes, turning.omega + own_.rate()};
}

template <class S>
SpatialInertia<S> RollingBallJoint<S>::inFrom(const SpatialInertia<S>& inertia) {
  return inertia.shifted(offset());
}

template <class S>
void BallAxes<S>::doMotion(MotionLevel level) {
  const Frame<S>& k = this->from_;
  Frame<S>& moved = this->to_;
  if (level != MotionLevel::acceleration) {
    rotation_ = Rotation<S>(own_.value());
    moved.R = rotation_.after(k.R);
    moved.r = rotation_.toChild(k.r);
  }
  if (level == MotionLevel::position) return;
  moved.omegaDot = rotation_.toChild(k.omegaDot);
  moved.a = rotation_.toChild(k.a);
  if (level == MotionLevel::acceleration) return;
  moved.omega = rotation_.toChild(k.omega);
  moved.v = rotation_.toChild(k.v);
}

template <class S>
void BallAxes<S>::doForce(ForceKind) {
  this->from_.f += rotation_.toParent(this->to_.f);
  this->from_.tau += rotation_.toParent(this->to_.tau);
}

template <class S>
MovingPoint<S> BallAxes<S>::inFrom(const MovingPoint<S>& point) const {
  return {rotation_.toParent(point.position), rotation_.toParent(point.velocity)};
}

template <class S>
TurningAxes<S> BallAxes<S>::axesInFrom(const TurningAxes<S>& turning) const {
  return rotation_.toParent(turning);
}

template <class S>
SpatialInertia<S> BallAxes<S>::inFrom(const SpatialInertia<S>& inertia) {
  return rotation_.toParent(inertia);
}

}  // namespace gamut
