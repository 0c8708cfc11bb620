// Wide sets whose solutions turn again and again, until some are a cycle or more ahead of others: trajectories whose
// events are located in 128 bits must lie inside, exactly, at output times, between them, in levels and models, and one
// piece or a few are enough.
#include <limits>

#include "analyses/flow/formulation.hpp"
#include "analyses/flow/journey.hpp"
#include "analyses/flow/refinement.hpp"
#include "analyses/work.hpp"
#include "tests/analyses/event_reference.hpp"
#include "tests/analyses/flow/containment.hpp"
#include "tests/analyses/sliding_reference.hpp"

namespace gamut::testing {
namespace {

struct Repeating {
  std::string name;
  Program f, g;
  Box box;
  double horizon;
  int pieces;
  bool sticks = false;  // where x[1] is `belt`
  double belt = 1;
  int events = 20;     // more than so many, of all trajectories
  Program timed = {};  // f with time as its last state, where it depends on time; else none
  double budget = 0;   // if not 0: of the flow, so small that it is in time for its pieces at times of their own alone
};

/// f(t, x, p) of two states and two parameters; and with t as a third state.
template <class Of>
std::pair<Program, Program> withAndWithoutClock(Of f) {
  return {record(2, 2, [=](const auto& t, const auto& x, const auto& p, auto& dx) { f(t, x, p, dx); }),
          record(3, 2, [=](auto, const auto& x, const auto& p, auto& dx) {
            f(x[2], x, p, dx);
            dx[2] = x[2] * 0.0 + 1.0;
          })};
}

/// Friction at rest is a quarter more than that of sliding (Stribeck); the spring's other end moves on evenly.
const std::pair<Program, Program>& drawn() {
  static const auto programs = withAndWithoutClock([](const auto& t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] * (t - x[0]) - 0.25 * x[1] - p[1] * (1.0 + 0.25 * exp(-400.0 * (x[1] * x[1]))) * sign(x[1]);
  });
  return programs;
}

const std::pair<Program, Program>& shaken() {
  static const auto programs = withAndWithoutClock([](const auto& t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = 0.25 * sin(2.0 * t) - p[0] * x[0] - p[1] * sign(x[0]);
  });
  return programs;
}

/// A carriage that is pushed against a stiff buffer, which throws it back, and from p[0] on half as much: the push, and
/// the buffer with it.
const std::pair<Program, Program>& pushed() {
  static const auto programs = withAndWithoutClock([](const auto& t, const auto& x, const auto& p, auto& dx) {
    const auto beyond = x[0] - p[1], share = 0.75 - 0.25 * sign(t - p[0]);
    dx[0] = x[1];
    dx[1] = share * (1.0 - sign(beyond) - 50.0 * (beyond + abs(beyond))) - 0.5 * x[1];
  });
  return programs;
}

/// A tank is filled until p[1], and drained while what follows its level is above p[0].
const std::pair<Program, Program>& filled() {
  static const auto programs = withAndWithoutClock([](const auto& t, const auto& x, const auto& p, auto& dx) {
    dx[0] = 0.72 - 0.48 * sign(t - p[1]) - 0.4 * x[0] - 0.375 - 0.375 * sign(x[1] - p[0]);
    dx[1] = x[0] - x[1];
  });
  return programs;
}

/// A relay that falls to a half at 1.7 s.
const std::pair<Program, Program>& weakened() {
  static const auto programs = withAndWithoutClock([](const auto& t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * x[0] - p[1] * (0.75 - 0.25 * sign(t - 1.7)) * sign(x[0]);
  });
  return programs;
}

/// A ball above ground, unfolded (Zhuravlev): x = |S| in units of 1/unit m, k = p[0] = (1 - e)/(1 + e), its rate
/// (1 - k sign S sign V) V sign S; p[1]: gravity.
Program bouncing(double unit) {
  return record(2, 2, [=](auto, const auto& x, const auto& p, auto& dx) {
    const auto lost = 1.0 - p[0] * (sign(x[0]) * sign(x[1]));
    dx[0] = x[1] * lost;
    dx[1] = -unit * p[1] * sign(x[0]) / lost;
  });
}

/// Its height and energy, in J/kg of 1/unit² each.
Program heightAndEnergy(double unit) {
  return record(2, 2, 2, [=](auto, const auto& x, const auto& p, auto& y) {
    const auto rate = (1.0 - p[0] * (sign(x[0]) * sign(x[1]))) * x[1];
    y[0] = abs(x[0]);
    y[1] = 0.5 * rate * rate + unit * p[1] * abs(x[0]);
  });
}

/// What teeth with the play p[0] on either side press with.
const auto tooth = [](const auto& x, const auto& p) {
  const auto ahead = x[0] - x[1] - p[0], behind = x[1] - x[0] - p[0];
  return 100.0 * (ahead + abs(ahead)) - 100.0 * (behind + abs(behind)) + 0.5 * (x[2] - x[3]);
};

/// Two masses with play between them, one drawn to 1, the other with friction p[1].
Program playBetweenTwo() {
  return record(4, 2, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = 2.0 * (4.0 * (1.0 - x[0]) - 0.5 * x[2] - tooth(x, p));
    dx[3] = tooth(x, p) - p[1] * sign(x[3]);
  });
}

