// Motions whose equations jump, sampled and arbitrated, against closed forms: what crosses, what is held, what is
// released. Errors are measured against the greatest state; CVODE's are those of its tolerance over some hundred steps.
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <vector>

#include "analyses/samples/arbiter.hpp"
#include "analyses/samples/witness.hpp"
#include "tests/analyses/motions.hpp"
#include "tests/analyses/whole_ensemble.hpp"

namespace gamut {
namespace {

using namespace testing_motions;
using std::numbers::pi;
using ::testing::HasSubstr;

/// All states are outputs.
template <class Formula>
Motion motionOf(int states, double horizon, int count, const Formula& formula) {
  Motion motion;
  motion.f = record(states, 0, formula);
  motion.g = record(states, 0, states, [](auto, const auto& x, const auto&, auto& y) {
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = x[i];
  });
  motion.times = timesTo(horizon, count);
  return motion;
}

std::vector<double> sampled(const Motion& motion, const std::vector<double>& start, const Tolerance& tolerance = {},
                            Method method = Method::adams) {
  std::vector<double> y(motion.times.size() * motion.outputs());
  const Integration run = Witness(motion, method).integrate(start, tolerance, y);
  EXPECT_EQ(run.why, "");
  EXPECT_EQ(run.times, motion.times.size());
  return y;
}

std::vector<double> arbitrated(const Motion& motion, const std::vector<double>& start) {
  const PreciseTrajectory y = arbitrate(motion, start);
  EXPECT_EQ(y.why, "");
  for (std::size_t i = 0; i < y.error.size(); ++i)
    EXPECT_LT(y.error[i], 1e-24 * (1 + abs(y.values[i]).convert_to<double>())) << i;
  return roundedToDoubles(y, motion.times.size() * motion.outputs());
}

/// exact: output o at time t.
template <class Exact>
void expectAll(const Motion& motion, const std::vector<double>& start, const Exact& exact, double scale = 1) {
  const auto expectNear = [&](const std::vector<double>& y, double error, const char* who) {
    for (std::size_t i = 0; i < motion.times.size(); ++i)
      for (std::size_t o = 0; o < motion.outputs(); ++o)
        ASSERT_NEAR(y[i * motion.outputs() + o], exact(o, motion.times[i]), error * scale)
            << who << " output " << o << " at " << motion.times[i];
  };
  const Tolerance tolerance{1e-10, 1e-12 * scale};
  expectNear(arbitrated(motion, start), 2e-14, "arbiter");
  expectNear(integrateByTaylor(motion, start), 1e-11, "series in doubles");
  expectNear(sampled(motion, start, tolerance), 2e-8, "Adams");
  expectNear(sampled(motion, start, tolerance, Method::bdf), 1e-6, "BDF");
  expectNear(sampled(motion, start, tolerance.tightened(100)), 5e-10, "Adams, tighter");
}

/// x'' = -x - 0.15 sign v from rest at 1: turns at -0.7, 0.4 and -0.1, where it stays.
double rubbing(std::size_t output, double t) {
  double from = 1;
  for (int half = 0; half < 3; ++half, t -= pi) {
    const double centre = from > 0 ? 0.15 : -0.15;
    if (t < pi) return output == 0 ? centre + (from - centre) * std::cos(t) : -(from - centre) * std::sin(t);
    from = 2 * centre - from;
  }
  return output == 0 ? from : 0;
}

Motion rubbingMass(double amplitude, double horizon = 16) {
  return motionOf(2, horizon, 64, [&](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -x[0] - 0.15 * amplitude * sign(x[1]);
  });
}

TEST(Jumps, AMassThatRubsComesToRestAndStays) {
  expectAll(rubbingMass(1), {1, 0}, rubbing);
  // What rounding leaves of the speed where it comes to rest is all that moves it later.
  const std::vector<double> y = sampled(rubbingMass(1, 1e4), {1, 0});
  EXPECT_NEAR(y.back(), 0, 1e-15);
  EXPECT_NEAR(y[2], y[y.size() - 2], 1e-11);
}

TEST(Jumps, AreFollowedInOtherUnits) {
  for (const double scale : {1e-6, 1e6})
    expectAll(
        rubbingMass(scale), {scale, 0}, [&](std::size_t o, double t) { return scale * rubbing(o, t); }, scale);
}

TEST(Jumps, AGrowingForceBreaksAMassLoose) {
  const Motion motion = motionOf(2, 4, 40, [](auto t, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = 0.5 * t - sign(x[1]);
  });
  expectAll(motion, {0, 0}, [](std::size_t o, double t) {
    const double since = std::max(0.0, t - 2);
    return o == 0 ? since * since * since / 12 : since * since / 4;
  });
}

/// A block on a block that is pulled over the floor: at rest to 2 s, together to 3 s, then the upper one slips.
TEST(Jumps, OfTwoBlocksAreHeldTogetherThenReleasedOneByOne) {
  const Motion motion = motionOf(2, 4, 40, [](auto t, const auto& v, const auto&, auto& dv) {
    const auto rub = 0.25 * sign(v[0] - v[1]);
    dv[0] = 0.5 * t - sign(v[0]) - rub;
    dv[1] = rub;
  });
  expectAll(motion, {0, 0}, [](std::size_t o, double t) {
    const double together = std::clamp(t - 2, 0.0, 1.0), apart = std::max(0.0, t - 3);
    return together * together / 8 + apart / 4 + (o == 0 ? apart * apart / 4 : 0);
  });
}

/// Two masses in series on the floor: the first, pulled, is loose at 0.4 s, and drags the second.
TEST(Jumps, OfTwoMassesInSeriesAreReleasedOneAfterTheOther) {
  const Motion motion = motionOf(4, 3, 60, [](auto t, const auto& x, const auto&, auto& dx) {
    const auto spring = 4.0 * (x[0] - x[1]);
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = 0.5 * t - spring - 0.2 * sign(x[2]);
    dx[3] = spring - 0.5 * sign(x[3]);
  });
  const std::vector<double> start(4), y = sampled(motion, start), exact = arbitrated(motion, start);
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    const double since = std::max(0.0, motion.times[i] - 0.4), x = (since / 4 - std::sin(2 * since) / 8) / 2;
    for (std::size_t o = 0; o < 4; ++o) EXPECT_NEAR(y[4 * i + o], exact[4 * i + o], 1e-9) << motion.times[i];
    if (motion.times[i] > 1.5) continue;  // the second one's turn
    EXPECT_LT(4 * x, 0.5);
    EXPECT_NEAR(exact[4 * i], x, 1e-15);
    EXPECT_NEAR(exact[4 * i + 1], 0, 1e-15);
  }
}

TEST(Jumps, ARelayComesToZeroAndStays) {
  const Motion motion = motionOf(1, 3, 30, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -sign(x[0]); });
  expectAll(motion, {1}, [](std::size_t, double t) { return std::max(0.0, 1 - t); });
  expectAll(motion, {0}, [](std::size_t, double) { return 0.0; });
}

