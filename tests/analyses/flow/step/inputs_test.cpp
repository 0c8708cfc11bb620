// Parameters that vary in time: trajectories with switching courses, optimal ones where these are known, must lie
// inside, exactly; and enclosures must be about as wide as what the optimal ones span.
#include <cmath>

#include "tests/analyses/flow/expect_courses.hpp"

namespace gamut::testing {
namespace {

/// ẍ = w - ω²x - 2ζωẋ from rest, |w| ≤ 1.
Containment oscillator(double frequency, double damping) {
  Containment c;
  c.f = record(2, 1, [&](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] - frequency * frequency * x[0] - 2 * damping * frequency * x[1];
  });
  c.box = {0.0, 0.0, Interval(-1, 1)};
  c.options.varying = {{0}};
  c.horizon = 4;
  c.times = {1, 2};
  return c;
}

/// ∫|h| over [0, time]: the most that x can reach; h is the response to an impulse. By quadrature.
double farthest(double frequency, double damping, double time) {
  const double turn = frequency * std::sqrt(1 - damping * damping), decay = damping * frequency;
  const int parts = 1 << 20;
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double s = (i + 0.5) * time / parts;
    sum += std::fabs(std::exp(-decay * s) * std::sin(turn * s) / turn);
  }
  return sum * time / parts;
}

TEST(FlowInputs, AreAsTightAsAskedForAgainstTheOptimalCourse) {
  for (double frequency : {2.0, 5.0, 50.0})
    for (double tightness : {1.02, 1.004}) {
      Containment c = oscillator(frequency, 0.1);
      c.options.tightness = tightness;
      const Tube tube = c.tube();
      ASSERT_EQ(tube.why(), "");
      for (std::size_t row : {1U, 2U, 3U}) {
        const double most = farthest(frequency, 0.1, tube.times()[row]);
        EXPECT_LT(width(tube.states(row)[0]), 2 * most * (tightness + 0.001)) << frequency << " at " << row;
        EXPECT_GT(width(tube.states(row)[0]), 2 * most * (1 - 1e-6)) << frequency << " at " << row;
      }
    }
}

/// A stiffness known to 1 %: the optimal course of its ends is a lower bound of what is possible.
TEST(FlowInputs, AreTightBesideUncertainParameters) {
  Containment c;
  c.f = record(2, 2, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] - 25.0 * p[1] * x[0] - x[1];
  });
  c.g = record(2, 2, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0] + 0.1 * x[1] * x[0]; });
  c.box = {0.0, 0.0, Interval(-1, 1), Interval(0.99, 1.01)};
  c.options.varying = {{0}};
  c.horizon = 4;
  c.times = {1, 2};
  const Tube tube = expectCourses(c, 10);
  for (std::size_t row : {1U, 2U, 3U})
    EXPECT_LT(width(tube.states(row)[0]),
              2 * 1.05 *
                  std::max(farthest(5 * std::sqrt(0.99), 0.1 / std::sqrt(0.99), tube.times()[row]),
                           farthest(5 * std::sqrt(1.01), 0.1 / std::sqrt(1.01), tube.times()[row])));
}

/// Bang-bang with the switches of the impulse response, counted back from the end.
TEST(FlowInputs, HoldTheOptimalCourse) {
  const Containment c = oscillator(4.0, 0.0);
  const Tube tube = c.tube();
  Course course;
  const double end = 4, halfWave = 0.785398163397448309616;
  double sign = std::sin(4.0 * end) > 0 ? 1 : -1;
  course.values.push_back({Precise(sign)});
  for (int wave = static_cast<int>(end / halfWave); wave >= 1; --wave) {
    course.from.push_back(std::ldexp(std::round(std::ldexp(end - wave * halfWave, 40)), -40));
    course.values.push_back({Precise(sign = -sign)});
  }
  const Vector x = follow(c.f, {Precise(0.0), Precise(0.0)}, course, {4.0})[0];
  EXPECT_THAT(tube.at(4)[0], Encloses(x[0]));
  EXPECT_GT(abs(x[0]), Precise(0.97 * magnitude(tube.at(4)[0])));
}

