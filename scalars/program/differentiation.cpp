// Both directions use the same partial derivatives, written once below.
#include "scalars/program/differentiation.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "scalars/operations/all.hpp"
#include "scalars/program/directions.hpp"

namespace gamut {
namespace {

/// A derivative that is known to be zero has no node.
constexpr int zero = -1;

/// d · ∂(node i)/∂(its operand), the first operand or (of a sum, difference or product) the second.
int chained(Recorder& r, int i, bool second, int d) {
  const Node n = r.node(i);
  switch (n.op) {
    case Op::add:
      return d;
    case Op::sub:
      return second ? r.neg(d) : d;
    case Op::neg:
      return r.neg(d);
    case Op::mul:
      return second ? r.mul(n.a, d) : r.mul(d, n.b);
    case Op::sqr: {
      const int product = r.mul(n.a, d);
      return r.mul(r.constant(2.0), product);
    }
    case Op::state:
    case Op::parameter:
    case Op::time:
    case Op::constant:
    case Op::solution:  // as a whole, below
      return zero;
    default:
      return withFunction(n.op, [&](auto f) { return f.derivative(r, i, n.a, n.b, d); });
  }
}

int sum(Recorder& r, int a, int b) { return a < 0 ? b : b < 0 ? a : r.add(a, b); }

/// Terms of a sum that cancel are no node either.
int orZero(const Recorder& r, int node) { return node >= 0 && r.isExactly(node, 0) ? zero : node; }
int asNode(Recorder& r, int node) { return node < 0 ? r.constant(0.0) : node; }

/// The last node of these, of its twins rather.
int lastOf(const Recorder& r, const std::vector<int>& nodes) {
  int last = nodes.empty() ? -1 : *std::max_element(nodes.begin(), nodes.end());
  if (last >= 0) detail::forEachTwin(r.table(), last, [&](int twin) { last = std::max(last, twin); });
  return last;
}

/// The matrix of a solution as it is solved: (k, j) is (j, k) of a transposed one.
struct SolvedSystem {
  LinearSolution solution;
  LinearMatrix matrix;  // copies: recording moves the originals

