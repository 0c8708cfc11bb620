// Equations of motion in the formulations of the lineage (A. Kecskeméthy's MOBILE), each written on the library's own
// frames: what Gamut takes, and what it could take instead. Machines of angles and displacements alone.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mechanics/assembly.hpp"
#include "mechanics/equations/articulated_bodies.hpp"
#include "mechanics/equations/least_constraint.hpp"
#include "mechanics/equations/sparse_equations.hpp"
#include "mechanics/model.hpp"
#include "scalars/algebra/linear_system.hpp"

namespace gamut::benchmarks {

using Vector = std::vector<Recorded>;

/// u̇ of a system of a tree that has been moved.
using Solver = Vector (*)(System<Recorded>&);

inline Vector divided(Vector matrix, Vector right) {
  LinearSystem<Recorded>(MatrixKind::positiveDefinite, static_cast<int>(right.size()), std::move(matrix)).solve(right);
  return right;
}

/// M, column by column, by inertia forces at unit accelerations; Q by those that remain (LNCS 5045, 2008, (26) – (29)).
inline Vector kinetostatic(System<Recorded>& system) {
  Vector matrix;
  const auto m = system.inertiaMatrix();
  for (int i = 0; i < m.rows(); ++i)
    for (int j = 0; j < m.cols(); ++j) matrix.push_back(m(i, j));
  return divided(std::move(matrix), system.residual());
}

/// What accelerates the bodies, row by row, and what each row weighs.
struct BodyRows {
  Vector rows;
  std::vector<InertiaWeight<Recorded>> weights;
};
inline BodyRows rowsOf(System<Recorded>& system, const Vector& accelerations, MotionLevel level) {
  system.setAccelerations(accelerations);
  system.doMotion(level);
  BodyRows found;
  for (const Inertia<Recorded>* inertia : system.chain().inertias()) inertia->collectRows(found.rows, found.weights);
  std::erase_if(found.weights, [](const auto& weight) { return isKnownZero(weight.w); });
  return found;
}

/// J, column by column, of all bodies, and γ = J̇ u.
struct Jacobian {
  std::vector<Vector> columns;
  BodyRows free;
  Vector loads;

  explicit Jacobian(System<Recorded>& system) {
    const auto n = static_cast<std::size_t>(system.degreesOfFreedom());
    free = rowsOf(system, Vector(n), MotionLevel::all);
    system.doForce(ForceKind::applied);
    loads = system.generalisedForces();
    for (std::size_t j = 0; j < n; ++j) {
      Vector unit(n);
      unit[j] = 1.0;
      columns.push_back(rowsOf(system, unit, MotionLevel::acceleration).rows);
    }
  }
};

/// M = JᵀWJ, Q − JᵀWγ.
inline Vector byJacobians(System<Recorded>& system) {
  const Jacobian of(system);
  const std::size_t n = of.columns.size();
  const auto product = [&](const Vector& a, const Vector& b) {
    Recorded sum(0.0);
    for (const auto& [k, l, w] : of.free.weights) {
      sum = sum + w * (a[k] * b[l]);
      if (k != l) sum = sum + w * (a[l] * b[k]);
    }
    return sum;
  };
  Vector matrix(n * n), right = of.loads;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) matrix[i * n + j] = matrix[j * n + i] = product(of.columns[i], of.columns[j]);
    right[i] = right[i] - product(of.columns[i], of.free.rows);
  }
  return divided(std::move(matrix), std::move(right));
}

/// Gauss's least constraint, variable by variable on the rows of the bodies: what Gamut takes up to two speeds.
inline Vector eliminated(System<Recorded>& system) {
  Jacobian of(system);
  return leastConstraint(std::move(of.columns), std::move(of.free.rows), std::move(of.loads), of.free.weights);
}

/// The same elements once more, to be moved by algorithms of one's own.
struct Tree {
  explicit Tree(const System<Recorded>& system) {
    for (Element<Recorded>* element : system.chain().elements()) {
      chain << *element;
      if (auto* joint = dynamic_cast<Transmission<Recorded>*>(element)) {
        transmissions.push_back(joint);
        if (joint->from().origin == nullptr) base = &joint->from();
      }
    }
  }
  Chain<Recorded> chain;
  std::vector<Transmission<Recorded>*> transmissions;
  Frame<Recorded>* base = nullptr;
};

