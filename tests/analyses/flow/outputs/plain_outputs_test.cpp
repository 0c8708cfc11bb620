// Outputs by plain intervals: nothing is claimed where they may have no value.
#include "analyses/flow/outputs/plain_outputs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scalars/recorded.hpp"

namespace gamut {
namespace {

/// y is exactly 0 and x < 0: the angle is π, though any multiple of y is 0.
TEST(PlainOutputs, DoNotTakeTheNegativeAxisForThePositiveOne) {
  PlainOutputs outputs(record(2, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = atan2(x[0], x[1]); }));
  for (const Interval& x : {Interval(-1.0), Interval(-1.1), Interval(-2.0, -1.0), Interval(-1.0, 0.0)})
    EXPECT_TRUE(contains(outputs.over(0, 0.0, {Interval(0.0), x}, {}), std::numbers::pi)) << x;
  EXPECT_TRUE(isEqual(outputs.over(0, 0.0, {Interval(0.0), Interval(1.0, 2.0)}, {}), Interval(0.0)));
  EXPECT_LT(magnitude(outputs.over(0, 0.0, {Interval(-1e-9, 1e-9), Interval(-2.0, -1.0)}, {})), 3.1416);
}

/// On the negative axis the angle is π, from whichever side y comes to 0, and however both are written.
TEST(PlainOutputs, KnowThatTheAngleOfTheNegativeAxisIsPi) {
  PlainOutputs outputs(record(2, 0, 5, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = atan2(x[0], x[1]);
    y[1] = atan2(-x[0], x[1]);
    y[2] = atan2(x[0], Recorded(-1.0));
    y[3] = atan2(-2.0 * x[0] * x[1], -sqr(x[1]));
    y[4] = abs(atan2(x[0] / x[1], x[1])) - 1.0;
  }));
  for (const Interval& y : {Interval(-0.1, 0.0), Interval(0.0, 0.1), Interval(-0x1p-1074, 0.0), Interval(-0.1, 0.1)})
    for (const Interval& x : {Interval(-1.0), Interval(-0.3), Interval(-2.0, -1.0), Interval(-1.0, 0.0)}) {
      for (int o = 0; o < 4; ++o) {
        const Interval angle = outputs.over(o, 0.0, {y, x}, {});
        EXPECT_TRUE(contains(angle, std::numbers::pi)) << o << y << x << angle;
        EXPECT_LT(magnitude(angle), 3.1416) << o << y << x << angle;
      }
      EXPECT_TRUE(contains(outputs.over(4, 0.0, {y, x}, {}), std::numbers::pi - 1)) << y << x;
    }
  EXPECT_GE(outputs.over(0, 0.0, {Interval(0.0, 0.1), Interval(-1.0)}, {}).lower(), 0);
  EXPECT_GE(outputs.over(1, 0.0, {Interval(-0.1, 0.0), Interval(-1.0)}, {}).lower(), 0);
  EXPECT_LT(outputs.over(0, 0.0, {Interval(-0.1, -0.05), Interval(-1.0)}, {}).upper(), -2.9);
}

/// An angle of what has no value has none, near the negative axis either.
TEST(PlainOutputs, SayNothingOfAnglesOfWhatMayHaveNoValue) {
  PlainOutputs outputs(record(2, 0, 4, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = atan2(x[0], sqrt(x[1]));
    y[1] = atan2(log(x[1]), x[0]);
    y[2] = atan2(atan2(sqrt(x[1]), x[0]), -1.0 - sqr(x[0]));
    y[3] = sqrt(4.0 - atan2(x[0], x[1]));
  }));
  for (int o = 0; o < 3; ++o)
    EXPECT_TRUE(isEntire(outputs.over(o, 0.0, {Interval(-0.1, 0.1), Interval(-0.1, 1.0)}, {}))) << o;
  const Interval root = outputs.over(3, 0.0, {Interval(-0.1, 0.1), Interval(-2.0, -1.0)}, {});
  EXPECT_TRUE(contains(root, std::sqrt(4 - 3.1)) && contains(root, std::sqrt(4 + 3.1)));
  EXPECT_LT(root.upper(), 2.7);
}

