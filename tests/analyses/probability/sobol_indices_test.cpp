// Sobol' indices against closed forms, and against pick-and-freeze estimates of functions that have none.
#include "analyses/probability/sobol_indices.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

#include "analyses/work.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "tests/analyses/probability/images.hpp"

namespace gamut::testing {
namespace {

SobolIndices indicesOf(const Function& function) {
  const QuantityMasses masses(function.surrogate, function.uncertain());
  return sobolIndices(function.surrogate, function.surrogate.at.back(), 0, masses);
}

void expectIs(const Interval& bounds, double truth, double narrow = 1e-3) {
  EXPECT_TRUE(contains(bounds, truth)) << toString(bounds) << " " << truth;
  EXPECT_LT(width(bounds), narrow) << truth;
}

TEST(SobolIndices, AreThoseOfClosedForms) {
  // Variances 4/12 and 9 (Beta(2,2): 1/20).
  const SobolIndices sum = indicesOf({{uniform(0, 1), uncertain(Distribution::beta({0.0, 1.0}, 2, 2))},
                                      [](const auto& x, auto& y) { y[0] = 5.0 + 2.0 * x[0] - 3.0 * x[1]; }});
  const double a = 4.0 / 12, b = 9.0 / 20;
  expectIs(sum.first[0], a / (a + b));
  expectIs(sum.total[0], a / (a + b));
  expectIs(sum.first[1], b / (a + b));
  expectIs(sum.mean, 5 + 1 - 1.5, 1e-5);
  expectIs(sum.deviation, std::sqrt(a + b), 1e-4);
  // x y of uniform [1, 2]: V_x = (3/2)²/12, V = (7/3)² - (9/4)².
  const SobolIndices product =
      indicesOf({{uniform(1, 2), uniform(1, 2)}, [](const auto& x, auto& y) { y[0] = x[0] * x[1]; }});
  const double one = 2.25 / 12, all = 49.0 / 9 - 81.0 / 16;
  expectIs(product.first[0], one / all);
  expectIs(product.total[0], 1 - one / all);
  // Like Ishigami's: sin x + 7 sin² y on [-1, 1].
  const SobolIndices waves = indicesOf(
      {{uniform(-1, 1), uniform(-1, 1)}, [](const auto& x, auto& y) { y[0] = sin(x[0]) + 7.0 * sqr(sin(x[1])); }});
  const double sine = 0.5 - std::sin(2.0) / 4;
  const double square = 12.25 * (0.5 + std::sin(4.0) / 8 - 0.25 * std::sin(2.0) * std::sin(2.0));
  expectIs(waves.first[0], sine / (sine + square), 0.02);
  expectIs(waves.total[1], square / (sine + square), 0.02);
  // A product of even functions: all of it in common.
  const SobolIndices common =
      indicesOf({{uniform(-1, 1), uniform(-1, 1)}, [](const auto& x, auto& y) { y[0] = x[0] * x[1]; }});
  expectIs(common.first[0], 0);
  expectIs(common.total[0], 1);
}

/// Pieces whose polynomials have other degrees: y is 1 on one half of the box, 1 + 2 η on the other.
TEST(SobolIndices, AreOfPiecesThatDifferInDegree) {
  const auto linear = std::make_shared<Monomials>(std::vector<int>{1, 1}, 1);
  for (const bool isConstantLast : {false, true}) {
    Surrogate surrogate{{{0, 1, 0}, {0, 1, 1}}, 2, {0}, {{}}};
    for (const double side : {-0.5, 0.5}) {
      const bool isConstant = (side > 0) == isConstantLast;
      OutputModel model{{1}, 0, {-1.0, 3.0}};
      if (!isConstant) model.c = {1, 0, 0};
      if (!isConstant) model.c[static_cast<std::size_t>(linear->linear(1))] = 2;
      surrogate.at[0].push_back({{{side, 0}, {0.5, 1}}, linear, {model}});
    }
    const std::vector<Uncertain> quantities{uniform(-1, 1), uniform(-1, 1)};
    const QuantityMasses masses(surrogate, {&quantities[0], &quantities[1]});
    const SobolIndices indices = sobolIndices(surrogate, surrogate.at[0], 0, masses);
    expectIs(indices.deviation, std::sqrt(2.0 / 3));
    expectIs(indices.first[0], 0);
    expectIs(indices.first[1], 0.5);
    expectIs(indices.total[0], 0.5);
    expectIs(indices.total[1], 1);
  }
}

/// Of long polynomials the least terms are left out: quicker by far, and no less true.
TEST(SobolIndices, CostNoMoreThanTheyMay) {
  constexpr int quantities = 7;
  const Function function(std::vector<Uncertain>(quantities, uniform(-1, 1)), [](const auto& x, auto& y) {
    auto sum = 0.2 * x[0];
    for (std::size_t q = 1; q < quantities; ++q) sum = sum + 0.2 * x[q];
    y[0] = exp(sum);
  });
  const auto mean = [](double a) { return std::sinh(a) / a; };  // of exp(a x)
  const double own = mean(0.4) - mean(0.2) * mean(0.2);
  const double share = own * std::pow(mean(0.2), 2 * quantities - 2) /
                       (std::pow(mean(0.4), quantities) - std::pow(mean(0.2), 2 * quantities));
  const QuantityMasses masses(function.surrogate, function.uncertain());
  double before = 0;
  for (const double work : {std::numeric_limits<double>::infinity(), 1.0}) {
    const auto began = Work::counted();
    const SobolIndices indices = sobolIndices(function.surrogate, function.surrogate.at.back(), 0, masses, work);
    const auto cost = static_cast<double>(Work::counted() - began);
    EXPECT_TRUE(contains(indices.first[3], share)) << toString(indices.first[3]);
    if (before > 0) {
      EXPECT_LT(cost, 0.3 * before);
    }
    before = cost;
  }
}

TEST(SobolIndices, AreNextToNothingOfWhatDoesNotMatter) {
  Function function({uniform(0, 1), uniform(2, 3)}, [](const auto& x, auto& y) { y[0] = exp(x[0]) + 0.0 * x[1]; });
  function.surrogate.quantities.push_back({0, 0, -1});
  function.quantities.push_back(uniform(0, 1));
  const SobolIndices indices = indicesOf(function);
  for (const std::size_t q : {1U, 2U}) {
    expectIs(indices.first[q], 0);
    expectIs(indices.total[q], 0);
  }
  expectIs(indices.first[0], 1);
}

TEST(SobolIndices, SayNothingOfWhatDoesNotVary) {
  const SobolIndices none =
      indicesOf({{uniform(0, 1), uniform(0, 1)}, [](const auto& x, auto& y) { y[0] = 0.0 * x[0] + 0.1; }});
  EXPECT_TRUE(isEqual(none.first[0], Interval(0.0, 1.0)));
  EXPECT_TRUE(contains(none.deviation, 0.0));
  EXPECT_TRUE(contains(none.mean, 0.1));
}

/// Random functions, several pieces among them: estimates of Saltelli et al. (2010) and Jansen (1999), whose standard
/// errors come from batches, lie within six of these.
TEST(SobolIndices, HoldPickAndFreezeEstimates) {
  std::mt19937_64 engine(17);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine); };
  for (int round = 0; round < 8; ++round) {
    std::vector<Uncertain> quantities;
    const std::size_t n = 2 + static_cast<std::size_t>(round) % 3;
    for (std::size_t q = 0; q < n; ++q) {
      const double lower = between(0.2, 1), upper = lower * (1 + between(0.05, 1.5));
      const double inside = lower + between(0.1, 0.9) * (upper - lower);
      quantities.push_back(q % 2 == 0 ? uncertain(Distribution::triangular({lower, upper}, inside))
                                      : uncertain(Distribution::normal({lower, upper}, inside, 0.3 * (upper - lower))));
    }
    const double unit = std::pow(10.0, between(-6, 6)), mixed = between(-2, 2);
    const Function function(quantities, [&](const auto& x, auto& y) {
      y[0] = unit * sin(3.0 * x[0]) * x.back();
      for (std::size_t i = 1; i < x.size(); ++i) y[0] += unit * (mixed * x[i] * x[i - 1] + sqr(x[i]));
    });
    const SobolIndices indices = indicesOf(function);
    Evaluator<double> evaluator(function.g);
    const auto valueOf = [&](const std::vector<double>& x) { return evaluator(0.0, x)[0]; };
    const double centre = midpoint(indices.mean);
    constexpr int batches = 16, count = 3000;
    for (std::size_t q = 0; q < n; ++q) {
      std::vector<double> first, total;
      for (int batch = 0; batch < batches; ++batch) {
        double sum = 0, firstSum = 0, totalSum = 0;
        for (int i = 0; i < count; ++i) {
          std::vector<double> a, b;
          for (const Uncertain& u : quantities) {
            a.push_back(u.distribution.quantile(between(0, 1)));
            b.push_back(u.distribution.quantile(between(0, 1)));
          }
          std::vector<double> ab = a;
          ab[q] = b[q];
          const double ya = valueOf(a) - centre, yb = valueOf(b) - centre, yab = valueOf(ab) - centre;
          sum += ya * ya + yb * yb;
          firstSum += yb * (yab - ya);
          totalSum += (ya - yab) * (ya - yab);
        }
        first.push_back(firstSum / (0.5 * sum));
        total.push_back(0.5 * totalSum / (0.5 * sum));
      }
      const auto expectMeets = [&](const Interval& bounds, const std::vector<double>& estimates) {
        double mean = 0, square = 0;
        for (const double x : estimates) mean += x / batches;
        for (const double x : estimates) square += (x - mean) * (x - mean) / (batches - 1);
        const double error = 6 * std::sqrt(square / batches);
        EXPECT_LE(bounds.lower(), mean + error) << round << " " << q;
        EXPECT_GE(bounds.upper(), mean - error) << round << " " << q;
        EXPECT_LT(width(bounds), 0.2) << round << " " << q;
      };
      expectMeets(indices.first[q], first);
      expectMeets(indices.total[q], total);
    }
  }
}

}  // namespace
}  // namespace gamut::testing
