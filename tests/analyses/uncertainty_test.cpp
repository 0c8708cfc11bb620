// Distributions against closed forms, and membership functions whose cuts must be outward and nested, exactly.
#include "analyses/uncertainty.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "analyses/arbiter.hpp"

namespace gamut {
namespace {

using testing::DoubleNear;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::vector<Distribution> oneOfEach() {
  const Interval support(0.3, 2.1);
  return {Distribution::uniform(support), Distribution::triangular(support, 0.7),
          Distribution::normal(support, 1.0, 0.4), Distribution::beta(support, 2.5, 0.7),
          Distribution::lognormal(support, -0.2, 0.6)};
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

TEST(Membership, CutsContainTheExactFlanks) {
  const Membership m = Membership::trapezoidal(0.1, 0.7, 1.1, 1.3);
  for (int i = 1; i < 1000; ++i) {
    const double alpha = i / 1000.0;
    const Precise left = Precise(0.1) + Precise(alpha) * (Precise(0.7) - Precise(0.1));
    const Precise right = Precise(1.3) - Precise(alpha) * (Precise(1.3) - Precise(1.1));
    const Interval cut = m.cut(alpha);
    EXPECT_LE(Precise(cut.lower()), left) << alpha;
    EXPECT_GE(Precise(cut.upper()), right) << alpha;
    EXPECT_LE(width(cut), width(Interval(left.convert_to<double>(), right.convert_to<double>())) * (1 + 1e-14));
  }
}

TEST(Membership, GaussianCutsContainTheExactReach) {
  const Membership m = Membership::gaussian({-4.0, 4.0}, 0.1, 0.3);
  for (int i = 1; i < 1000; ++i) {
    const double alpha = i / 1000.0;
    const Precise reach = Precise(0.3) * sqrt(-2 * log(Precise(alpha)));
    EXPECT_LE(Precise(m.cut(alpha).lower()), Precise(0.1) - reach) << alpha;
    EXPECT_GE(Precise(m.cut(alpha).upper()), Precise(0.1) + reach) << alpha;
  }
}

TEST(Membership, CutsAreNestedFromTheSupportToTheCore) {
  for (const Membership& m : {Membership::triangular(0.1, 0.3, 0.7), Membership::trapezoidal(-0.1, 0.2, 0.3, 0.35),
                              Membership::gaussian({0.0, 0.9}, 0.3, 0.2)}) {
    EXPECT_TRUE(isEqual(m.cut(0), m.support())) << m.name();
    for (int i = 1; i <= 1000; ++i) EXPECT_TRUE(isSubset(m.cut(i / 1000.0), m.cut((i - 1) / 1000.0))) << m.name();
    EXPECT_EQ(m(m.cut(1).lower()), 1) << m.name();
    EXPECT_EQ(m(m.cut(1).upper()), 1) << m.name();
  }
}

TEST(Membership, AValueLiesInTheCutOfItsOwnMembership) {
  for (const Membership& m : {Membership::triangular(0.1, 0.3, 0.7), Membership::trapezoidal(-0.1, 0.2, 0.3, 0.35),
                              Membership::gaussian({0.0, 0.9}, 0.3, 0.2)})
    for (int i = 0; i <= 10000; ++i) {
      const double value = m.support().lower() + i * 1e-4 * (m.support().upper() - m.support().lower());
      if (contains(m.support(), value)) {
        EXPECT_TRUE(contains(m.cut(m(value)), value)) << m.name() << ' ' << value;
      }
    }
}

TEST(Membership, IsZeroOutsideTheSupportAndOneOnTheCore) {
  const Membership m = Membership::trapezoidal(1, 2, 3, 4);
  EXPECT_EQ(m(0.9), 0);
  EXPECT_EQ(m(4.1), 0);
  EXPECT_EQ(m(2.5), 1);
  EXPECT_THAT(m(1.5), DoubleNear(0.5, 1e-15));
  EXPECT_EQ(Membership::trapezoidal(1, 1, 4, 4)(1.0), 1);  // upright flanks: a plain interval
  EXPECT_EQ(Membership::gaussian({0.0, 1.0}, 0.5, 10)(1.1), 0);
}

TEST(Membership, RefusesValuesOutOfOrder) {
  EXPECT_THROW(Membership::triangular(0, 2, 1), std::invalid_argument);
  EXPECT_THROW(Membership::trapezoidal(0, 2, 1, 3), std::invalid_argument);
  EXPECT_THROW(Membership::gaussian({0.0, 1.0}, 2.0, 0.1), std::invalid_argument);
  EXPECT_THROW(Membership::gaussian({0.0, 1.0}, 0.5, 0), std::invalid_argument);
  EXPECT_THROW(Membership::triangular(0, 1, 2).cut(1.1), std::invalid_argument);
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
