#include "analyses/flow/step/chord.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>

#include "tests/analyses/reference.hpp"

namespace gamut {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_100;

/// (1 - s) a + s b + 4 s (1 - s) bend.
Exact bowed(double a, double b, double bend, const Exact& s) {
  return (1 - s) * Exact(a) + s * Exact(b) + 4 * s * (1 - s) * Exact(bend);
}

TEST(FlowChord, HoldsWhatBendsAndLittleMore) {
  testing::Points points(1);
  for (int round = 0; round < 2000; ++round) {
    const double scale = std::ldexp(1.0, points.integer(-60, 60)), bend = scale * points.uniform(0, 1),
                 a = scale * points.signedUnit(), b = round % 4 == 0 ? a : scale * points.signedUnit();
    const FlowSag down{Interval(-bend, 0.0)}, up{Interval(0.0, bend)};
    const Interval below = overChord(Interval(a), Interval(b), down), above = overChord(Interval(a), Interval(b), up);
    Exact least = std::min(a, b), greatest = std::max(a, b);
    for (int i = 0; i <= 256; ++i) {
      const Exact s = Exact(i) / 256, low = bowed(a, b, -bend, s), high = bowed(a, b, bend, s);
      ASSERT_LE(below.lower(), low) << round;
      ASSERT_GE(above.upper(), high) << round;
      least = std::min(least, low), greatest = std::max(greatest, high);
    }
    EXPECT_EQ(below.upper(), std::max(a, b));
    EXPECT_EQ(above.lower(), std::min(a, b));
    const Exact finest = Exact(bend) * 4 / 256 / 256 + Exact(scale) * 1e-14;  // how far 256 parts may miss the extreme
    EXPECT_LE(least - below.lower(), finest);
    EXPECT_LE(above.upper() - greatest, finest);
  }
}

TEST(FlowChord, OfWhatRisesAllAlongIsBetweenItsEnds) {
  const FlowSag sag{Interval(-0.25, 0.25)};
  EXPECT_TRUE(isEqual(overChord(Interval(0.0, 0.5), Interval(1.0, 2.0), sag), Interval(0.0, 2.0)));
  EXPECT_TRUE(isEqual(overChord(Interval(1.0, 2.0), Interval(0.0, 0.5), sag), Interval(0.0, 2.0)));
  EXPECT_LT(overChord(Interval(0.0), Interval(0.5), sag).lower(), 0);
}

TEST(FlowChord, HasWhatIsLeftOverAllAlong) {
  const Interval over = overChord(Interval(0.0), Interval(1.0), {Interval(-0.125, 0.125), 0.5});
  EXPECT_LE(over.lower(), -0.5);
  EXPECT_GE(over.lower(), -0.5 - 1e-15);
  EXPECT_GE(over.upper(), 1.5);
}

TEST(FlowChord, KnowsNothingWhereNothingIsKnown) {
  EXPECT_TRUE(isEqual(overChord(Interval(0.0), Interval(1.0), {Interval::entire(), 0}), Interval::entire()));
  EXPECT_EQ(overChord(Interval::entire(), Interval(1.0), {Interval(-1.0, 1.0), 0}).lower(),
            -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(isEqual(overChord(Interval(0.0), Interval(1.0), {}), Interval(0.0, 1.0)));
}

TEST(FlowChord, IsNearTheOtherMomentWhereThereAreNoSolutionsAtOne) {
  const FlowSag sag{Interval(-0.25, 0.5), 0.25};
  const Interval alone(1.0, 2.0), near(0.5, 2.75);
  EXPECT_TRUE(isSubset(near, overChord(Interval::empty(), alone, sag)));
  EXPECT_TRUE(isSubset(near, overChord(alone, Interval::empty(), sag)));
  EXPECT_TRUE(isEmpty(overChord(Interval::empty(), Interval::empty(), sag)));
}

TEST(FlowChord, IsBoundedWhereNumbersOverflow) {
  constexpr double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(overChord(Interval(-most), Interval(most), {Interval(-most, most), 0}).lower(),
            -std::numeric_limits<double>::infinity());
  EXPECT_LE(overChord(Interval(0.0), Interval(0.0), {Interval(-least, 0.0), 0}).lower(), -least);
}

}  // namespace
}  // namespace gamut
