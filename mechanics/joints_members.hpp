// Members of class templates, for those who compile them.
#pragma once

#include "mechanics/joints.hpp"

namespace gamut {

template <class S>
void RevoluteJoint<S>::doMotion(MotionLevel level) {
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

template <class S>
void RevoluteJoint<S>::doForce(ForceKind) {
  this->from_.f += rotation_.toParent(this->to_.f);
  this->from_.tau += rotation_.toParent(this->to_.tau);
  angle_.force += axis_.template unit<S>().dot(this->to_.tau);
}

template <class S>
std::vector<Speed<S>*> RevoluteJoint<S>::speeds() const {
  if (!hasSpeed_) return {};
  return {&angle_};
}

template <class S>
MovingPoint<S> RevoluteJoint<S>::inFrom(const MovingPoint<S>& point) const {
  const Vector3<S> turning = axis_.template unit<S>() * angle_.rate;
  return {rotation_.toParent(point.position), rotation_.toParent(point.velocity + turning.cross(point.position))};
}

template <class S>
TurningAxes<S> RevoluteJoint<S>::axesInFrom(const TurningAxes<S>& turning) const {
  return rotation_.toParent(TurningAxes<S>{turning.axes, turning.omega + axis_.template unit<S>() * angle_.rate});
}

template <class S>
SpatialInertia<S> RevoluteJoint<S>::inFrom(const SpatialInertia<S>& inertia) {
  return rotation_.toParent(inertia);
}

template <class S>
void PrismaticJoint<S>::doMotion(MotionLevel level) {
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

template <class S>
void PrismaticJoint<S>::doForce(ForceKind) {
  const Vector3<S> u = axis_.template unit<S>(), d = u * path_.position;
  this->from_.f += this->to_.f;
  this->from_.tau += this->to_.tau + d.cross(this->to_.f);
  path_.force += u.dot(this->to_.f);
}

template <class S>
std::vector<Speed<S>*> PrismaticJoint<S>::speeds() const {
  return {&path_};
}

template <class S>
MovingPoint<S> PrismaticJoint<S>::inFrom(const MovingPoint<S>& point) const {
  const Vector3<S> u = axis_.template unit<S>();
  return {point.position + u * path_.position, point.velocity + u * path_.rate};
}

template <class S>
TurningAxes<S> PrismaticJoint<S>::axesInFrom(const TurningAxes<S>& turning) const {
  return turning;
}

template <class S>
SpatialInertia<S> PrismaticJoint<S>::inFrom(const SpatialInertia<S>& inertia) {
  return inertia.shifted(axis_.template unit<S>() * path_.position);
}

template <class S>
void ScrewJoint<S>::doMotion(MotionLevel level) {
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

template <class S>
void ScrewJoint<S>::doForce(ForceKind) {
  const Vector3<S> u = axis_.template unit<S>(), f = rotation_.toParent(this->to_.f);
  this->from_.f += f;
  this->from_.tau += rotation_.toParent(this->to_.tau) + path().cross(f);
  angle_.force += u.dot(this->to_.tau) + lead_ * u.dot(this->to_.f);
}

template <class S>
std::vector<Speed<S>*> ScrewJoint<S>::speeds() const {
  return {&angle_};
}

template <class S>
MovingPoint<S> ScrewJoint<S>::inFrom(const MovingPoint<S>& point) const {
  const Vector3<S> u = axis_.template unit<S>(), turning = u * angle_.rate;
  return {rotation_.toParent(point.position) + path(),
          rotation_.toParent(point.velocity + turning.cross(point.position)) + u * S(lead_ * angle_.rate)};
}

template <class S>
TurningAxes<S> ScrewJoint<S>::axesInFrom(const TurningAxes<S>& turning) const {
  return rotation_.toParent(TurningAxes<S>{turning.axes, turning.omega + axis_.template unit<S>() * angle_.rate});
}

template <class S>
SpatialInertia<S> ScrewJoint<S>::inFrom(const SpatialInertia<S>& inertia) {
  return rotation_.toParent(inertia).shifted(path());
}

template <class S>
Vector3<S> ScrewJoint<S>::path() const {
  return axis_.template unit<S>() * S(lead_ * angle_.position);
}

template <class S>
void SphericalJoint<S>::doMotion(MotionLevel level) {
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

template <class S>
void SphericalJoint<S>::doForce(ForceKind) {
  this->from_.f += rotation_.toParent(this->to_.f);
  this->from_.tau += rotation_.toParent(this->to_.tau);
  for (int i = 0; i < 3; ++i) own_.speeds[static_cast<std::size_t>(i)]->force += this->to_.tau[i];
}

template <class S>
std::vector<Speed<S>*> SphericalJoint<S>::speeds() const {
  return {own_.speeds.begin(), own_.speeds.end()};
}

template <class S>
MovingPoint<S> SphericalJoint<S>::inFrom(const MovingPoint<S>& point) const {
  return {rotation_.toParent(point.position), rotation_.toParent(point.velocity + own_.rate().cross(point.position))};
}

template <class S>
TurningAxes<S> SphericalJoint<S>::axesInFrom(const TurningAxes<S>& turning) const {
  return rotation_.toParent(TurningAxes<S>{turning.axes, turning.omega + own_.rate()});
}

template <class S>
SpatialInertia<S> SphericalJoint<S>::inFrom(const SpatialInertia<S>& inertia) {
  return rotation_.toParent(inertia);
}

}  // namespace gamut
