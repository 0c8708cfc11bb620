// The passes with unknowns at the cuts, their derivatives as entries, and the solution.
#include "mechanics/equations/sparse_equations.hpp"

#include <cstddef>
#include <new>
#include <span>
#include <utility>

#include "scalars/algebra/linear_reduction.hpp"
#include "scalars/algebra/linear_system.hpp"
#include "scalars/index.hpp"
#include "scalars/program/directions.hpp"

namespace gamut {
namespace {

using detail::at;

/// Unknowns: q̈ and the constraints' multipliers λ, then, in the order of the passes, what is cut. Equations: what
/// defines each of the latter, then those that are zero.
struct Cuts {
  std::vector<int> unknowns;  // nodes
  std::size_t degrees = 0, multipliers = 0;
  std::vector<int> values;  // nodes: what the passes give for each cut, then the generalised forces and the rows
  std::vector<char> isCut;  // of the components met on the way: known zeros need no cut

  std::size_t free() const { return degrees + multipliers; }
};

/// Of the constraints, one after the other.
void setMultipliers(System<Recorded>& system, std::span<const Recorded> all) {
  for (Constraint<Recorded>* constraint : system.chain().constraints()) {
    const std::size_t rows = constraint->residuals().size();
    constraint->setMultipliers({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(rows)});
    all = all.subspan(rows);
  }
}

/// After a pass: generalised forces, then the constraints' rows.
std::vector<Recorded> zerosOf(System<Recorded>& system) {
  std::vector<Recorded> zeros = system.generalisedForces();
  for (Recorded& row : system.openingAccelerations()) zeros.push_back(std::move(row));
  return zeros;
}

Cuts cutEverywhere(System<Recorded>& system) {
  Recorder& recorder = *Recorder::current();
  Cuts cuts;
  const auto unknown = [&] {
    cuts.unknowns.push_back(recorder.unknown());
    return Recorded::node(cuts.unknowns.back());
  };
  std::vector<Recorded> accelerations, multipliers;
  cuts.degrees = at(system.degreesOfFreedom());
  cuts.multipliers = system.residuals().size();
  while (accelerations.size() < cuts.degrees) accelerations.push_back(unknown());
  while (multipliers.size() < cuts.multipliers) multipliers.push_back(unknown());
  setMultipliers(system, multipliers);
  system.pass(accelerations, [&](Recorded& component) {
    cuts.isCut.push_back(!isKnownZero(component));
    if (cuts.isCut.back() == 0) return;
    cuts.values.push_back(component.node());
    component = unknown();
  });
  for (const Recorded& zero : zerosOf(system)) cuts.values.push_back(zero.node());
  return cuts;
}

/// The same values where all unknowns are zero.
std::vector<Recorded> constantParts(System<Recorded>& system, const Cuts& cuts) {
  std::vector<Recorded> constants;
  std::size_t next = 0;
  setMultipliers(system, std::vector<Recorded>(cuts.multipliers));
  system.pass(std::vector<Recorded>(cuts.degrees), [&](Recorded& component) {
    if (cuts.isCut[next++] != 0) constants.push_back(component);
    component = Recorded(0.0);
  });
  for (Recorded& zero : zerosOf(system)) constants.push_back(std::move(zero));
  return constants;
}

/// Row by row: unknown − ∂value/∂unknowns for each cut, −∂value/∂unknowns for what is zero.
LinearReduction::Rows matrixOf(const Cuts& cuts) {
  const std::size_t n = cuts.unknowns.size(), free = cuts.free();
  Directions directions(*Recorder::current(), cuts.values);
  LinearReduction::Rows matrix(n);
  for (std::size_t j = 0; j < n; ++j) {
    const auto column = static_cast<int>(j);
    if (j >= free) matrix[j - free][column] = 1.0;
    for (const auto& [i, node] : directions.along(cuts.unknowns[j])) {
      const Recorded derivative = Recorded::node(node);
      Recorded& entry = matrix[i][column];
      entry = at(i) + free == j ? 1.0 - derivative : -derivative;
    }
  }
  return matrix;
}

/// Throws std::bad_alloc where all that so many equations take would find no room: before any of it is taken, which
/// lasts its time where they are many.
void requireRoom(std::size_t equations) {
  constexpr std::size_t most = 46340;  // whose entries an int numbers
  constexpr std::size_t matrices = 3;  // of nodes: in the recorder, as what is known, and in the program
  if (equations > most) throw std::bad_alloc();
  const std::size_t bytes = equations * equations * (sizeof(Recorded) + matrices * sizeof(int));
  ::operator delete(::operator new(bytes));
}

/// All entries of what the reduction has left, row by row.
std::vector<Recorded> restOf(const LinearReduction::Rows& matrix, const LinearReduction& reduction) {
  const std::size_t size = reduction.rows().size();
  requireRoom(size);
  std::vector<std::size_t> place(matrix.size(), size);
  for (std::size_t k = 0; k < size; ++k) place[reduction.columns()[k]] = k;
  std::vector<Recorded> rest(size * size);
  for (std::size_t k = 0; k < size; ++k)
    for (const auto& [j, entry] : matrix[reduction.rows()[k]])
      if (place[j] < size) rest[k * size + place[j]] = entry;
  return rest;
}

}  // namespace

std::vector<Recorded> sparseAccelerations(System<Recorded>& system) {
  const Cuts cuts = cutEverywhere(system);
  std::vector<Recorded> right = constantParts(system, cuts);
  LinearReduction::Rows matrix = matrixOf(cuts);

  const LinearReduction reduction(matrix);
  reduction.reduce(right);
  std::vector<Recorded> restRight, x(cuts.unknowns.size());
  for (int i : reduction.rows()) restRight.push_back(right[i]);
  std::vector<Recorded> rest = restOf(matrix, reduction);
  if (!restRight.empty())
    LinearSystem<Recorded>(MatrixKind::general, static_cast<int>(restRight.size()), std::move(rest)).solve(restRight);
  for (std::size_t i = 0; i < restRight.size(); ++i) x[reduction.columns()[i]] = restRight[i];
  reduction.complete(right, x);
  setMultipliers(system, std::span<const Recorded>(x).subspan(cuts.degrees, cuts.multipliers));
  x.resize(cuts.degrees);
  return x;
}

}  // namespace gamut
