// What depends on time alone is met by every integrator, short as it may be against the steps it would take.
#include "analyses/samples/time_cells.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "analyses/samples/arbiter.hpp"
#include "analyses/samples/pack_witness.hpp"
#include "scalars/index.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

using ::testing::IsEmpty;

/// x' = sech²(k (t - p)): x(2) - x(0) = (tanh k (2 - p) + tanh k p) / k.
Motion pulse(double steepness) {
  Motion motion;
  motion.f = record(
      1, 1, [&](auto t, const auto&, const auto& p, auto& dx) { dx[0] = 1.0 - sqr(tanh(steepness * (t - p[0]))); });
  motion.g = record(1, 1, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  motion.times = {0, 0.5, 1.5, 2};
  return motion;
}

double afterPulse(double steepness, double centre) {
  return (std::tanh(steepness * (2 - centre)) + std::tanh(steepness * centre)) / steepness;
}

TEST(TimeCells, AreNoneWhereNothingDependsOnTimeAlone) {
  const Program f = record(1, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = p[0] * t + exp(x[0] * t) - tanh(1000.0 * x[0]);
  });
  EXPECT_THAT(TimeCells(f, 2).ends(std::array{Interval(1.0)}), IsEmpty());
}

TEST(TimeCells, RiseToTheHorizonAndAreShortWhereAPulseIs) {
  const Motion motion = pulse(1e4);
  TimeCells cells(motion.f, 2);
  for (const Interval& centre : {Interval(1.03), Interval(1.0, 1.01), Interval(0.3)}) {
    const std::vector<double>& ends = cells.ends(std::array{centre});
    ASSERT_GT(ends.size(), 8U);
    EXPECT_EQ(ends.back(), 2);
    double before = 0;
    for (const double end : ends) {
      ASSERT_GT(end, before);
      const bool holdsPulse = before < centre.upper() && end > centre.lower();
      EXPECT_LT(end - before, holdsPulse ? 1e-3 : 2) << "before " << end;
      before = end;
    }
    EXPECT_LE(ends.size(), 4096U);
  }
}

TEST(TimeCells, OfAKinkAreFew) {
  const Program f =
      record(1, 0, [](auto t, const auto&, const auto&, auto& dx) { dx[0] = sqrt(t) + sqrt(sqr(sin(20.0 * t))); });
  EXPECT_LT(TimeCells(f, 2).ends({}).size(), 2000U);
}

TEST(TimeCells, OfWhatHasNoBoundsAreNoMoreThanAnIntegratorTakes) {
  const Program f = record(1, 0, [](auto t, const auto&, const auto&, auto& dx) {
    dx[0] = exp(1000.0 * t) + 1.0 / (t - 1.0) + sin(1e7 * t) + 1.0 / (1.0 + exp(1000.0 * (1.0 - t)));
  });
  EXPECT_LE(TimeCells(f, 2).ends({}).size(), 4096U);
}

TEST(Witness, MeetsAPulseThatItsStepsWouldPassOver) {
  for (const double steepness : {40.0, 4e3, 4e5, 4e7})
    for (const Method method : {Method::adams, Method::bdf}) {
      const Motion motion = pulse(steepness);
      Witness witness(motion, method);
      std::array<double, 4> x{};
      for (const double centre : {1.03, 0.77}) {
        EXPECT_EQ(witness.integrate(std::array{0.0, centre}, {1e-10, 1e-14}, x).why, "");
        const double exact = afterPulse(steepness, centre);
        EXPECT_NEAR(x[3] / exact, 1, 1e-4) << steepness << " at " << centre;
      }
    }
}

TEST(PackWitness, MeetsThePulseOfEachSampleThatItsStepsWouldPassOver) {
  for (const double steepness : {40.0, 4e3, 4e4}) {
    const Motion motion = pulse(steepness);
    std::vector<double> starts(2 * packWidth), x(4 * packWidth);
    for (int lane = 0; lane < packWidth; ++lane) starts[detail::at(packWidth + lane)] = 1 + 0.001 * lane;
    EXPECT_EQ(PackWitness(motion).integrate(starts, {1e-10, 1e-14}, x).why, "");
    for (int lane = 0; lane < packWidth; ++lane)
      EXPECT_NEAR(x[detail::at(3 * packWidth + lane)] / afterPulse(steepness, 1 + 0.001 * lane), 1, 1e-4) << lane;
  }
}

/// Where the pulse was not met, two series of two orders agreed on a motion without it.
TEST(Arbiter, AndSeriesInDoublesMeetAPulseThatTheirStepsWouldPassOver) {
  for (const double steepness : {4e3, 4e6}) {
    const Motion motion = pulse(steepness);
    const PreciseTrajectory y = arbitrate(motion, std::array{0.0, 1.03});
    ASSERT_EQ(y.times, 4U) << y.why;
    const double exact = afterPulse(steepness, 1.03);
    EXPECT_NEAR(y.values[3].convert_to<double>() / exact, 1, 1e-14);
    EXPECT_NEAR(integrateByTaylor(motion, std::array{0.0, 1.03})[3] / exact, 1, 1e-9);
  }
}

/// x' = tanh k (t - a) - tanh k (t - b) begins with what rounding leaves of two large terms; x(2) = 2 (b - a).
TEST(Arbiter, AndSeriesInDoublesGoOnFromRestWhereLargeTermsCancel) {
  Motion motion = pulse(1);
  const double begin = 1.1, end = 1.105;
  motion.f = record(1, 1, [&](auto t, const auto&, const auto&, auto& dx) {
    dx[0] = tanh(1000.0 * (t - begin)) - tanh(1000.0 * (t - end));
  });
  const PreciseTrajectory y = arbitrate(motion, std::array{0.0, 0.0});
  ASSERT_EQ(y.times, 4U) << y.why;
  EXPECT_NEAR(y.values[3].convert_to<double>(), 2 * (end - begin), 1e-17);
  EXPECT_NEAR(integrateByTaylor(motion, std::array{0.0, 0.0})[3], 2 * (end - begin), 1e-13);
}

}  // namespace
}  // namespace gamut
