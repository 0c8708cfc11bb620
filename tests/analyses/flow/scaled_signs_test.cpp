// Surfaces that are written otherwise: with factors without states, which are taken off; in ways that are not
// recognised, of which nothing but what holds for either reading is said.
#include <gtest/gtest.h>

#include <vector>

#include "analyses/flow/flow.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

/// x' = 1/4 - sign(p x) with x from [0.5, 1], with outputs of x and p.
template <class Output>
Tube comingToRest(const Interval& p, const Output& output) {
  const Program f =
      record(1, 1, [](auto, const auto& x, const auto& q, auto& dx) { dx[0] = 0.25 - sign(q[0] * x[0]); });
  const Program g = record(1, 1, 1, [&](auto, const auto& x, const auto& q, auto& y) { y[0] = output(x[0], q[0]); });
  return Flow(f, g).enclose({Interval(0.5, 1.0), p}, 3.0, {1.0, 2.0});
}

TEST(ScaledSigns, OfAFactorOfOneSignAreHeld) {
  const auto scaled = [](const auto& x, const auto& p) { return sign(p * x); };
  for (const Interval& p : {Interval(0.5, 1.5), Interval(1e-9), Interval(2.0, 1e6)}) {
    const Tube tube = comingToRest(p, scaled);
    ASSERT_EQ(tube.why(), "");
    EXPECT_LT(width(tube.states(3)[0]), 1e-12) << toString(p);
    EXPECT_TRUE(contains(tube.states(3)[0], 0.0));
    EXPECT_TRUE(contains(tube.outputs(3)[0], 0.25));  // what holds it
    EXPECT_LT(width(tube.outputs(3)[0]), 1e-9) << toString(p);
  }
  const Tube away = comingToRest(Interval(-1.5, -0.5), scaled);  // the surface repels
  EXPECT_TRUE(isSubset(Interval(4.25, 4.75), away.states(3)[0]));
  EXPECT_LT(width(away.states(3)[0]), 0.51);
}

/// Those of p = 0 are not held, but rise by 1/4 a second; those of p > 0 rest.
TEST(ScaledSigns, OfAFactorThatMayBeZeroHoldAllThatItMayBe) {
  const Tube tube = comingToRest(Interval(-1.0, 1.0), [](const auto& x, const auto&) { return x; });
  ASSERT_EQ(tube.why(), "");
  const Interval last = tube.states(3)[0];
  for (const double end : {0.0, 1.25, 1.75, 4.25, 4.75}) EXPECT_TRUE(contains(last, end)) << end;
}

TEST(UnknownSurfaces, HaveAnySignWhereTheyMayBeHeld) {
  const auto held = [](const auto& x, const auto&) { return sign(x * sqr(x)); };
  const Tube tube = comingToRest(Interval(1.0), held);
  ASSERT_EQ(tube.why(), "");
  EXPECT_TRUE(isEqual(tube.outputs(0)[0], Interval(1.0)));  // it is not there yet
  EXPECT_TRUE(isSubset(Interval(-1.0, 1.0), tube.outputs(3)[0]));
  const Program one = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = 0.25 - sign(x[0]); });
  const Program cube =
      record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = sign(x[0] * sqr(x[0])); });
  const Tube resting = Flow(one, cube).enclose({Interval(0.0)}, 1.0, {0.5});
  ASSERT_EQ(resting.why(), "");
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_TRUE(isEqual(resting.outputs(row)[0], Interval(-1.0, 1.0))) << row;
    EXPECT_TRUE(isEqual(resting.outputsOver(row)[0], Interval(-1.0, 1.0))) << row;
  }
  // f jumps at x + y = 0, which thirds of both are not known to be.
  const Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = 0.25 - sign(x[0] + x[1]);
    dx[1] = 0.0 * x[0];
  });
  const Program g =
      record(2, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = sign(x[0] / 3.0 + x[1] / 3.0); });
  const Tube thirds = Flow(f, g).enclose({Interval(0.5, 1.0), Interval(0.0)}, 3.0, {2.0});
  ASSERT_EQ(thirds.why(), "");
  EXPECT_TRUE(isSubset(Interval(-1.0, 1.0), thirds.outputs(2)[0]));
}

TEST(UnknownSurfaces, AreThoseOfNumbersWhereNothingJumps) {
  const Program f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -x[0]; });
  const Program g = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = sign(sqr(x[0])); });
  const Tube tube = Flow(f, g).enclose({Interval(0.0, 1.0)}, 1.0, {});
  EXPECT_TRUE(isEqual(tube.outputs(0)[0], Interval(0.0, 1.0)));
}

}  // namespace
}  // namespace gamut
