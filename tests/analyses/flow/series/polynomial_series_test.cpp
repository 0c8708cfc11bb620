// Polynomial series of every operation, judged by their certificates.
#include "analyses/flow/series/polynomial_series.hpp"

#include <gtest/gtest.h>

#include "tests/analyses/flow/series/certificate.hpp"

namespace gamut::testing {
namespace {

class OfFunction : public ::testing::TestWithParam<std::string> {};

TEST_P(OfFunction, EveryNodeLiesWithinItsBounds) {
  Points points(7);
  for (int round = 0; round < 12; ++round) {
    const Setting s = randomSetting(points);
    const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
    const Program f = record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) {
      const Guarded first{x[0], nominal[0]}, second{x[1] + t, nominal[1]};
      dx[0] = 0.5 * apply(GetParam(), first, second).value + p[0];
      dx[1] = 0.25 * apply(GetParam(), second, {p[0], nominal[2]}).value - x[0];
    });
    expectCertified(f.differentiated(), s, points, nominal, 4);
    if (HasFatalFailure()) return;
  }
}

/// A motion with the function, of many symbols.
void expectManySymbolsCertified(const std::string& function, const Setting& s, Points& points, int places) {
  const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
  const Program f = record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) {
    const Guarded first{x[0], nominal[0]}, second{x[1] + t, nominal[1]};
    dx[0] = 0.5 * apply(function, first, second).value + p[0];
    dx[1] = x[0] * x[1] + 0.25 * apply(function, second, {p[0], nominal[2]}).value - x[0];
  });
  expectCertified(f.differentiated(), s, points, nominal, places);
}

TEST_P(OfFunction, ManySymbolsOfWhichLaterOrdersKeepFewerGradesAreBounded) {
  Points points(8);
  for (int round = 0; round < 2 && !HasFatalFailure(); ++round)
    expectManySymbolsCertified(GetParam(), settingOfMany(points), points, 3);
}

TEST_P(OfFunction, ManySymbolsAtOneTimeAreBounded) {
  Points points(9);
  for (int round = 0; round < 8 && !HasFatalFailure(); ++round)
    expectManySymbolsCertified(GetParam(), settingAtOneTime(points), points, 4);
}

INSTANTIATE_TEST_SUITE_P(PolynomialSeries, OfFunction, ::testing::ValuesIn(elementaryNames()),
                         [](const auto& name) { return name.param; });

/// Elementary functions of a state itself: no error of an operand hides what the function's own bound lacks.
const std::vector<std::pair<std::string, Recorded (*)(const Recorded&)>>& bareFunctions() {
  static const std::vector<std::pair<std::string, Recorded (*)(const Recorded&)>> functions = {
      {"square", [](const Recorded& x) { return sqr(x); }},
      {"reciprocal", [](const Recorded& x) { return 1.0 / x; }},
      {"squareRoot", [](const Recorded& x) { return sqrt(x); }},
      {"exponential", [](const Recorded& x) { return exp(x); }},
      {"logarithm", [](const Recorded& x) { return log(x); }},
      {"sine", [](const Recorded& x) { return sin(x); }},
      {"cosine", [](const Recorded& x) { return cos(x); }},
      {"arcTangent", [](const Recorded& x) { return atan(x); }},
      {"hyperbolicTangent", [](const Recorded& x) { return tanh(x); }},
      {"steepHyperbolicTangent", [](const Recorded& x) { return tanh(7.0 * (x - 1.4)); }},
      {"saturatedHyperbolicTangent", [](const Recorded& x) { return tanh(-9.0 * x); }}};
  return functions;
}

class OfBareFunction : public ::testing::TestWithParam<std::pair<std::string, Recorded (*)(const Recorded&)>> {};

