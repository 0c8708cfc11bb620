// The first orders of a recursion without symbols in double-double arithmetic. Rounding of order i weighs θ^i: where
// the first orders have no rounding, the others' is as small as what a step leaves out. docs/flow.md, section 2.
#pragma once

#include <utility>
#include <vector>

#include "analyses/flow/series/linear_factors.hpp"
#include "scalars/elementary/double_double.hpp"
#include "scalars/index.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

class FineRecursion {
 public:
  using Number = detail::DoubleDouble;

  /// A node as PolynomialSeries plans it: operands a, b; of a solution, its number and the component.
  struct Node {
    Op op;
    int a, b;
    bool invariant;
  };
  /// Numbers of the nodes of matrix and right-hand side. `factors` are the series' own, of the matrix' leading
  /// coefficients; one solution of a matrix factorises it, at order 0.
  struct Solution {
    LinearFactors* factors;
    bool factorises;
    std::vector<int> matrix, rightSide;
    std::vector<double> residual;  // |b - A x|, [order][component]
  };

  /// Whether every operation has a form in double-double.
  static bool isPossible(const std::vector<gamut::Node>& nodes);

  /// `computed`: numbers of the operations to compute, in order. `states` pairs a state with the node of its
  /// derivative.
  void plan(int orders, std::vector<Node> nodes, std::vector<int> computed, std::vector<Solution> solutions,
            std::vector<std::pair<int, int>> states, int time);
  /// 0: none is planned.
  int orders() const { return orders_; }
  /// A node that is not computed: states, parameters, constants.
  void set(int node, const Number& value) { values_[first(node)] = value; }
  void compute(double t0, double h0);

  const std::vector<int>& computed() const { return computed_; }
  const Number& value(int node, int order) const { return values_[first(node) + detail::at(order)]; }
  double residual(int solution, int component, int order) const;
  /// Of a sine, say, at the expansion point.
  double pointError(int node) const { return pointError_[node]; }

 private:
  template <bool fused>
  struct Orders;
  template <bool fused>
  void run(double t0, double h0);
  void runFused(double t0, double h0);
  template <bool fused>
  void computeOrder(int node, int i);
  template <bool fused>
  void solve(int node, int i);
  std::size_t first(int node) const { return detail::at(node * orders_); }

  int orders_ = 0, time_ = 0;
  std::vector<Node> nodes_;
  std::vector<int> computed_;
  std::vector<Solution> solutions_;
  std::vector<std::pair<int, int>> states_;
  std::vector<Number> values_, rightSide_;
  std::vector<double> pointError_, correction_, unused_;
};

}  // namespace gamut