Program noOutputs(int states, int parameters) {
  return record(states, parameters, 0, [](auto, const auto&, const auto&, auto&) {});
}

const std::vector<Repeating>& repeating() {
  static const std::vector<Repeating> all{
      {"aBall",
       bouncing(1),
       heightAndEnergy(1),
       {Interval(0.99, 1.01), -0.001, Interval(0.047, 0.058), 9.8125},
       4.5,
       1},
      {"aBallInMillimetresElsewhere",
       bouncing(1024),
       heightAndEnergy(1024),
       {Interval(0.95, 1.05) * Interval(1024), -1.0, Interval(0.05, 0.055), Interval(9.75, 9.875)},
       2.75,
       1},
      {"aForceToTheMiddleForLong",
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -sign(x[0]) / p[0];
              }),
       noOutputs(2, 1),
       {Interval(0.875, 1.125), 0.0, Interval(0.9, 1.1)},
       40.0,
       2},
      {"aRelayWithDamping",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -p[0] * x[0] - p[1] * sign(x[0]) - 0.0625 * x[1];
              }),
       record(2, 2, 1, [](auto, const auto& x, const auto& p, auto& y) { y[0] = x[1] * x[1] + p[0] * x[0] * x[0]; }),
       {Interval(0.9375, 1.0625), 0.0, Interval(0.9, 1.1), Interval(0.9, 1.1)},
       9.0,
       8},
      {"aBlockThatSticksAndSlips",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = p[1] * sign(1.0 - x[1]) - p[0] * x[0] - 0.25 * (1.0 - x[1]);
              }),
       noOutputs(2, 2),
       {0.0, 0.0, Interval(0.98, 1.02), Interval(1.96, 2.04)},
       20.0,
       2,
       true},
      {"aKinkForLong",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -p[0] * x[0] - p[1] * abs(x[0]);
              }),
       noOutputs(2, 2),
       {Interval(0.9375, 1.0625), 0.0, Interval(0.9, 1.1), Interval(0.25, 0.3125)},
       40.0,
       4},
      {"aBlockOnABeltWhoseFrictionFalls",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                const auto slip = 1.0 - x[1];
                dx[0] = x[1];
                dx[1] = p[1] * (1.0 + 0.25 * exp(-400.0 * (slip * slip))) * sign(slip) - p[0] * x[0] + 0.25 * slip;
              }),
       record(2, 2, 1, [](auto, const auto& x, const auto& p, auto& y) { y[0] = 0.5 * p[0] * x[0] * x[0]; }),
       {0.0, 0.0, Interval(0.98, 1.02), Interval(1.96, 2.04)},
       20.0,
       6,
       true,
       1,
       8,
       {},
       4},
      {"aBlockDrawnByASpring",
       drawn().first,
       record(2, 2, 1, [](auto t, const auto& x, const auto& p, auto& y) { y[0] = p[0] * (t - x[0]); }),
       {0.0, 0.0, Interval(0.98, 1.02), Interval(1.96, 2.04)},
       40.0,
       2,
       true,
       0,
       4,
       drawn().second,
       8},
      {"aRelayThatIsShaken",
       shaken().first,
       noOutputs(2, 2),
       {Interval(0.9375, 1.0625), 0.0, Interval(0.95, 1.05), Interval(0.9, 1.1)},
       7.0,
       4,
       false,
       1,
       20,
       shaken().second},
      {"aPendulumWithARelay",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -p[0] * sin(x[0]) - p[1] * sign(x[0]);
              }),
       record(2, 2, 1, [](auto, const auto& x, const auto& p, auto& y) { y[0] = p[0] * cos(x[0]); }),
       {Interval(1.4375, 1.5625), 0.0, Interval(0.9, 1.1), Interval(0.1875, 0.25)},
       9.0,
       4,
       false,
       1,
       20,
       {},
       4},
      {"aBufferAndASwitchAtAnUnknownTime",
       pushed().first,
       record(2, 2, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = 0.5 * x[1] * x[1]; }),
       {0.0, Interval(-0.0625, 0.0625), Interval(1.17, 1.23), Interval(0.285, 0.315)},
       3.0,
       4,
       false,
       1,
       20,
       pushed().second,
       8},
      {"aTankThatIsFilledUntilAnUnknownTime",
       filled().first,
       record(2, 2, 2,
              [](auto, const auto& x, const auto& p, auto& y) {
                y[0] = x[1];
                y[1] = x[0] - p[0];
              }),
       {0.2, 0.1, Interval(0.376, 0.424), Interval(1.84, 2.16)},
       8.25,
       4,
       false,
       1,
       12,
       filled().second,
       4},
      {"aRelayThatFallsAtAKnownTime",
       weakened().first,
       noOutputs(2, 2),
       {Interval(0.9375, 1.0625), 0.0, Interval(0.95, 1.05), Interval(0.9, 1.1)},
       9.0,
       4,
       false,
       1,
       20,
       weakened().second,
       4},
      {"aPlayThatIsTakenUp",
       playBetweenTwo(),
       record(4, 2, 1, [](auto, const auto& x, const auto& p, auto& y) { y[0] = tooth(x, p); }),
       {0.0, 0.0, 0.5, 0.25, Interval(0.0625, 0.1875), Interval(0.1875, 0.3125)},
       0.5,
       5,
       false,
       1,
       4,
       {},
       2}};
  return all;
}

