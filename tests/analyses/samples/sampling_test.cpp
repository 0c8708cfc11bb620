// Sampling plans: where the points lie, and that seed and number alone decide it.
#include "analyses/samples/sampling.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <stdexcept>
#include <vector>

namespace gamut {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr Plan allPlans[] = {Plan::sobol, Plan::random, Plan::latinHypercube, Plan::halton, Plan::grid};

std::vector<Uncertain> unitQuantities(std::size_t count) {
  const Uncertain one{"q", {0.0, 1.0}, 0.25, Distribution::uniform({0.0, 1.0}), Membership::triangular(0, 0.25, 1)};
  return std::vector<Uncertain>(count, one);
}

TEST(Sampling, EveryPlanStaysInTheUnitCube) {
  for (Plan plan : allPlans) {
    Sampling s(plan, 3, 512, 7);
    EXPECT_EQ(s.samples(), 512u) << nameOf(plan);  // 8³: the grid too
    for (std::size_t i = 0; i < s.samples(); ++i)
      EXPECT_THAT(s.unitPoint(i), Each(::testing::AllOf(::testing::Ge(0), ::testing::Le(1)))) << nameOf(plan);
  }
}

TEST(Sampling, EveryPlanSpreadsItsPointsOverAllEighths) {
  for (Plan plan : allPlans) {
    Sampling s(plan, 3, 512, 7);
    std::vector<int> count(8, 0);
    for (std::size_t i = 0; i < s.samples(); ++i) {
      const std::vector<double> u = s.unitPoint(i);
      ++count[static_cast<std::size_t>((u[0] > 0.5) + 2 * (u[1] > 0.5) + 4 * (u[2] > 0.5))];
    }
    EXPECT_THAT(count, Each(::testing::AllOf(::testing::Gt(35), ::testing::Lt(95)))) << nameOf(plan);  // 64 expected
  }
}

TEST(Sampling, LowDiscrepancyIntegratesBetterThanRandomPoints) {
  const auto meanError = [](Plan plan) {  // of the mean of u0 u1 u2, which is 1/8, over ten seeds
    double squares = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Sampling s(plan, 3, 1024, seed);
      double sum = 0;
      for (std::size_t i = 0; i < 1024; ++i) {
        const std::vector<double> u = s.unitPoint(i);
        sum += u[0] * u[1] * u[2];
      }
      squares += std::pow(sum / 1024 - 0.125, 2);
    }
    return std::sqrt(squares / 10);
  };
  EXPECT_LT(meanError(Plan::sobol), 0.2 * meanError(Plan::random));
  EXPECT_LT(meanError(Plan::halton), 0.3 * meanError(Plan::random));
}

TEST(Sampling, SameSeedGivesTheSamePointsAndAnotherSeedGivesOthers) {
  for (Plan plan : allPlans) {
    Sampling a(plan, 2, 64, 5), b(plan, 2, 64, 5), c(plan, 2, 64, 6);
    EXPECT_EQ(a.unitPoint(17), b.unitPoint(17)) << nameOf(plan);
    if (plan != Plan::grid) {
      EXPECT_NE(a.unitPoint(17), c.unitPoint(17)) << nameOf(plan);
    }
  }
}

TEST(Sampling, MoreSamplesKeepTheFirstOnesOfASequence) {
  for (Plan plan : {Plan::sobol, Plan::random, Plan::halton}) {
    Sampling few(plan, 3, 10, 5), many(plan, 3, 1000, 5);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(few.unitPoint(i), many.unitPoint(i)) << nameOf(plan);
  }
}

/// The points that an axis's 2^m strata hold, each of 2^m points.
std::vector<int> pointsOfStrata(const std::vector<double>& coordinates) {
  std::vector<int> count(coordinates.size(), 0);
  for (double u : coordinates) ++count[static_cast<std::size_t>(u * static_cast<double>(count.size()))];
  return count;
}

TEST(Sampling, SobolsPlanOfManyQuantitiesHasOnePointOfABatchInEveryStratumOfEveryAxis) {
  constexpr std::size_t inBatch = 64;
  for (const std::size_t k : {41U, 60U, 1000U}) {
    Sampling s(Plan::sobol, k, inBatch * batchCount, 5);
    std::vector<std::vector<double>> points;
    for (std::size_t i = 0; i < s.samples(); ++i) points.push_back(s.unitPoint(i));
    for (std::size_t batch = 0; batch < batchCount; ++batch)
      for (std::size_t j = 0; j < k; ++j)
        for (const std::size_t first : {inBatch, inBatch / 2, inBatch / 4}) {  // so have the first of them
          std::vector<double> axis;
          for (std::size_t i = 0; i < first; ++i) axis.push_back(points[batch + i * batchCount][j]);
          ASSERT_THAT(pointsOfStrata(axis), Each(1)) << k << ' ' << batch << ' ' << j << ' ' << first;
        }
  }
}

