// Outputs by plain intervals: nothing is claimed where they may have no value.
#include "analyses/flow/plain_outputs.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace gamut
