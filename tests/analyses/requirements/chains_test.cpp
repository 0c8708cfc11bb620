// Tolerance chains: limits of sums of many quantities, and of what is nearly one, against closed forms and samples.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "analyses/requirements/requirement.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {
namespace {

Uncertain quantityOf(const Distribution& distribution) {
  Uncertain u;
  u.name = "q";
  u.range = distribution.support();
  u.nominal = midpoint(u.range);
  u.distribution = distribution;
  u.membership = Membership::triangular(u.range.lower(), u.nominal, u.range.upper());
  return u;
}

/// Margins, all to be above zero, of quantities that are at rest.
struct Chain {
  std::vector<Uncertain> quantities;
  Program g;

  template <class Margins>
  Chain(std::vector<Uncertain> of, int margins, const Margins& write) : quantities(std::move(of)) {
    g = record(static_cast<int>(quantities.size()), 0, margins,
               [&](auto, const auto& x, const auto&, auto& y) { write(x, y); });
  }

  RequirementFinding examine() const {
    Box box;
    std::vector<CellQuantity> cells;
    for (const Uncertain& u : quantities) {
      cells.push_back({static_cast<int>(box.size()), &u});
      box.push_back(u.range);
    }
    CellQuestion question;
    std::vector<int> outputs;
    for (int i = 0; i < g.outputs(); ++i) outputs.push_back(i);
    question.margins = outputs;
    question.isStrict.assign(outputs.size(), 1);
    return gamut::examine(*modelImage(g, 0, box, outputs), question, cells);
  }
};

template <class Numbers>
auto sumOf(const Numbers& x, const std::vector<double>& factors) {
  auto sum = factors[0] * x[0];
  for (std::size_t i = 1; i < factors.size(); ++i) sum = sum + factors[i] * x[i];
  return sum;
}

/// P(Σ of n uniform on [0, 1] <= x) (Irwin, Hall 1927), by the tail with fewer terms.
double sumOfUniform(int n, double x) {
  if (x > 0.5 * n) return 1 - sumOfUniform(n, n - x);
  long double sum = 0;
  for (int k = 0; k < x && k <= n; ++k) {
    long double term = 1;  // C(n,k) (x-k)^n / n!
    for (int i = 1; i <= n; ++i) term *= (static_cast<long double>(x) - k) / i;
    for (int i = 1; i <= k; ++i) term = term * (n - k + i) / i;
    sum += k % 2 == 0 ? term : -term;
  }
  return static_cast<double>(sum);
}

TEST(ToleranceChain, IsThatOfClosedFormsWhateverTheNumberOfQuantities) {
  for (const int n : {1, 3, 10, 12, 30})
    for (const double place : {-3.5, -1.0, 0.0, 2.0, 3.5})  // standard deviations from the middle
      for (const double unit : {1e-9, 1.0, 1e6}) {
        const double half = 0.1 * unit, middle = 10 * unit * n;
        const double limit = middle + place * half * std::sqrt(n / 3.0);
        if (std::fabs(limit - middle) >= n * half) continue;
        const Chain chain(std::vector<Uncertain>(static_cast<std::size_t>(n),
                                                 quantityOf(Distribution::uniform({9.9 * unit, 10.1 * unit}))),
                          1, [&](const auto& x, auto& y) {
                            y[0] = limit - sumOf(x, std::vector<double>(static_cast<std::size_t>(n), 1.0));
                          });
        const RequirementFinding found = chain.examine();
        const double exact = sumOfUniform(n, 0.5 * n + (limit - middle) / (2 * half));
        EXPECT_LE(found.probability.lower(), exact + 1e-12) << n << ' ' << place;  // the reference's own rounding
        EXPECT_GE(found.probability.upper(), exact - 1e-12) << n << ' ' << place;
        EXPECT_LT(width(found.probability), n < 30 ? 0.002 : 0.001) << n << ' ' << place;
        const double possible = place >= 0 ? 1 - (limit - middle) / (n * half) : 1.0;
        EXPECT_LE(found.violationPossibility.lower(), possible + 1e-9) << n << ' ' << place;
        EXPECT_GE(found.violationPossibility.upper(), possible - 1e-9) << n << ' ' << place;
        EXPECT_LT(width(found.violationPossibility), 0.003) << n << ' ' << place;
        const double factor = std::max(0.0, (limit - middle) / (n * half));
        EXPECT_LE(found.factor, factor + 1e-9) << n << ' ' << place;
        EXPECT_GT(found.factor, factor - 0.002) << n << ' ' << place;
      }
}

TEST(ToleranceChain, IsOfNormalQuantities) {
  // 30 of standard deviation 0.02 in ± 5 of them: the sum is off a normal one by what is cut off, 30 · 5.8e-7.
  const std::vector<Uncertain> quantities(30, quantityOf(Distribution::normal({-0.1, 0.1}, 0.0, 0.02)));
  for (const double place : {-1.0, 0.0, 1.0, 2.5}) {
    const double limit = place * 0.02 * std::sqrt(30.0);
    const Chain chain(quantities, 1,
                      [&](const auto& x, auto& y) { y[0] = limit - sumOf(x, std::vector<double>(30, 1.0)); });
    const double exact = 0.5 * (1 + std::erf(place / std::sqrt(2.0))), cut = 30 * 5.8e-7;
    const Interval found = chain.examine().probability;
    EXPECT_LE(found.lower(), exact + cut);
    EXPECT_GE(found.upper(), exact - cut);
    EXPECT_LT(width(found), 0.001);
  }
}

TEST(ToleranceChain, IsHalfAtTheMiddleOfWhatIsSymmetric) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const int n : {3, 5, 10, 12, 20, 30, 50})
    for (const double dominating : {1.0, 30.0}) {  // one that is so much wider than the others
      std::vector<Uncertain> quantities;
      std::vector<double> factors;
      for (int q = 0; q < n; ++q) {
        const double half = (0.5 + uniform(random)) * (q == 1 ? dominating : 1.0);
        const Interval range(-half, half);
        quantities.push_back(quantityOf(q % 3 == 0   ? Distribution::uniform(range)
                                        : q % 3 == 1 ? Distribution::normal(range, 0.0, half / 4)
                                                     : Distribution::triangular(range, 0.0)));
        factors.push_back(uniform(random) < 0.5 ? 1.0 : -1.0);
      }
      const Chain chain(quantities, 1, [&](const auto& x, auto& y) { y[0] = sumOf(x, factors); });
      const Interval found = chain.examine().probability;
      EXPECT_TRUE(contains(found, 0.5)) << n << ' ' << dominating;
      EXPECT_LT(width(found), 0.001) << n << ' ' << dominating;
    }
}

