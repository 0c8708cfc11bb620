// A mechanical system in minimal coordinates and its equations of motion, got from doMotion and doForce alone (the
// kinetostatic method: one pass with u̇ = 0, one with each unit acceleration).
//
// M u̇ = Q: the inertia matrix M from the inertia forces at unit accelerations, Q the forces that remain at u̇ = 0. Up to
// two speeds are eliminated (least_constraint.hpp); systems of more are solved joint by joint, in the fewest operations
// (articulated_bodies.hpp), or as wholes, cut at the joints for enclosures (sparse_equations.hpp). With constraints, M
// is bordered by their rows. With gears, what a joint moves is more than what hangs on it, so that M takes the place of
// the way joint by joint. No path depends on a scalar's value.
#pragma once

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>
#include <vector>

#include "mechanics/element.hpp"
#include "mechanics/equations/articulated_bodies.hpp"
#include "mechanics/equations/formulation.hpp"
#include "mechanics/equations/least_constraint.hpp"
#include "scalars/algebra/linear_system.hpp"

namespace gamut {

template <class S>
class System;

/// Throws std::logic_error if a load depends on accelerations.
void checkLoads(System<Recorded>& system);
/// sparse_equations.hpp
std::vector<Recorded> sparseAccelerations(System<Recorded>& system);

template <class S>
class System {
 public:
  using Speeds = std::vector<std::reference_wrapper<Speed<S>>>;

  /// `gravity`: the acceleration of free fall in the inertial frame `base` [m/s²], e.g. {0, 0, -9.81}. Everything named
  /// here must outlive the system. Speeds of joints that are not among `speeds` are driven: an element ahead of the
  /// joint sets them. Throws std::invalid_argument if an element moves `base`.
  System(Speeds speeds, Chain<S>& chain, Frame<S>& base, Vector3<S> gravity)
      : speeds_(std::move(speeds)), chain_(chain), base_(base), gravity_(std::move(gravity)) {
    if (base.origin) throw std::invalid_argument("the inertial frame " + base.name + " must not be moved");
  }

  int degreesOfFreedom() const { return static_cast<int>(speeds_.size()); }

  /// Moves every frame by the variables' present positions, rates and accelerations.
  void doMotion(MotionLevel level = MotionLevel::all) {
    // A base accelerated by −g is a base at rest in the field g.
    base_.a = level == MotionLevel::acceleration ? zeroVector<S>() : baseAtRest();
    chain_.doMotion(level);
  }

  /// Clears all forces and pulls those of `kind` back to the variables' generalised forces.
  void doForce(ForceKind kind = ForceKind::all) {
    base_.clearForces();
    chain_.clearForces();
    chain_.doForce(kind);
  }

  /// The variables' generalised forces after doForce.
  std::vector<S> generalisedForces() const {
    std::vector<S> q;
    for (const Speed<S>& speed : speeds_) q.push_back(speed.force);
    return q;
  }

  /// The generalised forces that remain at u̇ = 0: with M u̇ = residual. With zero rates, the static forces.
  std::vector<S> residual() {
    setAccelerations(zeros());
    doMotion();
    doForce();
    return generalisedForces();
  }

  /// The inertia matrix M at the present positions, column by column: the inertia forces at unit accelerations.
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> inertiaMatrix() {
    const int f = degreesOfFreedom();
    doMotion();
    Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> m(f, f);
    for (int j = 0; j < f; ++j) {
      moveUnit(static_cast<std::size_t>(j));
      doForce(ForceKind::inertia);
      const std::vector<S> column = generalisedForces();
      for (int i = j; i < f; ++i) m(i, j) = m(j, i) = -column[static_cast<std::size_t>(i)];
    }
    return m;
  }

  /// u̇ at the present positions and rates; the speeds keep it and all frames move with it.
  /// Throws std::domain_error, naming the speed, if one is known to move no inertia.
  std::vector<S> accelerations(Formulation formulation = Formulation::sparse) {
    if constexpr (std::is_same_v<S, Recorded>) checkLoads(*this);
    setAccelerations(zeros());
    doMotion();
    if (speeds_.empty()) return {};
    const std::vector<S> result = !chain_.constraints().empty()        ? constrained()
                                  : degreesOfFreedom() <= 2            ? eliminated()
                                  : formulation == Formulation::sparse ? solved()
                                  : chain_.hasGears()                  ? solvedByInertia()
                                                      : articulatedAccelerations(speeds_, chain_, base_);
    setAccelerations(result);
    doMotion();
    return result;
  }

  /// After accelerations(): the forces of this motion, those of its inertia among them, on all frames and speeds; then
  /// the accelerations of frames as the base sees them, without −g.
  void complete() {
    doForce();
    base_.a = zeroVector<S>();
    chain_.doMotion(MotionLevel::all);
  }

  /// The acceleration of a base that is shaken, as a function of the present time; all motion is relative to it.
  void shake(std::function<Vector3<S>()> acceleration) { shaking_ = std::move(acceleration); }

