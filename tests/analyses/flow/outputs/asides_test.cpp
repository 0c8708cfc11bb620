// What is looked at besides is enclosed, about as tightly as an output, and changes nothing else.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Ends of two rods, a constant, what has a kink, and a root.
Program places() {
  return record(4, 1, 6, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = p[0] * sin(x[0]) + 0.1 * t;
    y[1] = -p[0] * cos(x[0]);
    y[2] = p[0] * sin(x[0]) + sin(x[0] + x[1]);
    y[3] = 0.0 * t;
    y[4] = abs(x[1]);
    y[5] = sqrt(x[2] + 30.0);
  });
}

/// A double pendulum of unit masses with an uncertain length.
Containment pendulumOfLength() {
  Containment c;
  c.f = record(4, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    const Recorded cosine = cos(x[1]), sine = sin(x[1]), sum = x[2] + x[3];
    const Recorded a11 = 2.0 * p[0] + cosine, a12 = cosine, a21 = p[0] * cosine + 1.0, a22 = Recorded(1.0);
    const Recorded b1 = -19.62 * sin(x[0]) + sine * sum * sum;
    const Recorded b2 = -9.81 * sin(x[0] + x[1]) - p[0] * sine * x[2] * x[2];
    const Recorded d = a11 * a22 - a12 * a21;
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = (b1 * a22 - a12 * b2) / d;
    dx[3] = (b2 * a11 - a21 * b1) / d;
  });
  c.box = {Interval(0.9, 0.92), -0.4, 0.5, 0.0, Interval(0.99, 1.01)};
  c.horizon = 1.5;
  for (int i = 1; i < 15; ++i) c.times.push_back(0.1 * i);
  return c;
}

TEST(FlowAsides, HoldWhatTheyMay) {
  Containment c = pendulumOfLength();
  c.options.aside = {places(), {0.0, 0.5, 1.0, 1.3, 1.5, 2.0}};
  const Tube tube = expectContainment(c, 12);
  EXPECT_THAT(tube.asides(0), SizeIs(6));
  EXPECT_THAT(tube.asides(1), IsEmpty());
  EXPECT_THAT(tube.asides(5), SizeIs(6));
  EXPECT_TRUE(isEqual(tube.asides(5)[3], 0.0));
}

TEST(FlowAsides, AreAboutAsTightAsOutputs) {
  Containment c = pendulumOfLength();
  c.g = places();
  c.options.aside = {places(), c.times};
  const Tube tube = c.tube();
  ASSERT_EQ(tube.why(), "");
  for (std::size_t i = 1; i + 1 < tube.reachedTimes(); ++i)
    for (std::size_t o = 0; o < 3; ++o)
      EXPECT_LE(width(tube.asides(i)[o]), 1.05 * width(tube.outputs(i)[o])) << i << ' ' << o;
}

TEST(FlowAsides, ChangeNothingElse) {
  Containment c = pendulumOfLength();
  c.g = standardOutputs(4, 1);
  c.levels = {{Interval(0.905, 0.91), -0.4, 0.5, 0.0, Interval(0.995, 1.0)}};
  const Tube without = c.tube();
  c.options.aside = {places(), c.times};
  const Tube with = c.tube();
  ASSERT_EQ(with.reachedTimes(), without.reachedTimes());
  EXPECT_EQ(with.steps(), without.steps());
  EXPECT_EQ(with.tightness(), without.tightness());
  for (std::size_t i = 0; i < with.reachedTimes(); ++i) {
    EXPECT_TRUE(std::ranges::equal(with.outputs(i), without.outputs(i), isEqual));
    EXPECT_TRUE(std::ranges::equal(with.statesOver(i), without.statesOver(i), isEqual));
    EXPECT_TRUE(std::ranges::equal(with.cut(0, i), without.cut(0, i), isEqual));
  }
}

TEST(FlowAsides, FollowInputsOfAnyCourseAndOfBoundedRate) {
  for (const double rate : {std::numeric_limits<double>::infinity(), 0.05}) {
    Containment c = pendulumOfLength();
    c.options.varying = {{0, rate}};
    c.options.aside = {places(), {0.0, 0.1, 0.3}};
    c.options.tightness = 1.5;
    c.horizon = 0.3;
    c.times = {0.1};
    const Tube tube = expectContainment(c, 4);  // constants are courses
    EXPECT_THAT(tube.asides(1), SizeIs(6)) << rate;
  }
}

TEST(FlowAsides, AreKnownAtTheStartOfWhatEndsThere) {
  Containment c = pendulumOfLength();
  c.options.aside = {places(), {0.0}};
  const std::atomic<bool> cancelled{true};
  c.options.cancelled = &cancelled;
  const Tube tube = c.tube();
  ASSERT_EQ(tube.reachedTimes(), 1u);
  EXPECT_THAT(tube.asides(0), SizeIs(6));
  EXPECT_LT(width(tube.asides(0)[0]), 0.04);
}

TEST(FlowAsides, NeedTheProgramsStatesAndParameters) {
  Containment c = pendulumOfLength();
  c.options.aside = {standardOutputs(3, 1), {0.0}};
  EXPECT_THROW(c.tube(), std::invalid_argument);
}

}  // namespace
}  // namespace gamut::testing
