// A Program is a straight line of elementary operations: y = f(t, x, p), recorded once from generic code.
// It is the one form in which dynamics is kept: evaluators give it doubles, intervals, series or polynomials, passes
// (passes.hpp) make it shorter, differentiation (differentiation.hpp) gives another Program, and it is printed, saved
// and loaded as text (program_text.hpp). Constants that are not doubles (9.81, pi/4) keep their enclosure.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string_view>
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

/// How many operations Op has.
constexpr int opCount = static_cast<int>(Op::cos) + 1;

/// "add", "sub", ...
std::string_view nameOf(Op op);
/// True unless op is an input or a constant.
constexpr bool isOperation(Op op) {
  return op != Op::state && op != Op::parameter && op != Op::time && op != Op::constant;
}
/// The number of nodes from which op's value is computed: 0, 1 or 2 (the denominators of log and atan do not count).
constexpr int operandsOf(Op op) {
  return !isOperation(op) ? 0 : op == Op::add || op == Op::sub || op == Op::mul ? 2 : 1;
}

struct Node {
  Op op;
  int a = -1;
  int b = -1;
  bool operator==(const Node&) const = default;
};

/// A recorded function of time t, states x (n values) and parameters p (k values) with m outputs.
class Program {
 public:
  int states() const { return states_; }
  int parameters() const { return parameters_; }
  int outputs() const { return static_cast<int>(outputs_.size()); }

  /// Nodes in an order in which every operand comes before its use: the states, the parameters, time, then the rest.
  const std::vector<Node>& nodes() const { return nodes_; }
  /// The node of each output.
  const std::vector<int>& outputNodes() const { return outputs_; }
  /// The enclosures of the constants that nodes refer to, in the order of these nodes, each of which has its own.
  const std::vector<Interval>& constants() const { return constants_; }
  /// True if the node's value depends neither on time nor on a state: it is evaluated once for given parameters.
  bool isInvariant(int node) const { return invariant_[detail::at(node)] != 0; }
  /// Number of nodes that are neither inputs nor constants nor invariant: the cost of one evaluation.
  int operations() const;

  /// forwardDifferentiated(*this, withParameters) of differentiation.hpp: the m outputs, then the Jacobian.
  Program differentiated(bool withParameters = false) const;

  /// The readable form of print() in program_text.hpp.
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

/// The same nodes, constants and outputs, number by number.
bool isIdentical(const Program& a, const Program& b);

}  // namespace gamut
