// Solutions that are held at jumps: trajectories whose events are located in 128 bits, and closed forms, must lie
// inside, exactly; and enclosures are hardly wider than they.
#include <cmath>

#include "analyses/flow/step/jumps.hpp"
#include "tests/analyses/flow/containment.hpp"
#include "tests/analyses/flow/jumping_machine.hpp"

namespace gamut::testing {
namespace {

Recorded stribeck(const Recorded& u) { return sign(u) / (1.0 + 2.0 * abs(u)); }

const std::vector<JumpingMachine>& sliders() {
  static const std::vector<JumpingMachine> all{
      {"comesToRest",
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -x[0] - 0.25 * p[0] * sign(x[1]);
              }),
       {1.0, 0.0, 0.875},
       {Interval(-1, 1), 0.0, Interval(-1, 1)},
       8,
       [](const auto& sides, const Vector&, Vector& x) {
         if (sides[0] == Side::held) x[1] = 0;
       },
       1.01},
      {"sticksAndSlipsOnABelt",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -x[0] - p[0] * stribeck(x[1] - p[1]);
              }),
       {0.0, 0.25, 1.0, 0.25},
       {0.0, 0.0, Interval(-1, 1), 0.0},
       12,
       [](const auto& sides, const Vector& p, Vector& x) {
         if (sides[0] == Side::held) x[1] = p[1];
       },
       1.1},
      {"breaksLoose",
       record(2, 1,
              [](auto t, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = p[0] * t - sign(x[1]);
              }),
       {0.0, 0.0, 0.5},
       {0.0, 0.0, Interval(-1, 1)},
       4,
       [](const auto& sides, const Vector&, Vector& x) {
         if (sides[0] == Side::held) x[1] = 0;
       },
       1.02},
      {"twoRub",
       record(4, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[2];
                dx[1] = x[3];
                dx[2] = -x[0] + (x[1] - x[0]) - p[0] * sign(x[2]);
                dx[3] = -(x[1] - x[0]) - p[1] * sign(x[3]);
              }),
       {0.5, 1.0, 0.0, 0.0, 0.1, 0.15},
       {0.0, 0.0, 0.0, 0.0, Interval(-0.1, 0.1), Interval(-0.1, 0.1)},
       4,
       [](const auto& sides, const Vector&, Vector& x) {
         if (sides[0] == Side::held) x[2] = 0;
         if (sides[1] == Side::held) x[3] = 0;
       },
       1.02},
      {"sledOnASled",
       record(4, 1,
              [](auto t, const auto& x, const auto& p, auto& dx) {
                const auto force = p[0] * sign(x[2] - x[3]);
                dx[0] = x[2];
                dx[1] = x[3];
                dx[2] = -2.0 * force;
                dx[3] = 0.5 * (force + 4.0 * sin(3.0 * t) - x[1]);
              }),
       {0.0, 0.0, 0.0, 0.0, 0.5},
       {0.0, 0.0, 0.0, 0.0, Interval(-0.25, 0.25)},
       4,
       [](const auto& sides, const Vector&, Vector& x) {
         if (sides[0] == Side::held) x[2] = x[3];
       },
       2.5},
      {"relay",
       record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = -p[0] * sign(x[0]) + 0.25; }),
       {1.0, 1.0},
       {Interval(-1, 1), Interval(-1, 1)},
       2,
       [](const auto& sides, const Vector&, Vector& x) {
         if (sides[0] == Side::held) x[0] = 0;
       },
       1}};
  return all;
}

class FlowSliding : public ::testing::TestWithParam<JumpingMachine> {};

TEST_P(FlowSliding, HoldsTrajectories) { holdsTrajectories(GetParam(), {0.0, 1e-6, 0.01}, 4); }

INSTANTIATE_TEST_SUITE_P(Flow, FlowSliding, ::testing::ValuesIn(sliders()),
                         [](const auto& machine) { return machine.param.name; });