TEST(Jumps, OfTimeAloneArePassed) {
  const Motion motion =
      motionOf(1, 20, 80, [](auto t, const auto&, const auto&, auto& dx) { dx[0] = sign(sin(pi * t)); });
  expectAll(motion, {0}, [](std::size_t, double t) { return 1 - std::abs(std::fmod(t, 2) - 1); });
}

TEST(Jumps, ThatHoldNothingAreCrossed) {
  const Motion motion =
      motionOf(1, 4, 40, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = 1.0 + 0.5 * sign(x[0]); });
  expectAll(motion, {-1}, [](std::size_t, double t) { return t < 2 ? t / 2 - 1 : 1.5 * (t - 2); });
  expectAll(motion, {0}, [](std::size_t, double t) { return 1.5 * t; });
}

TEST(Jumps, ThatMultiplyAreCrossedOneByOneAndBothAtOnce) {
  for (const double second : {1.5, 1.0}) {
    const Motion motion = motionOf(3, 3, 30, [](auto, const auto& x, const auto&, auto& dx) {
      dx[0] = 1.0;
      dx[1] = 2.0;
      dx[2] = sign(x[0]) * sign(x[1]);
    });
    expectAll(motion, {-1, -2 * second, 0}, [&](std::size_t o, double t) {
      return o == 0 ? t - 1 : o == 1 ? 2 * (t - second) : t < 1 ? t : t < second ? 2 - t : t - 2 * (second - 1);
    });
  }
}

