// Members of class templates, for those who compile them.
#pragma once

#include "mechanics/joint.hpp"

namespace gamut {

template <class S>
void Joint<S>::doMotion(MotionLevel level) {
  const Frame<S>& k = this->from_;
  Frame<S>& moved = this->to_;
  const std::vector<Twist<S>> s = motions();
  if (level != MotionLevel::acceleration) place_ = place();
  const auto& [rotation, d] = place_;
  if (level != MotionLevel::acceleration) {
    moved.R = standing_ ? *standing_ : rotation.after(k.R);
    moved.r = rotation.toChild(k.r + d);
  }
  if (level == MotionLevel::position) return;
  const Twist<S> change = sum(s, &Speed<S>::acceleration);
  moved.omegaDot = rotation.toChild(k.omegaDot) + change.angular;
  if (level == MotionLevel::acceleration) {
    moved.a = rotation.toChild(k.a + k.omegaDot.cross(d)) + change.linear;
    return;
  }
  const bool isConcentric = place_.isKnownConcentric();
  if (isConcentric) moved.a = rotation.toChild(k.a);
  const Vector3<S> carried = rotation.toChild(k.omega);
  const Twist<S> own = sum(s, &Speed<S>::rate);
  moved.omega = carried + own.angular;
  moved.v = rotation.toChild(k.v + k.omega.cross(d)) + own.linear;
  if (!isConcentric) moved.a = rotation.toChild(k.a + offsetAcceleration(k.omega, k.omegaDot) * d);
  const Twist<S> b = bias(carried, own);
  moved.omegaDot += b.angular;
  moved.a = moved.a + b.linear + change.linear;
}

template <class S>
void Joint<S>::doForce(ForceKind) {
  const Vector3<S>&f = this->to_.f, &tau = this->to_.tau, felt = place_.rotation.toParent(f);
  this->from_.f += felt;
  this->from_.tau += place_.rotation.toParent(tau) + place_.offset.cross(felt);
  const std::vector<Twist<S>> s = motions();
  for (std::size_t i = 0; i < speeds_.size(); ++i) speeds_[i]->force += s[i].angular.dot(tau) + s[i].linear.dot(f);
}

template <class S>
MovingPoint<S> Joint<S>::inFrom(const MovingPoint<S>& point) const {
  const Twist<S> own = sum(motions(), &Speed<S>::rate);
  return {place_.rotation.toParent(point.position) + place_.offset,
          place_.rotation.toParent(Vector3<S>(point.velocity + own.linear + own.angular.cross(point.position)))};
}

template <class S>
TurningAxes<S> Joint<S>::axesInFrom(const TurningAxes<S>& turning) const {
  const Vector3<S> omega = turning.omega + sum(motions(), &Speed<S>::rate).angular;
  return place_.rotation.toParent(TurningAxes<S>{turning.axes, omega});
}

template <class S>
Vector3<S> Joint<S>::accelerationBeyond(MotionLevel level) const {
  const Frame<S>& k = this->from_;
  const auto& [rotation, d] = place_;
  const std::vector<Twist<S>> s = motions();
  const bool isWhole = level == MotionLevel::all;
  Vector3<S> own = sum(s, &Speed<S>::acceleration).linear;
  if (isWhole) own += bias(rotation.toChild(k.omega), sum(s, &Speed<S>::rate)).linear;
  Vector3<S> beyond = rotation.toParent(own);
  if (place_.isKnownConcentric()) return beyond;
  if (isWhole) return beyond + offsetAcceleration(k.omega, k.omegaDot) * d;
  return beyond + k.omegaDot.cross(d);
}

template <class S>
SpatialInertia<S> Joint<S>::inFrom(const SpatialInertia<S>& inertia) {
  const SpatialInertia<S> turned = place_.rotation.toParent(inertia);
  return place_.isKnownConcentric() ? turned : turned.shifted(place_.offset);
}

template <class S>
Twist<S> Joint<S>::bias(const Vector3<S>& carried, const Twist<S>& own) const {
  return {carried.cross(own.angular), S(2.0) * carried.cross(own.linear)};
}

template <class S>
Twist<S> Joint<S>::sum(const std::vector<Twist<S>>& s, S Speed<S>::*x) const {
  Twist<S> sum;
  for (std::size_t i = 0; i < speeds_.size(); ++i) {
    sum.angular += s[i].angular * (speeds_[i]->*x);
    sum.linear += s[i].linear * (speeds_[i]->*x);
  }
  return sum;
}

}  // namespace gamut
