// Parts of cubes against closed forms, against each other, and against points drawn in them.
#include "analyses/requirements/cube.hpp"

#include <gmock/gmock.h>

#include <random>

namespace gamut {
namespace {

TEST(PartOfCube, IsThatOfClosedForms) {
  EXPECT_TRUE(isEqual(partOfCube({}, 1e-300), Interval(1.0)));
  EXPECT_TRUE(isEqual(partOfCube({}, 0.0), Interval(0.0, 1.0)));  // < or <=, nobody says
  EXPECT_TRUE(isEqual(partOfCube({}, -1e-300), Interval(0.0)));
  EXPECT_TRUE(contains(partOfCube({2.0}, 1.0), 0.75));
  EXPECT_TRUE(contains(partOfCube({-2.0}, 1.0), 0.75));
  EXPECT_TRUE(contains(partOfCube({1.0, 1.0}, -1.0), 0.125));
  EXPECT_TRUE(contains(partOfCube({1.0, -1.0, 1.0}, -2.0), 1.0 / 48));
  EXPECT_TRUE(contains(partOfCube({1.0, 1.0, 1.0, 1.0}, 0.0), 0.5));
  EXPECT_LT(width(partOfCube({1.0, 0.7, 0.4, 1.3}, 0.3)), 1e-12);
  for (const double unit : {1e-290, 1e-9, 1e12, 1e290}) {
    const Interval part = partOfCube({unit, unit, -unit, 0.5 * unit}, 0.25 * unit);
    EXPECT_TRUE(contains(part, midpoint(partOfCube({1.0, 1.0, -1.0, 0.5}, 0.25)))) << unit;
    EXPECT_LT(width(part), 1e-12) << unit;
  }
  EXPECT_TRUE(isEqual(partOfCube({1.0, 2.0}, 3.0), Interval(1.0)));
  EXPECT_TRUE(isEqual(partOfCube({1.0, 2.0}, -3.0), Interval(0.0)));
}

TEST(PartOfCube, HoldsTheShareOfPointsDrawn) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> anywhere(-1, 1);
  for (int round = 0; round < 40; ++round) {
    std::vector<double> slope(1 + engine() % 8);
    for (double& s : slope) s = anywhere(engine) * (engine() % 3 == 0 ? 1e-3 : 1.0);
    const double limit = anywhere(engine);
    const Interval part = partOfCube(slope, limit);
    int hits = 0;
    constexpr int count = 4000;
    for (int i = 0; i < count; ++i) {
      double sum = 0;
      for (const double s : slope) sum += s * anywhere(engine);
      hits += sum <= limit;
    }
    const double share = static_cast<double>(hits) / count, slack = 5 * 0.5 / std::sqrt(count);
    EXPECT_GT(share, part.lower() - slack);
    EXPECT_LT(share, part.upper() + slack);
    EXPECT_TRUE(isSubset(part, Interval(0.0, 1.0)));
    if (slope.size() <= 6) {
      EXPECT_LT(width(part), 0.1);
    }
  }
}

}  // namespace
}  // namespace gamut
