// Angles of two coordinates on the negative axis, for numbers and for intervals.
#include "scalars/program/angles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scalars/evaluation/evaluate.hpp"
#include "scalars/recorded.hpp"
#include "tests/scalars/high_precision.hpp"

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

using testing::EnclosesExactly;
using Number = testing::HighPrecision;

/// No zero has a sign.
Number angleOf(const Number& y, const Number& x) { return y == 0 ? atan2(Number(0), x) : atan2(y, x); }

/// Where y becomes zero as a program is written anew, x is still known, whichever way x is written.
TEST(HalfTurns, AreThoseOfTheAxisWhereYBecomesZero) {
  const Program g = record(1, 2, 5, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = atan2(p[0], x[0]);
    y[1] = atan2(-p[0] * x[0], -sqr(x[0]));
    y[2] = atan2(p[0], 3.0 * x[0]) + atan2(x[0], p[1]);
    y[3] = atan2(sin(p[0]), -x[0]);
    y[4] = atan2(p[0], p[1]);
  });
  const auto zeroIn = [&g](const Recorded& zero) {
    return record(1, 0, 5, [&](auto t, const auto& x, const auto&, auto& y) {
      const std::vector<Recorded> all = written(g, {x[0]}, {zero, Recorded(Interval(-2.0))}, t);
      std::copy(all.begin(), all.end(), y.begin());
    });
  };
  const Program there = zeroIn(Recorded(0.0));
  for (const double x : {-1e100, -2.5, -1e-9, 1e-9, 1.0, 3e80}) {
    const std::vector<double> number = evaluate<double>(withHalfTurns(there), std::vector{x});
    EXPECT_EQ(number[0], x < 0 ? std::numbers::pi : 0) << x;
    EXPECT_EQ(number[1], std::numbers::pi) << x;
    EXPECT_NEAR(number[2], number[0] + std::atan2(x, -2), 1e-15) << x;
    EXPECT_EQ(number[3], x > 0 ? std::numbers::pi : 0) << x;
    EXPECT_EQ(number[4], std::numbers::pi) << x;
    const std::vector<Interval> found = evaluate<Interval>(there, {Interval(x)});
    const Number half = atan2(Number(0), Number(-1));
    EXPECT_THAT(found[0], EnclosesExactly(x < 0 ? half : Number(0))) << x;
    EXPECT_THAT(found[1], EnclosesExactly(half)) << x;
    EXPECT_THAT(found[2], EnclosesExactly((x < 0 ? half : Number(0)) + atan2(Number(x), Number(-2)))) << x;
    EXPECT_THAT(found[4], EnclosesExactly(half)) << x;
  }
}

/// Over boxes that touch the negative axis, come from one side to it, or lie on it.
TEST(HalfTurns, AreHeldByIntervals) {
  const Program g = record(2, 1, 5, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = atan2(x[0], x[1]);
    y[1] = atan2(-x[0], x[1]);
    y[2] = atan2(x[0], p[0]);
    y[3] = atan2(x[0], Recorded(-1.0));
    y[4] = atan2(x[0] * p[0], x[1] * 3.0) - 1.0;
  });
  const std::vector<double> marks = {-2.0, -0.1, -1e-200, 0.0, 1e-9, 0.3};
  for (const double p : {-1.0, -0.3, 0.7})
    for (std::size_t a = 0; a < marks.size(); ++a)
      for (std::size_t b = a; b < marks.size(); ++b)
        for (const Interval& x : {Interval(-1.0), Interval(-0.3), Interval(-2.0, -1.0), Interval(-1.0, 0.5)}) {
          const std::vector<Interval> found =
              evaluate<Interval>(g, {Interval(marks[a], marks[b]), x}, {Interval(p)}, Interval(0.0));
          for (std::size_t k = a; k <= b; ++k)
            for (const double at : {x.lower(), x.upper()}) {
              const Number y(marks[k]), u(at), v(p);
              EXPECT_THAT(found[0], EnclosesExactly(angleOf(y, u)));
              EXPECT_THAT(found[1], EnclosesExactly(angleOf(-y, u)));
              EXPECT_THAT(found[2], EnclosesExactly(angleOf(y, v)));
              EXPECT_THAT(found[3], EnclosesExactly(angleOf(y, Number(-1))));
              EXPECT_THAT(found[4], EnclosesExactly(angleOf(y * v, u * 3) - 1));
            }
        }
  // Where y is not zero, or x not below it, nothing is added.
  EXPECT_LT(evaluate<Interval>(g, {Interval(-2.0, -0.1), Interval(-1.0, 0.5)}, {Interval(1.0)})[0].upper(), 0);
  EXPECT_LT(evaluate<Interval>(g, {Interval(-2.0, 0.0), Interval(0.25, 0.5)}, {Interval(1.0)})[0].upper(), 1e-9);
}

}  // namespace
}  // namespace gamut::angles_test