TEST_P(OfBareFunction, EveryNodeLiesWithinItsBounds) {
  Points points(13);
  for (const Regime regime : {Regime::time, Regime::quantities, Regime::rounding, Regime::fine})
    for (int round = 0; round < 25; ++round) {
      const std::vector<double> nominal{points.uniform(0.8, 2), points.uniform(0.8, 2), points.uniform(0.8, 2)};
      // The function of a state, of a parameter, of time; then, with no more than the frame's degree, of each again.
      const Program program = record(2, 1, 6, [&](auto t, const auto& x, const auto& p, auto& y) {
        const auto function = GetParam().second;
        y[0] = function(x[0]);
        y[1] = x[0] * function(p[0]) + function(t);
        y[2] = function(x[1]);
        y[3] = -function(x[0]);
        y[4] = -x[1] * p[0];
        y[5] = x[0] - p[0] * function(x[1]);
      });
      expectCertified(program, settingOf(regime, points), points, nominal, 4);
      if (HasFatalFailure()) return;
    }
}

TEST_P(OfBareFunction, RoundingOfHighOrdersIsBounded) {
  Points points(14);
  Setting s;
  s.weights = {};
  s.degree = s.frameDegree = 0;
  s.order = 30;
  s.size = 0x1p-40;
  s.parameters = 0;
  for (int round = 0; round < 60; ++round) {
    const bool entire = GetParam().first.find("ine") != std::string::npos || GetParam().first == "exponential";
    s.theta = entire ? 0.5 : 0x1p-5;  // the series converge everywhere, or as far as the nearest singularity
    const double speed = points.uniform(3, 4);
    const Program program = record(2, 0, 6, [&](auto, const auto& x, const auto&, auto& y) {
      y[0] = speed;
      y[1] = GetParam().second(x[0]);
      y[2] = y[3] = y[4] = y[5] = 0.0;
    });
    expectCertified(program, s, points, {points.uniform(0.8, 2), 0.5}, 3);
    if (HasFatalFailure()) return;
  }
}

