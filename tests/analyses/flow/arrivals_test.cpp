// Sets that come to be held from both sides of a jump, and states that follow them meanwhile: closed forms and
// trajectories whose events are located in 128 bits must lie inside, exactly; and enclosures are hardly wider than
// they.
#include <cmath>

#include "analyses/flow/step/jumps.hpp"
#include "tests/analyses/flow/containment.hpp"
#include "tests/analyses/sliding_reference.hpp"

namespace gamut::testing {
namespace {

/// ẋ = -1/4 - 3/4 sign x comes down at 1 and up at 1/2, so x from c leaves c²/2 or -c² in the integral of x.
TEST(FlowArrivals, WhatFollowsIsAsWideAsTheyMakeIt) {
  for (const double unit : {1.0, 0x1p-20, 0x1p20}) {
    SCOPED_TRACE(unit);
    const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
      dx[0] = p[0] * (-0.25 - 0.75 * sign(x[0]));
      dx[1] = -0.5 * x[0];
    });
    const Tube tube = Flow(f).enclose({unit * Interval(-0.125, 0.25), 0.0, Interval(unit)}, 2, {0.125, 2});
    ASSERT_EQ(tube.why(), "");
    const Interval truth = unit * Interval(-0.5 * 0.03125, 0.5 * 0.015625), now = tube.states(2)[1];
    EXPECT_TRUE(isSubset(truth, now)) << now;
    EXPECT_LT(width(now), 1.03 * width(truth));
    EXPECT_TRUE(isSubset(truth, tube.statesOver(2)[1]));
    EXPECT_LT(magnitude(tube.states(2)[0]), unit * 1e-9);
  }
}

/// From above x comes at the rate -t - 1/1024, slowly at first, so from c it is c - t²/2 - t/1024 until it is held, at
/// 1/2 about: a step that is bounded by rates alone must not begin long before the first comes.
TEST(FlowArrivals, WhatGathersSpeedIsFollowedUntilTheFirstComes) {
  for (const double side : {1.0, -1.0})
    for (const double unit : {1.0, 0x1p-20, 0x1p20}) {
      SCOPED_TRACE(side * unit);
      const Program f = record(1, 1, [side](auto t, const auto& x, const auto& p, auto& dx) {
        dx[0] = p[0] * (side * (1.0 - t) - 1.0009765625 * sign(x[0]));
      });
      const Interval from(0.125, 0.12890625);
      const Tube tube = Flow(f).enclose({side * unit * from, Interval(unit)}, 1, {0.375, 0.5, 1});
      ASSERT_EQ(tube.why(), "");
      const auto after = [](double t) { return 0.5 * t * t + t / 1024; };  // exact
      const Interval first = side * unit * (from - Interval(after(0.375)));
      EXPECT_TRUE(isSubset(first, tube.states(1)[0])) << tube.states(1)[0];
      EXPECT_LT(width(tube.states(1)[0]), 1.01 * width(first));
      EXPECT_TRUE(isSubset(side * unit * Interval(0.0, from.upper() - after(0.5)), tube.states(2)[0]));
      EXPECT_LT(magnitude(tube.states(3)[0]), unit * 1e-9);
    }
}

/// Of u = x - z, z moving at 1/4; m from 15/16 to 17/16, so the slowest come at m ∓ 1/4.
TEST(FlowArrivals, AnArgumentMayBeADifferenceAndItsRateUncertain) {
  const Program f = record(3, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = -p[0] * sign(2.0 * (x[0] - x[1]));
    dx[1] = 0.25;
    dx[2] = x[0] - x[1];
  });
  const Tube tube = Flow(f).enclose({Interval(0.25, 0.75), 0.5, 1.0, Interval(0.9375, 1.0625)}, 1);
  ASSERT_EQ(tube.why(), "");
  EXPECT_THAT(tube.at(1)[2], Encloses(1 + Precise(0.03125) / Precise(1.1875)));
  EXPECT_THAT(tube.at(1)[2], Encloses(1 - Precise(0.03125) / Precise(0.6875)));
  EXPECT_LT(width(tube.at(1)[2]), 1.05 * (0.03125 / 1.1875 + 0.03125 / 0.6875));
}

