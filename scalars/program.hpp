// A Program is a straight line of elementary operations: y = f(t, x, p), recorded once from generic code.
// It is the one form in which dynamics is kept: evaluators give it doubles, intervals, series or polynomials, and its
// derivative is again a Program. A Recorder builds it: equal operations are merged, exact constants are folded, and
// what no output needs is dropped. Constants that are not doubles (9.81, pi/4) keep their enclosure.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "scalars/index.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// The operations of a Program. `a` and `b` of a Node are node numbers, except for state, parameter and constant, where
/// `a` counts states, parameters or constants.
enum class Op : std::uint8_t {
  state,      ///< x[a]
  parameter,  ///< p[a]
  time,       ///< t
  constant,   ///< constants[a], an enclosed real number
  add,        ///< a + b
  sub,        ///< a - b
  neg,        ///< -a
  mul,        ///< a * b
  sqr,        ///< a * a
  recip,      ///< 1 / a
  sqrt,       ///< square root of a
  exp,        ///< exponential of a
  log,        ///< natural logarithm of a; b = a, the denominator of its derivative
  atan,       ///< arc tangent of a; b is the node 1 + a*a, the denominator of its derivative
  sin,        ///< sine of a; the next node is always the cosine of the same a
  cos,        ///< cosine of a; the node before is always the sine of the same a
};

struct Node {
  Op op;
  int a = -1;
  int b = -1;
};

/// A recorded function of time t, states x (n values) and parameters p (k values) with m outputs.
class Program {
 public:
  int states() const { return states_; }
  int parameters() const { return parameters_; }
  int outputs() const { return static_cast<int>(outputs_.size()); }

  /// Nodes in an order in which every operand comes before its use.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// The node of each output.
  const std::vector<int>& outputNodes() const { return outputs_; }
  /// The enclosures of the constants that nodes refer to.
  const std::vector<Interval>& constants() const { return constants_; }
  /// True if the node's value depends neither on time nor on a state: it is evaluated once for given parameters.
  bool isInvariant(int node) const { return invariant_[detail::at(node)] != 0; }
  /// Number of nodes that are neither inputs nor constants nor invariant: the cost of one evaluation.
  int operations() const;

  /// Forward differentiation: the m outputs, followed by the m x n Jacobian with respect to the states, row by row, and
  /// (if asked) the m x k Jacobian with respect to the parameters, row by row. Structural zeros are the constant 0.
  Program differentiated(bool withParameters = false) const;

  /// A readable listing, one node a line.
  friend std::ostream& operator<<(std::ostream& out, const Program& program);

 private:
  friend class Recorder;
  int states_ = 0;
  int parameters_ = 0;
  std::vector<Node> nodes_;
  std::vector<Interval> constants_;
  std::vector<int> outputs_;
  std::vector<char> invariant_;
};

/// Builds a Program. Every function returns the number of a node that has the value asked for; equal requests give
/// equal numbers. Rewrites are exact on real numbers: x + 0, x * 1, -(-x), constants whose result is a double.
class Recorder {
 public:
  /// Nodes 0 … n-1 are the states, the next k the parameters, the next one is time.
  Recorder(int states, int parameters);
  /// Starts with the nodes of `program`, numbered as there.
  explicit Recorder(const Program& program);

  int state(int i) const { return i; }
  int parameter(int i) const { return states_ + i; }
  int time() const { return states_ + parameters_; }
  /// A double has one node; of any other enclosure every call makes a new one, since it may be another number.
  int constant(const Interval& value);

  int add(int a, int b);
  int sub(int a, int b);
  int neg(int a);
  int mul(int a, int b);
  int sqr(int a);
  int recip(int a);
  int sqrt(int a);
  int exp(int a);
  int log(int a);
  int atan(int a);
  int sin(int a);
  int cos(int a);

  /// Derivatives of the nodes `of` along the direction in which node `seeds[s].first` has derivative
  /// `seeds[s].second` (a node) and every other input has derivative 0.
  std::vector<int> derivatives(const std::vector<int>& of, const std::vector<std::pair<int, int>>& seeds);

  const Node& node(int i) const { return nodes_[detail::at(i)]; }
  int size() const { return static_cast<int>(nodes_.size()); }
  /// The value of a constant node.
  const Interval& value(int node) const { return constants_[detail::at(this->node(node).a)]; }
  bool isConstant(int node) const { return this->node(node).op == Op::constant; }

  /// The program with these output nodes; what they do not need is dropped.
  Program finish(const std::vector<int>& outputs) const;

  /// The recorder that `Recorded` numbers of this thread write to; null outside `record`.
  static Recorder*& current();

 private:
  int push(Op op, int a = -1, int b = -1);
  /// The constant `number` that is `op` of a and b: the same request gives the same node.
  int derived(Op op, int a, int b, const Interval& number);
  bool isExactly(int node, double value) const;

  int states_;
  int parameters_;
  std::vector<Node> nodes_;
  std::vector<Interval> constants_;
  std::map<std::tuple<Op, int, int>, int> known_;
  std::map<double, int> knownConstants_;  // doubles
};

}  // namespace gamut
