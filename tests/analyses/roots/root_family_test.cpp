#include "analyses/roots/root_family.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scalars/recorded.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut {
namespace {

using Number = testing::HighPrecision;

/// Of x² = p from so many of Newton's steps from 1.
Program rootOfSquare(int steps) {
  return record(1, 1, 1, [steps](auto, const auto& delta, const auto& p, auto& y) {
    Recorded c(1.0);
    for (int i = 0; i < steps; ++i) c = c - (square(c) - p[0]) / (2.0 * c);
    const Recorded x = c + delta[0];
    y[0] = delta[0] - (square(x) - p[0]) / (2.0 * c);
  });
}

Number centreAt(const Number& p, int steps) {
  Number c(1);
  for (int i = 0; i < steps; ++i) c -= (c * c - p) / (2 * c);
  return c;
}

void expectRoots(const Interval& p, int steps, double widest) {
  const RootFamily family = proveRoots(rootOfSquare(steps), {p});
  ASSERT_EQ(family.remainder.size(), 1U) << toString(p);
  EXPECT_FALSE(family.open);
  EXPECT_LE(width(family.remainder[0]), widest);
  for (int i = 0; i <= 50; ++i) {
    const Number value = Number(p.lower()) + (Number(p.upper()) - Number(p.lower())) * i / 50;
    const Number delta = sqrt(value) - centreAt(value, steps);
    EXPECT_THAT(family.remainder[0], testing::EnclosesExactly(delta));
    // The other root is none of those among which this one is alone.
    const Number other = -sqrt(value) - centreAt(value, steps);
    EXPECT_LT(other, Number(family.alone[0].lower()));
  }
}

TEST(RootFamily, EnclosesTheRootsOfAllParameters) {
  expectRoots(Interval(1.0), 0, 1e-14);
  expectRoots(Interval(2.0), 4, 1e-5);
  expectRoots(Interval(2.0), 6, 1e-13);
  expectRoots(Interval(0.9, 1.1), 3, 1e-7);
  expectRoots(Interval(0.3, 3.0), 4, 1e-2);
  expectRoots(Interval(0.05, 8.0), 6, 0.2);
}

TEST(RootFamily, NamesAPartThatMayHaveNone) {
  for (const Interval& p : {Interval(-0.5, 1.5), Interval(0.0, 1.0), Interval(-2.0, -1.0)}) {
    const RootFamily family = proveRoots(rootOfSquare(4), {p});
    EXPECT_TRUE(family.remainder.empty());
    ASSERT_TRUE(family.open);
    EXPECT_TRUE(isSubset((*family.open)[0], p));
  }
}

/// (x - p)(x - p - 1e-3) = 0: where both roots are as near as what is known, neither is alone.
TEST(RootFamily, TakesNoneForAloneThatIsNot) {
  const auto twins = [](double c) {
    return record(1, 1, 1, [c](auto, const auto& delta, const auto& p, auto& y) {
      const Recorded x = c + delta[0], slope = (c - p[0]) + (c - p[0] - 0.001);
      y[0] = delta[0] - (x - p[0]) * (x - p[0] - 0.001) / slope;
    });
  };
  const RootFamily near = proveRoots(twins(0.0011), {Interval(0.0, 1e-6)});
  ASSERT_EQ(near.remainder.size(), 1U);
  EXPECT_GT(near.alone[0].lower() + 0.0011, 0.0001);
  EXPECT_TRUE(proveRoots(twins(0.0005), {Interval(-1e-4, 1e-4)}).remainder.empty());
}

}  // namespace
}  // namespace gamut
