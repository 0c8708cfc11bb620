// A Program is a straight line of elementary operations: y = f(t, x, p), recorded once from generic code.
// It is the one form in which dynamics is kept: evaluators give it doubles, intervals, series or polynomials, passes
// (passes.hpp) make it shorter, differentiation (differentiation.hpp) gives another Program, and it is printed, saved
// and loaded as text (program_text.hpp). Constants that are not doubles (9.81, pi/4) keep their enclosure.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/operations/op.hpp"

namespace gamut {

struct Node {
  Op op;
  int a = -1;
  int b = -1;
  bool operator==(const Node&) const = default;
};

/// What is known of a matrix whose systems are solved.
enum class MatrixKind : std::uint8_t {
  general,           ///< regular
  positiveDefinite,  ///< symmetric and positive definite: entries (i, j) and (j, i) are one node
};

/// A square matrix of nodes, whose systems are solved as a whole: no operation of an elimination is a node, so that
/// pivoting is the evaluator's own affair and errors are bounded by residuals, not carried forward.
struct LinearMatrix {
  MatrixKind kind = MatrixKind::general;
  int size = 0;
  std::vector<int> entries;  ///< row by row

  int entry(int row, int column) const { return entries[row * size + column]; }
  bool operator==(const LinearMatrix&) const = default;
};

/// x in M x = r or, transposed, Mᵀ x = r; a positive definite M is never transposed.
struct LinearSolution {
  int matrix = 0;
  bool transposed = false;
  std::vector<int> rightSide;

  bool operator==(const LinearSolution&) const = default;
};

namespace detail {

/// Nodes and what they refer to, one after another as they are written.
struct NodeTable {
  std::vector<Node> nodes;
  std::vector<Interval> constants;
  std::vector<LinearMatrix> matrices;
  std::vector<LinearSolution> solutions;
};

/// Multiplications, divisions, additions and subtractions of a factorisation (LDLᵀ or LU), and of a solution by it,
/// with numbers that are not known to be zero: exact for LDLᵀ, which has no choice of pivots; of LU no fewer than with
/// any pivots. (Evaluators that solve densely compute with the zeros as well.)
struct SolvingOperations {
  int factorisation = 0, solution = 0;
};
SolvingOperations solvingOperations(const NodeTable& table, const LinearMatrix& matrix);

/// visit(node) for every node from which node i's value is computed, denominators of derivatives included. Component
/// 0 of a solution has the operands of the whole, the others have component 0.
template <class Visit>
void forEachOperand(const NodeTable& table, int i, Visit visit) {
  const Node& n = table.nodes[i];
  if (!isOperation(n.op)) return;
  if (n.op != Op::solution) {
    visit(n.a);
    if (n.b >= 0) visit(n.b);
  } else if (n.b > 0) {
    visit(i - n.b);
  } else {
    const LinearSolution& solution = table.solutions[n.a];
    for (int entry : table.matrices[solution.matrix].entries) visit(entry);
    for (int r : solution.rightSide) visit(r);
  }
}

/// visit(node) for every node that belongs together with node i, i itself included: a sine and its cosine, a tanh and
/// its sech2, the components of a solution. One is never there without the others.
template <class Visit>
void forEachTwin(const NodeTable& table, int i, Visit visit) {
  const Node& n = table.nodes[i];
  int first = i, count = 1;
  if (hasTwin(n.op)) count = 2;
  if (isTwin(n.op)) first = i - 1, count = 2;
  if (n.op == Op::solution) first = i - n.b, count = static_cast<int>(table.solutions[n.a].rightSide.size());
  for (int k = 0; k < count; ++k) visit(first + k);
}

}  // namespace detail

/// A recorded function of time t, states x (n values) and parameters p (k values) with m outputs.
class Program {
 public:
  int states() const { return states_; }
  int parameters() const { return parameters_; }
  int outputs() const { return static_cast<int>(outputs_.size()); }

  /// Nodes in an order in which every operand comes before its use: the states, the parameters, time, then the rest.
  const std::vector<Node>& nodes() const { return table_.nodes; }
  /// The node of each output.
  const std::vector<int>& outputNodes() const { return outputs_; }
  /// The enclosures of the constants that nodes refer to, in the order of these nodes, each of which has its own.
  const std::vector<Interval>& constants() const { return table_.constants; }
  /// The matrices that solutions refer to, and the solutions that nodes refer to, in the order of these nodes.
  const std::vector<LinearMatrix>& matrices() const { return table_.matrices; }
  const std::vector<LinearSolution>& solutions() const { return table_.solutions; }
  /// All of these together, for detail::forEachOperand and forEachTwin.
  const detail::NodeTable& table() const { return table_; }
  /// True if the node's value depends neither on time nor on a state: it is evaluated once for given parameters.
  bool isInvariant(int node) const { return invariant_[node] != 0; }
  /// Likewise of a matrix, number `m` of matrices(): all of its entries are.
  bool isInvariantMatrix(int m) const;
  /// Number of operations of one evaluation: nodes that are neither inputs nor constants nor invariant, and in place of
  /// a solution's nodes the arithmetic of solving (detail::solvingOperations).
  int operations() const;

  /// forwardDifferentiated(*this, withParameters) of differentiation.hpp: the m outputs, then the Jacobian.
  Program differentiated(bool withParameters = false) const;

  /// The readable form of print() in program_text.hpp.
  friend std::ostream& operator<<(std::ostream& out, const Program& program);

 private:
  friend class Recorder;
  int states_ = 0;
  int parameters_ = 0;
  detail::NodeTable table_;
  std::vector<int> outputs_;
  std::vector<char> invariant_;
};

/// The same nodes, constants, systems and outputs, number by number.
bool isIdentical(const Program& a, const Program& b);

}  // namespace gamut
