// Angles of two coordinates on the negative axis, for numbers.
#include "scalars/program/angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scalars/evaluation/evaluate.hpp"
#include "scalars/recorded.hpp"

namespace gamut::angles_test {
namespace {

TEST(HalfTurns, HaveAValueOnTheNegativeAxisAndAllDigitsBesideIt) {
  const Program g = record(2, 1, 3, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = atan2(x[0], x[1]);
    y[1] = atan2(x[0] * p[0], -x[1]) + 1.0;
    y[2] = atan2(atan2(x[0], x[1]), -2.0 * p[0] + x[0]);  // an angle of an angle
  });
  const Program turned = withHalfTurns(g);
  ASSERT_EQ(halfAnglesOf(g).size(), 3u);
  for (const double y : {0.0, 1e-300, -1e-9, 0.5, -2.0})
    for (const double x : {1.0, -1.0, 1e-100, -3.5}) {
      const std::vector<double> plain = evaluate<double>(g, std::vector{y, x}, std::vector{2.0}, 0.0),
                                found = evaluate<double>(turned, std::vector{y, x}, std::vector{2.0}, 0.0);
      for (const double angle : found) ASSERT_TRUE(std::isfinite(angle)) << y << " " << x;
      if (x > 0) {
        EXPECT_EQ(found[0], plain[0]) << y << " " << x;
      }
      EXPECT_NEAR(found[0], std::atan2(y, x), 1e-15);
      EXPECT_NEAR(found[1] - 1, std::atan2(2 * y, -x), 1e-15);
    }
  EXPECT_TRUE(std::isnan(evaluate<double>(turned, std::vector{0.0, 0.0}, std::vector{2.0}, 0.0)[0]));
  // Signs move outwards, squares of numbers are numbers, and a factor of 1 is none.
  const Program written = record(2, 0, 5, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = atan2(-x[0], -x[1]);
    y[1] = atan2(x[0], Recorded(-1.0));
    y[2] = atan2(-3.0 * x[0] * x[1], Recorded(-0.5));
    y[3] = atan2(Recorded(1.0), -x[1]);
    y[4] = atan2(Recorded(-0.25), -x[1]);
  });
  ASSERT_EQ(halfAnglesOf(written).size(), 5u);
  for (const double y : {0.0, 1e-300, -1e-9, 0.5, -2.0})
    for (const double x : {1.0, 1e9, 3.5}) {
      const std::vector<double> found = evaluate<double>(withHalfTurns(written), std::vector{y, x});
      EXPECT_NEAR(found[0], std::atan2(0 - y, -x), 1e-15);
      EXPECT_NEAR(found[1], std::atan2(y, -1), 1e-15);
      EXPECT_NEAR(found[2], std::atan2(0 - 3 * y * x, -0.5), 1e-15);
      EXPECT_NEAR(found[3], std::atan2(1, -x), 1e-15);
      EXPECT_NEAR(found[4], std::atan2(-0.25, -x), 1e-15);
    }
  // No length: what only looks like an angle stays.
  const Program other = record(2, 0, 1, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = atan(x[0] * sqr(1.0 / sqrt(x[1] + sqrt(sqr(x[0]) + 4.0))));
  });
  EXPECT_EQ(evaluate<double>(withHalfTurns(other), std::vector{1.0, -2.0}),
            evaluate<double>(other, std::vector{1.0, -2.0}));
  const Program none = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = atan(x[0]); });
  EXPECT_EQ(withHalfTurns(none).nodes().size(), none.nodes().size());
}

}  // namespace
}  // namespace gamut::angles_test