TEST_P(OfBareFunction, TruncationThatComesWithTimeIsBounded) {
  Points points(15);
  Setting s;
  s.weights = {1};
  s.order = 24;
  s.size = 0.5;
  s.theta = 0.125;
  s.thinStates = true;  // only the rate is uncertain
  for (int round = 0; round < 30; ++round) {
    s.degree = s.frameDegree = points.integer(1, 2);
    const Program program = record(2, 1, 6, [&](auto, const auto& x, const auto& p, auto& y) {
      y[0] = p[0];
      y[1] = GetParam().second(x[0]);
      y[2] = y[3] = y[4] = y[5] = 0.0;
    });
    expectCertified(program, s, points, {points.uniform(0.8, 2), 0.5, points.uniform(-0.5, 0.5)}, 4);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(PolynomialSeries, OfBareFunction, ::testing::ValuesIn(bareFunctions()),
                         [](const auto& function) { return function.param.first; });

TEST(PolynomialSeries, ArcTangentsAroundZeroLieWithinTheirBounds) {
  Points points(16);
  for (int round = 0; round < 30; ++round) {
    Setting s;
    s.weights = {1};
    s.degree = s.frameDegree = 1;  // 1 + u² is 1 to this degree
    s.order = 20;
    s.size = 0.1;
    s.theta = 0x1p-6;
    const Program program = record(2, 1, 6, [&](auto, const auto& x, const auto& p, auto& y) {
      y[0] = atan(x[0]);
      y[1] = atan(p[0]);
      y[2] = y[3] = y[4] = y[5] = 0.0;
    });
    expectCertified(program, s, points, {0, 0, 0}, 4);
    if (HasFatalFailure()) return;
  }
}

TEST(PolynomialSeries, UnderflowIsBounded) {
  Points points(18);
  Setting s;
  s.parameters = 0;
  s.order = 6;
  s.size = 1e-310;
  s.rounded = 0;
  for (int round = 0; round < 20; ++round) {
    const Program program = record(2, 0, 6, [&](auto, const auto& x, const auto&, auto& y) {
      y[0] = 0.3 * x[0];
      y[1] = x[0] * x[1];
      y[2] = sqr(x[1]);
      y[3] = y[4] = y[5] = 0.0;
    });
    expectCertified(program, s, points, {points.uniform(1e-310, 9e-310), points.uniform(1e-170, 9e-160)}, 3);
    if (HasFatalFailure()) return;
  }
}

TEST(PolynomialSeries, NodesOfTheFramesDegreeLieWithinTheirBoundsWhateverTheyStandFor) {
  Points points(19);
  for (int round = 0; round < 60; ++round) {
    Setting s = settingOf(static_cast<Regime>(round % 4), points);
    const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
    RandomExpressions expression(points, nominal);
    const Program program = record(2, 1, 6, [&](auto t, const auto& x, const auto& p, auto& y) {
      std::vector<Recorded> rates(2), frame(4);
      expression(t, x, p, rates, 3);
      expression(t, x, p, frame, 6);
      std::copy(rates.begin(), rates.end(), y.begin());
      std::copy(frame.begin(), frame.end(), y.begin() + 2);
    });
    expectCertified(program, s, points, nominal, 3);
    if (HasFatalFailure()) return;
  }
}

/// Random programs, each with a setting that `settingFor(points)` gives.
template <class SettingFor>
void expectRandomProgramsCertified(unsigned seed, int rounds, SettingFor settingFor) {
  Points points(seed);
  for (int round = 0; round < rounds; ++round) {
    const Setting s = settingFor(points);
    const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
    RandomExpressions expression(points, nominal);
    const Program f = record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) { expression(t, x, p, dx, 6); });
    expectCertified(f.differentiated(), s, points, nominal, 3);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(PolynomialSeries, RandomProgramsLieWithinTheirBounds) { expectRandomProgramsCertified(11, 60, randomSetting); }

TEST(PolynomialSeries, RandomProgramsInManySymbolsLieWithinTheirBounds) {
  expectRandomProgramsCertified(13, 12, settingOfMany);
}

TEST(PolynomialSeries, RandomProgramsInManySymbolsAndOrdersLieWithinTheirBounds) {
  expectRandomProgramsCertified(15, 4, [](Points& points) {
    Setting s = settingOfMany(points);
    s.order = points.integer(17, 31);
    s.theta = 0.25;
    return s;
  });
}

/// Of many monomials, in which no node is kept but those that others are computed from.
TEST(PolynomialSeries, WhatIsKeptOfNodesIsAllThatBoundsAreMadeOf) {
  Points points(16);
  for (int round = 0; round < 6; ++round) {
    const Setting s = settingOfMany(points);
    const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
    RandomExpressions expression(points, nominal);
    const Program f = record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) { expression(t, x, p, dx, 6); });
    const Program program = f.differentiated();
    const auto monomials = std::make_shared<const Monomials>(s.weights, s.degree);
    std::vector<double> polynomial(static_cast<std::size_t>(monomials->count()));
    for (double& c : polynomial) c = s.size * points.uniform(-1, 1) / 100;
    std::vector<double> bounds[2];
    for (const int isAllKept : {0, 1}) {
      PolynomialSeries series(program, s.states, monomials, s.frameDegree, s.order, true);
      if (isAllKept != 0) series.keepEveryNode();
      for (int i = 0; i < 3; ++i) {
        polynomial[0] = nominal[static_cast<std::size_t>(i)];
        i < 2 ? series.setState(i, polynomial.data()) : series.setParameter(0, polynomial.data(), 0);
      }
      for (int again = 0; again < 2; ++again) {  // over what the first computation left
        series.compute(0.5, 0.5);
        const bool isProved = series.tabulate(s.theta) && series.bound(nullptr, false);
        bounds[isAllKept].push_back(isProved ? 1 : 0);
        for (int node = 0; isProved && node < static_cast<int>(program.nodes().size()); ++node)
          for (const double bound : {series.norm(node), series.rho0(node), series.rho1(node)})
            bounds[isAllKept].push_back(bound);
      }
    }
    EXPECT_GT(bounds[0].size(), 2U);
    EXPECT_EQ(bounds[0], bounds[1]) << program;
  }
}