/// A stop, at which nothing jumps: where(x > 0, -100 x, 0). A mass flies into it from x = 0, and one is pushed into it.
TEST(Jumps, OfNoHeightAreLeftToTheSideOfTheMotion) {
  const auto stop = [](double push, double horizon) {
    return motionOf(2, horizon, 30, [=](auto, const auto& x, const auto&, auto& dx) {
      dx[0] = x[1];
      dx[1] = push + where(x[0], -100.0 * x[0], x[0] * 0.0);
    });
  };
  expectAll(stop(0, 1), {0, 1}, [](std::size_t o, double t) {
    const double after = t - pi / 10;
    return after > 0 ? (o == 0 ? -after : -1) : o == 0 ? std::sin(10 * t) / 10 : std::cos(10 * t);
  });
  expectAll(stop(1, 0.6), {0, 0},
            [](std::size_t o, double t) { return o == 0 ? (1 - std::cos(10 * t)) / 100 : std::sin(10 * t) / 10; });
  expectAll(stop(-1, 1), {0, 0}, [](std::size_t o, double t) { return o == 0 ? -t * t / 2 : -t; });
  expectAll(stop(0, 1), {0, 0}, [](std::size_t, double) { return 0.0; });
}

/// Held while the push is less than the friction: x' = 1.25 sin t - sign x.
TEST(Jumps, AMotionIsHeldWhileWhatPushesItChanges) {
  const Motion motion =
      motionOf(1, 8, 64, [](auto t, const auto& x, const auto&, auto& dx) { dx[0] = 1.25 * sin(t) - sign(x[0]); });
  const double loose = std::asin(0.8);
  expectAll(motion, {0}, [&](std::size_t, double t) {
    double x = 0;  // until it is back at 0, between 3 s and 4 s, as long as 1.25 (cos loose - cos t) > t - loose
    const auto flight = [&](double since) { return 1.25 * (std::cos(loose) - std::cos(since)) - (since - loose); };
    double low = 2.5, high = 4.5;
    for (int i = 0; i < 60; ++i) (flight((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    // At its return the push has the other sign already: it goes through if beyond -1, else it waits for that.
    const double begin = std::max(low, loose + pi);
    if (t > loose && t < low) x = flight(t);
    if (t > begin) {
      const auto back = [&](double since) { return 1.25 * (std::cos(begin) - std::cos(since)) + (since - begin); };
      double from = begin + 1.5, to = begin + 4;
      for (int i = 0; i < 60; ++i) (back((from + to) / 2) < 0 ? from : to) = (from + to) / 2;
      x = t < from ? back(t) : 0;
      const double again = std::max(from, loose + 2 * pi);
      if (t > again) x = 1.25 * (std::cos(again) - std::cos(t)) - (t - again);
    }
    return x;
  });
}

/// Stick and slip on a belt: friction falls with the speed of sliding.
TEST(Jumps, OfAMassOnABeltAreHeldAndReleasedAgainAndAgain) {
  const Motion motion = motionOf(2, 30, 300, [](auto, const auto& x, const auto&, auto& dx) {
    const auto slip = x[1] - 0.3;
    dx[0] = x[1];
    dx[1] = -x[0] - sign(slip) * (0.6 + 0.4 * exp(-4.0 * sqr(slip)));
  });
  const std::vector<double> start{0.5, 0}, exact = arbitrated(motion, start), series = integrateByTaylor(motion, start);
  const std::vector<double> y = sampled(motion, start), finer = sampled(motion, start, Tolerance().tightened(100));
  int phases = 0;
  bool sticks = false;
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    for (std::size_t o = 0; o < 2; ++o) {
      ASSERT_NEAR(y[2 * i + o], exact[2 * i + o], 3e-8) << motion.times[i];
      ASSERT_NEAR(finer[2 * i + o], exact[2 * i + o], 3e-10) << motion.times[i];
      ASSERT_NEAR(series[2 * i + o], exact[2 * i + o], 1e-12) << motion.times[i];
    }
    const bool now = std::abs(exact[2 * i + 1] - 0.3) < 1e-15;
    phases += now && !sticks ? 1 : 0;
    sticks = now;
  }
  EXPECT_GE(phases, 3);
}

TEST(Jumps, APendulumComesToRestInItsHinge) {
  const Motion motion = motionOf(2, 40, 200, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -9.81 * sin(x[0]) - 0.7 * sign(x[1]);
  });
  const std::vector<double> start{1.5, 0}, y = sampled(motion, start), exact = arbitrated(motion, start);
  for (std::size_t i = 0; i < y.size(); ++i) ASSERT_NEAR(y[i], exact[i], 1e-8) << i;
  EXPECT_NEAR(y.back(), 0, 1e-15);
  EXPECT_LT(std::abs(9.81 * std::sin(y[y.size() - 2])), 0.7);
}

/// Two signs of one surface are no two that can be held: one takes a side, and the other holds.
TEST(Jumps, OfOneSurfaceTwiceAreHeldAsOne) {
  const Motion motion = motionOf(1, 3, 30, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = -sign(x[0]) - 3.0 * sign(x[0] * (1.0 + sqr(x[0])));
  });
  expectAll(motion, {1}, [](std::size_t, double t) { return std::max(0.0, 1 - 4 * t); });
  expectAll(motion, {0}, [](std::size_t, double) { return 0.0; });
}