  /// Motion and force once through the chain with these u̇. On the way `visit` sees, and may change, every component of
  /// what passes each joint: ω̇ and a of the frame behind it, then, inwards again, f and τ that act on this frame.
  template <class Visit>
  void pass(const std::vector<S>& accelerations, Visit visit) {
    const auto visitBoth = [&](Vector3<S>& first, Vector3<S>& second) {
      for (Vector3<S>* vector : {&first, &second})
        for (int i = 0; i < 3; ++i) visit((*vector)[i]);
    };
    setAccelerations(accelerations);
    base_.a = baseAtRest();
    for (Element<S>* element : chain_.elements()) {
      element->doMotion(MotionLevel::all);
      if (const auto* joint = jointAt(*element)) visitBoth(joint->to().omegaDot, joint->to().a);
    }
    base_.clearForces();
    chain_.clearForces();
    for (auto element = chain_.elements().rbegin(); element != chain_.elements().rend(); ++element) {
      if (const auto* joint = jointAt(**element)) visitBoth(joint->to().f, joint->to().tau);
      (*element)->doForce(ForceKind::all);
    }
  }

  S kineticEnergy() const {
    S sum(0.0);
    for (const Inertia<S>* inertia : chain_.inertias()) sum = sum + inertia->kineticEnergy();
    return sum;
  }
  S potentialEnergy() const { return chain_.potentialEnergy(gravity_); }
  S gravityEnergy() const {
    S sum(0.0);
    for (const Inertia<S>* inertia : chain_.inertias()) sum = sum + inertia->potentialEnergy(gravity_);
    return sum;
  }
  /// Kinetic and potential energy of the present motion (after doMotion) [J].
  S energy() const { return kineticEnergy() + potentialEnergy(); }

  void setAccelerations(const std::vector<S>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) speeds_[i].get().acceleration = values[i];
  }

 private:
  Vector3<S> baseAtRest() const { return shaking_ ? Vector3<S>(shaking_() - gravity_) : Vector3<S>(-gravity_); }

  /// The element as one that is moved by a speed of the system, or null.
  const Transmission<S>* jointAt(Element<S>& element) const {
    const auto* transmission = dynamic_cast<const Transmission<S>*>(&element);
    if (transmission == nullptr) return nullptr;
    for (const Speed<S>* own : transmission->speeds())
      for (const Speed<S>& speed : speeds_)
        if (own == &speed) return transmission;
    return nullptr;
  }

  /// f(constraint) of all constraints, one after another.
  template <class Rows>
  std::vector<S> ofConstraints(Rows rows) const {
    std::vector<S> all;
    for (Constraint<S>* constraint : chain_.constraints())
      for (S& row : rows(*constraint)) all.push_back(std::move(row));
    return all;
  }

  std::vector<S> zeros() const { return std::vector<S>(speeds_.size(), S(0.0)); }
  void moveUnit(std::size_t j) {
    std::vector<S> unit = zeros();
    unit[j] = S(1.0);
    setAccelerations(unit);
    doMotion(MotionLevel::acceleration);
  }
  std::vector<S> bodyAccelerations() const {
    std::vector<S> rows;
    std::vector<InertiaWeight<S>> weights;
    for (const Inertia<S>* inertia : chain_.inertias()) inertia->collectRows(rows, weights);
    return rows;
  }
  std::vector<S> bodyAccelerations(const std::vector<S>& values) {
    setAccelerations(values);
    doMotion();
    return bodyAccelerations();
  }
  /// Without those that are known zeros.
  std::vector<InertiaWeight<S>> inertiaWeights() const {
    std::vector<S> rows;
    std::vector<InertiaWeight<S>> weights;
    for (const Inertia<S>* inertia : chain_.inertias()) inertia->collectRows(rows, weights);
    std::erase_if(weights, [](const InertiaWeight<S>& weight) { return isKnownZero(weight.w); });
    return weights;
  }

  /// The bodies' accelerations for each unit acceleration, none of which may be known to move no inertia.
  std::vector<std::vector<S>> unitColumns() {
    std::vector<std::vector<S>> columns;
    const std::vector<InertiaWeight<S>> weights = inertiaWeights();
    for (std::size_t j = 0; j < speeds_.size(); ++j) {
      moveUnit(j);
      columns.push_back(bodyAccelerations());
      const auto isMoved = [&](int row) { return !isKnownZero(columns[j][static_cast<std::size_t>(row)]); };
      if (std::none_of(weights.begin(), weights.end(), [&](const auto& w) { return isMoved(w.k) || isMoved(w.l); }))
        throw std::domain_error("the variable " + speeds_[j].get().name + " moves no mass");
    }
    return columns;
  }

  std::vector<S> solved();
  std::vector<S> solvedByInertia();

