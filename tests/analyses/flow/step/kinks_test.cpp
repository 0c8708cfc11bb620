// Right-hand sides with kinks and jumps: trajectories whose events are located in 128 bits must lie inside, exactly.
#include <cmath>
#include <tuple>

#include "tests/analyses/flow/expect_events.hpp"

namespace gamut::testing {
namespace {

struct Kinked {
  std::string name;
  Program f;
  Box centre;  // with zeros where `spread` says how wide
  Box spread;  // times the width
  double horizon;
};

const std::vector<Kinked>& kinked() {
  static const std::vector<Kinked> all{
      {"bouncesOnASpring",
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -9.81 - 100.0 * p[0] * min(x[0], Recorded(0.0)) - 0.1 * x[1];
              }),
       {1.0, 0.0, 1.0},
       {Interval(-1, 1), 0.0, Interval(-1, 1)},
       2},
      {"saturates",
       record(2, 0,
              [](auto, const auto& x, const auto&, auto& dx) {
                dx[0] = x[1];
                dx[1] = max(Recorded(-0.5), min(Recorded(0.5), -4.0 * x[0] - x[1]));
              }),
       {1.0, 0.0},
       {Interval(-1, 1), Interval(-1, 1)},
       4},
      {"hasBacklash",
       record(2, 0,
              [](auto t, const auto& x, const auto&, auto& dx) {
                dx[0] = x[1];
                dx[1] = cos(t) - x[0] - 5.0 * (max(x[0] - 0.5, Recorded(0.0)) + min(x[0] + 0.5, Recorded(0.0)));
              }),
       {0.0, 0.0},
       {Interval(-1, 1), 0.0},
       6},
      {"slidesWithDryFriction",
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -4.0 * x[0] - 0.3 * p[0] * sign(x[1]);
              }),
       {1.0, -0.0625, 1.0},
       {Interval(-1, 1), 0.0, Interval(-1, 1)},
       3.5},
      {"changesItsRate",
       record(
           1, 0,
           [](auto, const auto& x, const auto&, auto& dx) { dx[0] = where(x[0] - 1.5, Recorded(1.0), Recorded(2.0)); }),
       {1.0},
       {Interval(-1, 1)},
       1},
      {"dragsQuadratically",
       record(2, 0,
              [](auto, const auto& x, const auto&, auto& dx) {
                dx[0] = x[1];
                dx[1] = -x[0] - 0.4 * abs(x[1]) * x[1] + 0.2 * abs(x[0] - 0.3);
              }),
       {1.0, 0.0},
       {Interval(-1, 1), Interval(-1, 1)},
       5}};
  return all;
}

class FlowKinks : public ::testing::TestWithParam<Kinked> {};

TEST_P(FlowKinks, HoldTrajectoriesAcrossEvents) {
  const Kinked& machine = GetParam();
  for (double width : {0.0, 1e-6, 0.003}) {
    SCOPED_TRACE(width);
    Containment c;
    c.f = machine.f;
    c.box = machine.centre;
    for (std::size_t i = 0; i < c.box.size(); ++i) c.box[i] = machine.centre[i] + Interval(width) * machine.spread[i];
    c.horizon = machine.horizon;
    c.times = {machine.horizon / 4, machine.horizon / 2};
    const Tube tube = expectEvents(c, width == 0 ? 1 : 12);
    for (const Interval& state : tube.states(tube.reachedTimes() - 1))
      EXPECT_LT(gamut::width(state), width == 0 ? 1e-6 : 60 * width);
  }
}

INSTANTIATE_TEST_SUITE_P(Flow, FlowKinks, ::testing::ValuesIn(kinked()),
                         [](const auto& machine) { return machine.param.name; });

