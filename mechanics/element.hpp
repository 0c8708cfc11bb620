// The contract of every part of a mechanism: motion is mapped forwards, force backwards (Kecskeméthy's MOBILE).
//
//   position q' = φ(q),  velocity q̇' = J q̇,  acceleration q̈' = J q̈ + J̇ q̇,  force Q = Jᵀ Q'
//
// An element remembers its inputs and outputs; a Chain is an ordered list of elements, force runs through it in
// reverse. A new element needs these two (and inFrom, if it moves a frame), nothing else: derivatives come from the
// recorded program.
#pragma once

#include <stdexcept>
#include <vector>

#include "mechanics/frame.hpp"
#include "mechanics/variable.hpp"

namespace gamut {

/// What doMotion updates.
enum class MotionLevel {
  position,      ///< positions only
  all,           ///< positions, velocities and accelerations
  acceleration,  ///< accelerations J q̈ at the positions of the last call, as if every velocity were zero
};

/// What doForce brings in; forces that arrive from behind are always handed on.
enum class ForceKind {
  all,      ///< inertia and applied forces
  applied,  ///< springs, dampers and gyroscopic moments
  inertia,  ///< −m a and −Θ ω̇ alone: the answer to MotionLevel::acceleration
};

/// The weight w of rows k and l in the inertia quadratic form ½ Σ w a_k a_l of the bodies' accelerations; an
/// off-diagonal weight stands for both (k, l) and (l, k).
template <class S>
struct InertiaWeight {
  int k, l;
  S w;
};

template <class S>
class Element {
 public:
  Element() = default;
  Element(const Element&) = delete;
  Element& operator=(const Element&) = delete;
  virtual ~Element() = default;

  virtual void doMotion(MotionLevel level = MotionLevel::all) = 0;
  virtual void doForce(ForceKind kind = ForceKind::all) = 0;
  /// Forces and generalised forces of what this element moves become zero.
  virtual void clearForces() {}

  /// The frame that this element moves by a variable of its own, if it has one: where equations of motion may be cut.
  virtual Frame<S>* drivenFrame() { return nullptr; }

  /// ½ m v² + ½ ω·Θω of the bodies of this element [J].
  virtual S kineticEnergy() const { return S(0.0); }
  /// Energy in the field `gravity` [m/s², inertial frame] and in springs [J].
  virtual S potentialEnergy(const Vector3<S>& /*gravity*/) const { return S(0.0); }

  /// Appends the accelerations of this element's bodies, one row a component, and the weights of these rows (numbered
  /// as they stand in `accelerations`).
  virtual void collectInertia(std::vector<S>& /*accelerations*/, std::vector<InertiaWeight<S>>& /*weights*/) const {}
};

/// An element that moves one frame by another.
template <class S>
class Transmission : public Element<S> {
 public:
  /// Throws std::invalid_argument if `to` is moved already or is `from` itself.
  Transmission(Frame<S>& from, Frame<S>& to) : from_(from), to_(to) {
    if (&from == &to) throw std::invalid_argument("an element needs two different frames, but both are " + to.name);
    if (to.origin) throw std::invalid_argument("frame " + to.name + " is moved by another element already");
    to.origin = this;
  }

  const Frame<S>& from() const { return from_; }
  const Frame<S>& to() const { return to_; }
  void clearForces() override { to_.clearForces(); }

  /// A point given in `to()`, seen from `from()`.
  virtual MovingPoint<S> inFrom(const MovingPoint<S>& point) const = 0;

 protected:
  Frame<S>& from_;
  Frame<S>& to_;
};

template <class S>
MovingPoint<S> Frame<S>::inInertial(MovingPoint<S> point) const {
  for (const Frame* frame = this; frame->origin; frame = &frame->origin->from()) point = frame->origin->inFrom(point);
  return point;
}

/// Elements in the order in which motion passes through them: `chain << joint << link << mass`.
template <class S>
class Chain final : public Element<S> {
 public:
  /// The element must outlive the chain.
  Chain& operator<<(Element<S>& element) {
    elements_.push_back(&element);
    return *this;
  }

  void doMotion(MotionLevel level = MotionLevel::all) override {
    for (Element<S>* element : elements_) element->doMotion(level);
  }
  void doForce(ForceKind kind = ForceKind::all) override {
    for (auto element = elements_.rbegin(); element != elements_.rend(); ++element) (*element)->doForce(kind);
  }
  const std::vector<Element<S>*>& elements() const { return elements_; }
  void clearForces() override {
    for (Element<S>* element : elements_) element->clearForces();
  }
  S kineticEnergy() const override {
    S sum(0.0);
    for (const Element<S>* element : elements_) sum = sum + element->kineticEnergy();
    return sum;
  }
  S potentialEnergy(const Vector3<S>& gravity) const override {
    S sum(0.0);
    for (const Element<S>* element : elements_) sum = sum + element->potentialEnergy(gravity);
    return sum;
  }
  void collectInertia(std::vector<S>& accelerations, std::vector<InertiaWeight<S>>& weights) const override {
    for (const Element<S>* element : elements_) element->collectInertia(accelerations, weights);
  }

 private:
  std::vector<Element<S>*> elements_;
};

}  // namespace gamut
