// Distribution functions of quantities that depend on each other, or of which more than one distribution is possible.
#include "analyses/probability/joint_masses.hpp"

#include <gmock/gmock.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analyses/probability/dependent_sum.hpp"
#include "analyses/probability/output_distribution.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "tests/analyses/probability/images.hpp"

namespace gamut::testing {
namespace {

DistributionBounds jointBoundsOf(const Function& function, const QuantityDependence& dependence = {}) {
  const JointMasses masses(function.surrogate.symbols, function.surrogate.quantities, function.uncertain(), dependence);
  return boundDistribution(function.surrogate.at.back(), 0, masses);
}

/// Nowhere do the bounds leave what is true of one of the distributions.
template <class Truth>
void expectJointHolds(const DistributionBounds& bounds, const Truth& truth) {
  ASSERT_GE(bounds.value.size(), 2U);
  for (std::size_t i = 0; i < bounds.value.size(); ++i) {
    EXPECT_LE(bounds.lower[i], truth(bounds.value[i])) << bounds.value[i];
    EXPECT_GE(bounds.upper[i], truth(bounds.value[i])) << bounds.value[i];
  }
}

/// Nor do they leave the least and the greatest of them by more than so much, but for steps of values.
template <class Least, class Most>
void expectWithin(const DistributionBounds& bounds, const Least& least, const Most& most, double gap) {
  for (std::size_t i = 0; i + 1 < bounds.value.size(); ++i) {
    EXPECT_GE(bounds.lower[i + 1], least(bounds.value[i]) - gap) << bounds.value[i];
    EXPECT_LE(bounds.upper[i], most(bounds.value[i + 1]) + gap) << bounds.value[i];
  }
}

const auto sumOfAll = [](const auto& x, auto& y) {
  y[0] = 0.0 * x[0];
  for (const auto& value : x) y[0] += value;
};

QuantityDependence unknown(std::vector<std::size_t> group) {
  QuantityDependence dependence;
  dependence.unknown = {std::move(group)};
  return dependence;
}

QuantityDependence correlated(double rank) {
  QuantityDependence dependence;
  dependence.copulas.emplace_back(std::vector<std::size_t>{0, 1},
                                  std::vector<std::vector<Interval>>{{1.0, rank}, {rank, 1.0}});
  return dependence;
}

double clamped(double p) { return std::clamp(p, 0.0, 1.0); }

/// Of two uniform ones the bounds are z and z - 1 (M. J. Frank, R. B. Nelsen, B. Schweizer, Probability Theory and
/// Related Fields 74, 1987): attained, so that no others would be better.
TEST(JointMasses, BoundSumsOfUnknownDependence) {
  const Function sum({uniform(0, 1), uniform(0, 1)}, sumOfAll);
  const DistributionBounds bounds = jointBoundsOf(sum, unknown({0, 1}));
  const auto least = [](double z) { return clamped(z - 1); };
  const auto most = [](double z) { return clamped(z); };
  expectJointHolds(bounds, least);
  expectJointHolds(bounds, most);
  expectWithin(bounds, least, most, 0.003);
  // Against each other their sum is but 1, together it is that of one twice.
  expectJointHolds(bounds, [](double z) { return z >= 1 ? 1.0 : 0.0; });
  expectJointHolds(bounds, [](double z) { return clamped(z / 2); });
}

TEST(JointMasses, BoundSumsOfSeveralOfUnknownDependence) {
  const Function sum({uniform(0, 1), uniform(0, 2), uniform(-1, 0), uniform(0, 1)}, sumOfAll);
  QuantityDependence dependence = unknown({0, 1, 2});
  const DistributionBounds bounds = jointBoundsOf(sum, dependence);
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> unit(0, 1);
  // Each of these is one of the possible joint distributions; the last quantity is independent.
  for (int kind = 0; kind < 8; ++kind) {
    std::vector<double> samples;
    for (int i = 0; i < 40000; ++i) {
      const double u = unit(engine), v = unit(engine), w = unit(engine);
      const double a = u, b = (kind & 1) != 0 ? 1 - u : u, c = (kind & 2) != 0 ? 1 - u : (kind & 4) != 0 ? v : u;
      samples.push_back(a + 2 * b + (c - 1) + w);
    }
    expectHoldsSamples(bounds, std::move(samples), kind);
  }
}

TEST(JointMasses, BoundSumsOfEvidence) {
  // Of A: [0,2] 1/4, [1,3] 1/2, [2,4] 1/4; of B: [10,11] 1/2, [11,13] 1/2.
  const auto evidence = [](std::vector<FocalInterval> focal) { return uncertain(Distribution::evidence(focal)); };
  const Function sum(
      {evidence({{{0, 2}, 0.25}, {{1, 3}, 0.5}, {{2, 4}, 0.25}}), evidence({{{10, 11}, 0.5}, {{11, 13}, 0.5}})},
      sumOfAll);
  const DistributionBounds bounds = jointBoundsOf(sum);
  const double lowerEnds[6] = {10, 11, 12, 11, 12, 13}, upperEnds[6] = {13, 14, 15, 15, 16, 17};
  const double masses[6] = {0.125, 0.25, 0.125, 0.125, 0.25, 0.125};
  const auto sumOf = [&](const double* ends, double z) {
    double p = 0;
    for (int i = 0; i < 6; ++i) p += ends[i] <= z ? masses[i] : 0;
    return p;
  };
  const auto least = [&](double z) { return sumOf(upperEnds, z); };
  const auto most = [&](double z) { return sumOf(lowerEnds, z); };
  expectJointHolds(bounds, least);
  expectJointHolds(bounds, most);
  constexpr double step = 0.02;
  expectWithin(
      bounds, [&](double z) { return least(z - step); }, [&](double z) { return most(z + step); }, 1e-9);
}

/// A fold: what is possible of a square is told by intervals, not by bounds of the distribution function alone.
TEST(JointMasses, KeepIntervalsOfEvidence) {
  const Function square({uncertain(Distribution::evidence({{{-1, 1}, 0.5}, {{0.5, 0.6}, 0.5}}))},
                        [](const auto& x, auto& y) { y[0] = sqr(x[0]); });
  const DistributionBounds bounds = jointBoundsOf(square);
  const auto least = [](double z) { return (z >= 1 ? 0.5 : 0) + (z >= 0.36 ? 0.5 : 0); };
  const auto most = [](double z) { return (z >= 0 ? 0.5 : 0) + (z >= 0.25 ? 0.5 : 0); };
  expectJointHolds(bounds, least);
  expectJointHolds(bounds, most);
  expectWithin(
      bounds, [&](double z) { return least(z - 0.01); }, [&](double z) { return most(z + 0.01); }, 1e-9);
}

/// A value of its own probability, on an edge between bins as far as numbers tell.
TEST(JointMasses, KnowValuesOfTheirOwnAtEdges) {
  for (const double lower : {0.1, 1.0, 5.3}) {
    const double span = 0.37, alone = lower + span / 8, upper = lower + span;
    const Function twice({uncertain(Distribution::histogram({lower, alone, alone, upper}, {0.3, 0.4, 0.3}))},
                         [](const auto& x, auto& y) { y[0] = 2.0 * x[0]; });
    const DistributionBounds bounds = jointBoundsOf(twice);
    expectJointHolds(bounds, [&](double v) {
      const double q = v / 2;
      return q < lower   ? 0
             : q < alone ? 0.3 * (q - lower) / (alone - lower)
             : q < upper ? 0.7 + 0.3 * (q - alone) / (upper - alone)
                         : 1.0;
    });
    EXPECT_LT(bounds.gap, 0.41) << lower;  // the jump
  }
}

TEST(JointMasses, BoundWhatParametersAllow) {
  const Distribution normal = Distribution::normal({-5, 5}, {-0.5, 0.5}, {0.5, 1});
  const Function twice({uncertain(normal)}, [](const auto& x, auto& y) { y[0] = 2.0 * x[0]; });
  const DistributionBounds bounds = jointBoundsOf(twice);
  const auto member = [](double mean, double deviation, double v) {
    const auto below = [&](double x) { return gsl_cdf_ugaussian_P((x - mean) / deviation); };
    return clamped((below(std::clamp(v / 2, -5.0, 5.0)) - below(-5)) / (below(5) - below(-5)));
  };
  double apart = 0;
  for (const double mean : {-0.5, 0.0, 0.5})
    for (const double deviation : {0.5, 0.7, 1.0})
      expectJointHolds(bounds, [&](double v) {
        const double p = member(mean, deviation, v);
        return v >= 10 ? 1.0 : v <= -10 ? 0.0 : p;
      });
  for (std::size_t i = 0; i < bounds.value.size(); ++i) {
    double least = 1, most = 0;
    for (const double mean : {-0.5, 0.5})
      for (const double deviation : {0.5, 1.0}) {
        least = std::min(least, member(mean, deviation, bounds.value[i]));
        most = std::max(most, member(mean, deviation, bounds.value[i]));
      }
    apart = std::max({apart, least - bounds.lower[i], bounds.upper[i] - most});
  }
  EXPECT_LT(apart, 0.01);
}

/// Correlated normal numbers: their sum is normal.
TEST(JointMasses, KnowGaussianCopulas) {
  for (const double rank : {-0.9, -0.3, 0.0, 0.5, 0.95}) {
    const auto normal = uncertain(Distribution::normal({-8, 8}, 0, 1));
    const Function sum({normal, normal}, sumOfAll);
    const DistributionBounds bounds = jointBoundsOf(sum, correlated(rank));
    const double r = 2 * std::sin(3.14159265358979324 * rank / 6), deviation = std::sqrt(2 + 2 * r);
    const auto truth = [&](double z) { return z < -16 ? 0 : z >= 16 ? 1 : gsl_cdf_ugaussian_P(z / deviation); };
    constexpr double cut = 1e-14;  // what truncation changes
    for (std::size_t i = 0; i < bounds.value.size(); ++i) {
      EXPECT_LE(bounds.lower[i], truth(bounds.value[i]) + cut) << rank;
      EXPECT_GE(bounds.upper[i], truth(bounds.value[i]) - cut) << rank;
    }
    EXPECT_LT(bounds.gap, rank < -0.5 ? 0.03 : 0.01) << rank;
  }
}

/// So is the sum of many: it is linear in the numbers that they are made of.
TEST(JointMasses, KnowGaussianCopulasOfMany) {
  for (const std::size_t count : {3, 9}) {
    const Function sum(std::vector<Uncertain>(count, uncertain(Distribution::normal({-8, 8}, 0, 1))), sumOfAll);
    QuantityDependence dependence;
    std::vector<std::size_t> all;
    std::vector<std::vector<Interval>> rank(count, std::vector<Interval>(count, Interval(0.3)));
    for (std::size_t i = 0; i < count; ++i) all.push_back(i), rank[i][i] = 1.0;
    dependence.copulas.emplace_back(all, rank);
    const DistributionBounds bounds = jointBoundsOf(sum, dependence);
    const double r = 2 * std::sin(3.14159265358979324 * 0.3 / 6), n = static_cast<double>(count);
    const double deviation = std::sqrt(n + n * (n - 1) * r);
    constexpr double cut = 1e-13;  // what truncation changes
    for (std::size_t i = 0; i < bounds.value.size(); ++i) {
      const double truth = gsl_cdf_ugaussian_P(bounds.value[i] / deviation);
      EXPECT_LE(bounds.lower[i], truth + cut) << count;
      EXPECT_GE(bounds.upper[i], truth - cut) << count;
    }
    EXPECT_LT(bounds.gap, 0.012) << count;  // that of their bins
  }
}

/// Terms in several correlated quantities need no cells: P(xy <= v) = ∫ P(y <= v/x | z) dΦ(z) by the trapezoidal rule.
TEST(JointMasses, KnowProductsOfCorrelated) {
  for (const double rank : {-0.8, 0.4, 0.9}) {
    const Function product({uniform(0, 1), uniform(0, 1)}, [](const auto& x, auto& y) { y[0] = x[0] * x[1]; });
    const DistributionBounds bounds = jointBoundsOf(product, correlated(rank));
    const double r = 2 * std::sin(3.14159265358979324 * rank / 6);
    const auto integral = [&](double value, double step) {
      constexpr double most = 9;
      double sum = 0;
      for (double z = -most; z < most; z += step) {
        const double y = value / gsl_cdf_ugaussian_P(z);
        const double below = y >= 1   ? 1
                             : y <= 0 ? 0
                                      : gsl_cdf_ugaussian_P((gsl_cdf_ugaussian_Pinv(y) - r * z) / std::sqrt(1 - r * r));
        sum += step * gsl_ran_ugaussian_pdf(z) * below;
      }
      return sum;
    };
    for (std::size_t i = 0; i < bounds.value.size(); i += 16) {
      const double truth = integral(bounds.value[i], 5e-4);
      const double error =
          std::fabs(truth - integral(bounds.value[i], 1e-3)) + 36000 * 0x1p-53;  // as measured, and of 36000 sums
      EXPECT_LE(bounds.lower[i], truth + error) << rank << " at " << bounds.value[i];
      EXPECT_GE(bounds.upper[i], truth - error) << rank << " at " << bounds.value[i];
    }
    EXPECT_LT(bounds.gap, 0.02) << rank;
  }
}

TEST(JointMasses, RefuseImpossibleCorrelations) {
  const auto messageOf = [](std::vector<std::vector<Interval>> rank) -> std::string {
    try {
      GaussianCopula({0, 1, 2}, rank);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(messageOf({{1, 0.5, 0}, {0.5, 1, 0.2}, {0, 0.2, 1}}), "");
  EXPECT_THAT(messageOf({{1, 0.9, -0.9}, {0.9, 1, 0.9}, {-0.9, 0.9, 1}}), ::testing::HasSubstr("positive definite"));
  EXPECT_THAT(messageOf({{1, 1, 0}, {1, 1, 0}, {0, 0, 1}}), ::testing::HasSubstr("positive definite"));
  EXPECT_THAT(messageOf({{1, 0.5, 0}, {0.4, 1, 0}, {0, 0, 1}}), ::testing::HasSubstr("symmetric"));
  EXPECT_THAT(messageOf({{2, 0.5, 0}, {0.5, 1, 0}, {0, 0, 1}}), ::testing::HasSubstr("diagonal"));
  EXPECT_THAT(messageOf({{1, 0.5}, {0.5, 1}}), ::testing::HasSubstr("3 rows"));
}

/// Curved functions with terms in several quantities, in odd units, of quantities of all kinds: samples of one of the
/// joint distributions that are possible leave the bounds by no more than their band at one in 1e9.
TEST(JointMasses, HoldSamplesOfWhateverIsPossible) {
  std::mt19937_64 engine(11);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); };
  for (int round = 0; round < 24; ++round) {
    const int n = 2 + round % 3;
    std::vector<Uncertain> quantities;
    std::vector<Distribution> members;
    for (int q = 0; q < n; ++q) {
      const double lower = between(0.2, 1), upper = lower * (1 + between(0.01, 0.6)), span = upper - lower;
      const Interval range(lower, upper);
      const Interval some(lower + 0.3 * span, lower + 0.6 * span);
      const double mean = between(some.lower(), some.upper());
      switch (engine() % 6) {
        case 0: {
          const Interval deviation(0.2 * span, 0.5 * span);
          quantities.push_back(uncertain(Distribution::normal(range, some, deviation)));
          members.push_back(Distribution::normal(range, mean, between(deviation.lower(), deviation.upper())));
          break;
        }
        case 1:
          quantities.push_back(uncertain(Distribution::triangular(range, some)));
          members.push_back(Distribution::triangular(range, mean));
          break;
        case 2:
          quantities.push_back(uncertain(Distribution::beta(range, {0.5, 3}, {0.8, 2})));
          members.push_back(Distribution::beta(range, between(0.5, 3), between(0.8, 2)));
          break;
        case 3:
          quantities.push_back(uncertain(Distribution::weibull(range, {0.8, 4}, some)));
          members.push_back(Distribution::weibull(range, between(0.8, 4), mean));
          break;
        case 4: {
          const double a = lower + 0.2 * span, b = lower + 0.7 * span;
          quantities.push_back(uncertain(Distribution::evidence(
              {{{lower, b}, Interval(0.25)}, {{a, upper}, Interval(0.5)}, {{a, b}, Interval(0.25)}})));
          const double s = between(0, 1);  // a value in each, wherever
          std::vector<double> values{lower + s * (b - lower), a + s * (upper - a), a + s * (b - a)};
          members.push_back(Distribution::evidence(
              {{values[0], Interval(0.25)}, {values[1], Interval(0.5)}, {values[2], Interval(0.25)}}));
          break;
        }
        default:
          quantities.push_back(uncertain(Distribution::uniform(range)));
          members.push_back(quantities.back().distribution);
      }
    }
    const double unit = std::pow(10.0, between(-9, 6)), fold = between(0.3, 1.2), mixed = between(-2, 2);
    const Function function(quantities, [&](const auto& x, auto& y) {
      y[0] = unit * sin(4.0 * (x[0] - fold)) * x.back();
      for (std::size_t i = 1; i < x.size(); ++i) y[0] += unit * (mixed * x[i] * x[i - 1] + sqr(x[i]));
    });
    const int kind = round % 3;  // independent, correlated, unknown
    const double rank = between(-0.95, 0.95);
    const DistributionBounds bounds = jointBoundsOf(function, kind == 0   ? QuantityDependence{}
                                                              : kind == 1 ? correlated(rank)
                                                                          : unknown({0, 1}));
    ASSERT_GE(bounds.value.size(), 2U) << round;
    std::vector<double> samples;
    Evaluator<double> evaluator(function.g);
    constexpr int count = 10000;
    for (int i = 0; i < count; ++i) {
      std::vector<double> u, x;
      for (int q = 0; q < n; ++q) u.push_back(between(0, 1));
      if (kind == 1) correlated(rank).copulas[0].correlate(u);
      if (kind == 2) u[1] = round % 2 == 0 ? 1 - u[0] : u[0];
      for (std::size_t q = 0; q < u.size(); ++q) x.push_back(members[q].quantile(u[q]));
      samples.push_back(evaluator(0.0, x)[0]);
    }
    expectHoldsSamples(bounds, std::move(samples), round);
  }
}

}  // namespace
}  // namespace gamut::testing