class FlowOwnTimes : public ::testing::TestWithParam<Repeating> {};

TEST_P(FlowOwnTimes, HoldTrajectories) {
  const Repeating& machine = GetParam();
  Containment c;
  c.f = machine.f;
  if (machine.g.outputs() > 0) c.g = machine.g;
  c.box = machine.box;
  Box level;
  for (const Interval& x : machine.box)
    level.push_back(Interval(midpoint(x)) + Interval(0.25) * (x - Interval(midpoint(x))));
  c.levels = {level};
  c.horizon = machine.horizon;
  if (machine.budget > 0) c.options.budget = machine.budget;
  for (int i = 1; i < 32; ++i) c.times.push_back(machine.horizon * i / 32);
  const bool isTimed = machine.timed.states() > 0;
  const Program& reference = isTimed ? machine.timed : machine.f;
  EventReference passing(reference);
  SlidingReference sliding(reference, reference, [&](const auto& sides, const Vector&, Vector& x) {
    if (sides[0] == Side::held) x[1] = machine.belt;
  });
  c.motion = [&](const Vector& start, const std::vector<double>& times) {
    Vector from = start;
    if (isTimed) from.insert(from.begin() + machine.f.states(), Precise(0.0));
    Containment::Motion motion{machine.sticks ? sliding(from, times) : passing(from, times), {}};
    for (Vector& states : motion.states) states.resize(static_cast<std::size_t>(machine.f.states()));
    Evaluator<Precise> outputs(machine.g);
    outputs.setParameters(Vector(start.begin() + machine.f.states(), start.end()));
    for (std::size_t i = 0; i < times.size(); ++i)
      motion.outputs.push_back(outputs(Precise(times[i]), motion.states[i]));
    return motion;
  };
  Judge judge(c, 5);
  EXPECT_LE(judge.tube().pieces(), machine.pieces);
  ASSERT_EQ(judge.tube().why(), "");
  judge.judge(8);
  EXPECT_GT(machine.sticks ? sliding.events : passing.events, machine.events);
}

