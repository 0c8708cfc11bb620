// Bounds by the mean value theorem: they hold values, know what stands twice, and say nothing where they may not.
#include "analyses/flow/outputs/mean_value_outputs.hpp"

#include <gmock/gmock.h>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/recorded.hpp"

namespace gamut::testing {
namespace {

Interval over(const Program& g, const Interval& t, const std::vector<Interval>& x, const std::vector<Interval>& p) {
  return MeanValueOutputs(g).over(0, t, x, p);
}

TEST(MeanValueOutputs, KnowWhatStandsTwice) {
  const Program g = record(1, 1, 1, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = p[0] * ((x[0] + t) / p[0] + 1.0) - x[0];
  });  // t + p
  const Interval found = over(g, Interval(0.5, 0.625), {Interval(-1, 1)}, {Interval(0.96875, 1.03125)});
  EXPECT_TRUE(isSubset(Interval(1.46875, 1.65625), found)) << toString(found);
  EXPECT_LT(width(found), 0.5);  // 2.5 with intervals
}

/// p s, s = (a + b)/(a - b) what holds between rates a = 1/4 + p and b = 1/4 - p: 1/4.
TEST(MeanValueOutputs, KnowWhatHoldsAsOftenAsItStands) {
  const Program g = record(1, 1, 1, [](auto, const auto&, const auto& p, auto& y) {
    const auto a = 0.25 + p[0], b = 0.25 - p[0];
    y[0] = p[0] * ((a + b) / (a - b));
  });
  const Interval found = over(g, Interval(0), {Interval(0)}, {Interval(0.9375, 1.0625)});
  EXPECT_TRUE(contains(found, 0.25)) << toString(found);
  EXPECT_LT(width(found), 1e-3);  // 0.01 in one part
}

TEST(MeanValueOutputs, HoldValuesAcrossKinks) {
  const Program g = record(1, 1, 1, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = abs(x[0] - p[0]) + exp(-x[0]) * max(x[0], 0.25 * p[0]);
  });
  const Interval x(-0.5, 1.25), p(-0.125, 0.75), found = over(g, Interval(0), {x}, {p});
  ASSERT_TRUE(isCommon(found));
  Evaluator<Interval> value(g);
  for (int i = 0; i <= 16; ++i)
    for (int k = 0; k <= 16; ++k) {
      value.setParameters(std::vector<Interval>{Interval(p.lower() + k * width(p) / 16)});
      EXPECT_TRUE(isSubset(value(Interval(0), {Interval(x.lower() + i * width(x) / 16)})[0], found)) << i << " " << k;
    }
}

TEST(MeanValueOutputs, SayNothingOfJumpsAnglesAndWhatHasNoValue) {
  const auto nothing = [](auto formula) {
    const Program g = record(1, 0, 1, [&](auto, const auto& x, const auto&, auto& y) { y[0] = formula(x[0]); });
    return isEqual(over(g, Interval(0), {Interval(-0.25, 1)}, {}), Interval::entire());
  };
  EXPECT_TRUE(nothing([](const auto& x) { return sign(x); }));
  EXPECT_TRUE(nothing([](const auto& x) { return sqrt(x); }));
  EXPECT_TRUE(nothing([](const auto& x) { return sqr(sqrt(x)); }));
  EXPECT_TRUE(nothing([](const auto& x) { return log(x); }));
  EXPECT_TRUE(nothing([](const auto& x) { return 1.0 / x; }));
  EXPECT_FALSE(nothing([](const auto& x) { return x * x; }));
}

}  // namespace
}  // namespace gamut::testing