/// Loads of time on a mass at rest, whose kinks and jumps are between doubles (⅓ s, ⅔ s) or depend on what is
/// uncertain.
TEST(FlowKink, OfTimeEndSteps) {
  const auto rising = [](const Recorded& t, const Recorded&) { return max(3.0 * t - 1.0, Recorded(0.0)); };
  const auto ramp = [](const Recorded& t, const Recorded&) {
    return min(max(3.0 * t - 1.0, Recorded(0.0)), Recorded(1.0));
  };
  const auto soft = [](const Recorded& t, const Recorded&) { return sqr(max(t - 0.25, Recorded(0.0))); };
  const auto step = [](const Recorded& t, const Recorded&) { return 1.0 + sign(3.0 * t - 1.0); };
  const auto pulses = [](const Recorded& t, const Recorded&) { return 1.0 + sign(sin(20.0 * t) - 0.5); };
  const auto rectified = [](const Recorded& t, const Recorded&) { return abs(sin(20.0 * t)); };
  const auto late = [](const Recorded& t, const Recorded& p) { return max(t - 0.25 * p, Recorded(0.0)); };
  const std::tuple<Recorded (*)(const Recorded&, const Recorded&), long, double> loads[] = {
      {rising, 20, 1.02}, {ramp, 20, 1.02},      {soft, 20, 1.02},  {step, 20, 1.02},
      {pulses, 60, 1.02}, {rectified, 60, 1.02}, {late, 100000, 10}};
  for (const auto& [load, steps, tightness] : loads)
    for (const double width : {0.0, 1e-6, 0.02}) {
      SCOPED_TRACE(width);
      Containment c;
      c.f = record(2, 2, [&](auto t, const auto& x, const auto& p, auto& dx) {
        dx[0] = x[1];
        dx[1] = 10.0 * load(t, p[1]) - 40.0 * p[0] * x[0] - 2.0 * x[1];
      });
      const Interval around = Interval(1.0) + Interval(width) * Interval(-1, 1);
      c.box = {0.0, 0.0, around, around};
      c.horizon = 1;
      c.times = {0.25, 0.5};
      const Tube tube = expectEvents(c, width == 0 ? 1 : 6);
      EXPECT_LT(tube.steps(), steps);
      EXPECT_LT(tube.tightness(), tightness);
      if (width == 0) {
        EXPECT_LT(gamut::width(tube.at(1)[0]), 1e-12);
      }
    }
}

/// What jumps at a double is what it was up to there, and not the mean that it is there.
TEST(FlowKink, OutputsJumpBetweenOutputTimes) {
  for (const int rows : {1, 2, 4, 16}) {
    Containment c;
    c.f = record(1, 1, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -x[0]; });
    c.g = record(1, 1, 3, [](auto t, const auto& x, const auto& p, auto& y) {
      y[0] = p[0] * where(t - 0.5, Recorded(-2.0), t * x[0]);
      y[1] = p[0] * where(sin(20.0 * t), t, x[0]);
      y[2] = where(x[0] - p[0], 1.0 + t, t - 1.0);
    });
    c.box = {Interval(0.99, 1.01), 0.5};
    c.horizon = 1;
    for (int i = 1; i < rows; ++i) c.times.push_back(i / static_cast<double>(rows));
    const Tube tube = expectEvents(c, 6, false);
    EXPECT_EQ(tube.reached(), 1);
  }
}

/// Between output times too, what outputs make of time.
TEST(FlowKink, OfTimeInOutputs) {
  Containment c;
  c.f = record(1, 1, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -x[0]; });
  c.g = record(1, 1, 2, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = p[0] * abs(3.0 * t - 1.0) * x[0];
    y[1] = p[0] * (2.0 + sign(3.0 * t - 2.0));
  });
  c.box = {Interval(0.99, 1.01), Interval(0.99, 1.01)};
  c.horizon = 1;
  for (int i = 1; i < 16; ++i) c.times.push_back(i / 16.0);
  const Tube tube = expectEvents(c, 6, false);
  for (std::size_t row = 1; row < tube.times().size(); ++row) {
    const double from = tube.times()[row - 1], to = tube.times()[row];
    const auto size = [](double t) { return std::fabs(3 * t - 1) * std::exp(-t); };
    // |3t - 1|e^{-t} rises to t = 4/3 but for the kink.
    EXPECT_LE(tube.outputsOver(row)[0].upper(), 1.0221 * std::max(size(from), size(to)) + 3e-3) << row;
    if (to < 0.66 || from > 0.67) {
      EXPECT_LT(width(tube.outputsOver(row)[1]), 0.0601 + 0.04 * (from > 0.67)) << row;
    }
  }
}

/// On one side all the time: as exact as without.
TEST(FlowKink, OnOneSidePassExactly) {
  Containment c;
  c.box = {Interval(0.9, 1.1), 0.0};
  c.horizon = 2;
  c.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -sin(x[0]);
  });
  const Tube smooth = c.tube();
  c.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -sin(abs(x[0] + 20.0) - 20.0 * sign(x[0] + 3.0));
  });
  const Tube tube = c.tube();
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(width(tube.at(2)[i]), (1 + 1e-6) * width(smooth.at(2)[i]));
}

/// Friction holds a body for ever: the solution of the inclusion stays at rest. What leaves it is enclosed with it.
TEST(FlowKink, HoldWhatSticks) {
  Containment c;
  c.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = 0.1 - 0.3 * sign(x[1]);
  });
  c.box = {0.5, 0.0};
  c.horizon = 1;
  c.times = {0.25, 0.5};
  const Tube tube = c.tube();
  ASSERT_EQ(tube.why(), "");
  for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
    EXPECT_TRUE(contains(tube.states(i)[0], 0.5));
    EXPECT_TRUE(contains(tube.states(i)[1], 0.0));
    EXPECT_TRUE(contains(tube.statesOver(i)[1], 0.0));
  }
}