TEST(FlowInputs, HoldSwitchingCourses) {
  expectCourses(oscillator(3.0, 0.05), 20);
  // A pendulum whose support moves and whose length is uncertain; the input is in outputs too.
  Containment c;
  c.f = record(2, 3, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = (p[0] * cos(x[0]) - 9.81 * sin(x[0])) / p[1] - p[2] * x[1];
  });
  c.g = record(2, 3, 2, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = p[1] * sin(x[0]) + 0.1 * t;
    y[1] = p[0] * cos(x[0]) + sqr(x[1]);
  });
  c.box = {Interval(0.3, 0.35), 0.0, Interval(-0.5, 0.5), Interval(0.99, 1.01), 0.2};
  c.options.varying = {{0}};
  c.horizon = 2;
  c.times = {0.25, 1};
  expectCourses(c, 20);
  // The input multiplies states, enters as a square and in a denominator; a second input.
  c.f = record(2, 3, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1] + 0.1 * p[1] * sin(x[0]);
    dx[1] = -(4.0 + p[0]) * x[0] - sqr(p[0]) * x[1] + p[2] / (2.0 + p[1]);
  });
  c.box = {1.0, Interval(-0.1, 0.1), Interval(-0.3, 0.5), Interval(0, 0.2), Interval(0.9, 1.1)};
  c.options.varying = {{1}, {0}};
  c.g = standardOutputs(2, 3);
  expectCourses(c, 20);
}

/// Of ẋ = x² + w the second order counts: the derivative half way to the extreme courses, the constant ones.
TEST(FlowInputs, HoldTheExtremesOfAQuadraticEquation) {
  Containment c;
  c.f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = sqr(x[0]) + p[0]; });
  c.options.varying = {{0}};
  for (double radius : {0.01, 0.1, 0.2}) {
    c.box = {0.5, Interval(-radius, radius)};
    c.horizon = 1.25;
    c.times = {0.25, 0.5, 0.75, 1};
    const Tube tube = c.tube();
    ASSERT_EQ(tube.why(), "");
    Reference reference(c.f);
    for (double course : {-radius, radius}) {
      const std::vector<Vector> motion = reference({Precise(0.5), Precise(course)}, {0.25, 0.5, 0.75, 1.0, 1.25});
      for (std::size_t row = 1; row <= 5; ++row) EXPECT_THAT(tube.states(row)[0], Encloses(motion[row - 1][0]));
    }
  }
}

/// Far from the centre of a parameter what inputs do is not linear in it: the optimal courses of both ends are held
/// (1e-9: more than the quadrature's own error, 2.7e-12 against four times as many parts).
TEST(FlowInputs, HoldTheOptimalCourseOfEveryParameter) {
  for (double spread : {0.1, 0.3}) {
    Containment c;
    c.f = record(2, 2, [](auto, const auto& x, const auto& p, auto& dx) {
      dx[0] = x[1];
      dx[1] = p[0] - 25.0 * p[1] * x[0] - 0.5 * x[1];
    });
    c.box = {0.0, 0.0, Interval(-1, 1), Interval(1 - spread, 1 + spread)};
    c.options.varying = {{0}};
    c.horizon = 1.5;
    for (int i = 1; i < 15; ++i) c.times.push_back(0.1 * i);
    const Tube tube = c.tube();
    ASSERT_EQ(tube.why(), "");
    for (std::size_t row = 1; row < tube.reachedTimes(); ++row)
      for (double part : {-1.0, -0.5, 0.5, 1.0}) {
        const double frequency = 5 * std::sqrt(1 + part * spread);
        EXPECT_GT(tube.states(row)[0].upper(), farthest(frequency, 0.25 / frequency, tube.times()[row]) * (1 - 1e-9))
            << spread << ' ' << part << ' ' << row;
      }
  }
}

/// What the input multiplies passes through zero, for all of the set and for a part of it.
TEST(FlowInputs, HoldWhereTheyDoNothingForAMoment) {
  Containment c;
  c.f = record(2, 2, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1] + p[1] * x[0];
    dx[1] = -p[0] * x[0];
  });
  c.options.varying = {{0}, {1}};
  c.horizon = 2;
  for (double spread : {0.0, 0.05}) {
    c.box = {Interval(1 - spread, 1 + spread), 0.0, Interval(3.9, 4.1), Interval(-0.05, 0.05)};
    EXPECT_LT(expectCourses(c, 8).steps(), 400);
  }
}

/// Many states, and inputs that act on the last of a chain.
TEST(FlowInputs, HoldOnChains) {
  Containment c;
  c.f = record(10, 2, [](auto, const auto& x, const auto& p, auto& dx) {
    for (std::size_t i = 0; i < 5; ++i) {
      dx[i] = x[5 + i];
      Recorded pull = i > 0 ? 40.0 * (x[i - 1] - x[i]) : -40.0 * p[1] * x[0];
      if (i < 4) pull += 40.0 * (x[i + 1] - x[i]);
      dx[5 + i] = pull - 0.5 * x[5 + i] - x[i] * sqr(x[i]);
    }
    dx[9] += p[0];
  });
  c.box = Box(10, 0.0);
  c.box.push_back(Interval(-1, 2));
  c.box.push_back(Interval(0.99, 1.01));
  c.options.varying = {{0}};
  c.horizon = 2;
  expectCourses(c, 6);
}