/// M by the inertia that hangs on each joint, as one body: a column is the wrench that this body's unit acceleration
/// needs, handed on inwards (M. Walker & D. Orin, J. Dyn. Syst. Meas. Control 104, 1982).
inline Vector composite(System<Recorded>& system) {
  const auto n = static_cast<std::size_t>(system.degreesOfFreedom());
  Vector right = system.residual();
  Tree tree(system);
  std::unordered_map<const Frame<Recorded>*, SpatialInertia<Recorded>> behind;
  for (const Inertia<Recorded>* inertia : tree.chain.inertias()) behind[&inertia->frame()] += inertia->spatial();
  std::unordered_map<const Speed<Recorded>*, std::size_t> number;
  for (std::size_t i = 0; i < n; ++i) number[&system.speeds()[i].get()] = i;
  Vector matrix(n * n);
  for (auto outer = tree.transmissions.rbegin(); outer != tree.transmissions.rend(); ++outer) {
    Transmission<Recorded>& joint = **outer;
    const SpatialInertia<Recorded> all = behind[&joint.to()];
    for (Speed<Recorded>* speed : joint.speeds()) {
      system.setAccelerations(Vector(n));
      speed->acceleration = 1.0;
      joint.from().omegaDot = joint.from().a = zeroVector<Recorded>();
      joint.doMotion(MotionLevel::acceleration);
      const auto wrench = detail::times(all, {joint.to().omegaDot, joint.to().a});
      tree.chain.clearForces();
      tree.base->clearForces();
      joint.to().tau = wrench[0];
      joint.to().f = wrench[1];
      for (auto inner = outer; inner != tree.transmissions.rend(); ++inner) (*inner)->doForce();
      const std::size_t j = number.at(speed);
      for (std::size_t i = 0; i < n; ++i)
        if (const Recorded& entry = system.speeds()[i].get().force; !isKnownZero(entry))
          matrix[i * n + j] = matrix[j * n + i] = entry;
    }
    if (&joint.from() != tree.base) behind[&joint.from()] += joint.inFrom(all);
  }
  return divided(std::move(matrix), std::move(right));
}

/// What Gamut takes for samples.
inline Vector articulated(System<Recorded>& system) {
  Tree tree(system);
  return articulatedAccelerations(system.speeds(), tree.chain, *tree.base);
}

/// What Gamut takes for enclosures of three speeds and more.
inline Vector cutAtJoints(System<Recorded>& system) { return sparseAccelerations(system); }

/// ẋ of x = [q; u].
inline Program motionOfTree(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                            Solver accelerations) {
  const int states = static_cast<int>(mechanism.stateNames().size()), n = states / 2;
  return record(states, static_cast<int>(freeParameters.size()), [&](auto t, const auto& x, const auto& p, auto& dx) {
    Assembly<Recorded> assembly(mechanism, freeParameters, p);
    assembly.setState(x, t);
    const Vector found = accelerations(assembly.system());
    for (int i = 0; i < n; ++i) dx[i] = x[n + i], dx[n + i] = found[i];
  });
}

/// The same of what closes on itself, where all coordinates and all speeds are states, and multipliers of the rows hold
/// it closed; x = [q; u], the speeds of dependent coordinates last. Nothing draws back what drifts off.
inline Program motionByMultipliers(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  const std::size_t n = mechanism.positions(), free = n - mechanism.dependents().size();
  const std::vector<std::string> names = mechanism.stateNames();
  return record(static_cast<int>(2 * n), static_cast<int>(freeParameters.size()),
                [&](auto t, const auto& x, const auto& p, auto& dx) {
                  Assembly<Recorded> assembly(mechanism, freeParameters, p);
                  const std::span<const Recorded> all(x);
                  assembly.setState(all.first(n + free), t);
                  System<Recorded>& system = assembly.system();
                  std::unordered_map<std::string, Recorded> rates;
                  for (std::size_t i = 0; i < n; ++i) {
                    system.speeds()[i].get().rate = x[n + i];
                    rates[i < free ? names[n + i] : mechanism.coordinateWith(mechanism.dependents()[i - free])->rate] =
                        x[n + i];
                  }
                  system.depend(0, false);
                  const Vector found = system.accelerations(Formulation::bordered);
                  for (std::size_t i = 0; i < n; ++i) {
                    dx[i] = rates.at(mechanism.coordinateWith(names[i])->rate);
                    dx[n + i] = found[i];
                  }
                });
}

}  // namespace gamut::benchmarks
