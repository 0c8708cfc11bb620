// Members of class templates, for those who compile them.
#pragma once

#include "mechanics/equations/system.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "mechanics/equations/articulated_bodies.hpp"
#include "mechanics/equations/least_constraint.hpp"

namespace gamut {

template <class S>
void System<S>::doMotion(MotionLevel level) {
  // A base accelerated by −g is a base at rest in the field g.
  base_.a = level == MotionLevel::acceleration ? zeroVector<S>() : baseAtRest();
  chain_.doMotion(level);
}

template <class S>
void System<S>::doForce(ForceKind kind) {
  base_.clearForces();
  chain_.clearForces();
  chain_.doForce(kind);
}

template <class S>
std::vector<S> System<S>::generalisedForces() const {
  std::vector<S> q;
  for (const Speed<S>& speed : speeds_) q.push_back(speed.force);
  return q;
}

template <class S>
std::vector<S> System<S>::residual() {
  setAccelerations(zeros());
  doMotion();
  doForce();
  return generalisedForces();
}

template <class S>
Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> System<S>::inertiaMatrix() {
  const int f = degreesOfFreedom();
  doMotion();
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> m(f, f);
  for (int j = 0; j < f; ++j) {
    moveUnit(static_cast<std::size_t>(j));
    doForce(ForceKind::inertia);
    const std::vector<S> column = generalisedForces();
    for (int i = j; i < f; ++i) m(i, j) = m(j, i) = -column[i];
  }
  return m;
}

template <class S>
std::vector<S> System<S>::accelerations(Formulation formulation) {
  if constexpr (std::is_same_v<S, Recorded>) checkLoads(*this);
  setAccelerations(zeros());
  doMotion();
  if (speeds_.empty()) return {};
  const bool isArticulated = formulation == Formulation::articulated;
  const bool isFree = formulation != Formulation::bordered && dependents_ > 0 && !areHeld_ &&
                      (isArticulated || speeds_.size() - dependents_ <= mostEliminated);
  const auto found = [&] {
    if (isConstrained()) return isFree ? projected() : formulation == Formulation::sparse ? constrained() : bordered();
    if (speeds_.size() <= mostEliminated) return eliminated();
    if (!isArticulated) return solved();
    return chain_.hasGears() ? solvedByInertia() : articulatedAccelerations(speeds_, chain_, base_);
  };
  const std::vector<S> result = found();
  setAccelerations(result);
  doMotion();
  return result;
}

template <class S>
void System<S>::complete() {
  doForce();
  base_.a = zeroVector<S>();
  chain_.doMotion(MotionLevel::all);
}

template <class S>
S System<S>::kineticEnergy() const {
  S sum(0.0);
  for (const Inertia<S>* inertia : chain_.inertias()) sum = sum + inertia->kineticEnergy();
  return sum;
}

template <class S>
S System<S>::gravityEnergy() const {
  S sum(0.0);
  for (const Inertia<S>* inertia : chain_.inertias()) sum = sum + inertia->potentialEnergy(gravity_);
  return sum;
}

template <class S>
void System<S>::setAccelerations(const std::vector<S>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) speeds_[i].get().acceleration = values[i];
}

template <class S>
const Transmission<S>* System<S>::jointAt(Element<S>& element) const {
  const auto* transmission = dynamic_cast<const Transmission<S>*>(&element);
  if (transmission == nullptr) return nullptr;
  for (const Speed<S>* own : transmission->speeds())
    for (const Speed<S>& speed : speeds_)
      if (own == &speed) return transmission;
  return nullptr;
}

template <class S>
void System<S>::moveUnit(std::size_t j) {
  std::vector<S> unit = zeros();
  unit[j] = S(1.0);
  setAccelerations(unit);
  doMotion(MotionLevel::acceleration);
}

template <class S>
std::vector<S> System<S>::bodyAccelerations() const {
  std::vector<S> rows;
  std::vector<InertiaWeight<S>> weights;
  for (const Inertia<S>* inertia : chain_.inertias()) inertia->collectRows(rows, weights);
  return rows;
}

template <class S>
std::vector<S> System<S>::bodyAccelerations(const std::vector<S>& values) {
  setAccelerations(values);
  doMotion();
  return bodyAccelerations();
}

