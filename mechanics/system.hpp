// A mechanical system in minimal coordinates and its equations of motion, got from doMotion and doForce alone (the
// kinetostatic method: one pass with q̈ = 0, one with each unit acceleration).
//
// The passes give every body's acceleration as a = γ + J q̈ (γ: velocities and gravity; J: unit accelerations), and Q,
// the applied forces pulled back. Gauss's principle of least constraint then picks q̈:
//
//     minimise  ½ Σ w (γ + J q̈)² − Q·q̈      (normal equations: Jᵀ W J q̈ = Q − Jᵀ W γ, Jᵀ W J the inertia matrix)
//
// by eliminating one variable after the other, from the last to the first, on the rows of J and γ instead of on the
// normal equations. Every pivot Σ w J² is a sum of squares: it cannot lose its sign to rounding or to wide intervals,
// as a pivot of the inertia matrix can, and recorded programs are shorter. No path depends on a scalar's value.
#pragma once

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>
#include <vector>

#include "mechanics/element.hpp"

namespace gamut {

template <class S>
class System {
 public:
  using Variables = std::vector<std::reference_wrapper<Variable<S>>>;

  /// `gravity`: the acceleration of free fall in the inertial frame `base` [m/s²], e.g. {0, 0, -9.81}. Everything named
  /// here must outlive the system. Throws std::invalid_argument without a variable or if an element moves `base`.
  System(Variables variables, Chain<S>& chain, Frame<S>& base, Vector3<S> gravity)
      : variables_(std::move(variables)), chain_(chain), base_(base), gravity_(std::move(gravity)) {
    if (variables_.empty()) throw std::invalid_argument("a system needs at least one variable");
    if (base.origin) throw std::invalid_argument("the inertial frame " + base.name + " must not be moved");
  }

  int degreesOfFreedom() const { return static_cast<int>(variables_.size()); }

  /// Moves every frame by the variables' present positions, rates and accelerations.
  void doMotion(MotionLevel level = MotionLevel::all) {
    // A base accelerated by −g is a base at rest in the field g.
    base_.a = level == MotionLevel::acceleration ? zeroVector<S>() : Vector3<S>(-gravity_);
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
    for (const Variable<S>& variable : variables_) q.push_back(variable.force);
    return q;
  }

  /// The generalised forces that remain at q̈ = 0: with M q̈ = residual. With zero rates, the static forces.
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

  /// q̈ at the present positions and rates; the variables keep it and all frames move with it.
  /// Throws std::domain_error, naming the variable, if a variable is known to move no inertia.
  std::vector<S> accelerations() {
    setAccelerations(zeros());
    doMotion();
    doForce(ForceKind::applied);
    std::vector<S> loads = generalisedForces();
    std::vector<std::vector<S>> columns;
    for (std::size_t j = 0; j < variables_.size(); ++j) {
      moveUnit(j);
      columns.push_back(bodyAccelerations());
    }
    std::vector<S> result = prediction(columns);
    const std::vector<S> correction = leastConstraint(std::move(columns), accelerationsAt(result), std::move(loads));
    for (std::size_t j = 0; j < result.size(); ++j) result[j] = result[j] + correction[j];
    setAccelerations(result);
    doMotion();
    return result;
  }

  S kineticEnergy() const { return chain_.kineticEnergy(); }
  S potentialEnergy() const { return chain_.potentialEnergy(gravity_); }
  /// Kinetic and potential energy of the present motion (after doMotion) [J].
  S energy() const { return kineticEnergy() + potentialEnergy(); }

 private:
  std::vector<S> zeros() const { return std::vector<S>(variables_.size(), S(0.0)); }
  void setAccelerations(const std::vector<S>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) variables_[i].get().acceleration = values[i];
  }
  void moveUnit(std::size_t j) {
    std::vector<S> unit = zeros();
    unit[j] = S(1.0);
    setAccelerations(unit);
    doMotion(MotionLevel::acceleration);
  }
  std::vector<S> bodyAccelerations() const {
    std::vector<S> rows;
    std::vector<InertiaWeight<S>> weights;
    chain_.collectInertia(rows, weights);
    return rows;
  }
  std::vector<S> accelerationsAt(const std::vector<S>& values) {
    setAccelerations(values);
    doMotion();
    return bodyAccelerations();
  }
  /// Without those that are known zeros.
  std::vector<InertiaWeight<S>> inertiaWeights() const {
    std::vector<S> rows;
    std::vector<InertiaWeight<S>> weights;
    chain_.collectInertia(rows, weights);
    std::erase_if(weights, [](const InertiaWeight<S>& weight) { return isKnownZero(weight.w); });
    return weights;
  }

