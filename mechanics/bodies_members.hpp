// Members of class templates, for those who compile them.
#pragma once

#include "mechanics/bodies.hpp"

namespace gamut {

template <class S>
void MassElement<S>::doMotion(MotionLevel level) {
  if (level == MotionLevel::position) return;
  a_ = level == MotionLevel::acceleration
           ? Vector3<S>(at_->a + at_->omegaDot.cross(centre_))
           : Vector3<S>(at_->a + offsetAcceleration(at_->omega, at_->omegaDot) * centre_);
}

template <class S>
void MassElement<S>::doForce(ForceKind kind) {
  if (hasInertia(kind)) {
    const Vector3<S> force = mass_ * a_;
    at_->f -= force;
    at_->tau -= inertia_ * at_->omegaDot + centre_.cross(force);
  }
  if (hasLoads(kind)) at_->tau -= at_->omega.cross(inertia_ * at_->omega);
}

template <class S>
S MassElement<S>::kineticEnergy() const {
  const Vector3<S> v = at_->v + at_->omega.cross(centre_);
  S energy = mass_ * (square(v[0]) + square(v[1]) + square(v[2]));
  for (int i = 0; i < 3; ++i) {
    energy = energy + inertia_(i, i) * square(at_->omega[i]);
    for (int j = i + 1; j < 3; ++j) energy = energy + S(2.0) * (inertia_(i, j) * (at_->omega[i] * at_->omega[j]));
  }
  return S(0.5) * energy;
}

template <class S>
S MassElement<S>::potentialEnergy(const Vector3<S>& gravity) const {
  return -(mass_ * gravity.dot(position().position));
}

template <class S>
MovingPoint<S> MassElement<S>::position() const {
  return at_->inInertial({centre_, zeroVector<S>()});
}

template <class S>
Vector3<S> MassElement<S>::acceleration() const {
  return at_->R * a_;
}

template <class S>
void MassElement<S>::collectRows(std::vector<S>& accelerations, std::vector<InertiaWeight<S>>& weights) const {
  const int first = static_cast<int>(accelerations.size());
  for (int i = 0; i < 3; ++i) {
    accelerations.push_back(a_[i]);
    weights.push_back({first + i, first + i, mass_});
  }
  for (int i = 0; i < 3; ++i) {
    accelerations.push_back(at_->omegaDot[i]);
    for (int j = i; j < 3; ++j) weights.push_back({first + 3 + i, first + 3 + j, inertia_(i, j)});
  }
}

template <class S>
Frame<S>& MassElement<S>::frame() const {
  return *at_;
}

template <class S>
bool MassElement<S>::isKnownSymmetric(const Axis& axis) const {
  if (!axis.isAligned()) return isKnownBall();
  const int i = (axis.index() + 1) % 3, j = (axis.index() + 2) % 3;
  return isKnownDiagonal() && isKnownZero(centre_[i]) && isKnownZero(centre_[j]) &&
         isKnownSame(inertia_(i, i), inertia_(j, j));
}

template <class S>
bool MassElement<S>::isKnownBall() const {
  return isKnownDiagonal() && isKnownZero(centre_[0]) && isKnownZero(centre_[1]) && isKnownZero(centre_[2]) &&
         isKnownSame(inertia_(0, 0), inertia_(1, 1)) && isKnownSame(inertia_(1, 1), inertia_(2, 2));
}

template <class S>
bool MassElement<S>::isKnownDiagonal() const {
  return isKnownZero(inertia_(0, 1)) && isKnownZero(inertia_(1, 2)) && isKnownZero(inertia_(0, 2));
}

template <class S>
SpatialInertia<S> MassElement<S>::spatial() const {
  SpatialInertia<S> atCentre{inertia_, zeroMatrix<S>(), zeroMatrix<S>()};
  for (int i = 0; i < 3; ++i) atCentre.linear(i, i) = mass_;
  return atCentre.shifted(centre_);
}

}  // namespace gamut
