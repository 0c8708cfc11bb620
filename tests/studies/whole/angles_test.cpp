// Angles of two coordinates (atan2) of what turns through whole turns: outputs hold them on either side of the negative
// axis, where they jump by a whole turn.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "studies/running/run.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace angles_of_turns {
namespace {

/// A crank that starts at 0.3 rad with 7 rad/s.
std::string crank(const std::string& rest) {
  return "[study]\nanalysis = \"dynamics\"\nhorizon = \"3 s\"\noutput_step = \"0.05 s\"\n"
         "compare = [\"interval\", \"stochastic\"]\n[distribution]\ntimes = 0\n[stochastic]\nsamples = 16\n"
         "[mechanism]\ngravity = [0, 0, 0]\nelement = [\n"
         "{ type = \"revolute\", name = \"crank\", from = \"inertial\", to = \"K\", axis = \"z\", "
         "initial = { angle = \"0.3 rad\", rate = \"7 rad/s\" } },\n"
         "{ type = \"link\", name = \"arm\", from = \"K\", to = \"tip\", vector = [\"0.5 m\", 0, 0] },\n"
         "{ type = \"mass\", name = \"m\", at = \"tip\", mass = 1 },\n" +
         rest;
}

std::string within(const std::string& interval) {
  return "]\n[[uncertain]]\nquantity = \"crank.rate\"\ninterval = \"" + interval + "\"\n";
}

/// Little wider than the angle is, where it keeps off the axis by more than coordinates in a box know.
TEST(AnglesOfTurns, AreHeldOnEitherSideOfTheNegativeAxis) {
  constexpr double pi = std::numbers::pi, inside = 1 - 0x1p-30;  // by more than doubles round
  for (const auto& [interval, share] : {std::pair("± 1 %", 0.01), {"± 10 %", 0.1}}) {
    SCOPED_TRACE(interval);
    const Results results = run(readStudyText(
        crank(within(interval)) + "[[output]]\nquantity = \"atan2(tip.position.y, tip.position.x)\"\n", "s"));
    ASSERT_EQ(results.interval.reached, 3);
    EXPECT_EQ(results.comparison.verdict, Agreement::inside);
    for (int i = 1; i <= 60; ++i) {
      const double lower = results.interval.at.lower(i, 0), upper = results.interval.at.upper(i, 0);
      const double middle = 0.3 + 0.35 * i, half = 0.35 * i * share * inside;
      const double turns = std::round(middle / (2 * pi)), least = middle - half - 2 * pi * turns,
                   greatest = middle + half - 2 * pi * turns;
      if (least > -pi && greatest < pi) {
        EXPECT_LE(lower, least) << i;
        EXPECT_GE(upper, greatest) << i;
        EXPECT_LE(upper - lower, (share < 0.1 ? 1.01 : 3.0) * (greatest - least)) << i;
      } else {
        EXPECT_LE(lower, -pi) << i;
        EXPECT_GE(upper, pi) << i;
      }
    }
  }
}

/// A swing that is let go at half a turn exactly, where a last digit decides between -π and π: behind that its
/// direction varies, so that it has an overestimation and a distribution.
TEST(AnglesOfTurns, VaryBehindAStartOnTheNegativeAxis) {
  const Results results = run(readStudyText(
      "[study]\nanalysis = \"dynamics\"\nhorizon = 1.0\noutput_step = 0.25\ncompare = [\"interval\", \"stochastic\"]\n"
      "[mechanism]\nparameters = { w = 2.5 }\nelement = [\n"
      "{ type = \"state\", name = \"y\", initial = -0.5, rate = \"v/(1 s)\" },\n"
      "{ type = \"state\", name = \"v\", initial = 0, rate = \"-w^2*y/(1 s)\" }]\n"
      "[[uncertain]]\nquantity = \"w\"\ninterval = \"± 10 %\"\n"
      "[[output]]\nquantity = \"atan2(v, y)\"\n[stochastic]\nsamples = 64\n[distribution]\ntimes = 2\n",
      "s"));
  ASSERT_EQ(results.interval.reached, 1);
  EXPECT_LE(results.comparison.maximum, 1.01);
  ASSERT_FALSE(results.distribution.gaps.data.empty());
  EXPECT_LE(results.distribution.gaps.data.back(), results.distribution.wanted);
}

}  // namespace
}  // namespace angles_of_turns
}  // namespace gamut
