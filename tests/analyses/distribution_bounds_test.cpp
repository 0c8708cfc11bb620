// Enclosures of distribution functions against 50 digits.
#include <gmock/gmock.h>

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "analyses/uncertainty.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut::testing {
namespace {

using Number = HighPrecision;

struct Case {
  Distribution distribution;
  std::function<Number(Number)> below;  ///< before truncation
};

Number normal(const Number& z) { return erfc(Number(-z / sqrt(Number(2)))) / 2; }

/// One of each kind, with parameters drawn by the engine.
std::vector<Case> drawn(std::mt19937_64& engine) {
  const auto number = [&](double least, double most) { return std::uniform_real_distribution(least, most)(engine); };
  const double lower = number(0, 1), upper = lower + number(0.01, 3), mode = number(lower, upper);
  const Interval support(lower, upper);
  const double a = number(0.2, 8), b = number(0.2, 8), scale = number(0.6, 3), mean = number(-1, 4);
  const Number span = Number(upper) - lower;
  return {{Distribution::uniform(support), [=](Number v) { return (v - lower) / span; }},
          {Distribution::triangular(support, mode),
           [=](Number v) {
             return v <= mode ? Number((v - lower) * (v - lower) / (span * (Number(mode) - lower)))
                              : Number(1 - (upper - v) * (upper - v) / (span * (upper - Number(mode))));
           }},
          {Distribution::normal(support, mean, scale), [=](Number v) { return normal((v - mean) / scale); }},
          {Distribution::beta(support, a, b),
           [=](Number v) { return boost::math::ibeta(Number(a), Number(b), Number((v - lower) / span)); }},
          {Distribution::lognormal(support, mean / 3, scale),
           [=](Number v) { return v <= 0 ? Number(0) : normal((log(v) - Number(mean / 3)) / scale); }},
          {Distribution::weibull(support, a, scale),
           [=](Number v) { return v <= 0 ? Number(0) : Number(-expm1(-pow(v / scale, Number(a)))); }},
          {Distribution::gamma(support, a, scale),
           [=](Number v) { return v <= 0 ? Number(0) : boost::math::gamma_p(Number(a), Number(v / scale)); }},
          {Distribution::exponential(support, scale), [=](Number v) { return Number(-expm1(-v / scale)); }}};
}

TEST(DistributionBounds, HoldTheDistributionFunction) {
  std::mt19937_64 engine(7);
  for (int round = 0; round < 60; ++round)
    for (const auto& [distribution, below] : drawn(engine)) {
      const double lower = distribution.support().lower(), upper = distribution.support().upper();
      const Number low = below(lower), all = below(upper) - low;
      for (const double part : {1e-9, 0.01, 0.2, 0.5, 0.77, 0.999}) {
        const double v = lower + part * (upper - lower);
        if (!(v > lower && v < upper)) continue;
        const Interval bound = distribution.enclosedBelow(v);
        EXPECT_THAT(bound, EnclosesExactly(Number((below(v) - low) / all))) << distribution.name() << " at " << v;
        // Where little of the whole is left by truncation, digits are lost.
        if (all > 0.01) {
          EXPECT_LT(width(bound), 1e-11) << distribution.name() << " at " << v;
        }
      }
      EXPECT_TRUE(isEqual(distribution.enclosedBelow(upper), Interval(1.0)));
      EXPECT_TRUE(isEqual(distribution.enclosedBelow(lower - 1), Interval(0.0)));
    }
}

/// Sums of the weights before, exactly.
TEST(DistributionBounds, HoldThoseOfHistogramsWithValuesOfTheirOwn) {
  std::mt19937_64 engine(11);
  for (int round = 0; round < 200; ++round) {
    const auto number = [&](double least, double most) { return std::uniform_real_distribution(least, most)(engine); };
    std::vector<double> values{number(-2, 1)}, weights;
    for (int i = 0; i < 12; ++i) {
      values.push_back(values.back() + (i % 4 == 3 ? 0 : std::exp(number(-20, 0))));
      weights.push_back(i % 5 == 4 ? 0 : number(0, 1));
    }
    const Distribution d = Distribution::histogram(values, weights);
    Number all = 0;
    for (const double weight : weights) all += weight;
    for (int i = 0; i < 60; ++i) {
      const double v = i < 13 ? values[static_cast<std::size_t>(i)] : number(values.front(), values.back());
      Number below = 0;
      for (std::size_t piece = 0; piece < weights.size(); ++piece) {
        const Number from = values[piece], end = values[piece + 1];
        if (v >= values[piece + 1])
          below += weights[piece];
        else if (v > values[piece])
          below += weights[piece] * ((v - from) / (end - from));
      }
      const Interval bound = d.enclosedBelow(v);
      EXPECT_THAT(bound, EnclosesExactly(Number(below / all))) << v;
      EXPECT_LT(width(bound), 1e-7) << v;  // pieces are 1e-9 long and more
      const double u = static_cast<double>(below / all);
      EXPECT_NEAR(d.quantile(u) >= v ? u : static_cast<double>(midpoint(d.enclosedBelow(d.quantile(u)))), u, 1e-6);
    }
    for (int i = 0; i < 20; ++i) {
      const double from = number(values.front(), values.back()), to = std::min(from + number(0, 0.3), values.back());
      if (from < to && d.isMonotone(Interval(from, to))) {
        for (const double v : values) EXPECT_FALSE(from < v && v < to);
      }
    }
  }
}

TEST(DistributionBounds, HoldWhereTheSupportIsOneValue) {
  const Interval one(1.0);
  for (const Distribution& d :
       {Distribution::uniform(one), Distribution::triangular(one, one), Distribution::normal(one, one, Interval(0.5)),
        Distribution::normal(one, {0.5, 2}, Interval(0.5)), Distribution::exponential(one, one)}) {
    EXPECT_TRUE(isEqual(d.enclosedBelow(0.5), Interval(0.0)));
    EXPECT_TRUE(isEqual(d.enclosedBelow(one), Interval(1.0)));
    for (const Interval& around : {Interval(0.5, 1), Interval(0.5, 1.5)})
      EXPECT_TRUE(isSubset(Interval(0, 1), d.enclosedBelow(around))) << d.name();
  }
}

TEST(DistributionBounds, HoldWhereAValueHasAProbabilityOfItsOwn) {
  const Distribution d = Distribution::histogram({0, 0, 1, 1}, {1, 1, 1});
  EXPECT_TRUE(contains(d.enclosedBelow({-1, 0}), 0));
  EXPECT_TRUE(contains(d.enclosedBelow({-1, 0.5}), 0));
  EXPECT_TRUE(contains(d.enclosedBelow({-1, 2}), 1));
  EXPECT_TRUE(isEqual(d.enclosedBelow({-2, -1}), Interval(0.0)));
  EXPECT_FALSE(d.isMonotone({0, 1}));  // P jumps at both ends
  EXPECT_FALSE(d.isMonotone({0, 0.5}));
  EXPECT_TRUE(Distribution::histogram({0, 0, 1}, {0, 1}).isMonotone({0, 1}));
}

TEST(DistributionBounds, KnowHowDenseAndHowUnevenItIs) {
  std::mt19937_64 engine(11);
  for (int round = 0; round < 40; ++round) {
    std::vector<Distribution> all;
    for (const Case& one : drawn(engine)) all.push_back(one.distribution);
    all.push_back(Distribution::histogram({0, 0.3, 0.4, 0.4, 1}, {0.2, 0.5, 0, 0.3}));
    for (const Distribution& distribution : all) {
      constexpr int parts = 500;
      const double lower = distribution.support().lower(), span = distribution.support().upper() - lower;
      // Means of the density over parts are no more, and vary by no more, than itself; the errors are those of F.
      double most = 0, varies = 0, before = 0, last = 0, error = 0;
      for (int i = 1; i <= parts; ++i) {
        const Interval below = distribution.enclosedBelow(lower + i * (span / parts));
        const double density = (midpoint(below) - last) / (span / parts);
        error = std::max(error, 2 * width(below) / (span / parts));
        most = std::max(most, density);
        varies += std::fabs(density - before);
        before = density, last = midpoint(below);
      }
      varies += before;
      const Distribution::DensityBound known = distribution.densityBound();
      EXPECT_GE(known.most, most - error - 1e-9 / span) << distribution.name();
      EXPECT_GE(known.variation, varies - parts * (error + 1e-9 / span)) << distribution.name();
      if (distribution.name() == "uniform" || distribution.name() == "triangular" ||
          distribution.name() == "histogram") {
        EXPECT_LT(known.most, 1.1 * most);
        EXPECT_LT(known.variation, 1.1 * varies);
      }
    }
  }
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  EXPECT_EQ(Distribution::beta({0, 1}, 0.5, 2.0).densityBound().most, unlimited);
  EXPECT_EQ(Distribution::histogram({0, 0.5, 0.5, 1}, {1, 1, 1}).densityBound().variation, unlimited);
  EXPECT_EQ(Distribution::normal({0, 1}, Interval(0.4, 0.6), 0.2).densityBound().most, unlimited);
}

TEST(DistributionBounds, HoldOverIntervals) {
  std::mt19937_64 engine(8);
  for (int round = 0; round < 20; ++round)
    for (const auto& [distribution, below] : drawn(engine)) {
      const double lower = distribution.support().lower(), upper = distribution.support().upper();
      const double from = lower + 0.3 * (upper - lower), to = lower + 0.4 * (upper - lower);
      const Interval bound = distribution.enclosedBelow(Interval(from, to));
      EXPECT_TRUE(isSubset(distribution.enclosedBelow(from), bound) || width(bound) > 0) << distribution.name();
      EXPECT_LE(bound.lower(), distribution.enclosedBelow(from).upper());
      EXPECT_GE(bound.upper(), distribution.enclosedBelow(to).lower());
      EXPECT_TRUE(contains(bound, midpoint(distribution.enclosedBelow(0.5 * (from + to))))) << distribution.name();
    }
}

/// Where the density is said to rise or fall, the distribution function bends to one side.
TEST(DistributionBounds, KnowWhereDensitiesRiseOrFall) {
  std::mt19937_64 engine(9);
  int said = 0, all = 0;
  for (int round = 0; round < 60; ++round)
    for (const auto& [distribution, below] : drawn(engine)) {
      const Interval support = distribution.support();
      const double part = std::uniform_real_distribution(0.0, 0.8)(engine), span = width(support);
      const double from = support.lower() + part * span, to = support.lower() + (part + 0.2) * span;
      if (to > support.upper()) continue;
      ++all;
      if (!distribution.isMonotone(Interval(from, to))) continue;
      ++said;
      int rises = 0, falls = 0;
      constexpr int steps = 20;
      const Number h = (Number(to) - from) / steps;
      Number before = below(from + h) - below(from);
      for (int i = 1; i < steps; ++i) {
        const Number mass = below(from + (i + 1) * h) - below(from + i * h);
        rises += mass > before * (1 + Number("1e-30"));
        falls += mass < before * (1 - Number("1e-30"));
        before = mass;
      }
      EXPECT_TRUE(rises == 0 || falls == 0) << distribution.name();
    }
  EXPECT_GT(said, all / 2);
  EXPECT_FALSE(Distribution::uniform(Interval(1.0, 2.0)).isMonotone(Interval(0.5, 1.5)));  // it jumps
}

}  // namespace
}  // namespace gamut::testing
