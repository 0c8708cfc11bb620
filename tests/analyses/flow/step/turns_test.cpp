// Wide sets that jumps let go, or come to hold: closed forms must lie inside, exactly, and enclosures are hardly wider.
#include "analyses/flow/step/jumps.hpp"
#include "tests/analyses/flow/containment.hpp"
#include "tests/analyses/sliding_reference.hpp"

namespace gamut::testing {
namespace {

/// A load t breaks a unit mass away at t = p: from then on its rate is (t - p)²/2, and it has gone (t - p)³/6.
TEST(FlowTurns, AllOfAWideSetIsLetGo) {
  const Interval limit(0.875, 1.125);
  for (const double side : {1.0, -1.0})
    for (const double unit : {1.0, 0x1p-20, 0x1p20}) {
      SCOPED_TRACE(side * unit);
      const Program f = record(2, 1, [=](auto t, const auto& x, const auto& p, auto& dx) {
        dx[0] = x[1];
        dx[1] = (side * unit) * t - unit * (p[0] * sign(x[1]));
      });
      const Program force =
          record(2, 1, 1, [](auto, const auto& x, const auto& p, auto& y) { y[0] = p[0] * sign(x[1]); });
      const Tube tube = Flow(f, force).enclose({0.0, 0.0, limit}, 2, {0.5, 1, 1.0625, 2});
      ASSERT_EQ(tube.why(), "");
      const auto gone = [](Precise t, Precise p) {
        return p < t ? Precise((t - p) * (t - p) * (t - p) / 6) : Precise(0);
      };
      const auto rate = [](Precise t, Precise p) { return p < t ? Precise((t - p) * (t - p) / 2) : Precise(0); };
      for (int row = 1; row <= 4; ++row) {
        const double t = tube.times()[static_cast<std::size_t>(row)];
        for (int i = 0; i <= 32; ++i) {
          const Precise p = limit.lower() + Precise(width(limit)) * i / 32, at = side * Precise(unit);
          EXPECT_THAT(tube.states(row)[0], Encloses(Precise(at * gone(t, p)))) << t;
          EXPECT_THAT(tube.states(row)[1], Encloses(Precise(at * rate(t, p)))) << t;
          EXPECT_THAT(tube.outputs(row)[0], Encloses(Precise(side * (p < t ? p : Precise(t))))) << t;
        }
      }
      EXPECT_LT(width(tube.states(4)[1]), unit * 1.001 * width(Interval(0.3828125, 0.6328125)));
      EXPECT_LT(width(tube.states(2)[1]), unit * 1.01 * 0.0078125);  // half of them have been let go
      EXPECT_LT(width(tube.outputs(1)[0]), 1e-9);
    }
}

/// Two masses on rough ground with a spring between them: the load lets go the one, and the spring, later, the other.
TEST(FlowTurns, OneAfterTheOtherIsLetGo) {
  const Program f = record(3, 2, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = t - x[2] - p[0] * sign(x[0]);
    dx[1] = x[2] - p[1] * sign(x[1]);
    dx[2] = x[0] - x[1];
  });
  const Box box{0.0, 0.0, 0.0, Interval(0.9375, 1.0625), 0.5};
  const Tube tube = Flow(f).enclose(box, 3, {1.5, 3});
  ASSERT_EQ(tube.why(), "");
  SlidingReference reference(f, [](const auto& sides, const Vector&, Vector& x) {
    for (std::size_t k = 0; k < 2; ++k)
      if (sides[k] == Side::held) x[k] = 0;
  });
  Interval first = Interval::empty(), second = first;
  for (int i = 0; i <= 16; ++i) {
    const Precise p = box[3].lower() + Precise(width(box[3])) * i / 16;
    const Vector end = reference({Precise(0), Precise(0), Precise(0), p, Precise(0.5)}, {1.5, 3}).back();
    for (std::size_t state = 0; state < 3; ++state) ASSERT_THAT(tube.states(2)[state], Encloses(end[state]));
    first = hull(first, Interval(end[0].convert_to<double>()));
    second = hull(second, Interval(end[1].convert_to<double>()));
  }
  EXPECT_LT(width(tube.states(2)[0]), 1.1 * width(first));
  EXPECT_LT(width(tube.states(2)[1]), 1.1 * width(second));
}

/// A mass slides to rest from the rate 1 under a friction p of 8 … 12, in 1/p, and goes 1/(2p): the comparison with any
/// sign would be much too wide.
TEST(FlowTurns, AllOfAWideSetComesToRest) {
  const Interval friction(8, 12);
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * sign(x[1]) - 16.0 * x[0] * x[1];
  });
  const Tube tube = Flow(f).enclose({0.0, 1.0, friction}, 1, {0.09375, 0.1, 1});
  ASSERT_EQ(tube.why(), "");
  SlidingReference reference(f, [](const auto& sides, const Vector&, Vector& x) {
    if (sides[0] == Side::held) x[1] = 0;
  });
  Interval gone = Interval::empty();
  for (int i = 0; i <= 64; ++i) {
    const Precise p = friction.lower() + Precise(width(friction)) * i / 64;
    const std::vector<Vector> states = reference({Precise(0), Precise(1), p}, {0.09375, 0.1, 1});
    for (int row = 1; row <= 3; ++row)
      for (std::size_t state = 0; state < 2; ++state)
        ASSERT_THAT(tube.states(row)[state], Encloses(states[static_cast<std::size_t>(row) - 1][state]));
    gone = hull(gone, Interval(states.back()[0].convert_to<double>()));
  }
  EXPECT_LT(width(tube.states(3)[0]), 1.05 * width(gone));
}