/// What drives v in late orders and high grades reaches x by x' = v alone.
TEST(PolynomialSeries, StatesThatAreSlopesOfStatesKeepAllThatTheseHave) {
  Points points(14);
  for (int round = 0; round < 20; ++round) {
    const Setting s = settingOfMany(points);
    const std::vector<double> nominal{points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1)};
    const int power = points.integer(1, 5);
    const Program f = record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) {
      auto force = p[0] + 0.5;
      for (int i = 1; i < power; ++i) force = force * p[0];
      dx[0] = x[1];
      dx[1] = force * sqr(t * t);
    });
    expectCertified(f.differentiated(), s, points, nominal, 6);
    if (HasFatalFailure()) return;
  }
}

/// What later orders leave out of high grades is all that is left out here: it is bounded, not overlooked.
TEST(PolynomialSeries, GradesThatLaterOrdersLeaveOutAreBoundedSharply) {
  const Program f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = sqr(x[0]); });
  const auto monomials = std::make_shared<const Monomials>(std::vector<int>(6, 1), 5);
  PolynomialSeries series(f.differentiated(), 1, monomials, 1, 10, true);
  std::vector<double> c(static_cast<std::size_t>(monomials->count()), 0.0);
  c[0] = c[1] = 0.5;  // 1/(1/x0 - σ), of which every order has every power of ξ0
  series.setState(0, c.data());
  std::vector<double> frame(static_cast<std::size_t>(series.frameCount()), 0.0);
  frame[0] = 1;
  series.setFrame(0, 0, frame.data(), 1);
  series.compute(0, 1);
  ASSERT_TRUE(series.tabulate(0.5) && series.bound(nullptr, false));
  const int node = series.outputNode(0);
  int left = 0;
  Precise x(0.0), kept(0.0);
  for (int m = 0; m < monomials->count(); ++m)
    for (int i = 0; i <= 10; ++i) {
      if (monomials->exponent(m, 0) < monomials->grade(m)) continue;  // at ξ = (1, 0, …)
      x += Precise(series.series(0)[m * series.stride() + i]) * pow(Precise(0.5), i);
      if (i == 10) continue;
      kept += Precise(series.series(node)[m * series.stride() + i]) * pow(Precise(0.5), i);
      left += series.series(node)[m * series.stride() + i] == 0 && monomials->grade(m) <= i + 2 ? 1 : 0;
    }
  EXPECT_GT(left, 0);
  const Precise error = x * x - kept, bound = Precise(series.rho0(node)) + series.rho1(node);
  EXPECT_LE(error, bound);
  EXPECT_LT(bound, error * (1 + 1e-6));
}

TEST(PolynomialSeries, RandomProgramsInDoubleDoubleLieWithinTheirBounds) {
  expectRandomProgramsCertified(12, 60, [](Points& points) { return settingOf(Regime::fine, points); });
}

// With all coefficients positive, at ξ = 1 and σ = θ, what a product drops is exactly what its bound adds up.
TEST(PolynomialSeries, DroppedTermsOfPositiveProductsAreBoundedSharply) {
  const Program f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = sqr(x[0]) * x[0]; });
  for (int order : {4, 8})
    for (int degree : {1, 3}) {
      const Program g = f.differentiated();
      const auto monomials = std::make_shared<const Monomials>(std::vector<int>{1}, degree);
      PolynomialSeries series(g, 1, monomials, degree, order, true);
      std::vector<double> c(static_cast<std::size_t>(monomials->count()), 0.25);
      series.setState(0, c.data());
      series.setFrame(0, 0, c.data(), 1);
      series.compute(0, 1);
      ASSERT_TRUE(series.tabulate(0.5) && series.bound(nullptr, false));
      const int node = series.outputNode(0);
      Precise x(0.0), kept(0.0);
      for (int m = 0; m < monomials->count(); ++m)
        for (int i = 0; i <= order; ++i) {
          x += Precise(series.series(0)[m * series.stride() + i]) * pow(Precise(0.5), i);
          if (i < order) kept += Precise(series.series(node)[m * series.stride() + i]) * pow(Precise(0.5), i);
        }
      const Precise error = x * x * x - kept, bound = Precise(series.rho0(node)) + series.rho1(node);
      EXPECT_LE(error, bound);
      EXPECT_LT(bound, error * (1 + 1e-6));
    }
}

