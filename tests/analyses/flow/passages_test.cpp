// Wide sets that pass jumps: trajectories whose events are located in 128 bits must lie inside, exactly, and a piece or
// a few are enough, also where f is not affine in its signs.
#include "tests/analyses/flow/expect_events.hpp"

namespace gamut::testing {
namespace {

struct Passing {
  std::string name;
  Program f;
  Box box;
  double horizon;
  int pieces;
};

/// A ball above ground, unfolded (Zhuravlev): x = |S| in units of 1/unit m, k = p[0] = (1 - e)/(1 + e), its rate
/// (1 - k sign S sign V) V sign S.
Program ball(double unit) {
  return record(2, 1, [=](auto, const auto& x, const auto& p, auto& dx) {
    const auto lost = 1.0 - p[0] * (sign(x[0]) * sign(x[1]));
    dx[0] = x[1] * lost;
    dx[1] = -9.81 * unit * sign(x[0]) / lost;
  });
}

const std::vector<Passing>& passing() {
  static const std::vector<Passing> all{
      {"aBallThatLosesATenth", ball(1), {Interval(0.99, 1.01), -0.001, Interval(0.047, 0.058)}, 1.75, 2},
      {"aBallInMillimetres",
       ball(1024),
       {Interval(0.99, 1.01) * Interval(1024), -1.0, Interval(0.047, 0.058)},
       1.75,
       2},
      {"aForceToTheMiddle",
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -sign(x[0]) / p[0];
              }),
       {Interval(0.95, 1.05), 0.0, Interval(0.9, 1.1)},
       6.0,
       4},
      {"aGearThatHalvesWhatItPasses",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1] / (2.0 + sign(x[0]));
                dx[1] = -p[0] * x[0] - p[1] * sign(x[0]);
              }),
       {Interval(0.95, 1.05), -0.5, Interval(0.95, 1.05), Interval(0.9, 1.1)},
       2.5,
       1},
      {"aSurfaceThatAParameterMoves",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -4.0 * x[0] + p[1] * sign(x[0] - p[0]);
              }),
       {1.0, 0.0, Interval(0.2, 0.3), Interval(0.9, 1.1)},
       2.0,
       8},
      {"twoSurfacesInAStep",
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -p[0] * (sign(x[0]) + sign(x[0] - 0.25));
              }),
       {Interval(0.9375, 1.0625), 0.0, Interval(0.475, 0.525)},
       2.25,
       8}};
  return all;
}

class FlowPassages : public ::testing::TestWithParam<Passing> {};

TEST_P(FlowPassages, HoldTrajectories) {
  const Passing& machine = GetParam();
  Containment c;
  c.f = machine.f;
  c.box = machine.box;
  c.horizon = machine.horizon;
  for (int i = 1; i < 32; ++i) c.times.push_back(machine.horizon * i / 32);
  EXPECT_LE(expectEvents(c, 12).pieces(), machine.pieces);
  EXPECT_LE(Flow(machine.f).enclose(machine.box, machine.horizon, {}).tightness(), 1.05);
}

/// Wherever the horizon is, among the moments at which they pass or after them; also where a load that a time
/// switches comes behind it.
TEST(FlowPassage, AHorizonMayBeBetweenTheMoments) {
  const Program f = record(1, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = p[0] * (1.5 + sign(t - 1.75)) / (2.0 + sign(x[0]));
  });
  for (int i = 2; i <= 16; ++i) {
    SCOPED_TRACE(i);
    Containment c;
    c.f = f;
    c.box = {-0.75, Interval(0.9375, 1.0625)};
    c.horizon = 1.375 + 0.03125 * i;  // they pass from 1.41 s to 1.6 s
    c.times = {0.5 * c.horizon, 0.984375 * c.horizon};
    EXPECT_LE(expectEvents(c, 8).pieces(), 2);
  }
}

INSTANTIATE_TEST_SUITE_P(Flow, FlowPassages, ::testing::ValuesIn(passing()),
                         [](const auto& machine) { return machine.param.name; });

/// Where what a set leaves over is most of it, as with a constant that may change as it likes, it leaps with the frame:
/// of motions with constant forces, dense in time, none is outside.
TEST(FlowPassage, WhatIsLeftOverLeaps) {
  const Interval forces(0.99, 1.01);
  const Program f = record(2, 0, [&](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -constant<Recorded>(forces) * sign(x[0]) - 4.0 * (1.0 + sign(x[0]));
  });
  const Program truth = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * sign(x[0]) - 4.0 * (1.0 + sign(x[0]));
  });
  const Box box{Interval(1, 1 + 0x1p-40), -1.0};
  std::vector<double> times;
  for (int i = 1; i <= 1024; ++i) times.push_back(0x1p-10 * i);
  std::vector<double> rows;
  for (int i = 1; i <= 8; ++i) rows.push_back(0.125 * i);
  const Tube tube = Flow(f).enclose(box, 1, rows);
  ASSERT_EQ(tube.why(), "");
  EXPECT_LE(tube.pieces(), 2);
  EventReference reference(truth);
  for (const double force : {0.99, 1.0, 1.01}) {
    const std::vector<Vector> motion = reference(Vector{1, -1, Precise(force)}, times);
    for (std::size_t i = 0; i < times.size(); ++i)
      for (std::size_t row = 1; row < tube.times().size(); ++row) {
        if (!(tube.times()[row - 1] < times[i] && times[i] <= tube.times()[row])) continue;
        for (std::size_t s = 0; s < 2; ++s) {
          EXPECT_THAT(tube.statesOver(row)[s], Encloses(motion[i][s])) << times[i];
          if (times[i] == tube.times()[row]) {
            EXPECT_THAT(tube.states(row)[s], Encloses(motion[i][s])) << times[i];
          }
        }
      }
  }
  EXPECT_EQ(reference.events, 3);
}

/// What a set leaves over passes as the saltation matrix says, which keeps areas here: a hundred of them cost no more
/// than the shear between them does.
TEST(FlowPassage, ErrorsDoNotGrowByPassing) {
  const Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -sign(x[0]);
  });
  const double period = 4 * std::sqrt(2.0);
  std::vector<double> times;
  for (int i = 1; i <= 50; ++i) times.push_back(period * i);
  for (const double half : {0.0, 1e-9}) {
    const Tube tube = Flow(f).enclose({Interval(1 - half, 1 + half), 0.0}, 300, times);
    ASSERT_EQ(tube.why(), "");
    EXPECT_LE(tube.pieces(), 2);
    for (std::size_t row = 1; row <= times.size();
         ++row)  // after n periods v is n times the period's 2 √2 half out of phase
      EXPECT_LT(width(tube.states(row)[1]), 1.02 * half * period * static_cast<double>(row) + 1e-10) << row;
  }
}

}  // namespace
}  // namespace gamut::testing