/// Pieces of a wide box, and symbols for the errors of a thin one.
TEST(FlowInputs, HoldWherePiecesAreBisectedOrExpanded) {
  Containment c;
  c.f = record(2, 2, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[1] * (1.0 - sqr(x[0])) * x[1] - x[0] + p[0];
  });
  c.g = standardOutputs(2, 2);
  c.options.varying = {{0}};
  c.horizon = 4;
  c.times = {1, 2, 3};
  c.box = {Interval(1.2, 1.8), Interval(2.2, 2.6), Interval(-0.001, 0.001), Interval(0.95, 1.05)};
  EXPECT_GT(expectCourses(c, 8).pieces(), 1);
  c.box = {1.5, 2.4, Interval(-1e-4, 1e-4), 1.0};
  expectCourses(c, 8);
}

/// With a bounded rate: ramps, whose rates switch. Narrower than without.
/// x(¼) = 1/32 for w = p = -1, though x is below that at both ends of the step: what inputs do is not convex in time.
TEST(FlowInputs, HoldBetweenTheEndsOfAStep) {
  for (const double v : {0.0, 32.0, 40.0, 200.0})
    for (const double tightness : {1.02, 1.5, 3.0}) {
      const Program f = record(1, 2, [&](auto t, const auto&, const auto& p, auto& dx) {
        dx[0] = -(v + 0.25) + (v * p[1] + (t - 0.5)) * p[0];
      });
      FlowOptions options;
      options.varying = {{0}};
      options.tightness = tightness;
      const Tube tube = Flow(f, options).enclose({0.0, Interval(-1, 1), Interval(-1, 1)}, 1);
      EXPECT_GE(tube.statesOver(1)[0].upper(), 0x1p-5) << v << ' ' << tightness;
    }
}

TEST(FlowInputs, OfBoundedRateHoldRamps) {
  Containment c = oscillator(5.0, 0.05);
  const Tube free = c.tube();
  for (double rate : {0.1, 0.7, 20.0}) {
    c.options.varying = {{0, rate}};
    const Tube tube = c.tube();
    for (std::size_t i = 0; i < tube.reachedTimes(); ++i)
      for (std::size_t s = 0; s < 2; ++s) EXPECT_TRUE(isSubset(tube.states(i)[s], free.states(i)[s]));
    if (rate < 1) {
      EXPECT_LT(width(tube.states(1)[0]), 0.9 * width(free.states(1)[0]));
    }
    // (x, ẋ, w) with the rate as the input, as long as |w| ≤ 1.
    const Program ramped = record(3, 1, [](auto, const auto& x, const auto& p, auto& dx) {
      dx[0] = x[1];
      dx[1] = x[2] - 25.0 * x[0] - 0.5 * x[1];
      dx[2] = p[0];
    });
    Points points(4);
    for (int trial = 0; trial < 10; ++trial) {
      Course course;
      double w = points.integer(-8, 8) / 8.0;
      const double begin = w;
      for (int i = 0; i < 32; ++i) {
        if (i > 0) course.from.push_back(i / 8.0);
        double v = points.integer(0, 1) == 0 ? rate : -rate;
        if (std::fabs(w + v / 8) > 1) v = -v;
        if (std::fabs(w + v / 8) > 1) v = 0;
        w += v / 8;
        course.values.push_back({Precise(v)});
      }
      const std::vector<Vector> motion =
          follow(ramped, {Precise(0.0), Precise(0.0), Precise(begin)}, course, {1.0, 2.0, 4.0});
      for (std::size_t row = 1; row <= 3; ++row)
        for (std::size_t s = 0; s < 2; ++s) EXPECT_THAT(tube.states(row)[s], Encloses(motion[row - 1][s])) << rate;
    }
  }
}

TEST(FlowInputs, OfALevelAreNarrower) {
  Containment c = oscillator(5.0, 0.05);
  c.levels = {c.box, c.box};
  c.levels[1][2] = Interval(-0.25, 0.25);
  const Tube tube = c.tube();
  EXPECT_LT(width(tube.cut(1, 3)[0]), 0.26 * width(tube.cut(0, 3)[0]));
}

TEST(FlowInputs, AreRefusedWhereTheyMakeNoSense) {
  Containment c = oscillator(5.0, 0.05);
  for (const std::vector<VaryingParameter>& wrong :
       {std::vector<VaryingParameter>{{1}}, {{-1}}, {{0}, {0}}, {{0, 0.0}}, {{0, -1.0}}, {{0, std::nan("")}}}) {
    c.options.varying = wrong;
    EXPECT_THROW(Flow(c.f, c.options), std::invalid_argument);
  }
}

}  // namespace
}  // namespace gamut::testing