TEST(Sampling, AnyTwoOfSixtyQuantitiesMeetInEveryQuarterAsOften) {
  constexpr std::size_t k = 60, n = 1024;
  Sampling s(Plan::sobol, k, n * batchCount, 11);
  std::vector<std::vector<double>> points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(s.unitPoint(i * batchCount));  // of the first batch
  for (std::size_t a = 0; a < k; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      std::vector<std::size_t> count(4, 0);
      for (const std::vector<double>& u : points) ++count[static_cast<std::size_t>((u[a] >= 0.5) + 2 * (u[b] >= 0.5))];
      EXPECT_THAT(count, Each(n / 4)) << a << ' ' << b;
    }
}

TEST(Sampling, PointsOfManyQuantitiesFollowFromTheirNumbersAlone) {
  for (const std::size_t k : {41U, 60U, 1000U}) {
    Sampling few(Plan::sobol, k, 40, 5), many(Plan::sobol, k, 1000, 5), other(Plan::sobol, k, 1000, 6);
    std::set<double> first;
    for (std::size_t i = 0; i < few.samples(); ++i) {
      const std::vector<double> point = few.unitPoint(i);
      EXPECT_EQ(many.unitPoint(i), point) << k << ' ' << i;
      EXPECT_EQ(Sampling(Plan::sobol, k, 1000, 5).unitPoint(i), point) << k << ' ' << i;  // alone
      EXPECT_NE(other.unitPoint(i), point) << k << ' ' << i;
      first.insert(point.front());
    }
    EXPECT_EQ(first.size(), few.samples());
  }
}

/// Results that were stored are extended, and their samples replayed, from such points.
TEST(Sampling, SobolsPointsOfUpToFortyQuantitiesStayWhereTheyAre) {
  Sampling one(Plan::sobol, 1, 4096, 7);
  Sampling forty(Plan::sobol, 40, 4096, 7);
  EXPECT_EQ(one.unitPoint(0).front(), 0x1.b70d8769c6c92p-1);
  EXPECT_EQ(one.unitPoint(1000).front(), 0x1.6b9edb256d4f2p-1);
  EXPECT_EQ(forty.unitPoint(0).front(), 0x1.b70d8769c6c92p-1);
  EXPECT_EQ(forty.unitPoint(0).back(), 0x1.2064d839256bdp-2);
  EXPECT_EQ(forty.unitPoint(1000).front(), 0x1.6b9edb256d4f2p-1);
  EXPECT_EQ(forty.unitPoint(1000).back(), 0x1.b7fa721a0ff6bp-1);
}

TEST(Sampling, EveryBatchOfALatinHypercubeHasOnePointInEveryStratumOfEveryAxis) {
  for (const std::size_t n : {25u, 1600u}) {  // fewer than 32 are one batch
    const std::size_t batches = n < 32 ? 1 : batchCount, size = n / batches;
    Sampling s(Plan::latinHypercube, 4, n, 3);
    for (std::size_t batch = 0; batch < batches; ++batch)
      for (std::size_t j = 0; j < 4; ++j) {
        std::set<int> strata;
        for (std::size_t i = batch; i < n; i += batches)
          strata.insert(static_cast<int>(std::floor(s.unitPoint(i)[j] * static_cast<double>(size) + 1e-9)));
        EXPECT_EQ(strata.size(), size);
        EXPECT_EQ(*strata.begin(), 0);
        EXPECT_EQ(*strata.rbegin(), static_cast<int>(size) - 1);
      }
  }
}

TEST(Sampling, BatchesAreOfEqualSizeAndNoneIsAnotherShifted) {
  for (const Plan plan : {Plan::sobol, Plan::halton, Plan::latinHypercube}) {
    EXPECT_EQ(Sampling(plan, 2, 1000, 5).samples(), 1008u) << nameOf(plan);
    EXPECT_EQ(Sampling(plan, 2, 31, 5).samples(), 31u) << nameOf(plan);
    Sampling s(plan, 2, 256, 5);
    std::set<double> first;
    for (std::size_t batch = 0; batch < batchCount; ++batch) first.insert(s.unitPoint(batch)[0]);
    EXPECT_EQ(first.size(), batchCount) << nameOf(plan);
  }
  EXPECT_EQ(Sampling(Plan::random, 2, 1000, 5).samples(), 1000u);
}