/// What holds x at z is known as soon as all have come, early in the last step: they come at rates that are known
/// better over a short one.
TEST(FlowArrivals, WhatHoldsIsKnownOnceAllHaveCome) {
  constexpr double a = 0.556640625, w = 2.68408203125, by = 0.1259765625, at = 0.3701171875, horizon = 1.872802734375;
  const Program f = record(2, 2, [&](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = by * x[1] + a * sin(w * t) - p[1] * sign(x[0] - x[1]);
    dx[1] = -0.4658203125 - 0.2578125 * x[1] - 1.4375 * sign(2.0 * (x[1] - at * p[0]));
  });
  const Program held = record(2, 2, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = sign(x[0] - x[1]); });
  const Interval friction(0.64453125, 0.87109375);
  const Box box{Interval(0.29736328125, 0.59326171875), 0.015625, -0.4931640625, friction};
  const Tube tube = Flow(f, held).enclose(box, horizon, {horizon});
  ASSERT_EQ(tube.why(), "");
  const Interval now = tube.outputs(1)[0];
  const Precise force = Precise(by) * Precise(at) * Precise(-0.4931640625) + Precise(a) * sin(Precise(w) * horizon);
  EXPECT_THAT(now, Encloses(Precise(force / friction.lower())));
  EXPECT_THAT(now, Encloses(Precise(force / friction.upper())));
  const double truth = std::fabs((force / friction.lower() - force / friction.upper()).convert_to<double>());
  EXPECT_LT(width(now), 1.01 * truth);
}

/// x from c in ±1/4 comes at the rate 1 and leaves c |c|/4 in z, which is known of no single c: so z sin z would be as
/// wide below zero as above. What comes is bisected, and what is left at rest is no looseness beside what it was.
TEST(FlowArrivals, WhatFollowsIsBisectedWhereItDecides) {
  for (const double unit : {1.0, 0x1p-20, 0x1p20}) {
    SCOPED_TRACE(unit);
    const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
      dx[0] = -p[0] * sign(x[0]);
      dx[1] = 0.5 * x[0];
    });
    const Program g = record(2, 1, 3, [](auto, const auto& x, const auto& p, auto& y) {
      y[0] = x[1] / p[0] * sin(x[1] / p[0]);
      y[1] = sign(3.0 * x[0]);
      y[2] = sqr(sign(x[0])) * (x[1] + p[0]);
    });
    const Tube tube = Flow(f, g).enclose({unit * Interval(-0.25, 0.25), 0.0, Interval(unit)}, 1, {0.5, 1});
    ASSERT_EQ(tube.why(), "");
    constexpr double most = 0.015625;
    EXPECT_THAT(tube.outputs(2)[0], Encloses(Precise(0.0)));
    EXPECT_THAT(tube.outputs(2)[0], Encloses(Precise(most) * sin(Precise(most))));
    EXPECT_LT(width(tube.outputs(2)[0]), 1.02 * most * std::sin(most));
    EXPECT_LT(magnitude(tube.outputs(2)[1]), 1e-9);
    EXPECT_THAT(tube.outputs(2)[2], Encloses(Precise(0.0)));
    EXPECT_LT(magnitude(tube.outputs(2)[2]), 1e-9 * unit);
    EXPECT_LE(tube.tightness(), 1.02);
  }
}

/// x₀ comes to be held at x₁, which x₀ drives: each follows the other.
TEST(FlowArrivals, WhatIsFollowedMayFollow) {
  const Program f = record(2, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = -0.375 - 0.375 * sin(2.75 * t) - p[0] * sign(0.5 * (x[0] - x[1]));
    dx[1] = 0.375 * x[0];
  });
  const Program g = record(2, 1, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = sign(x[0] - x[1]); });
  const Box box{Interval(-0.5, -0.0625), -0.125, 1.0};
  const Tube tube = Flow(f, g).enclose(box, 1.75, {1.75});
  ASSERT_EQ(tube.why(), "");
  SlidingReference reference(f, g, [](const auto& sides, const Vector&, Vector& x) {
    if (sides[0] == Side::held) x[0] = x[1];
  });
  Interval state = Interval::empty(), held = state;
  for (int i = 0; i <= 64; ++i) {
    const Precise start = box[0].lower() + (Precise(box[0].upper()) - box[0].lower()) * i / 64;
    const Vector end = reference({start, Precise(-0.125), Precise(1.0)}, {1.75}).back();
    ASSERT_THAT(tube.states(1)[1], Encloses(end[1]));
    ASSERT_THAT(tube.outputs(1)[0], Encloses(reference.outputs.back()[0]));
    state = hull(state, Interval(end[1].convert_to<double>()));
    held = hull(held, Interval(reference.outputs.back()[0].convert_to<double>()));
  }
  EXPECT_LT(width(tube.states(1)[1]), 1.02 * width(state));
  EXPECT_LT(width(tube.outputs(1)[0]), 1.02 * width(held));
}