/// Half-periods of π, each 2μ less: from x(0) the mass rests at x(0) - 4μ after two of them, whatever the units.
TEST(FlowSlidingExactly, RestIsRest) {
  for (const double unit : {1.0, 0x1p-20, 0x1p20}) {
    SCOPED_TRACE(unit);
    const Program f = record(2, 2, [](auto, const auto& x, const auto& p, auto& dx) {
      dx[0] = x[1];
      dx[1] = -x[0] - p[0] * p[1] * sign(x[1]);
    });
    const Box box{unit * Interval(0.984375, 1.015625), 0.0, Interval(0.2109375, 0.21875), Interval(unit)};
    const Tube tube = Flow(f).enclose(box, 100, {7, 100});
    ASSERT_EQ(tube.why(), "");
    for (const std::size_t row : {1u, 2u}) {
      const Interval truth = unit * Interval(0.984375 - 4 * 0.21875, 1.015625 - 4 * 0.2109375);
      EXPECT_TRUE(isSubset(truth, tube.states(row)[0]));
      EXPECT_LT(width(tube.states(row)[0]), (1 + 1e-6) * width(truth));
      EXPECT_LT(magnitude(tube.states(row)[1]), 1e-100);
    }
  }
}

/// Nothing tells when a motion leaves a surface that repels, or on which side: ẋ = sign x + w, |w| ≤ ½, and with it y.
TEST(FlowSlidingExactly, LeavesAtAnyTime) {
  const Program f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = sign(x[0]) + 0.5 * p[0]; });
  for (const bool varies : {false, true}) {
    FlowOptions options;
    if (varies) options.varying = {{0}};
    const Tube tube = Flow(f, options).enclose({0.0, Interval(-1, 1)}, 1, {0.5, 1});
    ASSERT_EQ(tube.why(), "");
    for (const std::size_t row : {1u, 2u}) {
      EXPECT_TRUE(isSubset(1.5 * tube.times()[row] * Interval(-1, 1), tube.states(row)[0]));
      EXPECT_LT(width(tube.states(row)[0]), 3.01 * tube.times()[row]);
    }
  }
}

/// An input holds the sliding mass at the surface or takes it away: v' = w - sign v, |w| ≤ 2: |v| ≤ t and |x| ≤ t²/2.
TEST(FlowSlidingExactly, HoldsWhatInputsMove) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] - sign(x[1]);
  });
  FlowOptions options;
  options.varying = {{0}};
  const Tube away = Flow(f, options).enclose({0.0, 0.0, Interval(-2, 2)}, 1, {0.5, 1});
  ASSERT_EQ(away.why(), "");
  for (const std::size_t row : {1u, 2u}) {
    const double t = away.times()[row];
    EXPECT_TRUE(isSubset(Interval(-t, t), away.states(row)[1]));
    EXPECT_TRUE(isSubset(0.5 * t * Interval(-t, t), away.states(row)[0]));
    EXPECT_LT(magnitude(away.states(row)[1]), 1.3 * t);
  }
  const Tube held = Flow(f, options).enclose({0.0, 0.0, Interval(-0.5, 0.5)}, 1, {0.5, 1});
  ASSERT_EQ(held.why(), "");
  EXPECT_LT(magnitude(held.states(2)[0]), 1e-100);
}

/// Outputs between their times, where the set's own bounds and what is known of the argument meet.
TEST(FlowSlidingExactly, OutputsHoldTrajectories) {
  const JumpingMachine& machine = sliders()[1];
  const Program g = record(2, 2, 2, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = sqr(x[1]) + x[0];
    y[1] = sin(10.0 * x[1]) * p[0];
  });
  const Box box{0.0, 0.25, Interval(0.99, 1.01), 0.25};
  const Tube tube = Flow(machine.f, g).enclose(box, 12, {3, 6, 9, 12});
  ASSERT_EQ(tube.why(), "");
  SlidingReference reference(machine.f, machine.rest);
  std::vector<double> times;
  for (int i = 1; i <= 192; ++i) times.push_back(i / 16.0);
  Points points(5);
  Evaluator<Precise> outputs(g);
  for (int trial = 0; trial < 4; ++trial) {
    const Vector start = points.inside(box);
    outputs.setParameters(Vector(start.begin() + 2, start.end()));
    const std::vector<Vector> motion = reference(start, times);
    for (std::size_t i = 0; i < times.size(); ++i) {
      const Vector y = outputs(Precise(times[i]), motion[i]);
      const std::size_t row = (i + 48) / 48;
      const auto& bounds = times[i] == tube.times()[row] ? tube.outputs(row) : tube.outputsOver(row);
      for (std::size_t o = 0; o < 2; ++o) ASSERT_THAT(bounds[o], Encloses(y[o])) << times[i];
    }
  }
}