/// Three masses and three plays, in moments of their own alone: in some steps solutions turn without being stopped just
/// behind their turn, and an output time is later than that.
TEST(FlowOwnMoments, WhatTurnsAndIsNotStoppedIsThereUntilTheStepEnds) {
  const Program f = record(6, 4, [](auto, const auto& x, const auto& p, auto& dx) {
    const auto play = [](const auto& u, const auto& gap) { return u + 0.5 * (abs(u - gap) - abs(u + gap)); };
    const auto first = 6.7054115447523124 * play(x[0] - x[1], p[0]), second = p[1] * play(x[1] - x[2], p[2]),
               third = 12.985197969018961 * play(0.5 * x[0] + 3.0 * x[1], p[0]);
    for (std::size_t i = 0; i < 3; ++i) dx[i] = x[i + 3];
    dx[3] = p[3] - first - 0.5 * third;
    dx[4] = first - second - 3.0 * third;
    dx[5] = 0.25 * second;
  });
  const double horizon = 2 * 0.39858068708245292;
  const std::vector<double> times{0.0, 0.4, 0.77, 0.775, 0.78, 0.785, 0.79, 0.7925, 0.795, horizon};
  const auto about = [](double value, double part) {
    return Interval(value - 1.3 * part * value, value + 1.3 * part * value);
  };
  const Box box{-0.4197265625,
                1.0740234375,
                -1.1365234375,
                -1.8725048653226257,
                0.0,
                0.0,
                about(0.38837890625, 0.05),
                about(6.7054115447523124, 0.05),
                about(0.38837890625, 0.05),
                about(1.5691911935195635, 0.05)};
  const Program none = record(6, 4, 0, [](auto, const auto&, const auto&, auto&) {});
  FlowOptions options;
  options.order = 8;
  FlowBudget budget{0.8 * Work::perSecond};
  const Program differentiated = differentiatedFor(f, {});
  double looseness = 0;
  const Tube tube = refine({f, differentiated, none, options, horizon, times, budget, -1, true}, box, {}, looseness);
  ASSERT_EQ(tube.reached(), horizon);
  const Program g = record(6, 4, 6, [](auto, const auto& x, const auto&, auto& y) {
    for (std::size_t i = 0; i < 6; ++i) y[i] = x[i];
  });
  for (int corner = 0; corner < 16; ++corner) {
    std::vector<double> start;
    for (std::size_t i = 0; i < box.size(); ++i)
      start.push_back(i >= 6 && (corner >> (i - 6)) % 2 == 1 ? box[i].upper() : box[i].lower());
    const PreciseTrajectory found = arbitrate({f, g, {}, times}, start);
    ASSERT_EQ(found.times, times.size());
    for (std::size_t row = 0; row < times.size(); ++row)
      for (std::size_t i = 0; i < 6; ++i)
        ASSERT_THAT(tube.states(row)[i], Encloses(found.values[row * 6 + i])) << corner << ' ' << row << ' ' << i;
  }
}

