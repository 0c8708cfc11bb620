// Taylor coefficients in time of a Program's nodes, for any scalar with exact-enough arithmetic: intervals (enclosures
// of derivatives), high precision (references and arbitration). The flow has its own, faster kernels for polynomials.
#pragma once

#include <span>
#include <vector>

#include "scalars/algebra/linear_system.hpp"
#include "scalars/index.hpp"
#include "scalars/operations/all.hpp"
#include "scalars/program/program.hpp"
#include "scalars/traits.hpp"

namespace gamut {

/// Coefficients c[node][i] of (t - t0)^i. Recurrences: W. Tucker, Validated Numerics (2011), ch. 4.
template <class S>
class Series {
 public:
  /// Orders 0 … `order` are kept for the nodes. The program has to outlive the series.
  Series(const Program& program, int order)
      : program_(&program),
        size_(order + 1),
        c_(program.nodes().size() * detail::at(size_), S(0.0)),
        systems_(program.matrices().size()) {
    for (const Node& n : program.nodes()) stands_.push_back(static_cast<char>(stands(n)));
  }

  /// The constants and parameters; one value a parameter.
  void setParameters(std::span<const S> p) {
    for (std::size_t i = 0; i < program_->nodes().size(); ++i) {
      const Node& n = program_->nodes()[i];
      if (n.op == Op::parameter) at(static_cast<int>(i), 0) = p[n.a];
      if (n.op == Op::constant) at(static_cast<int>(i), 0) = constant<S>(program_->constants()[n.a]);
    }
  }

  /// Coefficient i of a node, 0 ≤ i ≤ order.
  S& at(int node, int i) { return c_[detail::at(node) * detail::at(size_) + detail::at(i)]; }

  /// The solution's coefficients from x(t0): the program is ẋ = f(t, x, p). Afterwards at(state, i), i ≤ order.
  void solve(const S& t0, std::span<const S> x) {
    setTime(t0);
    for (int s = 0; s < program_->states(); ++s) at(s, 0) = x[s];
    for (int i = 0; i + 1 < size_; ++i) {
      for (int node = 0; node < nodeCount(); ++node) compute(node, i);
      for (int s = 0; s < program_->states(); ++s)
        at(s, i + 1) = at(program_->outputNodes()[s], i) / S(static_cast<double>(i + 1));
    }
  }

  /// The outputs' coefficients when the states' coefficients (at(state, i)) have been set.
  void evaluate(const S& t0) {
    setTime(t0);
    for (int i = 0; i < size_; ++i)
      for (int node = 0; node < nodeCount(); ++node) compute(node, i);
  }

  // What the recursions of functions are made of (operations/function.hpp).

  /// Σ_{j=from}^{to} a_j b_{i-j}
  S convolution(int a, int b, int i, int from, int to) {
    S sum(0.0), term(0.0);
    for (int j = from; j <= to; ++j) sum += (term = at(a, j)) *= at(b, i - j);  // in place: numbers may be long
    return sum;
  }
  /// Σ_{j=1}^{to} j a_j b_{i-j} / i
  S slopes(int a, int b, int i, int to) {
    S sum(0.0), term(0.0);
    for (int j = 1; j <= to; ++j) {
      term = at(a, j);
      sum += (term *= j) *= at(b, i - j);
    }
    return sum /= i;
  }
  static S difference(const S& x, const S& y) { return x - y; }
  static S quotient(const S& x, const S& y) { return x / y; }
  static S half(const S& x) { return S(0.5) * x; }
  /// The sign of node a behind the expansion point, as far as its orders up to i tell.
  S after(int a, int i) {
    S sign = signOf(at(a, 0));
    if constexpr (requires {
                    { sign == S(0.0) } -> std::convertible_to<bool>;
                  })
      for (int j = 1; j <= i && sign == S(0.0); ++j) sign = signOf(at(a, j));
    return sign;
  }