template <class S>
std::vector<InertiaWeight<S>> System<S>::inertiaWeights() const {
  std::vector<S> rows;
  std::vector<InertiaWeight<S>> weights;
  for (const Inertia<S>* inertia : chain_.inertias()) inertia->collectRows(rows, weights);
  std::erase_if(weights, [](const InertiaWeight<S>& weight) { return isKnownZero(weight.w); });
  return weights;
}

template <class S>
std::vector<S> System<S>::resisted(const std::vector<S>& accelerations) {
  const std::vector<InertiaWeight<S>> weights = inertiaWeights();
  setAccelerations(accelerations);
  doMotion(MotionLevel::acceleration);
  const std::vector<S> rows = bodyAccelerations();
  std::vector<S> found;
  for (const InertiaWeight<S>& weight : weights)
    for (const int row : {weight.k, weight.l}) found.push_back(rows[row]);
  return found;
}

template <class S>
std::vector<std::vector<S>> System<S>::unitColumns() {
  std::vector<std::vector<S>> columns;
  const std::vector<InertiaWeight<S>> weights = inertiaWeights();
  for (std::size_t j = 0; j < speeds_.size(); ++j) {
    moveUnit(j);
    columns.push_back(bodyAccelerations());
    const auto isMoved = [&](int row) { return !isKnownZero(columns[j][row]); };
    if (std::none_of(weights.begin(), weights.end(), [&](const auto& w) { return isMoved(w.k) || isMoved(w.l); }))
      throw std::domain_error("the variable " + speeds_[j].get().name + " moves no mass");
  }
  return columns;
}

template <class S>
std::vector<S> System<S>::eliminated() {
  const std::vector<std::vector<S>> columns = unitColumns();
  doForce(ForceKind::applied);
  std::vector<S> loads = generalisedForces();
  const std::vector<InertiaWeight<S>> weights = inertiaWeights();
  std::vector<S> result =
      holdingStill(zeros(), 0, columns, [this](const std::vector<S>& values) { return bodyAccelerations(values); });
  const std::vector<S> rest = leastConstraint(columns, bodyAccelerations(result), std::move(loads), weights);
  for (std::size_t j = 0; j < result.size(); ++j) result[j] = result[j] + rest[j];
  return result;
}

template <class S>
std::vector<S> System<S>::holdingStill(std::vector<S> accelerations, std::size_t first,
                                       const std::vector<std::vector<S>>& columns,
                                       const std::function<std::vector<S>(const std::vector<S>&)>& rowsAt) {
  std::set<std::size_t> weighted;
  for (const InertiaWeight<S>& weight : inertiaWeights())
    weighted.insert({static_cast<std::size_t>(weight.k), static_cast<std::size_t>(weight.l)});
  for (std::size_t j = first; j < columns.size(); ++j) {
    const auto movesLast = [&](std::size_t row) {
      return isKnownNonzero(columns[j][row]) &&
             std::all_of(columns.begin() + static_cast<std::ptrdiff_t>(j) + 1, columns.end(),
                         [&](const auto& later) { return isKnownZero(later[row]); });
    };
    const std::vector<S> rows = rowsAt(accelerations);
    for (std::size_t row : weighted) {
      if (!movesLast(row) || isKnownZero(rows[row])) continue;
      std::vector<S> trial = accelerations;
      trial[j] = trial[j] - rows[row] / columns[j][row];
      if (!isKnownZero(rowsAt(trial)[row])) continue;
      accelerations = std::move(trial);
      break;
    }
  }
  return accelerations;
}

