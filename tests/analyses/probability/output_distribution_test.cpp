// Bounds of distribution functions against closed forms, and against samples of functions that have none.
#include "analyses/probability/output_distribution.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "scalars/evaluation/evaluator.hpp"
#include "tests/analyses/probability/images.hpp"

namespace gamut::testing {
namespace {

DistributionBounds boundsOf(const Function& function, std::size_t output = 0, const DistributionOptions& options = {}) {
  const JointMasses masses(function.surrogate.symbols, function.surrogate.quantities, function.uncertain());
  return boundDistribution(function.surrogate.at.back(), output, masses, options);
}

/// Nowhere do the bounds leave what is true.
template <class Truth>
void expectHolds(const DistributionBounds& bounds, const Truth& truth) {
  ASSERT_GE(bounds.value.size(), 2U);
  EXPECT_EQ(bounds.lower.back(), 1);
  for (std::size_t i = 0; i < bounds.value.size(); ++i) {
    EXPECT_LE(bounds.lower[i], truth(bounds.value[i])) << bounds.value[i];
    EXPECT_GE(bounds.upper[i], truth(bounds.value[i])) << bounds.value[i];
  }
  double gap = 0;
  for (std::size_t i = 0; i + 1 < bounds.value.size(); ++i) {
    EXPECT_LT(bounds.value[i], bounds.value[i + 1]);
    gap = std::max(gap, bounds.upper[i + 1] - bounds.lower[i]);
  }
  EXPECT_EQ(gap, bounds.gap);
}

TEST(OutputDistribution, IsThatOfClosedForms) {
  const auto bounds = boundsOf({{uniform(2, 3)}, [](const auto& x, auto& y) { y[0] = 2.0 * x[0]; }});
  expectHolds(bounds, [](double v) { return std::clamp((v - 4) / 2, 0.0, 1.0); });
  EXPECT_LE(bounds.gap, 0.005);
  const auto sum = boundsOf({{uniform(0, 1), uniform(0, 1)}, [](const auto& x, auto& y) { y[0] = x[0] - x[1]; }});
  expectHolds(sum, [](double v) {
    return v <= -1 ? 0.0 : v < 0 ? 0.5 * (v + 1) * (v + 1) : v < 1 ? 1 - 0.5 * (1 - v) * (1 - v) : 1.0;
  });
  EXPECT_LE(sum.gap, 0.005);
  const auto product = boundsOf({{uniform(1, 2), uniform(1, 2)}, [](const auto& x, auto& y) { y[0] = x[0] * x[1]; }});
  expectHolds(product, [](double v) {  // ∫ of min(1, max(0, v/x - 1))
    if (v <= 1) return 0.0;
    if (v >= 4) return 1.0;
    return v <= 2 ? v * std::log(v) - v + 1 : (v / 2 - 1) + v * (std::log(4 / v)) - (2 - v / 2);
  });
  EXPECT_LE(product.gap, 0.005);
  const auto folded = boundsOf({{uniform(-1, 1)}, [](const auto& x, auto& y) { y[0] = sqr(x[0]); }});
  expectHolds(folded, [](double v) { return std::sqrt(std::clamp(v, 0.0, 1.0)); });
  EXPECT_LE(folded.gap, 0.01);  // of infinite density at 0
  const auto normal = boundsOf(
      {{uncertain(Distribution::normal({-3, 3}, 0, 1))}, [](const auto& x, auto& y) { y[0] = 1.0 - 1e-9 * x[0]; }});
  expectHolds(normal, [](double v) {
    const double x = (1 - v) / 1e-9, all = std::erf(3 / std::sqrt(2.0));
    return x >= 3 ? 0.0 : x <= -3 ? 1.0 : 0.5 * (1 - std::erf(x / std::sqrt(2.0)) / all);
  });
}

/// Whatever gap is asked for: at the folds of what goes to and fro, as a swing does, the density is infinite.
TEST(OutputDistribution, IsAsCloseAsAskedForWhereDensitiesAreInfinite) {
  for (const double gap : {0.1, 0.05, 0.02, 0.01, 0.005})
    for (const double shift : {0.0, 0.3, 0.9}) {
      DistributionOptions options;
      options.gap = gap;
      const auto bounds =
          boundsOf({{uniform(-1, 1)}, [&](const auto& x, auto& y) { y[0] = sqr(x[0] - shift); }}, 0, options);
      EXPECT_LE(bounds.gap, gap) << shift;
    }
}

TEST(OutputDistribution, IsOfManyQuantitiesAlike) {
  std::vector<Uncertain> ten(10, uniform(0, 1));
  const auto bounds = boundsOf({ten, [](const auto& x, auto& y) {
                                  y[0] = 0.0 * x[0];
                                  for (const auto& value : x) y[0] += value;
                                }});
  const std::function<double(double)> irwinHall = [&](double v) {
    if (v <= 0) return 0.0;
    if (v >= 10) return 1.0;
    if (v > 5) return 1 - irwinHall(10 - v);
    double sum = 0, binomial = 1;
    for (int k = 0; k <= static_cast<int>(v); ++k) {
      sum += (k % 2 == 0 ? 1 : -1) * binomial * std::pow(v - k, 10);
      binomial *= (10.0 - k) / (k + 1);
    }
    return sum / 3628800;
  };
  expectHolds(bounds, irwinHall);
  EXPECT_LE(bounds.gap, 0.005);
}

TEST(OutputDistribution, IsKnownOfWhatDoesNotVary) {
  const auto bounds = boundsOf({{uniform(0, 1)}, [](const auto& x, auto& y) { y[0] = 0.0 * x[0] + 0.1; }});
  expectHolds(bounds, [](double v) { return v >= 0.1 ? 1.0 : 0.0; });
  EXPECT_LT(bounds.value.back() - bounds.value.front(), 1e-12);
  DistributionOptions options;
  options.negligible = 1e-6;
  const auto about = boundsOf({{uniform(0, 1)}, [](const auto& x, auto& y) { y[0] = 1e-7 * x[0] + 0.1; }}, 0, options);
  ASSERT_EQ(about.value.size(), 2U);
  EXPECT_LT(about.value[0], 0.1);
  EXPECT_GE(about.value[1], 0.1 + 1e-7);
  EXPECT_EQ(about.gap, 0);
}

/// Random functions with curvature, mixed terms, folds, in odd units, with all distributions: the empirical
/// distribution function of 10000 samples leaves the bounds by no more than its band at one in 1e9 (Dvoretzky, Kiefer,
/// Wolfowitz, Massart).
TEST(OutputDistribution, HoldsThatOfSamples) {
  std::mt19937_64 engine(9);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); };
  for (int round = 0; round < 15; ++round) {
    std::vector<Uncertain> quantities;
    const int n = 1 + round % 5;
    for (int q = 0; q < n; ++q) {
      const double lower = between(0.2, 1), upper = lower * (1 + between(0.01, 0.6));
      const Interval range(lower, upper);
      const double inside = lower + between(0.1, 0.9) * (upper - lower);
      switch (engine() % 6) {
        case 0:
          quantities.push_back(uncertain(Distribution::normal(range, inside, 0.3 * (upper - lower))));
          break;
        case 1:
          quantities.push_back(uncertain(Distribution::triangular(range, inside)));
          break;
        case 2:
          quantities.push_back(uncertain(Distribution::beta(range, between(0.5, 3), between(0.5, 3))));
          break;
        case 3:
          quantities.push_back(uncertain(Distribution::exponential(range, between(0.05, 1))));
          break;
        case 4:
          quantities.push_back(uncertain(Distribution::weibull(range, between(0.8, 4), inside)));
          break;
        default:
          quantities.push_back(uncertain(Distribution::uniform(range)));
      }
    }
    const double unit = std::pow(10.0, between(-9, 6)), fold = between(0.3, 1.2), mixed = between(-2, 2);
    const Function function(quantities, [&](const auto& x, auto& y) {
      y[0] = unit * sin(4.0 * (x[0] - fold)) * x.back();
      for (std::size_t i = 1; i < x.size(); ++i) y[0] += unit * (mixed * x[i] * x[i - 1] + sqr(x[i]));
    });
    const DistributionBounds bounds = boundsOf(function);
    ASSERT_GE(bounds.value.size(), 2U) << round;
    EXPECT_LT(bounds.gap, n < 5 ? 0.05 : 0.1) << round << ", " << n << " quantities";
    std::vector<double> samples;
    Evaluator<double> evaluator(function.g);
    constexpr int count = 10000;
    for (int i = 0; i < count; ++i) {
      std::vector<double> x;
      for (const Uncertain& u : quantities) x.push_back(u.distribution.quantile(between(0, 1)));
      samples.push_back(evaluator(0.0, x)[0]);
    }
    expectHoldsSamples(bounds, std::move(samples), round);
  }
}

}  // namespace
}  // namespace gamut::testing
