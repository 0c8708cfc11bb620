// Distributions against closed forms, and what is demanded of an uncertain quantity.
#include "analyses/uncertainty.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace gamut {
namespace {

using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

std::vector<Distribution> oneOfEach() {
  const Interval support(0.3, 2.1);
  return {Distribution::uniform(support),
          Distribution::triangular(support, 0.7),
          Distribution::normal(support, 1.0, 0.4),
          Distribution::beta(support, 2.5, 0.7),
          Distribution::lognormal(support, -0.2, 0.6),
          Distribution::weibull(support, 1.5, 0.8),
          Distribution::gamma(support, 2.5, 0.5),
          Distribution::exponential(support, 0.75),
          Distribution::histogram({0.3, 0.5, 0.9, 1.4, 2.1}, {1, 4, 0.5, 2}),
          Distribution::empirical({1.1, 0.3, 2.1, 0.4, 0.9, 1.0})};
}

/// "lower 0.3, upper 2.1, mode 0.7": the numbers as they are called; those without unit in parentheses.
std::string written(const std::vector<ShapeNumber>& numbers) {
  std::string text;
  for (const auto& [name, value, isOfQuantity] : numbers)
    text += (text.empty() ? "" : ", ") + name + " " + (isOfQuantity ? toString(value) : "(" + toString(value) + ")");
  return text;
}

TEST(Distribution, SaysOfWhichNumbersItIsMade) {
  std::vector<std::string> found;
  for (const Distribution& d : oneOfEach()) {
    std::vector<ShapeNumber> numbers = d.numbers();
    if (d.cutOff() > 0) {
      EXPECT_EQ(numbers.back().name, "cut_off");
      EXPECT_EQ(numbers.back().value, d.cutOff());
      numbers.pop_back();
    }
    found.push_back(written(numbers));
  }
  EXPECT_THAT(found, ::testing::ElementsAre(
                         "lower 0.3, upper 2.1", "lower 0.3, upper 2.1, mode 0.7",
                         "lower 0.3, upper 2.1, mean 1, deviation 0.4", "lower 0.3, upper 2.1, a (2.5), b (0.7)",
                         "lower 0.3, upper 2.1, log_mean (-0.2), log_deviation (0.6)",
                         "lower 0.3, upper 2.1, shape (1.5), scale 0.8", "lower 0.3, upper 2.1, shape (2.5), scale 0.5",
                         "lower 0.3, upper 2.1, mean 0.75",
                         "lower 0.3, upper 2.1, value 1 0.3, weight 1 (1), value 2 0.5, weight 2 (4), value 3 0.9, "
                         "weight 3 (0.5), value 4 1.4, weight 4 (2)",
                         "lower 0.3, upper 2.1, count (6), value 2 0.4, value 3 0.9, value 4 1, value 5 1.1"));
}

/// P(X > v) of the standard normal distribution.
double upperTail(double v) { return 0.5 * std::erfc(v / std::numbers::sqrt2); }

TEST(Distribution, UniformQuantilesAreEquallySpaced) {
  const Distribution d = Distribution::uniform({-1.0, 3.0});
  EXPECT_EQ(d.quantile(0.25), 0.0);
  EXPECT_EQ(d.quantile(0.75), 2.0);
}

TEST(Distribution, TriangularQuantilesFollowTheSquareRootLaw) {
  const Distribution d = Distribution::triangular({0.0, 4.0}, 1.0);
  EXPECT_THAT(d.quantile(0.25), DoubleNear(1.0, 1e-15));                       // the mode: (1-0)/(4-0)
  EXPECT_THAT(d.quantile(0.0625), DoubleNear(0.5, 1e-15));                     // v²/4
  EXPECT_THAT(d.quantile(0.7), DoubleNear(4.0 - std::sqrt(0.3 * 12), 1e-15));  // 1-(4-v)²/12
}

TEST(Distribution, TriangularWithItsModeAtAnEndIsOneFlank) {
  EXPECT_THAT(Distribution::triangular({0.0, 1.0}, 0.0).quantile(0.75), DoubleNear(0.5, 1e-15));
  EXPECT_THAT(Distribution::triangular({0.0, 1.0}, 1.0).quantile(0.25), DoubleNear(0.5, 1e-15));
}

TEST(Distribution, NormalWithAFarTruncationIsTheNormalDistribution) {
  const Distribution d = Distribution::normal({-60.0, 60.0}, 5.0, 2.0);
  EXPECT_THAT(d.quantile(0.975), DoubleNear(5 + 2 * 1.959963984540054, 1e-12));
  EXPECT_THAT(d.quantile(0.01), DoubleNear(5 - 2 * 2.326347874040841, 1e-12));
}

TEST(Distribution, NormalIsExactFarOutInEitherTail) {
  for (double side : {-1.0, 1.0}) {
    const Distribution d = Distribution::normal(side < 0 ? Interval(-9.0, -8.0) : Interval(8.0, 9.0), 0, 1);
    const double median = side * d.quantile(0.5);
    EXPECT_THAT(upperTail(median) / (0.5 * (upperTail(8) + upperTail(9))), DoubleNear(1, 1e-12));
  }
}

TEST(Distribution, BetaQuantilesMatchTheirClosedForms) {
  for (double u : {1e-6, 0.1, 0.5, 0.9, 0.999}) {
    EXPECT_THAT(Distribution::beta({0.0, 1.0}, 2, 1).quantile(u), DoubleNear(std::sqrt(u), 1e-14));
    EXPECT_THAT(Distribution::beta({2.0, 4.0}, 1, 3).quantile(u), DoubleNear(2 + 2 * (1 - std::cbrt(1 - u)), 1e-13));
    const double s = std::sin(0.5 * std::numbers::pi * u);
    EXPECT_THAT(Distribution::beta({0.0, 1.0}, 0.5, 0.5).quantile(u), DoubleNear(s * s, 1e-13));
  }
}

TEST(Distribution, LognormalQuantilesAreExponentialsOfNormalOnes) {
  const Distribution d = Distribution::lognormal({0.0, 1e12}, 0.5, 0.25);
  EXPECT_THAT(d.quantile(0.5), DoubleNear(std::exp(0.5), 1e-13));
  EXPECT_THAT(d.quantile(0.975), DoubleNear(std::exp(0.5 + 0.25 * 1.959963984540054), 1e-12));
}

TEST(Distribution, WeibullGammaAndExponentialMatchTheirClosedForms) {
  for (const double u : {0.01, 0.3, 0.5, 0.9, 0.999}) {
    const double tail = -std::log1p(-u);
    EXPECT_THAT(Distribution::weibull({0.0, 1e9}, 2.0, 3.0).quantile(u), DoubleNear(3 * std::sqrt(tail), 1e-13));
    EXPECT_THAT(Distribution::exponential({0.0, 1e9}, 3.0).quantile(u), DoubleNear(3 * tail, 1e-13));
    EXPECT_THAT(Distribution::gamma({0.0, 1e9}, 1.0, 3.0).quantile(u), DoubleNear(3 * tail, 1e-12));
    // Truncated to [2, 5]: P(v) = (e^(-2/3) - e^(-v/3))/(e^(-2/3) - e^(-5/3))
    const double v = Distribution::exponential({2.0, 5.0}, 3.0).quantile(u), from = std::exp(-2 / 3.0);
    EXPECT_THAT((from - std::exp(-v / 3)) / (from - std::exp(-5 / 3.0)), DoubleNear(u, 1e-14));
    // Far out nothing of the tail is lost.
    const double far = Distribution::exponential({300.0, 400.0}, 3.0).quantile(u);
    EXPECT_THAT(far, DoubleNear(300 - 3 * std::log1p(-u * -std::expm1(-100 / 3.0)), 1e-12));
  }
  // Gamma of shape 2: P(v) = 1 - (1 + v) e^(-v).
  const double v = Distribution::gamma({0.0, 100.0}, 2.0, 1.0).quantile(0.25);
  EXPECT_THAT(1 - (1 + v) * std::exp(-v), DoubleNear(0.25, 1e-14));
}

TEST(Distribution, PiecesAreEvenlyFilledAndEqualValuesHaveTheirWeight) {
  const Distribution d = Distribution::histogram({1, 2, 2, 4}, {1, 1, 2});
  EXPECT_EQ(d.quantile(0.125), 1.5);
  for (const double u : {0.25, 0.3, 0.5}) EXPECT_EQ(d.quantile(u), 2) << u;
  EXPECT_EQ(d.quantile(0.75), 3);
  EXPECT_TRUE(contains(d.enclosedBelow(1.5), 0.125));
  EXPECT_TRUE(contains(d.enclosedBelow(2), 0.5));
  EXPECT_LT(d.enclosedBelow(std::nextafter(2, 1)).upper(), 0.251);
  EXPECT_TRUE(contains(d.enclosedBelow(3), 0.75));
  const Distribution e = Distribution::empirical({3, 1, 2, 7});
  EXPECT_DOUBLE_EQ(e.quantile(0.5), 2.5);
  EXPECT_DOUBLE_EQ(e.quantile(5.0 / 6), 5);
  const Distribution all = Distribution::empirical({2, 2, 2});
  EXPECT_EQ(all.quantile(0.4), 2);
  EXPECT_TRUE(isEqual(all.enclosedBelow(2), Interval(1.0)));
}

TEST(Distribution, SaysHowMuchTruncationCutsOff) {
  EXPECT_EQ(Distribution::uniform({0.0, 1.0}).cutOff(), 0);
  EXPECT_EQ(Distribution::beta({0.0, 1.0}, 2, 3).cutOff(), 0);
  EXPECT_THAT(Distribution::normal({-1.0, 2.0}, 0, 1).cutOff(), DoubleNear(upperTail(1) + upperTail(2), 1e-15));
  EXPECT_THAT(Distribution::lognormal({0.0, 1.0}, 0, 1).cutOff(), DoubleNear(0.5, 1e-15));
  EXPECT_THAT(Distribution::exponential({1.0, 4.0}, 2).cutOff(),
              DoubleNear(1 - std::exp(-0.5) + std::exp(-2.0), 1e-15));
}

TEST(Distribution, QuantilesRiseFromOneEndOfTheSupportToTheOtherAndNeverLeaveIt) {
  for (const Distribution& d : oneOfEach()) {
    EXPECT_EQ(d.quantile(0), d.support().lower()) << d.name();
    EXPECT_EQ(d.quantile(1), d.support().upper()) << d.name();
    double before = d.support().lower();
    for (int i = 1; i < 1000; ++i) {
      const double value = d.quantile(i / 1000.0);
      EXPECT_TRUE(contains(d.support(), value)) << d.name();
      EXPECT_GT(value, before) << d.name();
      before = value;
    }
  }
}

TEST(Distribution, AThinSupportHasOneValue) {
  EXPECT_EQ(Distribution::normal(Interval(0.1), 0.1, 1.0).quantile(0.3), 0.1);
  EXPECT_EQ(Distribution::triangular(Interval(0.1), 0.1).quantile(0.3), 0.1);
}

TEST(Distribution, RefusesWhatIsNoDistribution) {
  EXPECT_THROW(Distribution::uniform(Interval::entire()), std::invalid_argument);
  EXPECT_THROW(Distribution::triangular({0.0, 1.0}, 2.0), std::invalid_argument);
  EXPECT_THROW(Distribution::normal({0.0, 1.0}, 0.5, 0.0), std::invalid_argument);
  EXPECT_THROW(Distribution::beta({0.0, 1.0}, -1, 2), std::invalid_argument);
  EXPECT_THROW(Distribution::lognormal({-1.0, 1.0}, 0, 1), std::invalid_argument);
  EXPECT_THROW(Distribution::uniform({0.0, 1.0}).quantile(1.5), std::invalid_argument);
  EXPECT_THROW(Distribution::weibull({-1.0, 1.0}, 1, 1), std::invalid_argument);
  EXPECT_THROW(Distribution::weibull({0.0, 1.0}, 0, 1), std::invalid_argument);
  EXPECT_THROW(Distribution::gamma({0.0, 1.0}, 1, -1), std::invalid_argument);
  EXPECT_THROW(Distribution::exponential({0.0, 1.0}, 0), std::invalid_argument);
  EXPECT_THROW(Distribution::exponential({1e6, 2e6}, 1), std::invalid_argument);
  EXPECT_THAT(
      [] {
        Distribution::triangular({0.0, 1e-9}, 2e-9);
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("the mode 2e-09 of")));
  EXPECT_THAT(
      [] {
        Distribution::normal({100.0, 101.0}, 0, 1);
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("no mass on its support [100")));
}

TEST(Uncertain, NamesTheQuantityWhoseViewsLeaveItsInterval) {
  const Interval range(0.0, 1.0);
  const Distribution d = Distribution::uniform(range);
  const Membership m = Membership::triangular(0, 0.5, 1);
  EXPECT_NO_THROW((Uncertain{"mass", range, 0.5, d, m}.check()));
  EXPECT_THAT(([&] {
                Uncertain{"mass", range, 1.5, d, m}.check();
              }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("'mass': the nominal value")));
  EXPECT_THAT(([&] {
                Uncertain{"mass", range, 0.5, Distribution::uniform({0.0, 1.1}), m}.check();
              }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("'mass': the distribution")));
  EXPECT_THAT(([&] {
                Uncertain{"mass", range, 0.5, d, Membership::triangular(-1, 0, 1)}.check();
              }),
              ThrowsMessage<std::invalid_argument>(HasSubstr("'mass': the membership")));
}

}  // namespace
}  // namespace gamut
