// Wide sets that pass kinks: trajectories whose events are located in 128 bits must lie inside, exactly, and a piece or
// a few are enough.
#include <cmath>

#include "analyses/flow/step/kinks.hpp"
#include "tests/analyses/flow/expect_events.hpp"

namespace gamut::testing {
namespace {

struct Knocking {
  std::string name;
  Program f;
  Box box;
  double horizon;
  int pieces;
};

/// A mass p0 kg that falls on a stop of stiffness k p1 with the damping d, in units of 1/unit m.
Program stop(double k, double d, double unit) {
  return record(2, 2, [=](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -9.81 * unit + k * p[1] * max(-x[0], Recorded(0.0)) * (1.0 - (d / unit) * x[1]) / p[0];
  });
}

const std::vector<Knocking>& knocking() {
  static const std::vector<Knocking> all{
      {"aMassOfTwoPercent", stop(2000, 0.3, 1), {0.3, 0.0, Interval(0.49, 0.51), 1.0}, 1.0, 8},
      {"inMicrometres", stop(2000, 0.3, 0x1p20), {0.3 * 0x1p20, 0.0, Interval(0.49, 0.51), 1.0}, 1.0, 8},
      {"anUndampedOne", stop(2000, 0, 1), {0.3, 0.0, Interval(0.475, 0.525), 1.0}, 0.75, 8},
      {"aHardOne", stop(2e7, 0.05, 1), {0.3, 0.0, Interval(0.49, 0.51), 1.0}, 0.75, 8},
      {"threeOfFivePercent",
       stop(2000, 0.3, 1),
       {Interval(0.2975, 0.3025), 0.0, Interval(0.475, 0.525), Interval(0.95, 1.05)},
       0.5,
       40},
      {"betweenTwoStops",
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = (500.0 * (max(-1.0 - x[0], Recorded(0.0)) - max(x[0] - 1.0, Recorded(0.0)))) / p[0];
              }),
       {0.0, 8.0, Interval(0.9, 1.1)},
       1.0,
       8},
      // Where the kink is no linear form of states, and beside what rests, known to rounding.
      {"atAWallOnAnArc",
       record(3, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                const Recorded beyond = max(sin(x[0]) - p[0], Recorded(0.0));
                dx[0] = x[1];
                dx[1] = -64.0 * p[1] * beyond * cos(x[0]) - 0.0 * x[2];
                dx[2] = 0.0;
              }),
       {0.0, 1.0, Interval("0.1"), Interval(0.49, 0.51), Interval(0.95, 1.05)},
       1.25,
       4},
      {"withFrictionBesides",
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -9.81 + (2000.0 * max(-x[0], Recorded(0.0)) - 0.5 * sign(x[1])) / p[0];
              }),
       {0.25, -0.0625, Interval(0.475, 0.525)},
       0.28125,
       8}};
  return all;
}

class FlowKinkTurns : public ::testing::TestWithParam<Knocking> {};

TEST_P(FlowKinkTurns, HoldTrajectories) {
  const Knocking& machine = GetParam();
  Containment c;
  c.f = machine.f;
  c.box = machine.box;
  c.horizon = machine.horizon;
  for (int i = 1; i < 32; ++i) c.times.push_back(machine.horizon * i / 32);
  EXPECT_LE(expectEvents(c, 12).pieces(), machine.pieces);
  EXPECT_LE(Flow(machine.f).enclose(machine.box, machine.horizon, {}).tightness(), 1.05);
}

INSTANTIATE_TEST_SUITE_P(Flow, FlowKinkTurns, ::testing::ValuesIn(knocking()),
                         [](const auto& machine) { return machine.param.name; });

