// The contract of every part of a mechanism: motion is mapped forwards, force backwards (Kecskeméthy's MOBILE).
//
//   position q' = φ(q),  velocity q̇' = J q̇,  acceleration q̈' = J q̈ + J̇ q̇,  force Q = Jᵀ Q'
//
// Every part is an Element. Of its kinds, a Transmission moves a frame, ideally: what power goes in comes out. A
// Gearing moves speeds of joints by those of others, ideally too. A Load acts on what is moved. An Inertia (bodies.hpp)
// is moved: nothing else states mass. A Constraint holds rows closed. A new part needs doMotion and doForce, a
// Constraint its rows besides; derivatives for analyses come from the recorded program. A Chain is an ordered list of
// parts, force runs through it in reverse.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/frame.hpp"
#include "mechanics/spatial_inertia.hpp"
#include "mechanics/variable.hpp"

namespace gamut {

/// What doMotion updates.
enum class MotionLevel {
  position,      ///< positions only
  all,           ///< positions, velocities and accelerations
  acceleration,  ///< accelerations J u̇ at the positions of the last call, as if every velocity were zero
};

/// Which forces doForce brings in; forces that arrive from behind are always handed on.
enum class ForceKind {
  all,      ///< inertia and applied forces
  applied,  ///< loads and gyroscopic moments
  smooth,   ///< these without dry friction along speeds that have a leader
  inertia,  ///< −m a and −Θ ω̇ alone: the answer to MotionLevel::acceleration
};

constexpr bool hasInertia(ForceKind kind) { return kind == ForceKind::all || kind == ForceKind::inertia; }
constexpr bool hasLoads(ForceKind kind) { return kind != ForceKind::inertia; }

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

  /// Energy in the field `gravity` [m/s², inertial frame] and in springs [J].
  virtual S potentialEnergy(const Vector3<S>& /*gravity*/) const { return S(0.0); }
};

/// An element that moves one frame by another, and by speeds of its own if it is a joint. It is ideal: doForce brings
/// in nothing of its own, so that Q = Jᵀ Q'.
template <class S>
class Transmission : public Element<S> {
 public:
  /// Throws std::invalid_argument if `to` is moved already or is `from` itself.
  Transmission(Frame<S>& from, Frame<S>& to) : from_(from), to_(to) {
    if (&from == &to) throw std::invalid_argument("an element needs two different frames, but both are " + to.name);
    if (to.origin) throw std::invalid_argument("frame " + to.name + " is moved by another element already");
    to.origin = this;
  }

  Frame<S>& from() const { return from_; }
  Frame<S>& to() const { return to_; }
  /// Those that this element moves `to()` by: where equations of motion may be cut.
  virtual std::vector<Speed<S>*> speeds() const { return {}; }

  void clearForces() override {
    to_.clearForces();
    for (Speed<S>* speed : speeds()) speed->force = S(0.0);
  }

  /// A point given in `to()`, seen from `from()`.
  virtual MovingPoint<S> inFrom(const MovingPoint<S>& point) const = 0;
  /// Axes given in `to()`, seen from `from()`.
  virtual TurningAxes<S> axesInFrom(const TurningAxes<S>& turning) const;

  /// By how much the origin of `to()` is accelerated beyond that of `from()`, at the last motion, in the axes of
  /// `from()` [m/s²]; at MotionLevel::acceleration, without what velocities add.
  virtual Vector3<S> accelerationBeyond(MotionLevel /*level*/) const {
    return from_.R.transpose() * Vector3<S>(to_.R * to_.a) - from_.a;
  }

  /// What moves like `to()` with this inertia, as `from()` feels it while the own speeds are held: Xᵀ M X, where X maps
  /// accelerations of `from()` to those of `to()`. Got from doMotion, which changes the accelerations of both frames;
  /// elements that know X say it in fewer operations.
  virtual SpatialInertia<S> inFrom(const SpatialInertia<S>& inertia);

