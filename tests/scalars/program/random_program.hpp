// Random programs as nobody would write them: every operation on every kind of node, full of what passes look for, yet
// defined at one point, where they are judged with 110 digits.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "scalars/algebra/linear_system.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/program/program.hpp"
#include "scalars/program/recorder.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut::testing {

using Precise = Digits<110>;

/// Where random programs are defined, and their sizes.
struct Point {
  double t = 0.3;
  std::vector<double> x{0.7, -0.4, 1.9}, p{1.3, 0.2};

  template <class S>
  std::vector<S> values(const Program& program) const {
    return evaluate<S>(program, std::vector<S>(x.begin(), x.end()), std::vector<S>(p.begin(), p.end()), S(t));
  }
};

class RandomProgram {
 public:
  explicit RandomProgram(unsigned seed) : engine_(seed), recorder_(3, 2, RuleSet::none()) {
    value_ = point_.x;
    value_.insert(value_.end(), point_.p.begin(), point_.p.end());
    value_.push_back(point_.t);
  }

  /// Solutions of linear systems are among the operations too.
  RandomProgram withSolutions() && {
    withSolutions_ = true;
    return std::move(*this);
  }

  /// Products of the same factors are subtracted from each other, or added.
  RandomProgram withProducts() && {
    withProducts_ = true;
    return std::move(*this);
  }

  /// The last nodes of so many operations as outputs, or all nodes.
  Program operator()(int operations, int outputs) {
    for (const Interval& c : {Interval(0.0), Interval(1.0), Interval(-1.0), Interval(2.0), Interval(-0.25),
                              Interval(3.0), Interval("0.1"), Interval("0.1"), pi()})
      keep(recorder_.constant(c), midpoint(c));
    for (int i = 0; i < operations; ++i) step();
    std::vector<int> nodes;
    for (int i = outputs; i > 0; --i) nodes.push_back(recorder_.size() - i);
    return recorder_.program(nodes);
  }

 private:
  int pick() {
    const int size = recorder_.size();
    // Every other operand is recent, so that patterns of two operations arise.
    const int reach = engine_() % 2 == 0 ? size : std::min(size, 4);
    return size - 1 - static_cast<int>(engine_() % static_cast<unsigned>(reach));
  }

  void keep(int node, double value) {
    value_.resize(static_cast<std::size_t>(recorder_.size()));
    value_[static_cast<std::size_t>(node)] = value;
  }

  void step() {
    const int a = pick(), b = engine_() % 4 == 0 ? a : pick();
    const double u = value_[static_cast<std::size_t>(a)], v = value_[static_cast<std::size_t>(b)];
    if (withSolutions_ && engine_() % 8 == 0) return keepSolutions();
    switch (engine_() % 16) {
      case 0:
        return keepIfModerate(u + v, [&] { return recorder_.add(a, b); });
      case 1:
        return keepIfModerate(u - v, [&] { return recorder_.sub(a, b); });
      case 2:
        return keepIfModerate(-u, [&] { return recorder_.neg(a); });
      case 3:
        if (withProducts_ && engine_() % 2 == 0) return keepProducts(a, b, pick());
        return keepIfModerate(-u, [&] { return recorder_.neg(a); });
      case 4:
      case 5:
      case 6:
        return keepIfModerate(u * v, [&] { return recorder_.mul(a, b); });
      case 7:
        return keepIfModerate(u * u, [&] { return recorder_.sqr(a); });
      case 8:
        return keepIfModerate(std::abs(u) > 0.05 ? 1 / u : NAN, [&] { return recorder_.emit(Op::recip, a); });
      case 9:
        return keepIfModerate(u > 0.05 ? std::sqrt(u) : NAN, [&] { return recorder_.emit(Op::sqrt, a); });
      case 10:
        return keepIfModerate(u < 3 ? std::exp(u) : NAN, [&] { return recorder_.exp(a); });
      case 11:
        return keepIfModerate(u > 0.05 ? std::log(u) : NAN, [&] { return recorder_.emit(Op::log, a, a); });
      case 12: {
        if (b % 2 == 1) {
          const auto [tangent, slope] = recorder_.pair(Op::tanh, a);
          keep(tangent, std::tanh(u));
          return keep(slope, 1 - std::tanh(u) * std::tanh(u));
        }
        const int square = recorder_.sqr(a);
        keep(square, u * u);
        const int one = recorder_.constant(1.0);
        keep(one, 1);
        const int sum = recorder_.add(one, square);
        keep(sum, 1 + u * u);
        return keep(recorder_.emit(Op::atan, a, sum), std::atan(u));
      }
      case 14:
        if (std::abs(u) < 0.05) return;
        return b % 2 == 1 ? keep(recorder_.abs(a), std::abs(u)) : keep(recorder_.sign(a), u > 0 ? 1 : -1);
      case 13: {  // a quotient, multiplied back
        if (std::abs(u) < 0.05 || std::abs(v / u) > 50) return;
        const int inverse = recorder_.emit(Op::recip, a);
        keep(inverse, 1 / u);
        const int quotient = recorder_.mul(b, inverse);
        keep(quotient, v / u);
        return keep(recorder_.mul(quotient, a), v);
      }
      default: {
        const int sine = recorder_.sin(a);
        keep(sine, std::sin(u));
        return keep(sine + 1, std::cos(u));
      }
    }
  }