/// A block that sticks to a belt and slips, with a force that has a kink beside the belt's speed: what is let go comes
/// to the kink, which what is held keeps away from.
TEST(FlowOwnMoments, WhatIsLetGoPassesAKinkBesideWhatWasHeld) {
  const Program states = record(2, 2, 2, [](auto, const auto& x, const auto&, auto& y) {
    for (std::size_t i = 0; i < 2; ++i) y[i] = x[i];
  });
  const Program none = record(2, 2, 0, [](auto, const auto&, const auto&, auto&) {});
  const Box box{0.0, 0.0, Interval(0.9, 1.1), Interval(1.8, 2.2)};
  const double horizon = 10;
  std::vector<double> times;
  for (int i = 0; i <= 100; ++i) times.push_back(horizon * i / 100);
  for (const double kink : {0.99, 0.9}) {
    const Program f = record(2, 2, [=](auto, const auto& x, const auto& p, auto& dx) {
      dx[0] = x[1];
      dx[1] = p[1] * sign(1.0 - x[1]) - p[0] * x[0] - 0.25 * (1.0 - x[1]) - 4.0 * abs(x[1] - kink);
    });
    FlowBudget budget{8 * Work::perSecond};
    const Program differentiated = differentiatedFor(f, {});
    double looseness = 0;
    const Tube tube =
        refine({f, differentiated, none, FlowOptions(), horizon, times, budget, -1, true}, box, {}, looseness);
    ASSERT_EQ(tube.reached(), horizon);
    for (int corner = 0; corner < 4; ++corner) {
      const std::vector<double> start{0.0, 0.0, corner % 2 == 0 ? box[2].lower() : box[2].upper(),
                                      corner / 2 == 0 ? box[3].lower() : box[3].upper()};
      const PreciseTrajectory found = arbitrate({f, states, {}, times}, start);
      ASSERT_EQ(found.times, times.size());
      for (std::size_t row = 0; row < times.size(); ++row)
        for (std::size_t i = 0; i < 2; ++i)
          ASSERT_THAT(tube.states(row)[i], Encloses(found.values[row * 2 + i])) << corner << ' ' << times[row];
    }
  }
}

TEST(FlowCore, IsAPointOfWhatIsLostInExcess) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(isEqual(without(Interval(1, 4), 1), Interval(2, 3)));
  EXPECT_TRUE(isEqual(without(Interval(1, 4), 2), Interval(2.5)));
  for (const Interval& unbounded : {Interval::entire(), Interval(2, infinite), Interval(-infinite, -2)})
    for (const double excess : {1.0, infinite}) {
      const Interval core = without(unbounded, excess);
      EXPECT_TRUE(isSubset(core, unbounded));
      EXPECT_TRUE(excess == 1 || isThin(core));
    }
}

/// Time is a state on the way, but none of those that were asked for.
TEST(FlowClock, IsNotTold) {
  FlowOptions options;
  options.extremesAt = {1};
  options.modelled = {0};
  const Program g = record(2, 2, 1, [](auto t, const auto& x, const auto& p, auto& y) { y[0] = p[0] * (t - x[0]); });
  const Tube tube =
      Flow(drawn().first, g, options).enclose({0.0, 0.0, Interval(0.98, 1.02), Interval(1.96, 2.04)}, 3, {1.0, 3.0});
  ASSERT_EQ(tube.why(), "");
  EXPECT_EQ(tube.states(1).size(), 2U);
  EXPECT_EQ(tube.statesOver(1).size(), 2U);
  EXPECT_EQ(tube.nonlinear().size(), 4U);
  ASSERT_NE(tube.models(), nullptr);
  ASSERT_EQ(tube.models()->components.size(), 4U);
  EXPECT_EQ(tube.models()->components[1].symbol, -1);
  EXPECT_EQ(tube.models()->components[2].symbol, 0);
  EXPECT_EQ(tube.models()->components[3].symbol, 1);
  ASSERT_EQ(tube.extremes()[1].size(), 1U);
  const OutputExtremes& force = tube.extremes()[1][0];
  EXPECT_EQ(force.leastAt, (std::vector<double>{0, 0, 0.98, force.leastAt.at(3)}));
  EXPECT_EQ(force.greatestAt, (std::vector<double>{0, 0, 1.02, force.greatestAt.at(3)}));
}

INSTANTIATE_TEST_SUITE_P(Flow, FlowOwnTimes, ::testing::ValuesIn(repeating()),
                         [](const auto& machine) { return machine.param.name; });

}  // namespace
}  // namespace gamut::testing