/// Friction holds another mass, which the first one's spring pulls at, all the time.
TEST(FlowKinkTurn, WhatIsHeldBesidesStaysHeld) {
  const auto knocks = [](const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = (8.0 - 400.0 * max(x[0] - 1.0, Recorded(0.0))) / p[0];
  };
  const Program alone = record(2, 1, [&](auto, const auto& x, const auto& p, auto& dx) { knocks(x, p, dx); });
  const Program both = record(4, 2, [&](auto, const auto& x, const auto& p, auto& dx) {
    knocks(x, p, dx);
    dx[2] = x[3];
    dx[3] = 0.25 * x[0] - p[1] * sign(x[3]);
  });
  const Interval mass(0.9, 1.1);
  const std::vector<double> times{0.25, 0.5, 0.53125, 0.625, 0.75, 1.0};
  const Tube tube = Flow(both).enclose({0.0, 0.0, 0.0, 0.0, mass, Interval(0.95, 1.05)}, 1, times);
  ASSERT_EQ(tube.why(), "");
  EXPECT_LE(tube.pieces(), 8);
  EventReference reference(alone);
  for (int i = 0; i <= 16; ++i) {
    const Precise p = mass.lower() + Precise(width(mass)) * i / 16;
    const std::vector<Vector> motion = reference({Precise(0), Precise(0), p}, times);
    for (std::size_t row = 1; row <= times.size(); ++row) {
      for (std::size_t state = 0; state < 2; ++state)
        ASSERT_THAT(tube.states(row)[state], Encloses(motion[row - 1][state])) << times[row - 1];
      for (std::size_t state = 2; state < 4; ++state) {
        EXPECT_THAT(tube.states(row)[state], Encloses(Precise(0)));
        EXPECT_LT(magnitude(tube.states(row)[state]), 1e-100) << state << " at " << times[row - 1];
      }
    }
  }
}

/// While some have passed and others not, bounds are as close as before and after.
TEST(FlowKinkTurn, WhatPassesIsNoWiderMeanwhile) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -500.0 * max(x[0] - 1.0, Recorded(0.0)) / p[0];
  });
  const Interval mass(0.9, 1.1);
  const std::vector<double> times{0.25, 0.259765625, 0.265625, 0.271484375};  // it is left at 0.125 s + π √(m/500)
  const Tube tube = Flow(f).enclose({0.0, 8.0, mass}, 0.3, times);
  ASSERT_EQ(tube.why(), "");
  EventReference reference(f);
  for (std::size_t row = 1; row <= times.size(); ++row) {
    Interval seen = Interval::empty();
    for (int i = 0; i <= 64; ++i) {
      const Precise p = mass.lower() + Precise(width(mass)) * i / 64;
      const Vector end = reference({Precise(0), Precise(8), p}, {times[row - 1]}).back();
      ASSERT_THAT(tube.states(row)[1], Encloses(end[1]));
      seen = hull(seen, Interval(static_cast<double>(end[1])));
    }
    EXPECT_LT(width(tube.states(row)[1]), 1.05 * width(seen)) << times[row - 1];
  }
}

/// Some touch the stop, some only almost, and one grazes it.
TEST(FlowKinkTurn, WhatGrazesIsInside) {
  Containment c;
  c.f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] - 100.0 * min(x[0], Recorded(0.0));
  });
  c.box = {Interval(0.4375, 0.5625), -1.0, 1.0};  // comes down to x - 1/2
  c.horizon = 2;
  for (int i = 1; i < 16; ++i) c.times.push_back(i / 8.0);
  expectEvents(c, 12);
}

/// Two numbers that doubles enclose alike are two: neither kink is passed with the other.
TEST(FlowKinks, TellsNumbersApartWhoseEnclosuresAreOne) {
  const auto passed = [](const char* one, const char* other) {
    const Program f = record(1, 0, [&](auto, const auto& x, const auto&, auto& dx) {
      const Recorded u = sin(x[0]);
      dx[0] = abs(u - constant<Recorded>(Interval(one))) + abs(u - constant<Recorded>(Interval(other)));
    });
    return FlowKinks(f.differentiated(), {}, true).count();
  };
  EXPECT_EQ(passed("0.1", "0.2"), 2U);
  EXPECT_EQ(passed("0.1", "0.09999999999999999999"), 0U);
}

}  // namespace
}  // namespace gamut::testing
