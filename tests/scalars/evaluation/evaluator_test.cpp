// Evaluators give a program's values in any scalar, and compute what depends on parameters alone only once.
#include "scalars/evaluation/evaluator.hpp"

#include <gtest/gtest.h>

#include "tests/scalars/high_precision.hpp"

namespace gamut::testing {
namespace {

Program pendulum() {
  return record(2, 2, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -9.81 / p[0] * sin(x[0]) + p[1] * cos(2.0 * t) - 0.1 * x[1];
  });
}

TEST(Evaluator, GivesTheSameDoublesAsTheCode) {
  const Program program = pendulum();
  Evaluator<double> evaluator(program);
  for (double length : {0.5, 2.0}) {
    evaluator.setParameters(std::vector<double>{length, 0.3});
    for (double angle : {-1.0, 0.0, 2.5}) {
      const std::vector<double> y = evaluator(0.7, {angle, 0.4});
      EXPECT_EQ(y[0], 0.4);
      EXPECT_NEAR(y[1], -9.81 / length * std::sin(angle) + 0.3 * std::cos(1.4) - 0.04, 1e-14);
    }
  }
}

/// A double that counts how often it is operated on.
struct Counted {
  double value;
  static int& operations() {
    static int count = 0;
    return count;
  }
  Counted(double v) : value(v) {}  // NOLINT(google-explicit-*): implicit, as scalars are
  friend Counted operator+(Counted a, Counted b) { return ++operations(), a.value + b.value; }
  friend Counted operator-(Counted a, Counted b) { return ++operations(), a.value - b.value; }
  friend Counted operator*(Counted a, Counted b) { return ++operations(), a.value * b.value; }
  friend Counted operator/(Counted a, Counted b) { return ++operations(), a.value / b.value; }
  friend Counted operator-(Counted a) { return ++operations(), -a.value; }
  friend bool operator<(Counted a, Counted b) { return a.value < b.value; }
  friend Counted abs(Counted a) { return std::abs(a.value); }
  friend Counted sin(Counted a) { return ++operations(), std::sin(a.value); }
  friend Counted cos(Counted a) { return ++operations(), std::cos(a.value); }
  friend Counted exp(Counted a) { return ++operations(), std::exp(a.value); }
  friend Counted log(Counted a) { return ++operations(), std::log(a.value); }
  friend Counted sqrt(Counted a) { return ++operations(), std::sqrt(a.value); }
  friend Counted atan(Counted a) { return ++operations(), std::atan(a.value); }
  friend Counted tanh(Counted a) { return ++operations(), std::tanh(a.value); }
};

}  // namespace
}  // namespace gamut::testing

namespace gamut {
template <>
struct ScalarTraits<testing::Counted> {
  static testing::Counted constant(const Interval& enclosure) { return midpoint(enclosure); }
};
}  // namespace gamut

namespace gamut::testing {
namespace {

TEST(Evaluator, ComputesWhatDependsOnParametersAloneOnce) {
  const Program program = record(
      1, 2, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = sqrt(exp(p[0]) * sin(p[1]) + 3.0) * x[0]; });
  EXPECT_EQ(program.operations(), 1);
  Evaluator<Counted> evaluator(program);
  evaluator.setParameters(std::vector<Counted>{0.5, 0.25});
  Counted::operations() = 0;
  const std::vector<Counted> y = evaluator(0.0, {2.0});
  EXPECT_EQ(Counted::operations(), 1);
  EXPECT_DOUBLE_EQ(y[0].value, 2 * std::sqrt(std::exp(0.5) * std::sin(0.25) + 3));
}

TEST(Evaluator, OfAProgramWithoutParametersNeedsNone) {
  const Program program = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = 3.0 * x[0] + 1.0; });
  EXPECT_EQ(Evaluator<double>(program)(0.0, {2.0})[0], 7);
}

}  // namespace
}  // namespace gamut::testing
