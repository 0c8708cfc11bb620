// Members of class templates, for those who compile them.
#pragma once

#include "mechanics/element.hpp"

namespace gamut {

template <class S>
MovingPoint<S> Frame<S>::inInertial(MovingPoint<S> point) const {
  for (const Frame* frame = this; frame->origin; frame = &frame->origin->from()) point = frame->origin->inFrom(point);
  return point;
}

template <class S>
TurningAxes<S> Transmission<S>::axesInFrom(const TurningAxes<S>& turning) const {
  const Matrix3<S> a = from_.R.transpose() * to_.R;
  return {a * turning.axes, a * Vector3<S>(to_.omega + turning.omega) - from_.omega};
}

template <class S>
SpatialInertia<S> Transmission<S>::inFrom(const SpatialInertia<S>& inertia) {
  // Column j of X from the j-th unit acceleration of `from`: angular 0 … 2, linear 3 … 5.
  std::array<Vector3<S>, 6> angular, linear;
  for (Speed<S>* speed : speeds()) speed->acceleration = S(0.0);
  for (std::size_t j = 0; j < 6; ++j) {
    from_.omegaDot = from_.a = zeroVector<S>();
    (j < 3 ? from_.omegaDot : from_.a)[static_cast<Eigen::Index>(j % 3)] = S(1.0);
    this->doMotion(MotionLevel::acceleration);
    angular[j] = to_.omegaDot;
    linear[j] = to_.a;
  }
  SpatialInertia<S> result;
  for (std::size_t j = 0; j < 6; ++j) {
    const Vector3<S> moment = inertia.angular * angular[j] + inertia.coupling * linear[j];
    const Vector3<S> force = inertia.coupling.transpose() * angular[j] + inertia.linear * linear[j];
    for (std::size_t i = 0; i < 6; ++i) {
      const S entry = angular[i].dot(moment) + linear[i].dot(force);
      const auto row = static_cast<Eigen::Index>(i % 3), column = static_cast<Eigen::Index>(j % 3);
      if (i < 3 && j < 3) result.angular(row, column) = entry;
      if (i < 3 && j >= 3) result.coupling(row, column) = entry;
      if (i >= 3 && j >= 3) result.linear(row, column) = entry;
    }
  }
  return result;
}

template <class S>
Chain<S>& Chain<S>::operator<<(Element<S>& element) {
  elements_.push_back(&element);
  if (auto* inertia = dynamic_cast<Inertia<S>*>(&element)) inertias_.push_back(inertia);
  if (auto* constraint = dynamic_cast<Constraint<S>*>(&element)) constraints_.push_back(constraint);
  if (auto* load = dynamic_cast<Load<S>*>(&element)) loads_.push_back(load);
  hasGears_ = hasGears_ || dynamic_cast<Gearing<S>*>(&element) != nullptr;
  return *this;
}

}  // namespace gamut