TEST(Sampling, EveryDigitOfHaltonsSequenceIsAsProbable) {
  int below = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 20000; ++seed) {
    Sampling s(Plan::halton, 2, 16, seed);
    for (std::size_t i = 0; i < 16; ++i, ++all) below += s.unitPoint(i)[1] < 1.0 / 3;  // of base 3
  }
  EXPECT_NEAR(static_cast<double>(below) / all, 1.0 / 3, 0.0033);  // four deviations
}

TEST(Sampling, AGridHasBothEndsOfEveryAxisAndEveryCombination) {
  Sampling s(Plan::grid, 2, 10, 0);
  EXPECT_EQ(s.samples(), 16u);  // 4² is the least square of at least 10
  EXPECT_THAT(s.unitPoint(0), ElementsAre(0, 0));
  EXPECT_THAT(s.unitPoint(1), ElementsAre(1.0 / 3, 0));
  EXPECT_THAT(s.unitPoint(15), ElementsAre(1, 1));
  std::set<std::vector<double>> points;
  for (std::size_t i = 0; i < 16; ++i) points.insert(s.unitPoint(i));
  EXPECT_EQ(points.size(), 16u);
}

TEST(Sampling, AGridOfExactlyTheSamplesAskedForIsNotEnlarged) {
  EXPECT_EQ(Sampling(Plan::grid, 1, 101, 0).samples(), 101u);
  EXPECT_EQ(Sampling(Plan::grid, 3, 1000, 0).samples(), 1000u);
  EXPECT_EQ(Sampling(Plan::grid, 3, 1, 0).samples(), 8u);  // both ends at least
}

TEST(Sampling, UpToTenQuantitiesHaveAllCornersOfTheBox) {
  Sampling s(Plan::sobol, 10, 5, 0);
  EXPECT_EQ(s.corners(), 1024u);
  std::set<std::vector<double>> corners;
  for (std::size_t i = s.samples(); i < s.centre(); ++i) {
    EXPECT_THAT(s.unitPoint(i), Each(::testing::AnyOf(0, 1)));
    corners.insert(s.unitPoint(i));
  }
  EXPECT_EQ(corners.size(), 1024u);
}

TEST(Sampling, ManyQuantitiesHaveCornersInWhichAnyThreeMeetInAllCombinationsEquallyOften) {
  Sampling s(Plan::sobol, 30, 5, 0);
  ASSERT_EQ(s.corners(), 1024u);
  for (std::size_t a = 0; a < 30; ++a)
    for (std::size_t b = a + 1; b < 30; ++b) {
      const std::size_t c = (b * 7 + 3) % 30;
      if (c == a || c == b) continue;
      std::vector<int> count(8, 0);
      for (std::size_t i = s.samples(); i < s.centre(); ++i) {
        const std::vector<double> u = s.unitPoint(i);
        ++count[static_cast<std::size_t>(u[a] + 2 * u[b] + 4 * u[c])];
      }
      EXPECT_THAT(count, Each(128)) << a << ' ' << b << ' ' << c;
    }
}

TEST(Sampling, ValuesAreQuantilesThenCornersThenTheNominalCentre) {
  Sampling s(Plan::sobol, 2, 16, 9);
  const std::vector<Uncertain> q = unitQuantities(2);
  EXPECT_EQ(s.values(3, q), s.unitPoint(3));  // uniform on [0, 1]
  EXPECT_THAT(s.values(16, q), ElementsAre(0, 0));
  EXPECT_THAT(s.values(17, q), ElementsAre(1, 0));
  EXPECT_THAT(s.values(19, q), ElementsAre(1, 1));
  EXPECT_EQ(s.centre(), 20u);
  EXPECT_THAT(s.values(20, q), ElementsAre(0.25, 0.25));
}