/// Two blocks side by side on the floor, each of which rubs at the other too: at rest three speeds are zero, of which
/// two are free. At 2 s the first one moves against 0.75 of the floor and 0.25 of the other, which stays.
TEST(Jumps, OfSurfacesThatDependOnEachOtherAreHeld) {
  const Motion motion = motionOf(2, 4, 40, [](auto t, const auto& v, const auto&, auto& dv) {
    const auto rub = 0.25 * sign(v[0] - v[1]);
    dv[0] = 0.5 * t - 0.75 * sign(v[0]) - rub;
    dv[1] = rub - sign(v[1]);
  });
  expectAll(motion, {0, 0}, [](std::size_t o, double t) {
    const double since = std::max(0.0, t - 2);
    return o == 0 ? since * since / 4 : 0;
  });
}

/// x'' = -sign x - sign(x') / 2: half swings become shorter by 1/√3 each, and all is over after a finite time.
TEST(Jumps, WithoutEndEndTheMotionAndSaySo) {
  const Motion motion = motionOf(2, 20, 20, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -sign(x[0]) - 0.5 * sign(x[1]);
  });
  std::vector<double> y(42);
  const Integration run = Witness(motion).integrate(std::vector{1.0, 0.0}, {}, y);
  EXPECT_THAT(run.why, HasSubstr("again and again"));
  EXPECT_THAT(arbitrate(motion, std::vector{1.0, 0.0}).why, HasSubstr("again and again"));
}

/// A pulse that CVODE's steps would pass over strikes a mass that friction holds: x'' = p(t) - 0.1 sign v.
TEST(Jumps, APulseIsMetByAMassAtRest) {
  const double steepness = 4e3, height = 500;
  const Motion motion = motionOf(2, 2, 20, [=](auto t, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = height * (1.0 - sqr(tanh(steepness * (t - 1.03)))) - 0.1 * sign(x[1]);
  });
  const std::vector<double> start(2), y = sampled(motion, start), exact = arbitrated(motion, start);
  EXPECT_EQ(exact[2 * 10], 0);
  EXPECT_GT(exact[2 * 11 + 1], 0.2);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], exact[i], 1e-7) << i;
}

TEST(Jumps, AnOutputAtTheMomentOfAnEventIsThatOfBothPieces) {
  Motion motion = rubbingMass(1);
  motion.times = {pi, std::nextafter(pi, 4.0), 2 * pi, 3 * pi};
  const std::vector<double> y = sampled(motion, {1, 0}), series = integrateByTaylor(motion, std::vector{1.0, 0.0});
  const std::vector<double> exact{-0.7, -0.7, 0.4, -0.1};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(y[2 * i], exact[i], 1e-8);
    EXPECT_NEAR(series[2 * i], exact[i], 1e-13);
    EXPECT_NEAR(y[2 * i + 1], 0, 1e-8);
  }
}

/// What a force of 2 + t pushes rubs with as much until it is 3, and then with 3; two masses, the second twice as
/// heavy.
TEST(Jumps, WhatHoldsAMassIsSeen) {
  Motion motion = motionOf(2, 2, 8, [](auto t, const auto& v, const auto&, auto& dv) {
    dv[0] = 2.0 + t - 3.0 * sign(v[0]);
    dv[1] = (-1.0 - 0.25 * t - 3.0 * sign(v[1])) / 2.0;
  });
  motion.g = record(2, 0, 3, [](auto t, const auto& v, const auto&, auto& y) {
    y[0] = -3.0 * sign(v[0]);
    y[1] = 2.0 + t - 3.0 * sign(v[0]);
    y[2] = 3.0 * sign(-0.5 * v[1]);
  });
  for (const auto& y : {sampled(motion, {0.0, 0.0}), arbitrated(motion, {0.0, 0.0})})
    for (std::size_t i = 0; i < motion.times.size(); ++i) {
      const double t = motion.times[i];
      if (t == 1) continue;
      EXPECT_NEAR(y[3 * i], t < 1 ? -2 - t : -3, 1e-14) << t;
      EXPECT_NEAR(y[3 * i + 1], t < 1 ? 0 : t - 1, 1e-14) << t;
      EXPECT_NEAR(y[3 * i + 2], 1 + 0.25 * t, 1e-14) << t;
    }
}