/// A crate on a slope that tilts, at rest from the start on, until friction (μ = 3) no longer holds it: what holds it
/// is the load, not zero. Outputs: friction, acceleration; times before and after 3 = (2 + t) w, w = 0.9 … 1.1.
TEST(FlowSlidingExactly, OutputsHoldWhatHolds) {
  const auto acceleration = [](auto t, const auto& x, const auto& p) { return (2.0 + t) * p[0] - 3.0 * sign(x[1]); };
  const Program f = record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = acceleration(t, x, p);
  });
  const Program g = record(2, 1, 2, [&](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = -3.0 * sign(x[1]);
    y[1] = acceleration(t, x, p);
  });
  for (const Interval& w : {Interval(1.0), Interval(0.9375, 1.0625)}) {
    SCOPED_TRACE(toString(w));
    const Tube tube = Flow(f, g).enclose({0.0, 0.0, w}, 3, {0.25, 0.5, 2.5, 3});
    ASSERT_EQ(tube.why(), "");
    for (std::size_t row = 0; row < 3; ++row) {  // held; and right after row 2 at the greatest w still
      const Interval load = (2.0 + Interval(tube.times()[row])) * w;
      EXPECT_TRUE(isSubset(-load, tube.outputs(row)[0])) << row;
      EXPECT_TRUE(contains(tube.outputs(row)[1], 0.0)) << row;
      EXPECT_LT(width(tube.outputs(row)[0]), 1.01 * width(load) + 1e-12) << row;
      EXPECT_LT(magnitude(tube.outputs(row)[1]), 1e-12) << row;
    }
    EXPECT_TRUE(isSubset(-hull(2.25 * w, 2.5 * w), tube.outputsOver(2)[0]));
    EXPECT_TRUE(contains(tube.outputs(4)[0], -3.0));
    EXPECT_TRUE(isSubset(5.0 * w - 3.0, tube.outputs(4)[1]));
    EXPECT_LT(width(tube.outputs(4)[0]), 1e-12);
  }
}

/// While some rest and others still come, p sign x of those that rest is 1/4 whatever p is: as a product of intervals
/// it would be 0.2423 and more.
TEST(FlowSlidingExactly, WhatHoldsDependsOnWhatItHolds) {
  const auto rate = [](const auto& x, const auto& p) { return 0.25 + 0.25 * x[0] - p[0] * sign(x[0]); };
  const Program f = record(1, 1, [&](auto, const auto& x, const auto& p, auto& dx) { dx[0] = rate(x, p); });
  const Program g = record(1, 1, 2, [&](auto, const auto& x, const auto& p, auto& y) {
    y[0] = p[0] * sign(x[0]);
    y[1] = rate(x, p);
  });
  for (const double side : {1.0, -1.0}) {  // from below: the mirror image, p sign x = 1/4 still
    const Interval start = Interval(side) * Interval(0.25, 0.5);
    const Tube tube = Flow(f, g).enclose({start, Interval(0.95, 1.05)}, 2, {2});
    ASSERT_EQ(tube.why(), "");
    const Interval force = tube.outputsOver(1)[0], all = tube.outputsOver(1)[1];
    EXPECT_TRUE(isSubset(hull(Interval(0.25), side * Interval(0.95, 1.05)), force)) << toString(force);
    EXPECT_TRUE(contains(all, 0.0)) << toString(all);
    if (side > 0) {
      EXPECT_GT(force.lower(), 0.249);
      EXPECT_LT(all.upper(), 0.001);
    } else {
      EXPECT_LT(force.upper(), 0.251);
      EXPECT_GT(all.lower(), -0.001);
    }
  }
}

