// The rotor of a motor behind a gear, as the joint that it drives feels it.
//
//   rotor turns by n q:   Q −= J n² q̈     T = ½ J n² q̇²
//
// What else it does is not modelled: its spin exerts no gyroscopic moment on what carries it, and carries no momentum;
// its mass is that of the body which carries it.
#pragma once

#include <utility>
#include <vector>

#include "mechanics/element.hpp"

namespace gamut {

template <class S>
class ReflectedInertia final : public Inertia<S> {
 public:
  /// `inertia`: J n² [kg m², or kg of a slider].
  ReflectedInertia(Speed<S>& speed, S inertia) : speed_(speed), inertia_(std::move(inertia)) {}

  void doMotion(MotionLevel /*level*/ = MotionLevel::all) override {}
  void doForce(ForceKind kind = ForceKind::all) override {
    if (hasInertia(kind)) speed_.force -= inertia_ * speed_.acceleration;
  }
  S kineticEnergy() const override { return S(0.5) * (inertia_ * square(speed_.rate)); }
  void collectRows(std::vector<S>& accelerations, std::vector<InertiaWeight<S>>& weights) const override {
    const int row = static_cast<int>(accelerations.size());
    accelerations.push_back(speed_.acceleration);
    weights.push_back({row, row, inertia_});
  }

  /// No frame carries it: one that nothing moves, and no inertia there.
  Frame<S>& frame() const override { return nowhere_; }
  SpatialInertia<S> spatial() const override { return {}; }
  std::vector<std::pair<const Speed<S>*, S>> reflected() const override { return {{&speed_, inertia_}}; }

 private:
  Speed<S>& speed_;
  S inertia_;
  mutable Frame<S> nowhere_;
};

}  // namespace gamut
