// Half a car over a bump of the road: four freedoms, linear struts, tolerances as practice has them. Until the bump
// comes the machine is at rest; damped as it is, its remainder must not grow.
#include <gtest/gtest.h>

#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

constexpr double speed = 5.5;

/// Axle heights front and rear, heave and pitch, and their rates; body mass, front spring, dampers, tyres, and the
/// speed, if that is a parameter.
Program halfCar(double place, bool hasSpeed = false) {
  return record(8, hasSpeed ? 6 : 5, [&](auto t, const auto& x, const auto& p, auto& dx) {
    constexpr double a = 1.1, b = -1.5, length = 0.4;
    const auto road = [&](double from) {
      const Recorded way = hasSpeed ? p[5] * t : speed * t;
      return 0.04 * exp(-sqr((way - from) * (1 / length)));
    };
    const Recorded s = sin(x[3]), c = cos(x[3]);
    const Recorded front = p[1] * (x[0] - x[2] - a * s) + p[2] * (x[4] - x[6] - a * c * x[7]);
    const Recorded rear = 25e3 * (x[1] - x[2] - b * s) + p[3] * (x[5] - x[6] - b * c * x[7]);
    for (std::size_t i = 0; i < 4; ++i) dx[i] = x[4 + i];
    dx[4] = (p[4] * (road(place) - x[0]) - front) / 40.0;
    dx[5] = (p[4] * (road(place + 2.6) - x[1]) - rear) / 42.0;
    dx[6] = (front + rear) / p[0];
    dx[7] = (a * c * front + b * c * rear) / 1100.0;
  });
}

Box carWithin(double share) {
  Box box(8, Interval(0.0));
  const double nominal[] = {650, 22e3, 1600, 1700, 190e3}, tolerance[] = {0.08, 0.05, 0.15, 0.15, 0.10};
  for (int i = 0; i < 5; ++i) box.push_back(nominal[i] * Interval(1 - share * tolerance[i], 1 + share * tolerance[i]));
  return box;
}

TEST(HalfCar, TolerancesOfPracticeAreFollowedInOnePiece) {
  FlowOptions options;
  options.degree = 6;
  options.frameDegree = 4;
  options.order = 10;
  options.tolerance = 1e-7;
  options.split = false;
  const Tube tube = Flow(halfCar(0.5), options).enclose(carWithin(1), 1.5, {0.5, 1});
  EXPECT_EQ(tube.why(), "");
  EXPECT_LT(tube.tightness(), 1.5);
}

TEST(HalfCar, EveryCarIsInside) {
  Containment c;
  c.f = halfCar(0.5);
  c.box = carWithin(1);
  c.horizon = 0.5;
  c.times = {0.125, 0.25};
  c.options.degree = 4;
  c.options.split = false;
  expectContainment(c, 3);
}

TEST(HalfCar, ItDoesNotMatterWhenTheBumpComes) {
  for (const double place : {0.5, 1.0, 1.5, 2.0, 4.0}) {
    const Tube tube = Flow(halfCar(place)).enclose(carWithin(0.1), 1.5, {0.25, 0.5, 1});
    EXPECT_EQ(tube.why(), "") << place;
    EXPECT_LE(tube.tightness(), 1.01) << place;
    EXPECT_LT(tube.steps(), 300) << place;
    EXPECT_EQ(tube.pieces(), 1) << place;
  }
}

// With bisection alone the first takes 8 pieces, and the second ends before its bump comes.
TEST(HalfCar, TolerancesOfPracticeNeedOnePieceWithoutBeingTold) {
  for (const double place : {0.5, 4.0}) {
    const Tube tube = Flow(halfCar(place)).enclose(carWithin(1), 1.5, {0.5, 1});
    EXPECT_EQ(tube.why(), "") << place;
    EXPECT_LE(tube.tightness(), 1.02) << place;
    EXPECT_EQ(tube.pieces(), 1) << place;
  }
}

// The speed decides when each bump comes, so that high powers of it alone are needed: its halves are followed rather
// than all symbols to a higher degree.
TEST(HalfCar, ASpeedThatIsNotKnownIsCutBeforehand) {
  Box box = carWithin(0.3);
  box.push_back(speed * Interval(0.93, 1.07));
  FlowOptions options;
  const Tube one = Flow(halfCar(1, true), options).enclose(box, 0.6, {0.25, 0.5});
  EXPECT_EQ(one.why(), "");
  EXPECT_LE(one.tightness(), 1.02);
  EXPECT_GT(one.pieces(), 1);
  EXPECT_LE(one.pieces(), 8);
  options.jobs = 3;
  const Tube three = Flow(halfCar(1, true), options).enclose(box, 0.6, {0.25, 0.5});
  EXPECT_EQ(one.steps(), three.steps());
  ASSERT_EQ(one.reachedTimes(), three.reachedTimes());
  for (std::size_t row = 0; row < one.reachedTimes(); ++row)
    for (std::size_t i = 0; i < one.states(row).size(); ++i)
      EXPECT_TRUE(isEqual(one.states(row)[i], three.states(row)[i]));
  Containment c;
  c.f = halfCar(1, true);
  c.box = box;
  c.horizon = 0.6;
  c.times = {0.25, 0.5};
  expectContainment(c, 3);
}

}  // namespace
}  // namespace gamut::testing