TEST(ToleranceChain, BendsAsASineDoes) {
  for (const int n : {10, 12, 30}) {
    const double limit = 0.6 * n / 30.0;  // of the sum of [-0.1, 0.1], beside the middle
    const Chain chain(
        std::vector<Uncertain>(static_cast<std::size_t>(n), quantityOf(Distribution::uniform({9.9, 10.1}))), 1,
        [&](const auto& x, auto& y) {
          const auto sum = sumOf(x, std::vector<double>(static_cast<std::size_t>(n), 1.0 / (10.0 * n)));
          y[0] = 50.0 * std::sin(1 + limit / (10.0 * n)) - 50.0 * sin(sum);
        });
    const RequirementFinding found = chain.examine();
    const double exact = sumOfUniform(n, 0.5 * n + limit / 0.2);  // the sine rises there
    EXPECT_LE(found.probability.lower(), exact + 1e-9);
    EXPECT_GE(found.probability.upper(), exact - 1e-9);
    EXPECT_LT(width(found.probability), 0.001);
    EXPECT_NEAR(found.violationPossibility.upper(), 1 - limit / (0.1 * n), 1e-3);
    EXPECT_LT(width(found.violationPossibility), 0.003);
  }
}

TEST(ToleranceChain, HasLimitsOnBothSides) {
  // Both are violated never: P(met) is 1 less both probabilities, although no plane lies below both margins.
  const Chain chain(std::vector<Uncertain>(12, quantityOf(Distribution::uniform({-0.1, 0.1}))), 2,
                    [](const auto& x, auto& y) {
                      const auto sum = sumOf(x, std::vector<double>(12, 1.0));
                      y[0] = 0.3 - sum;
                      y[1] = sum + 0.2;
                    });
  const RequirementFinding found = chain.examine();
  const double exact = sumOfUniform(12, 6 + 1.5) - sumOfUniform(12, 6 - 1.0);
  EXPECT_TRUE(contains(found.probability, exact));
  EXPECT_LT(width(found.probability), 0.004);
  EXPECT_NEAR(found.violationPossibility.upper(), 1 - 0.2 / 1.2, 0.002);
  EXPECT_LT(width(found.violationPossibility), 0.003);
}

TEST(ToleranceChain, KnowsOutputsOfDifferentQuantitiesApart) {
  const Chain chain(std::vector<Uncertain>(10, quantityOf(Distribution::uniform({-0.1, 0.1}))), 2,
                    [](const auto& x, auto& y) {
                      y[0] = 0.1 - (x[0] + x[1] + x[2] + x[3] + x[4]);
                      y[1] = 0.1 - (x[5] + x[6] + x[7] + x[8] + x[9]);
                    });
  const double one = sumOfUniform(5, 2.5 + 0.5);
  const Interval found = chain.examine().probability;
  EXPECT_TRUE(contains(found, one * one));
  EXPECT_LT(width(found), 0.01);
}

