// Surfaces that are written otherwise: with factors without states, which are taken off.
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

}  // namespace
}  // namespace gamut
