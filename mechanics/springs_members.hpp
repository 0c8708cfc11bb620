// Members of class templates, for those who compile them.
#pragma once

#include "mechanics/springs.hpp"

namespace gamut {

template <class S>
void Chord<S>::doMotion(MotionLevel level) {
  if (level == MotionLevel::acceleration) return;
  using std::sqrt;
  const MovingPoint<S> p1 = ends_[0].frame.inInertial({ends_[0].point, zeroVector<S>()});
  const MovingPoint<S> p2 = ends_[1].frame.inInertial({ends_[1].point, zeroVector<S>()});
  const Vector3<S> x = p2.position - p1.position;
  length_ = sqrt(square(x[0]) + square(x[1]) + square(x[2]));
  direction_ = x / length_;
  if (level == MotionLevel::all) rate_ = direction_.dot(p2.velocity - p1.velocity);
}

template <class S>
void Chord<S>::push(const S& force) {
  double side = -1;
  for (End& end : ends_) {
    const Vector3<S> local = end.frame.R.transpose() * Vector3<S>(direction_ * (S(side) * force));
    end.frame.f += local;
    end.frame.tau += end.point.cross(local);
    side = 1;
  }
}

template <class S>
void SpringDamper<S>::doMotion(MotionLevel level) {
  chord_.doMotion(level);
}

template <class S>
S SpringDamper<S>::force() const {
  return -(stiffness_ * (chord_.length() - restLength_)) - damping_ * chord_.rate();
}

template <class S>
S SpringDamper<S>::potentialEnergy(const Vector3<S>&) const {
  return S(0.5) * (stiffness_ * square(S(chord_.length() - restLength_)));
}

template <class S>
void SpringDamper<S>::applyForce() {
  chord_.push(force());
}

template <class S>
S JointSpringDamper<S>::potentialEnergy(const Vector3<S>&) const {
  return S(0.5) * (stiffness_ * square(S(variable_.position - restPosition_)));
}

template <class S>
void JointSpringDamper<S>::applyForce() {
  variable_.force -= stiffness_ * (variable_.position - restPosition_) + damping_ * variable_.rate;
}

}  // namespace gamut