/// Where some rest already and others still come, by 1 - c or so a second: an acceleration is that of either, at output
/// times and between, in alpha-cuts and in models; what rests has c for a sign, whatever it is written as.
TEST(FlowSlidingExactly, OutputsHoldThoseThatRestAndThoseThatCome) {
  for (const double c : {-0.75, -0.125, 0.25, 0.875})
    for (const double shift : {0.0, 0.5})
      for (const double side : {-1.0, 1.0}) {
        SCOPED_TRACE(::testing::Message() << c << ' ' << shift << ' ' << side);
        const Program f =
            record(1, 1, [&](auto, const auto& x, const auto& p, auto& dx) { dx[0] = c - sign(x[0] - shift * p[0]); });
        const Program g = record(1, 1, 4, [&](auto, const auto& x, const auto& p, auto& y) {
          const auto u = x[0] - shift * p[0];
          y[0] = c - sign(u);
          y[1] = sign(2.0 * u);
          y[2] = 1.5 - 0.5 * sign(-u);  // where(u < 0, 1, 2)
          y[3] = sqr(sign(u));
        });
        const Box box{shift + side * Interval(0.25, 0.75), 1.0}, level{shift + side * Interval(0.25, 0.5), 1.0};
        FlowOptions options;
        options.modelled = {0, 1, 2, 3};
        const double first = 0.25 / (1 - side * c);  // comes to rest
        const Tube tube =
            Flow(f, g, options).enclose(box, 4 * first, {1.5 * first, 1.75 * first, 2.5 * first}, {level});
        ASSERT_EQ(tube.why(), "");
        for (std::size_t row = 1; row < tube.reachedTimes(); ++row) {
          const bool allRest = tube.times()[row] > 3 * first, oneComes = tube.times()[row] < 3 * first;
          std::vector<std::vector<double>> truths{{0.0, c, 1.5 + 0.5 * c, c * c}};
          if (oneComes) truths.push_back({c - side, side, 1.5 + 0.5 * side, 1.0});
          for (std::size_t o = 0; o < 4; ++o) {
            for (const std::vector<double>& truth : truths) {
              EXPECT_TRUE(contains(tube.outputs(row)[o], truth[o])) << row << ' ' << o;
              EXPECT_TRUE(contains(tube.outputsOver(row)[o], truth[o])) << row << ' ' << o;
            }
            EXPECT_TRUE(contains(tube.cut(0, row)[o], truths[0][o])) << row << ' ' << o;
            Interval model = Interval::empty(), chords = Interval::empty();
            for (const auto& snapshot : tube.models()->at[row]) model = hull(model, snapshot->outputs[o].bound);
            for (const FlowChord& chord : tube.models()->over[row]) chords = hull(chords, chord.bound[o]);
            EXPECT_TRUE(contains(model, truths[0][o])) << row << ' ' << o;
            EXPECT_TRUE(contains(chords, truths[0][o])) << row << ' ' << o;
            const Interval truth = oneComes ? hull(Interval(truths[0][o]), Interval(truths[1][o])) : truths[0][o];
            EXPECT_LT(width(tube.outputs(row)[o]), 1.01 * width(truth) + 1e-9) << row << ' ' << o;
            if (allRest) {
              EXPECT_LT(width(tube.outputs(row)[o]), 1e-12) << row << ' ' << o;
            }
          }
        }
      }
}

/// A sign that jumps as another surface is reached begins anew with the step: what holds x is -¼ until y has come to
/// rest, then ¼.
TEST(FlowSlidingExactly, WhatHoldsMayJump) {
  const Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = 0.25 - 0.5 * sign(x[1]) - sign(x[0]);
    dx[1] = 0.0 - sign(x[1]);
  });
  const Program g = record(2, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = sign(x[0]); });
  for (const Interval& start : {Interval(0.5), Interval(0.4375, 0.5625)}) {
    const Tube tube = Flow(f, g).enclose({0.0, start}, 1, {0.25, 0.75});
    ASSERT_EQ(tube.why(), "");
    EXPECT_TRUE(contains(tube.outputs(1)[0], -0.25));
    EXPECT_TRUE(contains(tube.outputs(2)[0], 0.25));
    EXPECT_TRUE(isSubset(Interval(-0.25, 0.25), tube.outputsOver(2)[0]));
    EXPECT_LT(width(tube.outputs(1)[0]), 1e-9);
    EXPECT_LT(width(tube.outputs(2)[0]), 1e-9);
    EXPECT_TRUE(contains(tube.outputsOver(3)[0], 0.25));
  }
}