/// Where z is held, and with what strength x is, decides about nothing before they are: a first look sees no influence.
TEST(FlowArrivals, WhatHoldsMayBeAllThatAQuantityDecidesAbout) {
  const Program f = record(3, 2, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = -0.0625 * x[2] - p[1] * sign(x[0]);
    dx[1] = -0.375 * x[0];
    dx[2] = -sign(2.0 * (x[2] - p[0]));
  });
  const Program g = record(3, 2, 2, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = sign(x[0]);
    y[1] = 1.5 - 0.5 * sign(x[0]) + 1.5 * x[2];
  });
  const Interval at(-0.09375, -0.078125), strength(0.875, 0.9375);
  const Tube tube =
      Flow(f, g).enclose({Interval(-0.125, 0.0625), Interval(0.375, 0.5), 0.0, at, strength}, 1, {0.5, 1});
  ASSERT_EQ(tube.why(), "");
  const auto holds = [](double z, double by) -> Precise { return -0.0625 * Precise(z) / by; };
  const Precise least = holds(at.upper(), strength.upper()), most = holds(at.lower(), strength.lower());
  EXPECT_THAT(tube.outputs(2)[0], Encloses(least));
  EXPECT_THAT(tube.outputs(2)[0], Encloses(most));
  EXPECT_LT(width(tube.outputs(2)[0]), 1.02 * Precise(most - least).convert_to<double>());
  const Precise lower = 1.5 - 0.5 * most + 1.5 * at.lower(), upper = 1.5 - 0.5 * least + 1.5 * at.upper();
  EXPECT_THAT(tube.outputs(2)[1], Encloses(lower));
  EXPECT_THAT(tube.outputs(2)[1], Encloses(upper));
  EXPECT_LT(width(tube.outputs(2)[1]), 1.02 * Precise(upper - lower).convert_to<double>());
}

struct Arriving {
  Program f;
  Box box;
  SlidingReference::Rest rest;
};

/// What follows drives what arrives; two arrive, one of them the other's load; a sign itself pushes a second state.
std::vector<Arriving> arriving() {
  const Interval wide(-0.25, 0.25);
  return {{record(2, 1,
                  [](auto t, const auto& x, const auto& p, auto& dx) {
                    dx[0] = x[1];
                    dx[1] = -0.5 * x[0] + 0.25 * sin(2.0 * t) - p[0] * sign(x[1]);
                  }),
           {0.125, wide, Interval(0.875, 1.125)},
           [](const auto& sides, const Vector&, Vector& x) {
             if (sides[0] == Side::held) x[1] = 0;
           }},
          {record(3, 1,
                  [](auto, const auto& x, const auto& p, auto& dx) {
                    dx[0] = 0.25 * x[1] - p[0] * sign(x[0]);
                    dx[1] = -0.125 + 0.75 * sign(-2.0 * x[1]);
                    dx[2] = 0.5 * x[0] - x[1] - 0.25 * x[2];
                  }),
           {wide, Interval(-0.125, 0.1875), 0.5, 1.0},
           [](const auto& sides, const Vector&, Vector& x) {
             for (std::size_t i = 0; i < 2; ++i)
               if (sides[i] == Side::held) x[i] = 0;
           }},
          {record(3, 1,
                  [](auto, const auto& x, const auto& p, auto& dx) {
                    const auto force = p[0] * sign(x[0] - x[1]);
                    dx[0] = 0.125 - force;
                    dx[1] = 0.5 * force;
                    dx[2] = x[0];
                  }),
           {wide, 0.0625, 0.0, Interval(0.9375, 1.0625)},
           [](const auto& sides, const Vector&, Vector& x) {
             if (sides[0] == Side::held) x[0] = x[1];
           }}};
}

TEST(FlowArrivals, HoldTrajectories) {
  for (const Arriving& machine : arriving()) {
    SlidingReference reference(machine.f, machine.f, machine.rest);
    Containment c;
    c.f = machine.f;
    c.box = machine.box;
    c.horizon = 1;
    c.times = {0.03125, 0.0625, 0.125, 0.25, 0.3125, 1};
    c.motion = [&](const Vector& start, const std::vector<double>& times) {
      return Containment::Motion{reference(start, times), {}};
    };
    Judge judge(c, 5);
    ASSERT_EQ(judge.tube().why(), "");
    judge.judge(12);
    EXPECT_GT(reference.events, 10);
  }
}

/// Bounds of an argument that comes to zero, by hand.
TEST(FlowArrivals, ArgumentsAreBoundedWhileTheyCome) {
  const auto after = [](const Interval& start, double seconds) {
    JumpBound bound;
    bound.start = start;
    bound.up = Interval(-2, -1);
    bound.down = Interval(0.5, 4);
    return bound.whileArriving(seconds);
  };
  EXPECT_EQ(toString(after({-1, 1}, 0), 4), toString(Interval(-1, 1), 4));
  EXPECT_TRUE(isSubset(Interval(-0.5, 0), after({-1, 1}, 1)));
  EXPECT_LT(width(after({-1, 1}, 1)), 0.5 + 1e-12);
  EXPECT_TRUE(isSubset(Interval(0, 0.5), after({1, 1.5}, 1)));
  EXPECT_TRUE(isSubset(Interval(-1, 0), after({-1.5, -1}, 1)));
  EXPECT_LT(width(after({3, 4}, 1)), 2 + 1e-12);  // none has come
}

}  // namespace
}  // namespace gamut::testing