 protected:
  Frame<S>& from_;
  Frame<S>& to_;
};

/// An element that moves speeds by others, ideally: u' = J u, Q += Jᵀ Q'. It stands ahead of the joints of both, so
/// that motion passes on through them, and the forces of both have come in when it hands on its own.
template <class S>
class Gearing : public Element<S> {};

/// One coordinate by another, in proportion: q' = i q + c, Q += i Q'.
template <class S>
class Gear final : public Gearing<S> {
 public:
  Gear(Variable<S>& from, Variable<S>& to, S ratio, S offset)
      : from_(from), to_(to), ratio_(std::move(ratio)), offset_(std::move(offset)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override {
    if (level != MotionLevel::acceleration) to_.position = ratio_ * from_.position + offset_;
    if (level == MotionLevel::all) {
      to_.rate = ratio_ * from_.rate;
      to_.leader = from_.leader;
      if (from_.leader != nullptr) to_.ratio = ratio_ * from_.ratio;
    }
    if (level != MotionLevel::position) to_.acceleration = ratio_ * from_.acceleration;
  }
  void doForce(ForceKind = ForceKind::all) override { from_.force += ratio_ * to_.force; }

 private:
  Variable<S>& from_;
  Variable<S>& to_;
  S ratio_, offset_;
};

/// Dry friction along a speed: −strength · direction().
template <class S>
struct DryFriction {
  const Speed<S>* speed;
  S strength;
};

/// An element that acts on frames and speeds, by what their positions and velocities are.
template <class S>
class Load : public Element<S> {
 public:
  void doMotion(MotionLevel /*level*/ = MotionLevel::all) override {}
  void doForce(ForceKind kind = ForceKind::all) final {
    if (kind == ForceKind::smooth) applySmoothForce();
    if (kind == ForceKind::all || kind == ForceKind::applied) applyForce();
  }

  /// What ForceKind::smooth leaves out.
  virtual std::vector<DryFriction<S>> dryFriction() const { return {}; }

 protected:
  /// Adds its forces to those of frames and speeds. Accelerations must not enter: what they move is an Inertia.
  virtual void applyForce() = 0;
  virtual void applySmoothForce() { applyForce(); }
};

/// The weight w of rows k and l in the inertia quadratic form ½ Σ w a_k a_l of the bodies' accelerations; an
/// off-diagonal weight stands for both (k, l) and (l, k).
template <class S>
struct InertiaWeight {
  int k, l;
  S w;
};

/// An element that moves mass. What is said of it here is all that a system knows of inertia.
template <class S>
class Inertia : public Element<S> {
 public:
  /// ½ m v² + ½ ω·Θω [J].
  virtual S kineticEnergy() const = 0;
  /// Appends its accelerations, one row a component, and the weights of these rows (numbered as they stand in
  /// `accelerations`).
  virtual void collectRows(std::vector<S>& accelerations, std::vector<InertiaWeight<S>>& weights) const = 0;
  /// The frame that it is fixed to, and its inertia there.
  virtual Frame<S>& frame() const = 0;
  virtual SpatialInertia<S> spatial() const = 0;
  /// Speeds whose accelerations it resists besides, and by how much (rotors.hpp).
  virtual std::vector<std::pair<const Speed<S>*, S>> reflected() const { return {}; }
};

/// An element that holds rows g(q) = 0 closed, ideally, by the force Gᵀ λ, where ġ = G q̇ and λ has a multiplier a row.
/// The system finds λ such that g̈ = −2 σ ġ − σ² g: where the motion starts closed it stays so, and what rounding
/// opens closes again as e^(−σ t) (J. Baumgarte, Comput. Methods Appl. Mech. Eng. 1, 1972). The rows must be
/// independent.
template <class S>
class Constraint : public Element<S> {
 public:
  /// `stabilisation`: σ [1/s].
  explicit Constraint(S stabilisation = S(0.0)) : stabilisation_(std::move(stabilisation)) {}