/// A surface is known again whatever scales it: ω in the motion, r ω or ω/r in what is asked for.
TEST(FlowSlidingExactly, OutputsKnowSurfacesWithFactors) {
  const Program f = record(1, 1, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = 0.3125 - sign(x[0]); });
  const Program g = record(1, 1, 5, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = sign(p[0] * x[0]);
    y[1] = sign(x[0] / p[0]);
    y[2] = sign(x[0] * exp(t));
    y[3] = -sign(-x[0] * p[0] * 3.0);
    y[4] = sign(p[0]) * sign(t + 1.0);  // of none
  });
  for (const Interval& start : {Interval(0.0), Interval(0.125, 0.25)}) {
    const Tube tube = Flow(f, g).enclose({start, Interval(1.0, 2.0)}, 1, {0.5});
    ASSERT_EQ(tube.why(), "");
    for (std::size_t row = 1; row < tube.reachedTimes(); ++row)
      for (std::size_t o = 0; o < 4; ++o) {
        EXPECT_TRUE(contains(tube.outputs(row)[o], 0.3125)) << row << ' ' << o;
        EXPECT_TRUE(contains(tube.outputsOver(row)[o], 0.3125)) << row << ' ' << o;
        EXPECT_LT(width(tube.outputs(row)[o]), 1e-9) << row << ' ' << o;
      }
    EXPECT_TRUE(isEqual(tube.outputs(1)[4], Interval(1.0)));
  }
}

/// A surface is known again whatever factors it has, in kinks too: at |2 x| = 1 the sign is -¼ from the start on.
TEST(FlowSlidingExactly, OutputsKnowSurfacesWithKinks) {
  const Program f =
      record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -0.25 - sign(abs(2.0 * x[0]) - 1.0); });
  const Program g =
      record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = sign(abs(2.0 * x[0]) - 1.0); });
  const Tube tube = Flow(f, g).enclose({0.5}, 0.125, {0.0625});
  for (std::size_t row = 0; row < tube.reachedTimes(); ++row) {
    EXPECT_TRUE(contains(tube.outputs(row)[0], -0.25)) << row;
    EXPECT_TRUE(contains(tube.outputsOver(row)[0], -0.25)) << row;
  }
}

/// At the start a motion may leave at once, and the sign is anything.
TEST(FlowSlidingExactly, OutputsAtTheStartAllowForEverySign) {
  const Program f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] - sign(x[0]); });
  const Program g = record(1, 1, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = 2.0 * sign(-x[0]); });
  const auto atStart = [&](const Interval& x, const Interval& w) {
    return Flow(f, g).enclose({x, w}, 1, {1}).outputs(0)[0];
  };
  EXPECT_TRUE(isEqual(atStart(0.0, 3.0), Interval(-2.0, 2.0)));
  EXPECT_TRUE(isEqual(atStart(0.0, Interval(0.5, 3.0)), Interval(-2.0, 2.0)));
  EXPECT_TRUE(isEqual(atStart(0.0, 0.5), Interval(-1.0)));  // held
  EXPECT_TRUE(isEqual(atStart(Interval(0.0, 1.0), 0.5), Interval(-2.0, 2.0)));
  EXPECT_TRUE(isEqual(atStart(Interval(0.5, 1.0), 3.0), Interval(-2.0)));
}

/// What holds one block at the start depends on the friction of another, which leaves with its own.
TEST(FlowSlidingExactly, OutputsAtTheStartHeedWhatLeaves) {
  const Program f = record(2, 0, [](auto, const auto& v, const auto&, auto& dv) {
    dv[0] = 1.0 - 3.0 * sign(v[0]) + 0.5 * sign(v[1]);
    dv[1] = 5.0 - sign(v[1]);
  });
  const Program g = record(2, 0, 1, [](auto, const auto& v, const auto&, auto& y) { y[0] = -3.0 * sign(v[0]); });
  const Tube tube = Flow(f, g).enclose({0.0, 0.0}, 1, {1});
  ASSERT_EQ(tube.why(), "");
  EXPECT_TRUE(contains(tube.outputs(0)[0], -1.5));
  EXPECT_TRUE(contains(tube.outputs(1)[0], -1.5));
  EXPECT_LT(width(tube.outputs(1)[0]), 1e-12);
}

