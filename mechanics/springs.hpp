// Springs and dampers: along the chord between two points, and on a joint's variable.
//
//   chord       x = p₂ − p₁   l = |x|   l̇ = x·ẋ / l   F = −c (l − l₀) − d l̇   force on p₂: F x/l, on p₁: −F x/l
//   on a joint  Q = −c (q − q₀) − d q̇
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "mechanics/element.hpp"
#include "mechanics/resisting.hpp"

namespace gamut {

/// The straight line between a point of frame `from` and a point of frame `to`, which must never coincide: its length,
/// and a force along it.
template <class S>
class Chord {
 public:
  Chord(Frame<S>& from, Vector3<S> fromPoint, Frame<S>& to, Vector3<S> toPoint)
      : ends_{{{from, std::move(fromPoint)}, {to, std::move(toPoint)}}} {}

  /// Measures by the frames' present positions and, at MotionLevel::all, velocities.
  void doMotion(MotionLevel level);

  const S& length() const { return length_; }
  const S& rate() const { return rate_; }

  /// The force [N] pushes the points apart.
  void push(const S& force);

 private:
  struct End {
    Frame<S>& frame;
    Vector3<S> point;
  };
  std::array<End, 2> ends_;
  S length_ = S(0.0), rate_ = S(0.0);
  Vector3<S> direction_ = zeroVector<S>();
};

/// A spring and a viscous damper in parallel along a chord, with stiffness c [N/m], rest length l₀ [m] and damping d
/// [N s/m].
template <class S>
class SpringDamper final : public Load<S>, public Resisting<S> {
 public:
  SpringDamper(Chord<S> chord, S stiffness, S restLength, S damping)
      : chord_(std::move(chord)),
        stiffness_(std::move(stiffness)),
        restLength_(std::move(restLength)),
        damping_(std::move(damping)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  const Chord<S>& chord() const { return chord_; }
  /// Pushes the points apart where it is positive [N].
  S force() const;

  S potentialEnergy(const Vector3<S>&) const override;
  std::vector<S> resistances() const override { return {damping_}; }
  void release() override { damping_ = S(0.0); }

 private:
  void applyForce() override;

  Chord<S> chord_;
  S stiffness_, restLength_, damping_;
};

/// A torsional or linear spring and viscous friction on one joint variable: stiffness [N m/rad or N/m], rest position
/// [rad or m], damping [N m s/rad or N s/m].
template <class S>
class JointSpringDamper final : public Load<S>, public Resisting<S> {
 public:
  JointSpringDamper(Variable<S>& variable, S stiffness, S restPosition, S damping)
      : variable_(variable),
        stiffness_(std::move(stiffness)),
        restPosition_(std::move(restPosition)),
        damping_(std::move(damping)) {}

  S potentialEnergy(const Vector3<S>&) const override;
  std::vector<S> resistances() const override { return {damping_}; }
  void release() override { damping_ = S(0.0); }

 private:
  void applyForce() override;

  Variable<S>& variable_;
  S stiffness_, restPosition_, damping_;
};

GAMUT_COMPILED_ELSEWHERE(Chord)
GAMUT_COMPILED_ELSEWHERE(SpringDamper)
GAMUT_COMPILED_ELSEWHERE(JointSpringDamper)

}  // namespace gamut
