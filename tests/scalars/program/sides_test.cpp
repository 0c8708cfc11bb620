// Jumps on one side, on the other, and held between.
#include "scalars/program/sides.hpp"

#include <gtest/gtest.h>

#include "scalars/evaluation/evaluate.hpp"
#include "scalars/recorded.hpp"

namespace gamut::testing {
namespace {

/// A mass on a spring that rubs: states x, v; parameter c.
Program rubbing() {
  return record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -(p[0] * x[0]) - 3.0 * sign(x[1]);
  });
}

TEST(Sides, AboveAndBelowAreTheTwoSides) {
  const Program f = rubbing();
  ASSERT_EQ(jumpsOf(f).size(), 1u);
  const std::vector<double> x{0.5, 0.0}, p{2.0};
  for (const Side side : {Side::below, Side::between, Side::above}) {
    const double s = static_cast<double>(side);
    EXPECT_EQ(evaluate<double>(onSides(f, std::vector{side}), x, p, 0.0), (std::vector{0.0, -1.0 - 3 * s, 0.0, s}));
  }
}

TEST(Sides, HeldIsTheMeanThatStays) {
  const std::vector<double> x{0.5, 0.0}, p{2.0};
  const std::vector<double> y = evaluate<double>(onSides(rubbing(), std::vector{Side::held}), x, p, 0.0);
  EXPECT_EQ(y[0], 0);
  EXPECT_NEAR(y[1], 0, 1e-16);
  EXPECT_NEAR(y[3], -1.0 / 3, 1e-16);
}

TEST(Sides, RatesOfArgumentsAreAlongTheMotion) {
  const Program f = record(2, 0, [](auto t, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -x[0] - sign(x[1] - x[0] * t);
  });
  const std::vector<double> y =
      evaluate<double>(withSignsGiven(f), std::vector{2.0, 3.0}, std::vector{0.5}, 5.0);  // s = 0.5
  EXPECT_EQ(y, (std::vector{3.0, -2.5, -7.0, -2.5 - 3.0 * 5.0 - 2.0}));
}

/// Two rubbing masses that one matrix couples: M v' = F - μ sign(v).
TEST(Sides, SeveralAreHeldAtOnce) {
  const Program f = record(2, 2, [](auto, const auto& v, const auto& p, auto& dv) {
    const auto a = p[0] - 2.0 * sign(v[0]), b = p[1] - 4.0 * sign(v[1]);  // inverse of [[2, 1], [1, 1]]
    dv[0] = a - b;
    dv[1] = 2.0 * b - a;
  });
  const std::vector<double> v{0.0, 0.0}, p{1.0, -3.0};
  const std::vector<double> both = evaluate<double>(onSides(f, std::vector{Side::held, Side::held}), v, p, 0.0);
  EXPECT_NEAR(both[0], 0, 1e-15);
  EXPECT_NEAR(both[1], 0, 1e-15);
  EXPECT_NEAR(both[4], 0.5, 1e-15);
  EXPECT_NEAR(both[5], -0.75, 1e-15);
  const std::vector<double> one =
      evaluate<double>(onSides(f, std::vector{Side::above, Side::held}), v, p, 0.0);  // a = -1: 2b = a
  EXPECT_NEAR(one[0], -0.5, 1e-15);
  EXPECT_NEAR(one[1], 0, 1e-15);
  EXPECT_NEAR(one[5], (-3.0 + 0.5) / 4, 1e-15);
}

TEST(Sides, ProductsOfSignsAreNotAffine) {
  const auto isAffine = [](const auto& formula) {
    return isAffineInSigns(record(2, 0, [&](auto, const auto& x, const auto&, auto& dx) {
      dx[0] = x[1];
      dx[1] = formula(x);
    }));
  };
  EXPECT_TRUE(isAffine([](const auto& x) { return -x[0] * sign(x[1]) - 2.0 * sign(x[0]); }));
  EXPECT_TRUE(isAffine([](const auto& x) { return sin(x[0]); }));
  EXPECT_FALSE(isAffine([](const auto& x) { return sign(x[0]) * sign(x[1]); }));
  EXPECT_FALSE(isAffine([](const auto& x) { return 1.0 / (2.0 + sign(x[1])); }));
  EXPECT_FALSE(isAffine([](const auto& x) { return sqr(3.0 + sign(x[1])); }));
  EXPECT_FALSE(isAffine([](const auto& x) { return sign(x[0] + sign(x[1])); }));
}

}  // namespace
}  // namespace gamut::testing
