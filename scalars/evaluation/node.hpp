// One node of a Program from the values of those before it, for what looks at each node by itself. An Evaluator is
// faster.
#pragma once

#include <algorithm>
#include <vector>

#include "scalars/algebra/linear_system.hpp"
#include "scalars/program/program.hpp"
#include "scalars/traits.hpp"

namespace gamut {

/// Whether n is a sum, a difference, a negative, a product or a square; then `result` is that of its operands' values.
template <class S>
bool setByArithmetic(const Node& n, const std::vector<S>& values, S& result) {
  switch (n.op) {
    case Op::add:
      result = values[n.a] + values[n.b];
      return true;
    case Op::sub:
      result = values[n.a] - values[n.b];
      return true;
    case Op::neg:
      result = -values[n.a];
      return true;
    case Op::mul:
      result = values[n.a] * values[n.b];
      return true;
    case Op::sqr:
      result = square(values[n.a]);
      return true;
    default:
      return false;
  }
}

/// `system` becomes that of this matrix of f.
template <class S>
void assign(LinearSystem<S>& system, const LinearMatrix& matrix, const std::vector<S>& values) {
  system.assign(matrix.kind, matrix.size, [&](int i, int j) { return values[matrix.entry(i, j)]; });
}

/// All components of a solution, of which node `first` is the first, by its matrix's system.
template <class S>
void setSolution(const Program& f, int first, LinearSystem<S>& system, std::vector<S>& values) {
  const LinearSolution& solution = f.solutions()[f.nodes()[first].a];
  std::vector<S> x;
  for (const int r : solution.rightSide) x.push_back(values[r]);
  system.solve(x, solution.transposed);
  std::ranges::copy(x, values.begin() + first);
}

}  // namespace gamut