/// An angle of half a turn, beside what rubs.
TEST(Jumps, AnglesOfHalfATurnAreSeen) {
  for (const double height : {0.0, 1.0}) {
    Motion motion = motionOf(2, 1, 4, [&](auto, const auto& x, const auto&, auto& dx) {
      dx[0] = x[1];
      dx[1] = -height * sign(x[1]) - 1.0;
    });
    motion.g = record(2, 0, 1,
                      [](auto, const auto& x, const auto&, auto& y) { y[0] = atan2(0.0 * x[0] + x[1] - x[1], x[0]); });
    for (const auto& y : {sampled(motion, {-1.0, 0.0}), arbitrated(motion, {-1.0, 0.0})})
      for (const double angle : y) EXPECT_EQ(angle, pi);
  }
}

TEST(Jumps, AMotionIsCancelledOrLateBetweenThemToo) {
  const Motion motion = motionOf(2, 1e7, 2, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -x[0] - 1e-9 * sign(x[1]);
  });
  std::vector<double> y(6);
  const Integration late = Witness(motion).integrate(std::vector{1.0, 0.0}, {}, y, 0.01);
  EXPECT_THAT(late.why, HasSubstr("time limit of 0.01 s"));
  EXPECT_GT(late.reached, 0);
  std::atomic<bool> cancelled = true;
  EXPECT_EQ(Witness(motion, Method::adams, &cancelled).integrate(std::vector{1.0, 0.0}, {}, y).why, "cancelled");
}

/// What a witness knows of other samples' sides does not matter.
TEST(Jumps, ATrajectoryDoesNotDependOnThoseBefore) {
  const Motion motion = rubbingMass(1);
  std::vector<double> alone(motion.times.size() * 2), later = alone;
  Witness(motion).integrate(std::vector{1.0, 0.0}, {}, alone);
  Witness witness(motion);
  for (const double start : {0.05, -3.0, 1.0}) witness.integrate(std::vector{start, 0.0}, {}, later);
  EXPECT_EQ(alone, later);
}

/// x'' = -w² x - 0.3 sign x', amplitude and w uncertain: each sample comes to rest elsewhere, at its own time.
UncertainMotion rubbingOscillator() {
  UncertainMotion system = oscillator(30, 24);
  system.motion.f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -sqr(p[0]) * x[0] - 0.3 * sign(x[1]);
  });
  return system;
}

double resting(double w, double amplitude) {
  const double step = 0.6 / (w * w);
  double x = amplitude;
  while (std::abs(x) > step / 2) x = x > 0 ? step - x : -step - x;
  return x;
}

TEST(Ensemble, OfAMotionThatJumpsIsTheSameWithAnyJobsAndReplayed) {
  const UncertainMotion system = rubbingOscillator();
  EnsembleOptions options;
  options.samples = 100;
  const WholeEnsemble one = sampleEnsemble(system, options);
  options.jobs = 3;
  const WholeEnsemble three = sampleEnsemble(system, options);
  EXPECT_EQ(one.packWidth, 1u);
  EXPECT_EQ(one.failures, 0u);
  EXPECT_EQ(one.data, three.data);
  EXPECT_EQ(one.error.data, three.error.data);
  for (const std::size_t i : {0u, 37u, 63u, 64u, 99u, 100u, 104u}) {
    const SampleBlock again = replaySample(system, options, i);
    EXPECT_EQ(again.trajectory(0), std::vector(one.trajectory(i).begin(), one.trajectory(i).end())) << i;
  }
}

TEST(Ensemble, OfAMotionThatComesToRestMeasuresItsError) {
  const UncertainMotion system = rubbingOscillator();
  EnsembleOptions options;
  options.samples = 100;
  const WholeEnsemble e = sampleEnsemble(system, options);
  double greatest = 0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double rest = resting(e.valuesOf(i)[0], e.valuesOf(i)[1]);
    greatest = std::max(greatest, std::abs(e(i, 24, 0) - rest));
    EXPECT_NEAR(e(i, 24, 1), 0, 1e-12);
  }
  EXPECT_LT(greatest, 1e-7);
  EXPECT_GT(greatest, 1e-13);
  EXPECT_LT(e.error(24, 0), 1e-7);
  EXPECT_GT(e.error(24, 0), greatest / 30);
}

}  // namespace
}  // namespace gamut