/// A rate of zero on one side lets solutions stay on the surface as long as they like.
TEST(FlowSlidingExactly, StaysWhereOneSideIsAtRest) {
  const Program up = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = 1.0 + sign(x[0]); });
  const Program down = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -1.0 + sign(x[0]); });
  const Program later =
      record(1, 0, [](auto t, const auto& x, const auto&, auto& dx) { dx[0] = (t - 1.0) * (1.0 + sign(x[0])) * 0.5; });
  EXPECT_TRUE(isSubset(Interval(0, 2), Flow(up).enclose({0.0}, 1).at(1)[0]));
  EXPECT_TRUE(isSubset(Interval(-2, 0), Flow(down).enclose({0.0}, 1).at(1)[0]));
  EXPECT_TRUE(
      isSubset(Interval(0, 2), Flow(later).enclose({0.0625}, 3).at(3)[0]));  // at rest from 0.06 s on, or till 1 s
}

/// What is held may make other signs one, a number, or nothing.
TEST(FlowSlidingExactly, HeldArgumentsChangeOtherSigns) {
  const Program block = record(2, 0, [](auto t, const auto& x, const auto&, auto& dx) {
    dx[0] = -0.125 * sign(x[0]) - 0.125 * sign(x[0] - x[1]);
    dx[1] = t - sign(x[1]);
  });
  const Tube two = Flow(block).enclose({10.0, 0.0}, 3);
  EXPECT_THAT(two.at(3)[0], Encloses(Precise(9.25)));
  EXPECT_THAT(two.at(3)[1], Encloses(Precise(2.0)));
  const Program step = record(
      1, 0, [](auto t, const auto& x, const auto&, auto& dx) { dx[0] = t - sign(x[0]) - 0.25 * sign(x[0] - 0.5); });
  EXPECT_THAT(Flow(step).enclose({0.0}, 1.25).at(1.25)[0], Encloses(Precise(0.125)));  // (t - 0.75)²/2
  const Program faint = record(2, 0, [](auto t, const auto& x, const auto&, auto& dx) {
    dx[0] = 1.0 + 0.125 * sign(x[0]) * x[1];
    dx[1] = t - sign(x[1]);
  });
  const Tube nothing = Flow(faint).enclose({1.0, 0.0}, 3);
  EXPECT_THAT(nothing.at(3)[1], Encloses(Precise(2.0)));
  EXPECT_THAT(nothing.at(3)[0], Encloses(Precise(4 + Precise(1) / 6)));  // ∫ (t - 1)²/16
  const Program turned = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    const auto s = sign(x[0] - x[1]);
    dx[0] = -5.0 * sign(x[0]) - s;
    dx[1] = 0.5 * s + 0.25;
  });
  for (const Interval& start : {Interval(0.0078125, 0.015625), Interval(1.0)}) {
    const Tube tube = Flow(turned).enclose({0.0, start}, 8);
    ASSERT_EQ(tube.why(), "");
    EXPECT_TRUE(contains(tube.at(8)[0], 0.0));
    EXPECT_TRUE(contains(tube.at(8)[1], 0.0));
    EXPECT_LT(magnitude(tube.at(8)[1]), 1e-9);
  }
}

/// u = x - w with an input w: it holds nothing, since w moves. With s = sign cos 20 t, x = -∫s and w = x - s/100; then
/// y is ∫|cos 20 t|, 1.26273 after 2 s.
TEST(FlowSlidingExactly, InputsMoveArguments) {
  const Program f = record(2, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
    const auto s = sign(x[0] - p[0]);
    dx[0] = -s;
    dx[1] = s * cos(20.0 * t);
  });
  FlowOptions options;
  options.varying = {{0}};
  EXPECT_GT(Flow(f, options).enclose({0.0, 0.0, Interval(-0.125, 0.125)}, 2).at(2)[1].upper(), 1.2626);
}

