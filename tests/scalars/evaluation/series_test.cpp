// Taylor series of programs: their sums are the functions, their solutions the solutions.
#include "scalars/evaluation/series.hpp"

#include <gtest/gtest.h>

#include "scalars/evaluation/evaluator.hpp"
#include "tests/scalars/high_precision.hpp"
#include "tests/scalars/program/random_program.hpp"

namespace gamut::testing::series_test {
namespace {

using Numbers = std::vector<HighPrecision>;

/// Σ c_i τ^i of one node.
HighPrecision sum(Series<HighPrecision>& series, int node, int order, const HighPrecision& tau) {
  HighPrecision s(0);
  for (int i = order; i >= 0; --i) s = s * tau + series.at(node, i);
  return s;
}

TEST(Series, OfRandomExpressionsSumToTheirValues) {
  constexpr int order = 12;
  const HighPrecision t0(0.25), tau(1e-4);
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const RandomExpression expression(seed, 8);
    const Program program = expression.recorded(2, 1, 4);
    Series<HighPrecision> series(program, order);
    const Numbers p = highPrecision({0.8});
    series.setParameters(p);
    const Numbers x0 = highPrecision({0.5, -0.3}), x1 = highPrecision({0.7, 1.1}), x2 = highPrecision({-0.2, 0.4});
    for (int s = 0; s < 2; ++s) {
      const auto i = static_cast<std::size_t>(s);
      series.at(s, 0) = x0[i], series.at(s, 1) = x1[i], series.at(s, 2) = x2[i];
    }
    series.evaluate(t0);
    const Numbers moved{x0[0] + tau * (x1[0] + tau * x2[0]), x0[1] + tau * (x1[1] + tau * x2[1])};
    const Numbers truth = expression(HighPrecision(t0 + tau), moved, p, 4);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const HighPrecision value = sum(series, program.outputNodes()[i], order, tau);
      ASSERT_LE(HighPrecision(abs(value - truth[i])), (1 + abs(truth[i])) * HighPrecision(1e-36)) << "seed " << seed;
    }
  }
}

TEST(Series, OfProgramsWithSolutionsSumToTheirValues) {
  constexpr int order = 12;
  const Precise tau(1e-6);
  const Point point;
  const std::vector<Precise> x1{0.7, 1.1, -0.6}, p(point.p.begin(), point.p.end());
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Program program = RandomProgram(seed).withSolutions()(30, 6);
    Series<Precise> series(program, order);
    series.setParameters(p);
    for (int repeated = 0; repeated < 2; ++repeated) {  // at another point first: factors are of this one
      std::vector<Precise> moved;
      for (int s = 0; s < 3; ++s) {
        const auto i = static_cast<std::size_t>(s);
        series.at(s, 0) = point.x[i] + (1 - repeated) * 1e-3, series.at(s, 1) = x1[i];
        moved.push_back(point.x[i] + tau * x1[i]);
      }
      series.evaluate(Precise(point.t));
      if (repeated == 0) continue;
      const auto truth = gamut::evaluate<Precise>(program, moved, p, Precise(point.t + tau));
      for (std::size_t i = 0; i < truth.size(); ++i) {
        Precise value(0);
        for (int k = order; k >= 0; --k) value = value * tau + series.at(program.outputNodes()[i], k);
        ASSERT_LE(Precise(abs(value - truth[i])), (1 + abs(truth[i])) * Precise("1e-40")) << "seed " << seed;
      }
    }
  }
}

TEST(Series, SolvesLinearEquationsExactly) {
  const Program rotation = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = p[0] * x[1];
    dx[1] = -p[0] * x[0];
  });
  constexpr int order = 30;
  Series<HighPrecision> series(rotation, order);
  series.setParameters(highPrecision({2.0}));
  series.solve(HighPrecision(0), highPrecision({1.0, 0.0}));
  const HighPrecision tau(0.25);
  EXPECT_LE(HighPrecision(abs(sum(series, 0, order, tau) - cos(2 * tau))), HighPrecision(1e-40));
  EXPECT_LE(HighPrecision(abs(sum(series, 1, order, tau) + sin(2 * tau))), HighPrecision(1e-40));
}

TEST(Series, SolvesEquationsThatDependOnTime) {
  // x' = 3 t², from t0 = 2: x = x0 + t³ - 8.
  const Program ramp = record(1, 0, [](auto t, const auto&, const auto&, auto& dx) { dx[0] = 3.0 * sqr(t); });
  Series<HighPrecision> series(ramp, 5);
  series.setParameters({});
  series.solve(HighPrecision(2), highPrecision({1.0}));
  EXPECT_EQ(series.at(0, 0), 1);
  EXPECT_EQ(series.at(0, 1), 12);
  EXPECT_EQ(series.at(0, 2), 6);
  EXPECT_EQ(series.at(0, 3), 1);
  EXPECT_EQ(series.at(0, 4), 0);
}

TEST(Series, OfIntervalsHoldTheCoefficientsOfEveryPoint) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const Program program = RandomExpression(seed, 7).recorded(2, 1, 2);
    constexpr int order = 4;
    Series<Interval> ranges(program, order);
    ranges.setParameters(std::vector<Interval>{Interval(0.75, 1)});
    ranges.solve(Interval(0, 0.25), std::vector<Interval>{Interval(0.5, 0.75), Interval(-0.25, 0)});
    Series<HighPrecision> series(program, order);
    for (double part : {0.0, 0.25, 1.0}) {
      series.setParameters(highPrecision({0.75 + 0.25 * part}));
      series.solve(HighPrecision(0.25 * part), highPrecision({0.5 + 0.25 * part, -0.25 + 0.25 * part}));
      for (int s = 0; s < 2; ++s)
        for (int i = 0; i <= order; ++i)
          ASSERT_THAT(ranges.at(s, i), EnclosesToItsDigits(series.at(s, i))) << "seed " << seed << ", order " << i;
    }
  }
}

}  // namespace
}  // namespace gamut::testing::series_test
