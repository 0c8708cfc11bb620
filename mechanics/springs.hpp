// Springs and dampers: along the chord between two points, and on a joint's variable.
//
//   chord       x = p₂ − p₁   l = |x|   l̇ = x·ẋ / l   F = −c (l − l₀) − d l̇   force on p₂: F x/l, on p₁: −F x/l
//   on a joint  Q = −c (q − q₀) − d q̇
#pragma once

#include <array>
#include <cmath>

#include "mechanics/element.hpp"

namespace gamut {

/// A spring and a viscous damper in parallel between a point of frame `from` and a point of frame `to`, with stiffness
/// c [N/m], rest length l₀ [m] and damping d [N s/m]. The points must never coincide.
template <class S>
class SpringDamper final : public Element<S> {
 public:
  SpringDamper(Frame<S>& from, Frame<S>& to, S stiffness, S restLength, S damping,
               Vector3<S> fromPoint = zeroVector<S>(), Vector3<S> toPoint = zeroVector<S>())
      : ends_{{{from, std::move(fromPoint)}, {to, std::move(toPoint)}}},
        stiffness_(std::move(stiffness)),
        restLength_(std::move(restLength)),
        damping_(std::move(damping)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override {
    if (level == MotionLevel::acceleration) return;
    using std::sqrt;
    const MovingPoint<S> p1 = ends_[0].frame.inInertial({ends_[0].point, zeroVector<S>()});
    const MovingPoint<S> p2 = ends_[1].frame.inInertial({ends_[1].point, zeroVector<S>()});
    const Vector3<S> x = p2.position - p1.position;
    length_ = sqrt(square(x[0]) + square(x[1]) + square(x[2]));
    direction_ = x / length_;
    if (level == MotionLevel::all) lengthRate_ = direction_.dot(p2.velocity - p1.velocity);
  }

  void doForce(ForceKind kind = ForceKind::all) override {
    if (kind == ForceKind::inertia) return;
    const S force = -(stiffness_ * (length_ - restLength_)) - damping_ * lengthRate_;
    double side = -1;
    for (End& end : ends_) {
      const Vector3<S> local = end.frame.R.transpose() * Vector3<S>(direction_ * (S(side) * force));
      end.frame.f += local;
      end.frame.tau += end.point.cross(local);
      side = 1;
    }
  }

  S potentialEnergy(const Vector3<S>&) const override {
    return S(0.5) * (stiffness_ * square(S(length_ - restLength_)));
  }

 private:
  struct End {
    Frame<S>& frame;
    Vector3<S> point;
  };
  std::array<End, 2> ends_;
  S stiffness_, restLength_, damping_;
  S length_ = S(0.0), lengthRate_ = S(0.0);
  Vector3<S> direction_ = zeroVector<S>();
};

/// A torsional or linear spring and viscous friction on one joint variable: stiffness [N m/rad or N/m], rest position
/// [rad or m], damping [N m s/rad or N s/m].
template <class S>
class JointSpringDamper final : public Element<S> {
 public:
  JointSpringDamper(Variable<S>& variable, S stiffness, S restPosition, S damping)
      : variable_(variable),
        stiffness_(std::move(stiffness)),
        restPosition_(std::move(restPosition)),
        damping_(std::move(damping)) {}

  void doMotion(MotionLevel = MotionLevel::all) override {}
  void doForce(ForceKind kind = ForceKind::all) override {
    if (kind == ForceKind::inertia) return;
    variable_.force -= stiffness_ * (variable_.position - restPosition_) + damping_ * variable_.rate;
  }
  S potentialEnergy(const Vector3<S>&) const override {
    return S(0.5) * (stiffness_ * square(S(variable_.position - restPosition_)));
  }

 private:
  Variable<S>& variable_;
  S stiffness_, restPosition_, damping_;
};

}  // namespace gamut