/// What a wide start that is carried as a remainder does to an argument, it does through the frame's ξ too.
TEST(FlowSlidingExactly, RemaindersMoveArguments) {
  const Program f = record(3, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = 6e6 * p[0] * (x[1] - 1048576.0) - sign(x[0]);
    dx[1] = Recorded(0.0);
    dx[2] = x[0];
  });
  const double offset = 0x1p-24;
  const Tube tube = Flow(f).enclose({1.0, Interval(1048576 - offset, 1048576 + offset), 0.0, Interval(0.85, 1.15)}, 1.5,
                                    {0.8, 1.4, 1.5});
  for (const std::size_t row : {1u, 2u, 3u}) {
    const Precise slowest = 1 - Precise(tube.times()[row]) * (1 - Precise(6e6) * Precise(1.15) * offset);
    EXPECT_GE(Precise(tube.states(row)[0].upper()), slowest);
  }
}

/// |u| and sign u of one argument: x(t) = 0 holds, and with it y = 0; e is zero, but plain intervals do not know.
TEST(FlowSlidingExactly, SlopesOfKinksAreNotSigns) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    const auto e = sqr(p[0] + 1.0) - sqr(p[0]) - 2.0 * p[0] - 1.0;
    dx[0] = 0.5 - sign(x[0]) + sqr(e);
    dx[1] = abs(x[0]) - x[0];
  });
  const Tube tube = Flow(f).enclose({0.0, 0.0, Interval(-1, 1)}, 1);
  EXPECT_TRUE(contains(tube.at(1)[0], 0.0));
  EXPECT_TRUE(contains(tube.at(1)[1], 0.0));
}

/// Products that vanish in doubles are not zero.
TEST(FlowSlidingExactly, TinyArgumentsAreArguments) {
  for (const double scale : {0x1p-1074, 0x1p-1000}) {
    const Program f =
        record(1, 0, [scale](auto, const auto& x, const auto&, auto& dx) { dx[0] = -sign(Recorded(scale) * x[0]); });
    EXPECT_THAT(Flow(f).enclose({0.375}, 0.25).at(0.25)[0], Encloses(Precise(0.125)));
  }
}

/// A sign that stands where another is held is not a third one of another threshold. A valve opens at 0 and shuts at 2.
TEST(FlowSlidingExactly, ThresholdsAreToldApart) {
  const Program steps = record(3, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = 1.0 + sign(x[1]) - sign(x[0]);
    dx[1] = 1.0;
    dx[2] = 0.01 * sign(x[1] - 0.5);
  });
  const Tube tube = Flow(steps).enclose({0.0, -0.125, 0.0}, 1, {0.5, 1});
  EXPECT_THAT(tube.states(1)[0], Encloses(Precise(0.375)));
  EXPECT_THAT(tube.states(2)[0], Encloses(Precise(0.875)));
  const Program valve = record(3, 0, [](auto, const auto& x, const auto&, auto& dx) {
    const Recorded none(0.0), one(1.0);
    dx[0] = one;
    dx[1] = where(x[0], one, none) - where(x[0] - 2.0, one, none) - 0.75 * sign(x[1]);
    dx[2] = where(x[0], one, none) + where(x[0] - 2.0, one, none) - x[2];
  });
  const Tube opened = Flow(valve).enclose({-0.5, 0.0, 0.0}, 2, {1, 2});
  EXPECT_THAT(opened.states(1)[1], Encloses(Precise(0.125)));
  EXPECT_THAT(opened.states(2)[1], Encloses(Precise(0.375)));
}

/// On one surface all signs are one: x rests with s = ½, and y follows it.
TEST(FlowSlidingExactly, SignsOnOneSurfaceAreOne) {
  using Argument = Recorded (*)(const Recorded&, const Recorded&);
  const Argument arguments[] = {[](const Recorded& x, const Recorded&) { return 3.0 * x; },
                                [](const Recorded& x, const Recorded& p) { return p * x; },
                                [](const Recorded& x, const Recorded&) { return sin(x); },
                                [](const Recorded& x, const Recorded&) { return x * x * x; }};
  for (const Argument argument : arguments) {
    const Program f = record(2, 1, [&](auto, const auto& x, const auto& p, auto& dx) {
      dx[0] = 0.5 - sign(x[0]);
      dx[1] = sign(argument(x[0], p[0]));
    });
    const Tube tube = Flow(f).enclose({0.25, 0.0, Interval(1, 2)}, 1);  // arrives at 0.5 s
    EXPECT_THAT(tube.at(1)[0], Encloses(Precise(0.0)));
    EXPECT_THAT(tube.at(1)[1], Encloses(Precise(0.75)));
  }
}