 private:
  /// Whether a node depends on parameters alone: its orders from 1 on are zero.
  bool stands(const Node& n) const {
    switch (n.op) {
      case Op::parameter:
      case Op::constant:
        return true;
      case Op::state:
      case Op::time:
      case Op::solution:
        return false;
      case Op::add:
      case Op::sub:
      case Op::mul:
        return stands_[n.a] != 0 && stands_[n.b] != 0;
      default:
        return stands_[n.a] != 0;
    }
  }

  int nodeCount() const { return static_cast<int>(program_->nodes().size()); }

  void setTime(const S& t0) {
    const int time = program_->states() + program_->parameters();
    at(time, 0) = t0;
    if (size_ > 1) at(time, 1) = S(1.0);
    isFactorised_.assign(systems_.size(), 0);
  }

  void compute(int node, int i) {
    if (i > 0 && stands_[node] != 0) return;
    const Node& n = program_->nodes()[node];
    switch (n.op) {
      case Op::state:
      case Op::parameter:
      case Op::time:
      case Op::constant:
        break;
      case Op::add:
        at(node, i) = at(n.a, i) + at(n.b, i);
        break;
      case Op::sub:
        at(node, i) = at(n.a, i) - at(n.b, i);
        break;
      case Op::neg:
        at(node, i) = -at(n.a, i);
        break;
      case Op::mul:
        if (stands_[n.a] != 0)
          at(node, i) = at(n.a, 0) * at(n.b, i);
        else if (stands_[n.b] != 0)
          at(node, i) = at(n.a, i) * at(n.b, 0);
        else
          at(node, i) = convolution(n.a, n.b, i, 0, i);
        break;
      case Op::sqr: {
        S sum(0.0), term(0.0);
        for (int j = 0; 2 * j < i; ++j) sum += (term = at(n.a, j)) *= at(n.a, i - j);
        sum = sum + sum;
        if (i % 2 == 0) sum = sum + square(at(n.a, i / 2));
        at(node, i) = sum;
        break;
      }
      case Op::solution:
        if (n.b == 0) computeSolution(node, i);
        break;
      default:
        if (!isTwin(n.op)) withFunction(n.op, [&](auto f) { computeFunction(f, node, i); });
    }
  }

  template <class F>
  void computeFunction(F f, int x, int i) {
    const Node& n = program_->nodes()[x];
    if (i == 0)
      gamut::evaluate(f, at(n.a, 0), at(x, 0), at(hasTwin(n.op) ? x + 1 : x, 0));
    else if constexpr (requires { f.order(*this, x, n.a, n.b, i); })
      f.order(*this, x, n.a, n.b, i);
  }

  /// A_0 x_i = r_i - Σ_{j=1}^{i} A_j x_{i-j}: one factorisation for all orders.
  void computeSolution(int first, int i) {
    const LinearSolution& solution = program_->solutions()[program_->nodes()[first].a];
    const LinearMatrix& matrix = program_->matrices()[solution.matrix];
    LinearSystem<S>& system = systems_[solution.matrix];
    if (isFactorised_[solution.matrix] == 0) {
      system.assign(matrix.kind, matrix.size, [&](int k, int l) -> const S& { return at(matrix.entry(k, l), 0); });
      isFactorised_[solution.matrix] = 1;
    }
    std::vector<S> x;
    for (int k = 0; k < matrix.size; ++k) {
      S sum = at(solution.rightSide[k], i);
      for (int l = 0; l < matrix.size; ++l)
        sum = sum - convolution(solution.transposed ? matrix.entry(l, k) : matrix.entry(k, l), first + l, i, 1, i);
      x.push_back(sum);
    }
    system.solve(x, solution.transposed);
    for (int k = 0; k < matrix.size; ++k) at(first + k, i) = x[k];
  }

  const Program* program_;
  int size_;
  std::vector<S> c_;
  std::vector<LinearSystem<S>> systems_;  // of the program's matrices
  std::vector<char> isFactorised_, stands_;
};

}  // namespace gamut