  SolvedSystem(const Recorder& r, int node)
      : solution(r.table().solutions[r.node(node).a]), matrix(r.table().matrices[solution.matrix]) {}
  int size() const { return matrix.size; }
  int entry(int k, int j) const { return solution.transposed ? matrix.entry(j, k) : matrix.entry(k, j); }
};

/// The derivatives of the components first, first + 1, …: M x' = r' - M' x, the same matrix.
void solutionTangents(Recorder& r, int first, std::vector<int>& d) {
  const SolvedSystem system(r, first);
  std::vector<int> rightSide;
  bool isZero = true;
  for (int k = 0; k < system.size(); ++k) {
    int sum = d[system.solution.rightSide[k]];
    for (int j = 0; j < system.size(); ++j) {
      const int entry = d[system.entry(k, j)];
      if (entry < 0) continue;
      const int product = r.mul(entry, first + j);
      sum = sum < 0 ? r.neg(product) : r.sub(sum, product);
    }
    sum = orZero(r, sum);
    isZero = isZero && sum < 0;
    rightSide.push_back(asNode(r, sum));
  }
  if (isZero) return;
  const std::vector<int> components = r.solve(system.solution.matrix, system.solution.transposed, rightSide);
  for (int k = 0; k < system.size(); ++k) d[first + k] = components[k];
}

/// contribute(operand, adjoint) for a solution whose components have the adjoints x̄: with Mᵀ w = x̄ it is w for the
/// right-hand side and -w xᵀ for M.
template <class Contribute>
void solutionAdjoints(Recorder& r, int first, const std::vector<int>& adjoint, const std::vector<char>& active,
                      Contribute contribute) {
  const SolvedSystem system(r, first);
  std::vector<int> rightSide;
  bool isZero = true;
  for (int k = 0; k < system.size(); ++k) {
    const int d = adjoint[first + k];
    isZero = isZero && d < 0;
    rightSide.push_back(asNode(r, d));
  }
  if (isZero) return;
  const std::vector<int> w = r.solve(system.solution.matrix, !system.solution.transposed, rightSide);
  for (int k = 0; k < system.size(); ++k) {
    if (active[system.solution.rightSide[k]]) contribute(system.solution.rightSide[k], w[k]);
    for (int j = 0; j < system.size(); ++j)
      if (active[system.entry(k, j)]) contribute(system.entry(k, j), r.neg(r.mul(w[k], first + j)));
  }
}

/// The numbers first, first + 1, …: inputs of a program.
std::vector<int> inputsFrom(int first, int count) {
  std::vector<int> result;
  for (int i = 0; i < count; ++i) result.push_back(first + i);
  return result;
}

/// The Jacobian given as jacobian(i, j) behind the outputs: states first, then parameters.
template <class Entry>
Program withJacobian(const Recorder& recorder, const Program& program, int columns, Entry jacobian) {
  std::vector<int> outputs = program.outputNodes();
  for (int i = 0; i < program.outputs(); ++i)
    for (int j = 0; j < program.states(); ++j) outputs.push_back(jacobian(i, j));
  for (int i = 0; i < program.outputs(); ++i)
    for (int j = program.states(); j < columns; ++j) outputs.push_back(jacobian(i, j));
  return recorder.finish(outputs);
}

/// Of node i, which is no solution, from those of its operands.
int tangent(Recorder& r, int i, const std::vector<int>& d) {
  const Node n = r.node(i);
  if (operandsOf(n.op) == 0) return zero;
  const int da = d[n.a], db = operandsOf(n.op) == 2 ? d[n.b] : zero;
  if (da < 0 && db < 0) return zero;
  if (n.op == Op::sub && da >= 0 && db >= 0) return orZero(r, r.sub(da, db));
  const int left = da < 0 ? zero : chained(r, i, false, da);
  return orZero(r, sum(r, left, db < 0 ? zero : chained(r, i, true, db)));
}

std::vector<int> outputsOf(const Program& program, const std::vector<int>& here) {
  std::vector<int> result;
  for (int output : program.outputNodes()) result.push_back(here[output]);
  return result;
}

}  // namespace

std::vector<int> tangents(Recorder& r, const std::vector<int>& of, const std::vector<std::pair<int, int>>& seeds) {
  const int last = lastOf(r, of);
  std::vector<int> d(last + 1, zero);
  for (const auto& [input, value] : seeds)
    if (input <= last) d[input] = orZero(r, value);
  for (int i = 0; i <= last; ++i) {
    const Node& n = r.node(i);
    if (n.op == Op::solution && n.b == 0) solutionTangents(r, i, d);
    if (operandsOf(r.node(i).op) > 0) d[i] = tangent(r, i, d);
  }
  std::vector<int> result;
  for (int node : of) result.push_back(asNode(r, d[node]));
  return result;
}

Directions::Directions(Recorder& recorder, const std::vector<int>& of) : recorder_(recorder) {
  const int last = lastOf(recorder, of);
  users_.resize(last + 1);
  places_.resize(last + 1);
  derivatives_.assign(last + 1, zero);
  for (int i = 0; i <= last; ++i) {
    const Node& n = recorder.node(i);
    if (n.op == Op::solution && n.b == 0)
      detail::forEachOperand(recorder.table(), i, [&](int operand) { users_[operand].push_back(i); });
    if (operandsOf(n.op) > 0) users_[n.a].push_back(i);
    if (operandsOf(n.op) > 1) users_[n.b].push_back(i);
  }
  for (std::size_t place = 0; place < of.size(); ++place) places_[of[place]].push_back(static_cast<int>(place));
}

/// Nodes in their order, as there.
std::vector<std::pair<int, int>> Directions::along(int input) {
  if (input >= static_cast<int>(users_.size())) return {};
  Recorder& r = recorder_;
  std::vector<int>& d = derivatives_;
  std::vector<int> known;
  std::set<int> open;
  const auto take = [&](int node) {
    if (d[node] < 0) return;
    known.push_back(node);
    open.insert(users_[node].begin(), users_[node].end());
  };
  d[input] = r.constant(1.0);
  take(input);
  while (!open.empty()) {
    const int i = *open.begin();
    open.erase(open.begin());
    if (r.node(i).op != Op::solution) {
      d[i] = tangent(r, i, d);
      take(i);
      continue;
    }
    const std::size_t size = r.table().solutions[r.node(i).a].rightSide.size();
    solutionTangents(r, i, d);
    for (std::size_t k = 0; k < size; ++k) take(i + static_cast<int>(k));
  }
  std::vector<std::pair<int, int>> result;
  for (const int node : known)
    for (const int place : places_[node]) result.emplace_back(place, d[node]);
  for (const int node : known) d[node] = zero;
  std::ranges::sort(result);
  return result;
}

std::vector<int> adjoints(Recorder& r, const std::vector<int>& of, const std::vector<int>& weights,
                          const std::vector<int>& inputs) {
  const int last = std::max(lastOf(r, of), lastOf(r, inputs));
  // Only what depends on one of the inputs is worth an adjoint.
  std::vector<char> active(last + 1, 0);
  for (int input : inputs) active[input] = 1;
  for (int i = 0; i <= last; ++i) {
    const Node& n = r.node(i);
    if (operandsOf(n.op) > 0 && active[n.a]) active[i] = 1;
    if (operandsOf(n.op) > 1 && active[n.b]) active[i] = 1;
    if (n.op == Op::solution)
      detail::forEachOperand(r.table(), i, [&](int operand) {
        if (active[operand]) active[i] = 1;
      });
  }
  std::vector<int> adjoint(last + 1, zero);
  const auto contribute = [&](int node, int d) { adjoint[node] = orZero(r, sum(r, adjoint[node], d)); };
  for (std::size_t i = 0; i < of.size(); ++i)
    if (active[of[i]]) contribute(of[i], orZero(r, weights[i]));
  for (int i = last; i >= 0; --i) {
    if (r.node(i).op == Op::solution && r.node(i).b == 0 && active[i])
      solutionAdjoints(r, i, adjoint, active, contribute);
    const int operands = operandsOf(r.node(i).op), d = adjoint[i];
    if (operands == 0 || d < 0) continue;
    const Node n = r.node(i);
    if (active[n.a]) contribute(n.a, chained(r, i, false, d));
    if (operands > 1 && active[n.b]) contribute(n.b, chained(r, i, true, d));
  }
  std::vector<int> result;
  for (int input : inputs) result.push_back(asNode(r, adjoint[input]));
  return result;
}

Program forwardDifferentiated(const Program& program, bool withParameters) {
  Recorder recorder(program);
  const int columns = program.states() + (withParameters ? program.parameters() : 0);
  std::vector<std::vector<int>> column;
  for (int j = 0; j < columns; ++j)
    column.push_back(tangents(recorder, program.outputNodes(), {{j, recorder.constant(1.0)}}));
  return withJacobian(recorder, program, columns, [&](int i, int j) { return column[j][i]; });
}

Program reverseDifferentiated(const Program& program, bool withParameters) {
  Recorder recorder(program);
  const int columns = program.states() + (withParameters ? program.parameters() : 0);
  std::vector<std::vector<int>> row;
  for (int output : program.outputNodes())
    row.push_back(adjoints(recorder, {output}, {recorder.constant(1.0)}, inputsFrom(0, columns)));
  return withJacobian(recorder, program, columns, [&](int i, int j) { return row[i][j]; });
}

Program gradient(const Program& program, bool withParameters) {
  if (program.outputs() != 1)
    throw std::invalid_argument("a gradient belongs to one output, not to " + std::to_string(program.outputs()));
  return reverseDifferentiated(program, withParameters);
}

Program jacobianTimesVector(const Program& program) {
  Recorder recorder(program.states(), program.parameters() + program.states());
  std::vector<int> outputs = outputsOf(program, recorder.append(program));
  std::vector<std::pair<int, int>> seeds;
  for (int j = 0; j < program.states(); ++j)
    seeds.emplace_back(recorder.state(j), recorder.parameter(program.parameters() + j));
  const std::vector<int> derivatives = tangents(recorder, outputs, seeds);
  outputs.insert(outputs.end(), derivatives.begin(), derivatives.end());
  return recorder.finish(outputs);
}

Program transposedJacobianTimesVector(const Program& program) {
  Recorder recorder(program.states(), program.parameters() + program.outputs());
  std::vector<int> outputs = outputsOf(program, recorder.append(program));
  const std::vector<int> weights = inputsFrom(recorder.parameter(program.parameters()), program.outputs());
  const std::vector<int> derivatives = adjoints(recorder, outputs, weights, inputsFrom(0, program.states()));
  outputs.insert(outputs.end(), derivatives.begin(), derivatives.end());
  return recorder.finish(outputs);
}

Program alongDerivatives(const Program& program, const std::vector<int>& by) {
  const int n = program.states(), k = program.parameters();
  Recorder recorder(n * (1 + static_cast<int>(by.size())), k);
  const std::vector<int> values = outputsOf(program, recorder.append(program));
  std::vector<int> outputs = values;
  int first = n;  // of the states ∂x/∂q
  for (const int q : by) {
    if (q < 0 || q >= n + k)
      throw std::invalid_argument("there is no initial value or parameter " + std::to_string(q) +
                                  " to differentiate by");
    std::vector<std::pair<int, int>> seeds;
    for (int j = 0; j < n; ++j) seeds.emplace_back(recorder.state(j), recorder.state(first + j));
    if (q >= n) seeds.emplace_back(recorder.parameter(q - n), recorder.constant(1.0));
    const std::vector<int> derivatives = tangents(recorder, values, seeds);
    outputs.insert(outputs.end(), derivatives.begin(), derivatives.end());
    first += n;
  }
  return recorder.finish(outputs);
}

}  // namespace gamut