  /// The same factors in two orders, with the same sign or not, and what they leave.
  void keepProducts(int a, int b, int c) {
    const double u = value_[static_cast<std::size_t>(a)], v = value_[static_cast<std::size_t>(b)],
                 w = value_[static_cast<std::size_t>(c)];
    if (std::abs(u * v * w) > 50 || std::abs(v * w) > 50 || std::abs(u * w) > 50) return;
    const auto product = [&](int x, int y, double value) {
      const int node = recorder_.mul(x, y);
      keep(node, value);
      return node;
    };
    const int first = product(a, product(b, c, v * w), u * v * w);
    const bool isNegative = engine_() % 2 == 0;
    int factor = b;
    if (isNegative) {
      factor = recorder_.neg(b);
      keep(factor, -v);
    }
    const double value = isNegative ? -(u * v * w) : u * v * w;
    const int second = product(product(c, a, u * w), factor, value);
    if (isNegative)
      keep(recorder_.add(first, second), 0);
    else
      keep(recorder_.sub(first, second), 0);
  }

  template <class Operation>
  void keepIfModerate(double value, Operation operation) {
    if (std::abs(value) <= 50) keep(operation(), value);
  }

  /// One or two solutions of a matrix of either kind, one or two equations included, unless it is near a singular one.
  void keepSolutions() {
    const int n = 1 + static_cast<int>(engine_() % 4);
    LinearMatrix matrix{engine_() % 2 == 0 ? MatrixKind::general : MatrixKind::positiveDefinite, n, {}};
    matrix.entries.assign(static_cast<std::size_t>(n * n), -1);
    const auto entry = [&](int i, int j) -> int& { return matrix.entries[static_cast<std::size_t>(i * n + j)]; };
    std::vector<double> sums(static_cast<std::size_t>(n), 1.0);  // of magnitudes beside the diagonal
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        entry(i, j) = matrix.kind == MatrixKind::positiveDefinite && j < i ? entry(j, i) : pick();
        if (i != j) sums[static_cast<std::size_t>(i)] += std::abs(value_[static_cast<std::size_t>(entry(i, j))]);
      }
    for (int i = 0; i < n && matrix.kind == MatrixKind::positiveDefinite; ++i) {  // dominant: constant + square
      const int root = pick();
      const double u = value_[static_cast<std::size_t>(root)];
      const int square = recorder_.sqr(root);
      keep(square, u * u);
      const int constant = recorder_.constant(sums[static_cast<std::size_t>(i)]);
      keep(constant, sums[static_cast<std::size_t>(i)]);
      entry(i, i) = recorder_.add(constant, square);
      keep(entry(i, i), sums[static_cast<std::size_t>(i)] + u * u);
    }
    const LinearSystem<double> system(matrix.kind, n, valuesOf(matrix.entries));
    double size = 0, inverse = 0;
    for (double value : valuesOf(matrix.entries)) size = std::max(size, std::abs(value));
    for (int i = 0; i < n; ++i) {
      std::vector<double> column(static_cast<std::size_t>(n), 0.0);
      column[static_cast<std::size_t>(i)] = 1;
      system.solve(column);
      for (double value : column) inverse = std::isnan(value) ? HUGE_VAL : std::max(inverse, std::abs(value));
    }
    if (!(size * inverse < 1e4)) return;
    const int number = recorder_.matrix(matrix);
    for (int solutions = 1 + static_cast<int>(engine_() % 2); solutions > 0; --solutions) {
      std::vector<int> rightSide;
      for (int i = 0; i < n; ++i) rightSide.push_back(pick());
      const bool transposed = engine_() % 2 == 0;
      std::vector<double> x = valuesOf(rightSide);
      system.solve(x, transposed);
      if (std::any_of(x.begin(), x.end(), [](double value) { return !(std::abs(value) <= 50); })) continue;
      const std::vector<int> components = recorder_.solve(number, transposed, rightSide);
      for (std::size_t i = 0; i < x.size(); ++i) keep(components[i], x[i]);
    }
  }

  std::vector<double> valuesOf(const std::vector<int>& nodes) const {
    std::vector<double> values;
    for (int node : nodes) values.push_back(value_[static_cast<std::size_t>(node)]);
    return values;
  }

  bool withSolutions_ = false, withProducts_ = false;
  std::mt19937_64 engine_;
  Point point_;
  Recorder recorder_;
  std::vector<double> value_;
};

/// Two values that differ by no more than what 110 digits lose.
MATCHER_P(AgreesTo45Digits, value, "agrees to 45 digits with " + value.str(50)) {
  return abs(arg - value) <= (1 + abs(value)) * Precise("1e-45");
}

/// Holds the value; a bound may be exact, the value of 110 digits is not.
MATCHER_P(Holds, value, "holds " + value.str(50)) {
  const Precise slack = (1 + abs(value)) * Precise("1e-90");
  return Precise(arg.lower()) - slack <= value && value <= Precise(arg.upper()) + slack;
}

/// Both programs have the same values at the point, and both, over intervals, hold them.
inline void expectSameMeaning(const Program& before, const Program& after, const std::string& what) {
  ASSERT_EQ(after.states(), before.states()) << what;
  ASSERT_EQ(after.parameters(), before.parameters()) << what;
  ASSERT_EQ(after.outputs(), before.outputs()) << what;
  const Point point;
  const auto truth = point.values<Precise>(before), values = point.values<Precise>(after);
  const auto ranges = point.values<Interval>(after), rangesBefore = point.values<Interval>(before);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    ASSERT_TRUE(isfinite(truth[i])) << what << ", output " << i;
    ASSERT_THAT(values[i], AgreesTo45Digits(truth[i])) << what << ", output " << i;
    ASSERT_THAT(ranges[i], Holds(truth[i])) << what << ", output " << i;
    ASSERT_THAT(rangesBefore[i], Holds(truth[i])) << what << ", output " << i;
  }
}

}  // namespace gamut::testing