/// The polynomial stays on one side, the set that an input makes of it does not.
/// ẋ = 1, ẏ = g(sign x) from x = -½: crossed at ½, where y = g(-1)/2, and y(1) = (g(-1) + g(1))/2.
TEST(FlowKink, PassJumpsThatHaveNoMeaningBeyondTheirValues) {
  const Precise one(1.0);
  const std::pair<Recorded (*)(const Recorded&), Precise> functions[] = {
      {[](const Recorded& s) { return 1.0 / (2.0 + s); }, 2 * one / 3},
      {[](const Recorded& s) { return 1.0 / (1.25 + s); }, 2 + 2 * one / 9},
      {[](const Recorded& s) { return sqrt(5.0 + 4.0 * s); }, 2 * one},
      {[](const Recorded& s) { return log(1.5 + s); }, log(one * 1.25) / 2}};
  for (const auto& [function, truth] : functions) {
    const Program f = record(2, 0, [&](auto, const auto& x, const auto&, auto& dx) {
      dx[0] = 1.0;
      dx[1] = function(sign(x[0]));
    });
    const Tube tube = Flow(f).enclose({-0.5, 0.0}, 1);
    EXPECT_EQ(tube.why(), "");
    EXPECT_EQ(tube.pieces(), 1);
    EXPECT_THAT(tube.at(1)[1], Encloses(truth));
    EXPECT_LT(width(tube.at(1)[1]), 1e-6);
  }
}

TEST(FlowKink, HoldJumpsThatInputsReach) {
  Containment c;
  c.f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = p[0];
    dx[1] = sign(x[0]);
  });
  c.box = {0.0625, 0.0, Interval(-1, 1)};
  c.options.varying = {{0}};
  c.horizon = 1;
  c.times = {0.25, 0.5};
  const Tube tube = c.tube();
  ASSERT_EQ(tube.why(), "");
  for (std::size_t row = 1; row < tube.reachedTimes(); ++row) {  // w = -1, w = 1
    EXPECT_LE(tube.states(row)[1].lower(), 0.125 - tube.times()[row]);
    EXPECT_GE(tube.states(row)[1].upper(), tube.times()[row]);
  }
}

/// In outputs: kinks and jumps in the range, at output times and between them.
TEST(FlowKink, InOutputs) {
  Containment c;
  c.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -4.0 * x[0];
  });
  c.g = record(2, 0, 4, [](auto t, const auto& x, const auto&, auto& y) {
    y[0] = abs(x[0]);
    y[1] = max(x[0], x[1]) + t;
    y[2] = where(x[1], x[0], 3.0 + x[0]);
    y[3] = sign(x[0]);
  });
  c.box = {Interval(-0.5, 1), Interval(0, 0.1)};
  c.horizon = 2;
  c.times = {0.25, 0.5, 0.75, 1.5};
  const Tube tube = expectEvents(c, 40, false);
  EXPECT_GE(tube.outputs(0)[0].lower(), 0);
  EXPECT_LT(width(tube.outputs(1)[0]), 1.01 * magnitude(tube.states(1)[0]));
}

/// What the greater of two numbers leaves open, as a kink of it that is not passed by all, is not in the lesser.
TEST(FlowKink, LeaveTheLesserNumberAloneWhereItIsKnown) {
  Containment c;
  c.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -x[0];
  });
  c.g = record(2, 0, 2, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = min(x[0], 5.0 + abs(x[1])) - x[0];
    y[1] = max(x[0] - abs(x[1]), 3.0 - x[0]) + x[0];
  });
  c.box = {Interval(-0.25, 0.25), Interval(-0.25, 0.25)};
  c.horizon = 2;
  c.times = {0.5, 1.0};
  const Tube tube = expectEvents(c, 40, false);
  for (std::size_t row = 0; row < tube.times().size(); ++row) {
    EXPECT_LT(magnitude(tube.outputs(row)[0]), 1e-9);
    EXPECT_LT(magnitude(tube.outputs(row)[1] - 3.0), 1e-9);
  }
}

/// Chords of steps much longer than what passes a kink: 10 + |cos t| - cos t, from 1 to 2, of which boxes know little.
TEST(FlowKink, AreBoundedOverAShortTimeBetweenOutputTimes) {
  Containment c;
  c.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -x[0];
  });
  c.g = record(2, 0, 1, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = abs(x[0]) - x[0] + 10.0 * (sqr(x[0]) + sqr(x[1]));
  });
  c.box = {1.0, 0.0};
  c.horizon = 2;
  c.times = {1.0};
  const Tube tube = expectEvents(c, 40, false);
  const Interval over = tube.outputsOver(tube.times().size() - 1)[0];
  EXPECT_GE(over.lower(), 9.5);
  EXPECT_LE(over.upper(), 10 - 2 * std::cos(2.0) + 0.05);
}

}  // namespace
}  // namespace gamut::testing