/// Where surfaces meet, a third one through both may be on any side, whatever it agrees with elsewhere.
TEST(FlowSlidingExactly, CornersLeaveThirdSignsFree) {
  const Program f = record(3, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = -sign(x[0]);
    dx[1] = -sign(x[1]);
    dx[2] = sign(x[1] + 3.0 * x[0]);
  });
  const Tube tube = Flow(f).enclose({0.0, Interval(0.5, 0.5078125), 0.0}, 2);
  EXPECT_TRUE(isSubset(Interval(-1, 2), tube.at(2)[2]));
}

/// A brake that engages at ½ s, times the sign of what it brakes: w = 1 - M (t - ½) until it rests.
TEST(FlowSlidingExactly, JumpsInTimeMayBeFactors) {
  const Program f = record(2, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -where(t - 0.5, p[0], Recorded(0.0)) * sign(x[1]);
  });
  const Tube tube = Flow(f).enclose({0.0, 1.0, Interval(1.9375, 2.0625)}, 2, {0.75, 2});
  ASSERT_EQ(tube.why(), "");
  const Interval truth = 1.0 - 0.25 * Interval(1.9375, 2.0625);
  EXPECT_TRUE(isSubset(truth, tube.states(1)[1]));
  EXPECT_LT(width(tube.states(1)[1]), 1.01 * width(truth));
  EXPECT_LT(magnitude(tube.states(2)[1]), 1e-100);
  EXPECT_THAT(tube.states(2)[0], Encloses(Precise(0.5) + 1 / (2 * Precise(1.9375))));
  EXPECT_THAT(tube.states(2)[0], Encloses(Precise(0.5) + 1 / (2 * Precise(2.0625))));
  EXPECT_LT(width(tube.states(2)[0]), 0.0165);
}

/// A force that begins at a known time takes a mass away that is held until then.
TEST(FlowSlidingExactly, HeldTillATime) {
  const Program f = record(1, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = where(t - 1.0, Recorded(3.0), Recorded(0.0)) - p[0] * sign(x[0]);
  });
  for (const double radius : {0x1p-6, 0x1p-12}) {
    const Tube tube = Flow(f).enclose({1.0, Interval(2 - radius, 2 + radius)}, 2, {1, 2});
    EXPECT_TRUE(isSubset(Interval(1 - radius, 1 + radius), tube.states(2)[0]));
    EXPECT_LT(width(tube.states(2)[0]), 2.01 * radius);
  }
}

/// While x₁ (y) is held, what is left of the other arguments is a multiple of one state: its factor, its sign and its
/// place among the jumps may be others.
TEST(Sliding, ArgumentsOfWhichAPartIsHeldAreStillThemselves) {
  const Program sign2 = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    const auto s = sign(-2.0 * x[0] + x[1]);
    dx[0] = 0.125 * s;
    dx[1] = 0.25 - 0.875 * s - sign(x[1]);
  });
  EXPECT_THAT(Flow(sign2).enclose({1.0, 0.0}, 0.5, {0.5}).at(0.5)[1], Encloses(Precise(0.0625)));
  const Program order = record(3, 0, [](auto, const auto& x, const auto&, auto& dx) {
    const auto s = sign(2.0 * x[0] - x[1]);
    dx[0] = -0.125 * s;
    dx[1] = 0.25 + 0.4375 * s - 0.4375 * sign(x[2]) - sign(x[1]);
    dx[2] = -0.125 * sign(x[2]);
  });
  EXPECT_THAT(Flow(order).enclose({1.0, 0.0, -1.0}, 0.5, {0.5}).at(0.5)[1], Encloses(Precise(0.0625)));
  const Program scale = record(3, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = -0.25 * sign(0.25 * x[0] + x[1]) + 0.0625 * x[2];
    dx[1] = -2.0 * sign(x[1]);
    dx[2] = -x[2];
  });
  const Precise now = -1 + Precise(0.25) * Precise(0.5) + Precise(0.0625) * Precise(0.25) * (1 - exp(Precise(-0.5)));
  EXPECT_THAT(Flow(scale).enclose({Interval(-1, 1), 0.0, 0.25}, 0.5, {0.5}).at(0.5)[0], Encloses(now));
}

}  // namespace
}  // namespace gamut::testing