  /// g, one entry a row, at the present positions.
  std::vector<S> residuals() const { return kept(allResiduals()); }
  /// ġ at the present positions and velocities.
  std::vector<S> rates() const { return kept(allRates()); }
  /// g̈ at the present motion; at MotionLevel::acceleration, what the frames' accelerations give of it: G u̇.
  std::vector<S> accelerations(MotionLevel level) const { return kept(allAccelerations(level)); }

  /// Of all rows these are left to others, which hold them; they bear no force.
  void leaveOut(std::vector<std::size_t> rows) { leftOut_ = std::move(rows); }
  const std::vector<std::size_t>& leftOut() const { return leftOut_; }
  virtual std::vector<S> allResiduals() const = 0;
  virtual std::vector<S> allRates() const = 0;
  virtual std::vector<S> allAccelerations(MotionLevel level) const = 0;
  /// What each row holds, in words: "along x".
  virtual std::vector<std::string> rowNames() const = 0;

  /// Of the present motion, a force or moment that fits its row, zero of those left out: what the machine feels of
  /// being closed.
  const std::vector<S>& multipliers() const { return multipliers_; }
  /// One a row that is not left out, or none.
  void setMultipliers(std::vector<S> multipliers) {
    multipliers_ = std::move(multipliers);
    if (!multipliers_.empty())
      for (const std::size_t row : leftOut_)
        multipliers_.insert(multipliers_.begin() + static_cast<std::ptrdiff_t>(row), S(0.0));
  }
  const S& stabilisation() const { return stabilisation_; }

  void doMotion(MotionLevel /*level*/ = MotionLevel::all) override {}
  void doForce(ForceKind kind = ForceKind::all) final {
    if (kind == ForceKind::all && !multipliers_.empty()) applyForce();
  }

 protected:
  /// Adds Gᵀ λ to the forces of frames and speeds.
  virtual void applyForce() = 0;

 private:
  std::vector<S> kept(std::vector<S> rows) const {
    for (auto row = leftOut_.rbegin(); row != leftOut_.rend(); ++row)
      rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(*row));
    return rows;
  }

  S stabilisation_;
  std::vector<S> multipliers_;
  std::vector<std::size_t> leftOut_;  // rising
};

/// Elements in the order in which motion passes through them: `chain << joint << link << mass`.
template <class S>
class Chain final : public Element<S> {
 public:
  /// The element must outlive the chain.
  Chain& operator<<(Element<S>& element);

  void doMotion(MotionLevel level = MotionLevel::all) override {
    for (Element<S>* element : elements_) element->doMotion(level);
  }
  void doForce(ForceKind kind = ForceKind::all) override {
    for (auto element = elements_.rbegin(); element != elements_.rend(); ++element) (*element)->doForce(kind);
  }
  void clearForces() override {
    for (Element<S>* element : elements_) element->clearForces();
  }
  S potentialEnergy(const Vector3<S>& gravity) const override {
    S sum(0.0);
    for (const Element<S>* element : elements_) sum = sum + element->potentialEnergy(gravity);
    return sum;
  }

  const std::vector<Element<S>*>& elements() const { return elements_; }
  const std::vector<Inertia<S>*>& inertias() const { return inertias_; }
  const std::vector<Constraint<S>*>& constraints() const { return constraints_; }
  const std::vector<Load<S>*>& loads() const { return loads_; }
  /// Whether some frames move by speeds of joints that they do not hang on.
  bool hasGears() const { return hasGears_; }

 private:
  std::vector<Element<S>*> elements_;
  std::vector<Inertia<S>*> inertias_;
  std::vector<Constraint<S>*> constraints_;
  std::vector<Load<S>*> loads_;
  bool hasGears_ = false;
};

GAMUT_COMPILED_ELSEWHERE(Frame)
GAMUT_COMPILED_ELSEWHERE(Transmission)
GAMUT_COMPILED_ELSEWHERE(Chain)

}  // namespace gamut