  /// With the multipliers of the constraints: M u̇ − Gᵀ λ = Q, G u̇ = −g̈(u̇ = 0) − 2 σ ġ − σ² g.
  std::vector<S> constrained();

  std::vector<S> eliminated() {
    const std::vector<std::vector<S>> columns = unitColumns();
    doForce(ForceKind::applied);
    std::vector<S> loads = generalisedForces();
    const std::vector<InertiaWeight<S>> weights = inertiaWeights();
    std::vector<S> result = start(columns, weights);
    const std::vector<S> rest = leastConstraint(columns, bodyAccelerations(result), std::move(loads), weights);
    for (std::size_t j = 0; j < result.size(); ++j) result[j] = result[j] + rest[j];
    return result;
  }

  /// Any u̇ is as good a start as 0. Where a row moves with u̇_j by a number that is not zero, and with no later
  /// variable, the u̇_j that holds it still is taken, if the row is then known to be zero: that is one component less to
  /// be carried through the rest of the recorded program. For scalars other than Recorded nothing is known, and the
  /// start is 0.
  std::vector<S> start(const std::vector<std::vector<S>>& columns, const std::vector<InertiaWeight<S>>& weights) {
    std::vector<S> start = zeros();
    std::set<std::size_t> weighted;
    for (const InertiaWeight<S>& weight : weights)
      weighted.insert({static_cast<std::size_t>(weight.k), static_cast<std::size_t>(weight.l)});
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const auto movesLast = [&](std::size_t row) {
        return isKnownNonzero(columns[j][row]) &&
               std::all_of(columns.begin() + static_cast<std::ptrdiff_t>(j) + 1, columns.end(),
                           [&](const auto& later) { return isKnownZero(later[row]); });
      };
      const std::vector<S> gamma = bodyAccelerations(start);
      for (std::size_t row : weighted) {
        if (!movesLast(row) || isKnownZero(gamma[row])) continue;
        std::vector<S> trial = start;
        trial[j] = -(gamma[row] / columns[j][row]);
        if (!isKnownZero(bodyAccelerations(trial)[row])) continue;
        start = std::move(trial);
        break;
      }
    }
    return start;
  }

  Speeds speeds_;
  Chain<S>& chain_;
  Frame<S>& base_;
  Vector3<S> gravity_;
  std::function<Vector3<S>()> shaking_;
};

template <class S>
std::vector<S> System<S>::solved() {
  if constexpr (std::is_same_v<S, Recorded>) {
    unitColumns();
    return sparseAccelerations(*this);
  } else {
    return solvedByInertia();
  }
}

template <class S>
std::vector<S> System<S>::solvedByInertia() {
  unitColumns();
  std::vector<S> result = residual(), entries;
  const auto m = inertiaMatrix();
  for (int i = 0; i < m.rows(); ++i)
    for (int j = 0; j < m.cols(); ++j) entries.push_back(m(i, j));
  LinearSystem<S>(MatrixKind::positiveDefinite, degreesOfFreedom(), std::move(entries)).solve(result);
  return result;
}

template <class S>
std::vector<S> System<S>::constrained() {
  for (Constraint<S>* constraint : chain_.constraints()) constraint->setMultipliers({});
  std::vector<S> right = residual();
  const std::vector<S> atRest = ofConstraints([](Constraint<S>& constraint) {
    std::vector<S> rows = constraint.accelerations(MotionLevel::all);
    const std::vector<S> rates = constraint.rates(), residuals = constraint.residuals();
    const S& sigma = constraint.stabilisation();
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] = -rows[i] - S(2.0) * sigma * rates[i] - square(sigma) * residuals[i];
    return rows;
  });
  right.insert(right.end(), atRest.begin(), atRest.end());

  const int f = degreesOfFreedom(), size = static_cast<int>(right.size());
  const auto m = inertiaMatrix();
  std::vector<S> entries(static_cast<std::size_t>(size * size), S(0.0));
  const auto entry = [&](int i, int j) -> S& { return entries[static_cast<std::size_t>(i * size + j)]; };
  for (int j = 0; j < f; ++j) {
    for (int i = 0; i < f; ++i) entry(i, j) = m(i, j);
    moveUnit(static_cast<std::size_t>(j));
    const std::vector<S> column =
        ofConstraints([](Constraint<S>& constraint) { return constraint.accelerations(MotionLevel::acceleration); });
    for (int i = f; i < size; ++i) {
      entry(i, j) = column[static_cast<std::size_t>(i - f)];
      entry(j, i) = -entry(i, j);
    }
  }
  LinearSystem<S>(MatrixKind::general, size, std::move(entries)).solve(right);
  auto multiplier = right.begin() + f;
  for (Constraint<S>* constraint : chain_.constraints()) {
    const auto end = multiplier + static_cast<std::ptrdiff_t>(constraint->residuals().size());
    constraint->setMultipliers({multiplier, end});
    multiplier = end;
  }
  right.resize(static_cast<std::size_t>(f));
  return right;
}

}  // namespace gamut