template <class S>
std::vector<S> System<S>::solved() {
  if constexpr (std::is_same_v<S, Recorded>) {
    checkMoved(*this);
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
std::vector<S> System<S>::unitRows(std::size_t j) {
  moveUnit(j);
  return rowsAt(MotionLevel::acceleration);
}

template <class S>
LinearSystem<S> System<S>::dependentRows() {
  const std::size_t m = dependents_, first = speeds_.size() - m;
  std::vector<S> entries(m * m, S(0.0));
  for (std::size_t j = 0; j < m; ++j) {
    const std::vector<S> column = unitRows(first + j);
    if (column.size() != m)
      throw std::logic_error("loops have " + std::to_string(column.size()) + " rows, but " + std::to_string(m) +
                             " dependent coordinates (Fields::dependentCoordinates)");
    for (std::size_t i = 0; i < m; ++i) entries[i * m + j] = column[i];
  }
  return LinearSystem<S>(MatrixKind::general, static_cast<int>(m), std::move(entries));
}

template <class S>
std::vector<std::vector<S>> System<S>::tangents(const LinearSystem<S>& rows) {
  const std::size_t first = speeds_.size() - dependents_;
  const auto moved = [this](const std::vector<S>& accelerations) {
    setAccelerations(accelerations);
    doMotion(MotionLevel::acceleration);
    return bodyAccelerations();
  };
  std::vector<std::vector<S>> columns, found;
  for (std::size_t j = 0; j < speeds_.size(); ++j) {
    moveUnit(j);
    columns.push_back(bodyAccelerations());
  }
  for (std::size_t j = 0; j < first; ++j) {
    std::vector<S> tangent = zeros();
    tangent[j] = S(1.0);
    tangent = holdingStill(std::move(tangent), first, columns, moved);
    moved(tangent);
    std::vector<S> open = rowsAt(MotionLevel::acceleration);
    rows.solve(open);
    for (std::size_t i = 0; i < dependents_; ++i) tangent[first + i] = tangent[first + i] - open[i];
    found.push_back(std::move(tangent));
  }
  return found;
}

template <class S>
void System<S>::close() {
  if (dependents_ == 0) return;
  const auto dependent = std::span(speeds_).last(dependents_);
  const std::size_t f = speeds_.size() - dependents_;
  const bool isByTangents = f <= mostEliminated;  // of more speeds, one solution for all of them is less work
  std::vector<S> independent;
  for (std::size_t j = 0; j < f && isByTangents; ++j)
    independent.push_back(std::exchange(speeds_[j].get().rate, S(0.0)));
  for (Speed<S>& speed : speeds_) speed.leader = nullptr;
  for (Speed<S>& speed : dependent) speed.rate = S(0.0);
  setAccelerations(zeros());
  doMotion();
  std::vector<S> rates = openingRates();
  for (S& rate : rates) rate = -rate;
  const LinearSystem<S> rows = dependentRows();
  rows.solve(rates);
  if (isByTangents) {
    const std::vector<std::vector<S>> along = tangents(rows);
    if (!areHeld_) lead(along, rates);  // else these laws hold at the start alone
    for (std::size_t j = 0; j < f; ++j) {
      speeds_[j].get().rate = independent[j];
      for (std::size_t i = 0; i < dependents_; ++i) rates[i] = rates[i] + along[j][f + i] * independent[j];
    }
  }
  for (std::size_t i = 0; i < dependents_; ++i) dependent[i].get().rate = rates[i];
  setAccelerations(zeros());
}

template <class S>
void System<S>::lead(const std::vector<std::vector<S>>& along, const std::vector<S>& driven) {
  const std::size_t f = along.size();
  for (std::size_t i = 0; i < speeds_.size(); ++i) {
    Speed<S>& speed = speeds_[i];
    if (i >= f && !isKnownZero(driven[i - f])) continue;
    const auto moves = [&](const std::vector<S>& tangent) { return !isKnownZero(tangent[i]); };
    if (i >= f && std::ranges::count_if(along, moves) != 1) continue;
    const std::size_t j = i < f ? i : static_cast<std::size_t>(std::ranges::find_if(along, moves) - along.begin());
    speed.leader = &speeds_[j].get();
    speed.ratio = i < f ? S(1.0) : along[j][i];
  }
}

template <class S>
std::vector<S> System<S>::opening() {
  std::vector<S> rows = residuals();
  dependentRows().solve(rows);
  return rows;
}

template <class S>
void System<S>::holdDry(std::vector<S>& loads) const {
  using std::abs;
  for (std::size_t j = 0; j < loads.size(); ++j) {
    const Speed<S>& leader = speeds_[j];
    S strength(0.0);
    for (const Load<S>* load : chain_.loads())
      for (const DryFriction<S>& each : load->dryFriction())
        if (each.speed->leader == &leader) strength = strength + each.strength * abs(each.speed->ratio);
    if (!isKnownZero(strength)) loads[j] = loads[j] - strength * signOf(leader.rate);
  }
}

template <class S>
std::vector<S> System<S>::projected() {
  const std::size_t n = speeds_.size(), m = dependents_, f = n - m;
  for (Constraint<S>* constraint : chain_.constraints()) constraint->setMultipliers({});
  setAccelerations(zeros());
  doMotion();
  std::vector<S> gamma = rowsAt(MotionLevel::all);
  const LinearSystem<S> rows = dependentRows();
  const auto dependentPart = [&](std::vector<S> right) {  // of what solves J_d x = −right
    for (S& row : right) row = -row;
    rows.solve(right);
    return right;
  };
  gamma = dependentPart(std::move(gamma));
  if (f == 0) return gamma;
  gamma.insert(gamma.begin(), f, S(0.0));
  const std::vector<std::vector<S>> tangents = this->tangents(rows);
  const auto along = [&](const std::vector<S>& tangent, const std::vector<S>& force) {
    S sum(0.0);
    for (std::size_t i = 0; i < n; ++i) sum = sum + tangent[i] * force[i];
    return sum;
  };
  std::vector<S> result;
  if (f <= mostEliminated) {
    std::vector<std::vector<S>> columns;
    for (const std::vector<S>& tangent : tangents) {
      setAccelerations(tangent);
      doMotion(MotionLevel::acceleration);
      columns.push_back(bodyAccelerations());
    }
    setAccelerations(zeros());
    doMotion();
    doForce(ForceKind::smooth);
    const std::vector<S> forces = generalisedForces();
    std::vector<S> loads;
    for (const std::vector<S>& tangent : tangents) loads.push_back(along(tangent, forces));
    holdDry(loads);
    result = leastConstraint(std::move(columns), bodyAccelerations(gamma), std::move(loads), inertiaWeights());
  } else {
    setAccelerations(gamma);
    doMotion();
    doForce();
    const std::vector<S> forces = generalisedForces();  // Q − M γ
    std::vector<S> entries(f * f, S(0.0));
    for (std::size_t j = 0; j < f; ++j) {
      setAccelerations(tangents[j]);
      doMotion(MotionLevel::acceleration);
      doForce(ForceKind::inertia);
      const std::vector<S> inertia = generalisedForces();
      for (std::size_t i = j; i < f; ++i) entries[i * f + j] = entries[j * f + i] = -along(tangents[i], inertia);
      result.push_back(along(tangents[j], forces));
    }
    LinearSystem<S>(MatrixKind::positiveDefinite, static_cast<int>(f), std::move(entries)).solve(result);
  }
  std::vector<S> all = gamma;
  for (std::size_t j = 0; j < f; ++j)
    for (std::size_t i = 0; i < n; ++i) all[i] = all[i] + tangents[j][i] * result[j];
  return all;
}

template <class S>
std::vector<S> System<S>::openingAccelerations() const {
  return ofConstraints([this](Constraint<S>& constraint) {
    std::vector<S> rows = constraint.accelerations(MotionLevel::all);
    const std::vector<S> rates = constraint.rates(), residuals = constraint.residuals();
    const S sigma = areHeld_ ? S(pull) : constraint.stabilisation();
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] = rows[i] + S(2.0) * sigma * rates[i] + square(sigma) * residuals[i];
    return rows;
  });
}

template <class S>
std::vector<S> System<S>::constrained() {
  if constexpr (std::is_same_v<S, Recorded>)
    return sparseAccelerations(*this);
  else
    return bordered();
}

template <class S>
std::vector<S> System<S>::bordered() {
  for (Constraint<S>* constraint : chain_.constraints()) constraint->setMultipliers({});
  std::vector<S> right = residual();
  for (const S& row : openingAccelerations()) right.push_back(-row);

  const int f = degreesOfFreedom(), size = static_cast<int>(right.size());
  const auto m = inertiaMatrix();
  std::vector<S> entries(static_cast<std::size_t>(size * size), S(0.0));
  const auto entry = [&](int i, int j) -> S& { return entries[i * size + j]; };
  for (int j = 0; j < f; ++j) {
    for (int i = 0; i < f; ++i) entry(i, j) = m(i, j);
    const std::vector<S> column = unitRows(static_cast<std::size_t>(j));
    for (int i = f; i < size; ++i) {
      entry(i, j) = column[i - f];
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