/// A load that just reaches what holds, for some of them, and falls again: these are let go, others never are.
TEST(FlowTurns, WhatGrazesIsInside) {
  const Program f = record(
      1, 1, [](auto t, const auto& x, const auto& p, auto& dx) { dx[0] = 4.0 * t * (1.0 - t) - p[0] * sign(x[0]); });
  const Interval limit(0.9375, 1.0625);
  const Tube tube = Flow(f).enclose({0.0, limit}, 0.75, {0.5, 0.75});
  ASSERT_EQ(tube.why(), "");
  SlidingReference reference(f, [](const auto& sides, const Vector&, Vector& x) {
    if (sides[0] == Side::held) x[0] = 0;
  });
  for (int i = 0; i <= 16; ++i) {
    if (i == 8) continue;  // touches
    const Precise p = limit.lower() + Precise(width(limit)) * i / 16;
    const std::vector<Vector> states = reference({Precise(0), p}, {0.5, 0.75});
    EXPECT_THAT(tube.states(2)[0], Encloses(states.back()[0]));
  }
}

/// What is beyond its limit at once leaves at once, not when it would have come to it: the rate is 0.01 t + t²/2, not
/// that since t = -0.01.
TEST(FlowTurns, WhatIsBeyondAtTheStartLeavesThere) {
  for (const double by : {0.0009765625, 0.0078125, 0.0625})
    for (const double half : {0.0, 0.0078125}) {
      const Program f = record(2, 1, [by](auto t, const auto& x, const auto& p, auto& dx) {
        dx[0] = x[1];
        dx[1] = 1.0 + by + p[0] * t - sign(x[1]);
      });
      const Interval slope(1 - half, 1 + half);
      const Tube tube = Flow(f).enclose({0.0, 0.0, slope}, 1, {0.0078125, 0.0625, 0.5, 1});
      ASSERT_EQ(tube.why(), "");
      for (int row = 1; row <= 4; ++row)
        for (const double p : {slope.lower(), slope.upper()}) {
          const Precise t = tube.times()[static_cast<std::size_t>(row)];
          EXPECT_THAT(tube.states(row)[1], Encloses(Precise(t * by + p * t * t / 2))) << by;
        }
    }
}

/// A state that follows a sign turns back where the last of a set come to be held, between two output times.
TEST(FlowTurns, CornersBetweenOutputTimesAreInside) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    const auto s = sign(x[0]);
    dx[0] = -0.25 * p[0] - s - 0.125 * x[0];
    dx[1] = s;
  });
  const Box box{Interval(0.95, 1.05), 0.0, Interval(0.9875, 1.0125)};
  const Tube tube = Flow(f).enclose(box, 2, {0.1, 0.7206, 0.81, 2});
  ASSERT_EQ(tube.why(), "");
  for (const double start : {box[0].lower(), box[0].upper()})
    for (const double p : {box[2].lower(), box[2].upper()}) {
      const Precise last = 1 + Precise(p) / 4;  // x = (x₀ + 8 c) e^{-t/8} - 8 c = 0
      const Precise until = 8 * log(1 + Precise(start) / (8 * last));
      for (int row = 1; row <= 4; ++row)
        if (until > tube.times()[static_cast<std::size_t>(row) - 1] &&
            until < tube.times()[static_cast<std::size_t>(row)]) {
          EXPECT_THAT(tube.statesOver(row)[1], Encloses(until));
        }
      EXPECT_THAT(tube.states(1)[1], Encloses(Precise(0.1)));
    }
}

}  // namespace
}  // namespace gamut::testing