/// tanh and its derivative for arguments from -400 to 400, however far they move: there is always a bound, and it
/// holds.
TEST(PolynomialSeries, TanhIsBoundedForEveryArgument) {
  Points points(29);
  for (double scale : {1.0, 10.0, 100.0, 400.0})
    for (int round = 0; round < 40; ++round) {
      const Program f = record(1, 0, [&](auto t, const auto& x, const auto&, auto& dx) {
        dx[0] = -tanh(scale * x[0]) + 0.5 * tanh(-scale * (x[0] + t));
      });
      Setting s = randomSetting(points);
      s.states = 1;
      s.parameters = 0;
      s.size = std::ldexp(1.0, -points.integer(0, 30));
      const double centre = points.integer(0, 2) == 0 ? points.uniform(-1, 1) / scale : points.uniform(-1, 1);
      expectCertified(f.differentiated(), s, points, {centre}, 6);
      if (HasFatalFailure()) return;
    }
}

/// What is uncertain at the start, beside which a step across a kink may be so long, is that of the step at hand.
TEST(PolynomialSeries, HasteIsThatOfTheStepAtHand) {
  const Program f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = abs(x[0] - 0.1); });
  const auto monomials = std::make_shared<const Monomials>(std::vector<int>{1}, 2);
  const auto hasteOf = [&](bool isUsed) {
    PolynomialSeries series(f.differentiated(), 1, monomials, 1, 6, true);
    const double x[] = {0.15, 0.01, 0}, frame[] = {1, 0}, wide = 0.02;
    series.setState(0, x);
    series.setFrame(0, 0, frame, 1);
    series.compute(0, 1);
    if (isUsed) {
      EXPECT_TRUE(series.tabulate(1) && series.bound(&wide, false));
      series.keepAtStart();
    }
    EXPECT_TRUE(series.tabulate(1) && series.bound(nullptr, false));
    return series.haste();
  };
  EXPECT_GT(hasteOf(false), 1);
  EXPECT_EQ(hasteOf(true), hasteOf(false));
}

TEST(PolynomialSeries, ADivisorThatMayVanishIsNotProved) {
  const Program f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = 1.0 / x[0]; });
  const auto monomials = std::make_shared<const Monomials>(std::vector<int>{1}, 4);
  PolynomialSeries series(f.differentiated(), 1, monomials, 1, 6, true);
  const std::vector<double> through{0.5, 0.6, 0, 0, 0}, frame{1.0, 0.0};
  series.setState(0, through.data());
  series.setFrame(0, 0, frame.data(), 1);
  series.compute(0, 1);
  EXPECT_FALSE(series.tabulate(0x1p-20) && series.bound(nullptr, false));
}

TEST(PolynomialSeries, SquareRootsAndLogarithmsOfWhatMayBeNegativeAreNotProved) {
  for (const bool root : {true, false}) {
    const Program f =
        record(1, 0, [&](auto, const auto& x, const auto&, auto& dx) { dx[0] = root ? sqrt(x[0]) : log(x[0]); });
    const auto monomials = std::make_shared<const Monomials>(std::vector<int>{1}, 4);
    PolynomialSeries series(f.differentiated(), 1, monomials, 1, 6, true);
    const std::vector<double> through{0.5, 0.6, 0, 0, 0}, frame{1.0, 0.0};
    series.setState(0, through.data());
    series.setFrame(0, 0, frame.data(), 1);
    series.compute(0, 1);
    EXPECT_FALSE(series.tabulate(0x1p-20) && series.bound(nullptr, false));
  }
}

}  // namespace
}  // namespace gamut::testing
