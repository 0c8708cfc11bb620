// Rigid links and masses.
//
//   link (offset d in K, then rotation A): a joint without speeds (joint.hpp)
//   mass (m, centre c, inertia Θ about c)   a_c = a + ω̇ × c + ω × (ω × c)
//                                           f −= m a_c   τ −= Θ ω̇ + ω × Θ ω + c × m a_c   (d'Alembert)
#pragma once

#include "mechanics/joint.hpp"

namespace gamut {

/// A rigid link, rod or offset: frame `to` lies at `offset` in `from`, rotated by a fixed rotation if one is given.
template <class S>
class RigidLink final : public Joint<S> {
 public:
  RigidLink(Frame<S>& from, Frame<S>& to, Vector3<S> offset, Rotation<S> rotation = {})
      : Joint<S>(from, to), fixed_{std::move(rotation), std::move(offset)} {}

  const Vector3<S>& offset() const { return fixed_.offset; }
  const Rotation<S>& rotation() const { return fixed_.rotation; }

 private:
  Place<S> place() const override { return fixed_; }

  Place<S> fixed_;
};

/// A rigid body's mass [kg], centre of mass [m] and inertia tensor about that centre [kg m²], in frame `at`.
template <class S>
class MassElement final : public Inertia<S> {
 public:
  /// A point mass at the origin of `at`.
  MassElement(Frame<S>& at, S mass) : MassElement(at, std::move(mass), zeroVector<S>()) {}
  /// A point mass at `centre`.
  MassElement(Frame<S>& at, S mass, Vector3<S> centre)
      : MassElement(at, std::move(mass), std::move(centre), zeroMatrix<S>()) {}
  /// A body; `inertia` is symmetric.
  MassElement(Frame<S>& at, S mass, Vector3<S> centre, Matrix3<S> inertia)
      : at_(&at), mass_(std::move(mass)), centre_(std::move(centre)), inertia_(std::move(inertia)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override;

  void doForce(ForceKind kind = ForceKind::all) override;

  S kineticEnergy() const override;

  S potentialEnergy(const Vector3<S>& gravity) const override;

  /// The centre of mass, as the inertial frame sees it.
  MovingPoint<S> position() const;

  /// Of the centre of mass, in inertial axes.
  Vector3<S> acceleration() const;

  void collectRows(std::vector<S>& accelerations, std::vector<InertiaWeight<S>>& weights) const override;

  Frame<S>& frame() const override;
  SpatialInertia<S> spatial() const override;

  /// Whether it is known to be the same body however it is turned about this axis of `frame()`, through the origin:
  /// as formulas, whatever the values of uncertain quantities are.
  bool isKnownSymmetric(const Axis& axis) const;
  /// The same of all axes: its centre is the origin, and its moments of inertia are one.
  bool isKnownBall() const;
  /// Fixes it to another frame instead, with the same numbers.
  void moveTo(Frame<S>& frame) { at_ = &frame; }

 private:
  bool isKnownDiagonal() const;

  Frame<S>* at_;
  S mass_;
  Vector3<S> centre_;
  Matrix3<S> inertia_;
  Vector3<S> a_ = zeroVector<S>();
};

GAMUT_COMPILED_ELSEWHERE(RigidLink)
GAMUT_COMPILED_ELSEWHERE(MassElement)

}  // namespace gamut