/// The probability that values of the quantities meet all margins, by so many samples, and how far off that is at most
/// (Hoeffding, one in 1e9).
struct Sampled {
  double share = 0, band = 0;
};
Sampled sampledOf(const Chain& chain, std::mt19937_64& random) {
  constexpr int count = 10000;
  std::uniform_real_distribution<double> uniform(0, 1);
  Evaluator<double> g(chain.g);
  std::vector<double> x(chain.quantities.size()), y(static_cast<std::size_t>(chain.g.outputs()));
  int met = 0;
  for (int i = 0; i < count; ++i) {
    for (std::size_t q = 0; q < x.size(); ++q) {
      const Uncertain& u = chain.quantities[q];
      if (u.distribution.name() == "normal") {  // as quantiles are, but quicker
        std::normal_distribution<double> normal(u.nominal, 0.4 * radius(u.range));
        do x[q] = normal(random);
        while (!contains(u.range, x[q]));
      } else {
        x[q] = u.distribution.quantile(uniform(random));
      }
    }
    g(0.0, x, y);
    met += std::ranges::all_of(y, [](double margin) { return margin > 0; }) ? 1 : 0;
  }
  return {met / static_cast<double>(count), std::sqrt(std::log(2 / 1e-9) / (2.0 * count))};
}

TEST(ToleranceChain, HoldsSamplesOfRandomNeighbours) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 20; ++round) {
    const std::size_t n = std::vector<std::size_t>{2, 5, 9, 16}[static_cast<std::size_t>(round % 4)];
    const double unit = std::vector<double>{1, 1e-9, 1e6}[static_cast<std::size_t>(round % 3)];
    std::vector<Uncertain> quantities;
    std::vector<double> factors;
    double spread = 0, middle = 0;
    for (std::size_t q = 0; q < n; ++q) {
      const double size = unit * (1 + uniform(random)), tolerance = size * (0.01 + 0.14 * uniform(random));
      const Interval range(size - tolerance, size + tolerance);
      const int kind = static_cast<int>(3 * uniform(random));
      quantities.push_back(quantityOf(kind == 0   ? Distribution::uniform(range)
                                      : kind == 1 ? Distribution::normal(range, size, 0.4 * tolerance)
                                                  : Distribution::triangular(range, size - 0.5 * tolerance)));
      factors.push_back(uniform(random) < 0.5 ? 1.0 : -1.0);  // so that sums cancel
      spread += tolerance * tolerance / 5;
      middle += factors.back() * size;
    }
    const double limit = middle + (3 * uniform(random) - 1.5) * std::sqrt(spread);
    const int shape = round % 5;
    const Chain chain(quantities, 1, [&](const auto& x, auto& y) {
      const auto sum = sumOf(x, factors);
      if (shape == 0) y[0] = limit - sum;
      if (shape == 1) y[0] = x[0] * x[1] / (quantities[0].nominal * quantities[1].nominal) - 1.0 + (limit - sum) / unit;
      if (shape == 2) y[0] = exp((limit - sum) / (10 * unit)) - 1.0;
      if (shape == 3) y[0] = (limit - sum) / unit + 0.2 * sqr((limit - sum) / (10 * unit));
      if (shape == 4) y[0] = (limit - sum) * x[0];
    });
    const RequirementFinding found = chain.examine();
    const Sampled sampled = sampledOf(chain, random);
    EXPECT_LE(found.probability.lower(), sampled.share + sampled.band) << round;
    EXPECT_GE(found.probability.upper(), sampled.share - sampled.band) << round;
    // Of 16 quantities by up to 15 % each terms of high order matter to the exponential function.
    EXPECT_LT(width(found.probability), shape == 2 && n == 16 ? 0.1 : 0.02) << round;
    EXPECT_LE(found.met, 1 - found.violated) << round;
  }
}

TEST(ToleranceChain, IsDecidedAtTheEnds) {
  const std::vector<Uncertain> quantities(20, quantityOf(Distribution::uniform({-0.1, 0.1})));
  const auto ask = [&](double limit) {
    return Chain(quantities, 1, [&](const auto& x, auto& y) { y[0] = limit - sumOf(x, std::vector<double>(20, 1.0)); })
        .examine();
  };
  EXPECT_TRUE(ask(2.0001).isAlwaysMet);
  EXPECT_TRUE(ask(-2.0001).isNeverMet);
  const RequirementFinding found = ask(1.9999);  // violated in one corner of 2^20, for certain
  EXPECT_FALSE(found.isAlwaysMet);
  ASSERT_EQ(found.violating.size(), 20U);
  double sum = 0;
  for (const double value : found.violating) sum += value;
  EXPECT_GT(sum, 1.9999);
  EXPECT_GT(found.probability.lower(), 1 - 1e-6);
}

}  // namespace
}  // namespace gamut::testing
