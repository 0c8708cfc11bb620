// Rigid links and masses.
//
//   link (offset d in K, then rotation A)   R' = R A   r' = Aᵀ(r + d)   ω' = Aᵀω   v' = Aᵀ(v + ω × d)
//                                           ω̇' = Aᵀω̇   a' = Aᵀ(a + ω̇ × d + ω × (ω × d))
//                                           f += A f'   τ += A τ' + d × A f'
//   mass (m, centre c, inertia Θ about c)   a_c = a + ω̇ × c + ω × (ω × c)
//                                           f −= m a_c   τ −= Θ ω̇ + ω × Θ ω + c × m a_c   (d'Alembert)
#pragma once

#include "mechanics/element.hpp"
#include "mechanics/rotation.hpp"

namespace gamut {

/// A rigid link, rod or offset: frame `to` lies at `offset` in `from`, rotated by a fixed rotation if one is given.
template <class S>
class RigidLink final : public Transmission<S> {
 public:
  RigidLink(Frame<S>& from, Frame<S>& to, Vector3<S> offset, Rotation<S> rotation = {})
      : Transmission<S>(from, to), offset_(std::move(offset)), rotation_(std::move(rotation)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override {
    const Frame<S>& k = this->from_;
    Frame<S>& moved = this->to_;
    if (level != MotionLevel::acceleration) {
      moved.R = rotation_.after(k.R);
      moved.r = rotation_.toChild(k.r + offset_);
    }
    if (level == MotionLevel::position) return;
    moved.omegaDot = rotation_.toChild(k.omegaDot);
    if (level == MotionLevel::acceleration) {
      moved.a = rotation_.toChild(k.a + k.omegaDot.cross(offset_));
      return;
    }
    moved.omega = rotation_.toChild(k.omega);
    moved.v = rotation_.toChild(k.v + k.omega.cross(offset_));
    moved.a = rotation_.toChild(k.a + offsetAcceleration(k.omega, k.omegaDot) * offset_);
  }

  void doForce(ForceKind = ForceKind::all) override {
    const Vector3<S> force = rotation_.toParent(this->to_.f);
    this->from_.f += force;
    this->from_.tau += rotation_.toParent(this->to_.tau) + offset_.cross(force);
  }

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override {
    return {offset_ + rotation_.toParent(point.position), rotation_.toParent(point.velocity)};
  }
  SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia) override {
    return rotation_.toParent(inertia).shifted(offset_);
  }

 private:
  Vector3<S> offset_;
  Rotation<S> rotation_;
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
      : at_(at), mass_(std::move(mass)), centre_(std::move(centre)), inertia_(std::move(inertia)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override {
    if (level == MotionLevel::position) return;
    a_ = level == MotionLevel::acceleration ? Vector3<S>(at_.a + at_.omegaDot.cross(centre_))
                                            : Vector3<S>(at_.a + offsetAcceleration(at_.omega, at_.omegaDot) * centre_);
  }

  void doForce(ForceKind kind = ForceKind::all) override {
    if (kind != ForceKind::applied) {
      const Vector3<S> force = mass_ * a_;
      at_.f -= force;
      at_.tau -= inertia_ * at_.omegaDot + centre_.cross(force);
    }
    if (kind != ForceKind::inertia) at_.tau -= at_.omega.cross(inertia_ * at_.omega);
  }

  S kineticEnergy() const override {
    const Vector3<S> v = at_.v + at_.omega.cross(centre_);
    S energy = mass_ * (square(v[0]) + square(v[1]) + square(v[2]));
    for (int i = 0; i < 3; ++i) {
      energy = energy + inertia_(i, i) * square(at_.omega[i]);
      for (int j = i + 1; j < 3; ++j) energy = energy + S(2.0) * (inertia_(i, j) * (at_.omega[i] * at_.omega[j]));
    }
    return S(0.5) * energy;
  }

  S potentialEnergy(const Vector3<S>& gravity) const override { return -(mass_ * gravity.dot(position().position)); }

  /// The centre of mass, as the inertial frame sees it.
  MovingPoint<S> position() const { return at_.inInertial({centre_, zeroVector<S>()}); }

  /// Of the centre of mass, in inertial axes.
  Vector3<S> acceleration() const { return at_.R * a_; }

  void collectRows(std::vector<S>& accelerations, std::vector<InertiaWeight<S>>& weights) const override {
    const int first = static_cast<int>(accelerations.size());
    for (int i = 0; i < 3; ++i) {
      accelerations.push_back(a_[i]);
      weights.push_back({first + i, first + i, mass_});
    }
    for (int i = 0; i < 3; ++i) {
      accelerations.push_back(at_.omegaDot[i]);
      for (int j = i; j < 3; ++j) weights.push_back({first + 3 + i, first + 3 + j, inertia_(i, j)});
    }
  }

  Frame<S>& frame() const override { return at_; }
  SpatialInertia<S> spatial() const override {
    SpatialInertia<S> atCentre{inertia_, zeroMatrix<S>(), zeroMatrix<S>()};
    for (int i = 0; i < 3; ++i) atCentre.linear(i, i) = mass_;
    return atCentre.shifted(centre_);
  }

 private:
  Frame<S>& at_;
  S mass_;
  Vector3<S> centre_;
  Matrix3<S> inertia_;
  Vector3<S> a_ = zeroVector<S>();
};

}  // namespace gamut