  /// Any q̈ is as good a start as 0. Where a row moves with q̈_j but with no later variable, the q̈_j that holds it still
  /// is taken, if the row is then known to be zero: that is one component less to be carried through the rest of the
  /// recorded program. For scalars other than Recorded nothing is known, and the start is 0.
  std::vector<S> prediction(const std::vector<std::vector<S>>& columns) {
    std::vector<S> start = zeros();
    if (!isKnownZero(S(0.0))) return start;
    std::set<std::size_t> weighted;
    for (const InertiaWeight<S>& weight : inertiaWeights())
      weighted.insert({static_cast<std::size_t>(weight.k), static_cast<std::size_t>(weight.l)});
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const auto movesLast = [&](std::size_t row) {
        return !isKnownZero(columns[j][row]) &&
               std::all_of(columns.begin() + static_cast<std::ptrdiff_t>(j) + 1, columns.end(),
                           [&](const auto& later) { return isKnownZero(later[row]); });
      };
      const std::vector<S> gamma = accelerationsAt(start);
      for (std::size_t row : weighted) {
        if (!movesLast(row) || isKnownZero(gamma[row])) continue;
        std::vector<S> trial = start;
        trial[j] = -(gamma[row] / columns[j][row]);
        if (!isKnownZero(accelerationsAt(trial)[row])) continue;
        start = std::move(trial);
        break;
      }
    }
    return start;
  }

  /// Minimises ½ Σ w (γ + J q̈)² − Q·q̈. Eliminating q̈_j (with D = Σ w J_j²) leaves
  ///   q̈_j = (Q_j − Σ w J_j γ)/D − Σ_{i<j} L_i q̈_i,   L_i = Σ w J_j J_i / D,
  /// and the same problem in the rest, with J_i − J_j L_i for J_i, γ − J_j Σ w J_j γ / D for γ, Q_i − L_i Q_j for Q_i.
  std::vector<S> leastConstraint(std::vector<std::vector<S>> columns, std::vector<S> gamma,
                                 std::vector<S> loads) const {
    const std::vector<InertiaWeight<S>> weights = inertiaWeights();
    const std::size_t f = columns.size(), rows = gamma.size();
    std::vector<std::vector<S>> l(f);
    std::vector<S> result(f, S(0.0));
    for (std::size_t j = f; j-- > 0;) {
      const std::vector<S>& pivot = columns[j];
      std::vector<S> weighted(rows, S(0.0));
      S d(0.0);
      for (const InertiaWeight<S>& weight : weights) {
        const auto row = static_cast<std::size_t>(weight.k), other = static_cast<std::size_t>(weight.l);
        weighted[row] = weighted[row] + weight.w * pivot[other];
        if (row != other) weighted[other] = weighted[other] + weight.w * pivot[row];
        d = d + (row == other ? weight.w * square(pivot[row]) : S(2.0) * (weight.w * (pivot[row] * pivot[other])));
      }
      std::vector<std::size_t> involved;
      for (std::size_t row = 0; row < rows; ++row)
        if (!isKnownZero(weighted[row])) involved.push_back(row);
      if (involved.empty()) throw std::domain_error("the variable " + variables_[j].get().name + " moves no mass");

      // A single row is solved for q̈_j and is zero ever after: no weight is needed, and nothing is left to cancel.
      const bool single = involved.size() == 1 && !isKnownZero(pivot[involved[0]]);
      const S inverse = single ? S(1.0) / pivot[involved[0]] : S(1.0) / d;
      const auto project = [&](const std::vector<S>& column) {
        if (single) return S(column[involved[0]] * inverse);
        S sum(0.0);
        for (std::size_t row : involved) sum = sum + weighted[row] * column[row];
        return S(sum * inverse);
      };
      const auto reduce = [&](std::vector<S>& column, const S& factor) {
        for (std::size_t row = 0; row < rows; ++row) column[row] = column[row] - pivot[row] * factor;
        if (single) column[involved[0]] = S(0.0);
      };
      const S free = project(gamma);
      reduce(gamma, free);
      result[j] = isKnownZero(loads[j]) ? S(-free) : S(loads[j] / d - free);
      for (std::size_t i = 0; i < j; ++i) {
        l[j].push_back(project(columns[i]));
        reduce(columns[i], l[j][i]);
        loads[i] = loads[i] - l[j][i] * loads[j];
      }
    }
    for (std::size_t j = 0; j < f; ++j)
      for (std::size_t i = 0; i < j; ++i) result[j] = result[j] - l[j][i] * result[i];
    return result;
  }

  Variables variables_;
  Chain<S>& chain_;
  Frame<S>& base_;
  Vector3<S> gravity_;
};

}  // namespace gamut
