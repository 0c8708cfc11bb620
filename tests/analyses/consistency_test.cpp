// Probability and possibility that are made from each other never contradict.
#include "analyses/consistency.hpp"

#include <gmock/gmock.h>

#include <random>
#include <vector>

namespace gamut {
namespace {

std::vector<Distribution> distributions() {
  const Interval support(0.3, 2.1);
  return {Distribution::uniform(support),
          Distribution::triangular(support, 0.7),
          Distribution::normal(support, 1, 0.4),
          Distribution::beta(support, 0.5, 0.7),
          Distribution::gamma(support, 2.5, 0.5),
          Distribution::histogram({0.3, 0.5, 0.9, 0.9, 1.4, 2.1}, {1, 4, 0.5, 0, 2}),
          Distribution::empirical({0.3, 0.4, 0.4, 0.4, 1.9, 2.1})};
}

std::vector<Membership> memberships() {
  return {Membership::triangular(0.3, 0.7, 2.1),
          Membership::triangular(0.3, 0.3, 2.1),
          Membership::trapezoidal(0.3, 0.5, 1.5, 2.1),
          Membership::gaussian({0.3, 2.1}, 0.9, 0.3),
          Membership::table({{0.3, 0}, {0.5, 0.2}, {0.5, 0.9}, {1.1, 1}, {2.0, 0.4}, {2.1, 0}}),
          Membership::table({{0, 0}, {1, 0.001}, {1, 1}}),
          Membership::table({{0, 0}, {0.5, 0.5}, {0.5, 1}, {0.5, 0.5}, {1, 0}})};
}

/// The probability of a cut, at least.
double probabilityOf(const Distribution& d, const Interval& cut) {
  const double below =
      cut.lower() <= d.support().lower() ? 0 : d.enclosedBelow(std::nextafter(cut.lower(), -10)).upper();
  return d.enclosedBelow(cut.upper()).lower() - below;
}

TEST(Consistency, NoCutLeavesOutMoreThanItsLevel) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution level(0.0, 1.0);
  for (const Distribution& d : distributions())
    for (const double centre : {0.3, 0.4, 0.9, 2.1}) {
      const Membership m = membershipOf(d, centre);
      EXPECT_EQ(m(centre), 1) << d.name();
      EXPECT_TRUE(isSubset(m.support(), d.support()));
      for (int i = 0; i < 500; ++i) {
        const double alpha = i == 0 ? 1 : level(engine), inside = probabilityOf(d, m.cut(alpha));
        EXPECT_GE(inside, 1 - alpha) << d.name() << ' ' << centre << ' ' << alpha;
      }
      EXPECT_LE(inconsistency(d, m), 1.0 / 256 + 1e-12) << d.name() << ' ' << centre;
    }
}

TEST(Consistency, TheCutsOfAContinuousDistributionLeaveOutAboutTheirLevel) {
  const Distribution d = Distribution::normal({-4, 4}, 0, 1);
  const Membership m = membershipOf(d, 0);
  for (const double alpha : {0.05, 0.3172, 0.9}) EXPECT_LE(probabilityOf(d, m.cut(alpha)), 1 - alpha + 2.0 / 256);
  EXPECT_NEAR(m.cut(0.3173).upper(), 1, 0.02);
}

TEST(Consistency, ADistributionFromAMembershipIsNoMoreProbableThanPossible) {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution level(0.0, 1.0);
  for (const Membership& m : memberships()) {
    const Distribution d = distributionOf(m);
    EXPECT_TRUE(isSubset(d.support(), m.support()));
    for (int i = 0; i < 500; ++i) {
      const double alpha = level(engine);
      EXPECT_GE(probabilityOf(d, m.cut(alpha)), 1 - alpha - 0x1p-38) << m.name() << ' ' << alpha;
    }
    if (m.core().lower() < m.core().upper() || m(std::nextafter(m.core().lower(), 0)) > 0.99) {
      EXPECT_LE(inconsistency(d, m), 1.0 / 256 + 1e-9) << m.name();
    }
  }
}

TEST(Consistency, OfATriangleItIsTheLogarithm) {  // the density at distance t from the apex is -log t / 2
  const Distribution d = distributionOf(Membership::triangular(-1, 0, 1));
  for (const double t : {0.1, 0.5, 0.9})
    EXPECT_NEAR(midpoint(d.enclosedBelow(t)), 0.5 + 0.5 * (t - t * std::log(t)), 0.003) << t;
}

TEST(Consistency, SaysByHowMuchProbabilityExceedsPossibility) {
  const Interval support(0, 1);
  EXPECT_NEAR(inconsistency(Distribution::uniform(support), Membership::triangular(0, 0.5, 1)), 0, 1.0 / 256 + 1e-12);
  // P(|X - 0.5| > 0.25) = 1/2, and no value beyond is more possible than 1/2 + 1/4 - 1/4.
  EXPECT_NEAR(inconsistency(Distribution::uniform(support), Membership::triangular(0.4, 0.5, 0.6)), 0.8, 0.005);
  // Of F the regularised incomplete beta function, the greatest 2 F(0.5 - d) - (1 - 2 d) is 0.48471 at d = 0.436.
  const double ofBeta = inconsistency(Distribution::beta(support, 0.2, 0.2), Membership::triangular(0, 0.5, 1));
  EXPECT_GE(ofBeta, 0.48470);
  EXPECT_LE(ofBeta, 0.48472 + 1.0 / 256);
}

}  // namespace
}  // namespace gamut