TEST(Sampling, BoxesInsideHaveTheirCornersBetweenThoseOfTheRangesAndTheCentre) {
  Sampling s(Plan::sobol, 2, 16, 9, {{{0.25, 0.75}, {0.5, 0.625}}, {{0.375, 0.5}, {0.5, 0.5}}});
  const std::vector<Uncertain> q = unitQuantities(2);
  EXPECT_EQ(s.boxCorners(), 8u);
  EXPECT_EQ(s.centre(), 28u);
  EXPECT_THAT(s.values(19, q), ElementsAre(1, 1));
  EXPECT_THAT(s.values(20, q), ElementsAre(0.25, 0.5));
  EXPECT_THAT(s.values(21, q), ElementsAre(0.75, 0.5));
  EXPECT_THAT(s.values(23, q), ElementsAre(0.75, 0.625));
  EXPECT_THAT(s.values(25, q), ElementsAre(0.5, 0.5));
  EXPECT_THAT(s.values(28, q), ElementsAre(0.25, 0.25));
  EXPECT_THROW(Sampling(Plan::sobol, 2, 16, 9, {{{0.25, 0.75}}}), std::invalid_argument);
}

TEST(Sampling, ManyBoxesHaveAllCornersOfAFewQuantitiesAndNoMoreThan1024OfMany) {
  const auto boxCorners = [](std::size_t quantities, std::size_t boxes) {
    return Sampling(Plan::sobol, quantities, 16, 9, std::vector<Box>(boxes, Box(quantities, Interval(0.25, 0.75))))
        .boxCorners();
  };
  EXPECT_EQ(boxCorners(6, 16), 16u * 64u);
  EXPECT_EQ(boxCorners(7, 9), 9u * 64u);
  EXPECT_EQ(boxCorners(30, 1), 1024u);
  EXPECT_EQ(boxCorners(30, 99), 99u * 8u);
}

TEST(Sampling, PointsAreTheSameInWhateverOrderTheyAreAskedFor) {
  for (Plan plan : allPlans) {
    Sampling up(plan, 3, 100, 5), down(plan, 3, 100, 5);
    std::vector<std::vector<double>> points;
    for (std::size_t i = 0; i < 100; ++i) points.push_back(up.unitPoint(i));
    for (std::size_t i = 100; i-- > 0;) EXPECT_EQ(down.unitPoint(i), points[i]) << nameOf(plan) << i;
  }
}

TEST(Sampling, ALatinHypercubesAxesAreIndependentOfEachOther) {
  Sampling s(Plan::latinHypercube, 5, 4096, 3);
  std::vector<double> products(25, 0);
  for (std::size_t i = 0; i < 4096; ++i) {
    const std::vector<double> u = s.unitPoint(i);
    for (std::size_t a = 0; a < 5; ++a)
      for (std::size_t b = 0; b < 5; ++b) products[5 * a + b] += 12 * (u[a] - 0.5) * (u[b] - 0.5) / 4096;
  }
  for (std::size_t a = 0; a < 5; ++a)
    for (std::size_t b = 0; b < 5; ++b)
      EXPECT_NEAR(products[5 * a + b], a == b ? 1 : 0, a == b ? 5e-4 : 4.0 / 64) << a << b;  // four deviations
}

TEST(Sampling, WithoutUncertainQuantitiesThereIsOneSample) {
  Sampling s(Plan::sobol, 0, 100, 1);
  EXPECT_EQ(s.samples(), 1u);
  EXPECT_EQ(s.size(), 2u);
  EXPECT_TRUE(s.values(1, {}).empty());
}

TEST(Sampling, SaysWhichPlanCannotServeSoManyQuantities) {
  EXPECT_NO_THROW(Sampling(Plan::sobol, mostQuantities(Plan::sobol), 4, 1));
  EXPECT_THAT(
      [] { Sampling(Plan::sobol, 3668, 4, 1); },
      ThrowsMessage<std::invalid_argument>(HasSubstr("'sobol' serves at most 3667 uncertain quantities, not 3668")));
  EXPECT_NO_THROW(Sampling(Plan::halton, 1229, 4, 1));
  EXPECT_THAT([] { Sampling(Plan::halton, 1230, 4, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("at most 1229")));
  EXPECT_THAT([] { Sampling(Plan::grid, 25, 4, 1); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("too many points")));
}

TEST(Sampling, PlansAreKnownByName) {
  for (Plan plan : allPlans) EXPECT_EQ(planNamed(nameOf(plan)), plan);
  EXPECT_THAT([] { planNamed("sobel"); }, ThrowsMessage<std::invalid_argument>(HasSubstr("latin-hypercube")));
}

}  // namespace
}  // namespace gamut