/// Bounds of the greater are the greater bounds, nested ones too, however the two are written.
TEST(PlainOutputs, OfExtremesAreThoseOfTheExtreme) {
  PlainOutputs outputs(record(2, 1, 8, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = max(x[0], x[1]);
    y[1] = min(x[0], Recorded(0.25));
    y[2] = max(x[0], Recorded(0.0));
    y[3] = 1.0 - max(2.0 * x[0], -x[1] * p[0]);
    y[4] = min(max(x[0], x[1]), p[0] + t);
    y[5] = max(sqrt(x[1]), x[0]);
    y[6] = max(-x[0], sin(x[1]) * 0.0 - p[0]);
    y[7] = x[1] * max(x[0], Recorded(0.0));  // the half of the formula goes into the product
  }));
  const std::vector<Interval> x{Interval(-1.0, 1.0), Interval(0.5, 3.0)}, p{Interval(2.0)};
  const auto over = [&](int output) { return outputs.over(output, Interval(0.0, 0.5), x, p); };
  EXPECT_TRUE(isEqual(over(0), Interval(0.5, 3.0)));
  EXPECT_TRUE(isEqual(over(1), Interval(-1.0, 0.25)));
  EXPECT_TRUE(isEqual(over(2), Interval(0.0, 1.0)));
  EXPECT_TRUE(isEqual(over(7), Interval(0.0, 3.0)));
  EXPECT_TRUE(isEqual(over(3), Interval(-1.0, 3.0)));
  EXPECT_TRUE(isEqual(over(4), Interval(0.5, 2.5)));
  EXPECT_TRUE(isSubset(Interval(std::sqrt(0.5), std::sqrt(3.0)), over(5)));
  EXPECT_LT(over(5).upper(), 1.7321);
  EXPECT_TRUE(isEqual(over(6), Interval(-1.0, 1.0)));
  EXPECT_TRUE(isEqual(outputs.over(5, 0.0, {Interval(0.0), Interval(-1.0, 1.0)}, p), Interval::entire()));
}

/// The least of very many numbers, as of distances of hulls, some of which have no value; also where it is moved.
TEST(PlainOutputs, OfThousandsOfExtremesAreThoseOfTheExtreme) {
  constexpr int many = 3000;
  std::vector<PlainOutputs> all;
  all.emplace_back(record(2, 1, 3, [](auto, const auto& x, const auto& p, auto& y) {
    Recorded least = x[0] + 10.0, greatest = x[0] - 10.0;
    for (int i = 0; i < many; ++i) {
      const Recorded other = x[1] * (1.0 + i) + p[0];
      least = min(least, other);
      greatest = max(greatest, -other);
    }
    y[0] = least;
    y[1] = greatest;
    y[2] = least + sqrt(x[0]);
  }));
  all.emplace_back(all.front());  // a copy knows what it needs by itself
  all.erase(all.begin());
  PlainOutputs outputs = std::move(all.front());
  const Box box{Interval(-1.0, 1.0), Interval(0.5, 3.0), Interval(2.0)};
  for (int pass = 0; pass < 2; ++pass) {
    const std::vector<Interval> found = outputs.over(0.0, box);
    EXPECT_TRUE(isEqual(found[0], Interval(2.5, 5.0)));
    EXPECT_TRUE(isEqual(found[1], Interval(-5.0, -2.5)));
    EXPECT_TRUE(isEntire(found[2]));
    for (int o = 0; o < 3; ++o)
      EXPECT_TRUE(isEqual(outputs.over(o, Interval(0.0), {box[0], box[1]}, {box[2]}), found[o])) << o;
  }
}

}  // namespace
}  // namespace gamut
