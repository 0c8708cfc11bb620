// The arbiter against closed forms and against an independent method (extrapolation) in wider arithmetic.
#include "analyses/samples/arbiter.hpp"

#include <gmock/gmock.h>

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/analyses/motions.hpp"

namespace gamut {
namespace {

using namespace testing_motions;
using ::testing::HasSubstr;
using Wide = boost::multiprecision::cpp_bin_float_50;  // 168 bits, none of MPFR's code

Wide widened(const Precise& value) { return Wide(value.str(0, std::ios_base::scientific)); }

double relativeError(const Precise& value, const Wide& exact) {
  return Wide(abs((widened(value) - exact) / exact)).convert_to<double>();
}

TEST(Arbiter, AgreesWithTheHarmonicOscillatorTo28Digits) {
  const Motion motion = oscillator(3, 30).motion;
  const std::array start{1.1, 0.0, 2.3};
  const PreciseTrajectory y = arbitrate(motion, start);
  ASSERT_EQ(y.times, 31u);
  EXPECT_EQ(y.why, "");
  for (std::size_t t = 1; t < 31; ++t) {
    const Wide phase = Wide(2.3) * Wide(motion.times[t]);
    EXPECT_LT(relativeError(y.values[2 * t], Wide(1.1) * cos(phase)), 1e-28);
    EXPECT_LT(relativeError(y.values[2 * t + 1], -Wide(1.1) * Wide(2.3) * sin(phase)), 1e-28);
  }
}

/// Pendulum with forcing, x'' = -sin x + cos(t) / 8, by Gragg's midpoint rule and Richardson extrapolation.
using State = std::array<Wide, 2>;
State pendulumRate(const Wide& t, const State& x) { return {x[1], -sin(x[0]) + cos(t) / 8}; }

State extrapolatedStep(const Wide& t, const State& x, const Wide& step) {
  std::vector<std::vector<State>> table;
  for (int row = 0; row < 14; ++row) {
    const int parts = 2 * (row + 1);
    const Wide h = step / parts;
    State before = x, here;
    State rate = pendulumRate(t, x);
    for (std::size_t s = 0; s < 2; ++s) here[s] = x[s] + h * rate[s];
    for (int i = 1; i < parts; ++i) {
      rate = pendulumRate(t + i * h, here);
      for (std::size_t s = 0; s < 2; ++s) {
        const Wide next = before[s] + 2 * h * rate[s];
        before[s] = here[s];
        here[s] = next;
      }
    }
    rate = pendulumRate(t + step, here);
    for (std::size_t s = 0; s < 2; ++s) here[s] = (here[s] + before[s] + h * rate[s]) / 2;
    table.push_back({here});
    for (int column = 1; column <= row; ++column) {  // errors are series in h²
      const Wide ratio = Wide(row + 1) / (row + 1 - column);
      State better;
      for (std::size_t s = 0; s < 2; ++s) {
        const Wide& finer = table[static_cast<std::size_t>(row)][static_cast<std::size_t>(column - 1)][s];
        const Wide& coarser = table[static_cast<std::size_t>(row - 1)][static_cast<std::size_t>(column - 1)][s];
        better[s] = finer + (finer - coarser) / (ratio * ratio - 1);
      }
      table.back().push_back(better);
    }
  }
  return table.back().back();
}

TEST(Arbiter, AgreesWithAnExtrapolationMethodInWiderArithmeticTo28Digits) {
  Motion motion;
  motion.f = record(2, 0, [](auto t, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = 0.125 * cos(t) - sin(x[0]);
  });
  motion.g = record(2, 0, 2, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = x[0];
    y[1] = x[1];
  });
  motion.times = {1, 2};
  const PreciseTrajectory y = arbitrate(motion, std::array{1.25, 0.5});
  ASSERT_EQ(y.times, 2u);
  State x{Wide(1.25), Wide(0.5)};
  for (int step = 0; step < 32; ++step) {
    x = extrapolatedStep(Wide(step) / 16, x, Wide(1) / 16);
    if (step != 15 && step != 31) continue;
    const std::size_t row = step == 15 ? 0 : 2;
    for (std::size_t s = 0; s < 2; ++s) EXPECT_LT(relativeError(y.values[row + s], x[s]), 1e-28) << step << ' ' << s;
  }
}

TEST(Arbiter, ItsErrorEstimateIsSmallAndBoundsTheActualError) {
  const Motion motion = decay(2, 20).motion;
  const PreciseTrajectory y = arbitrate(motion, std::array{1.0, 1.3});
  for (std::size_t t = 1; t <= 20; ++t) {
    const Wide exact = exp(-Wide(1.3) * Wide(motion.times[t]));
    EXPECT_LT(y.error[t], 1e-28);
    EXPECT_LE(Wide(abs(widened(y.values[t]) - exact)).convert_to<double>(), y.error[t]);
  }
}

TEST(Arbiter, TakesConstantsAtTheMidpointOfTheirEnclosureAsTheSamplesDo) {
  Motion motion;
  motion.f =
      record(1, 0, [](auto, const auto&, const auto&, auto& dx) { dx[0] = constant<Recorded>(Interval("0.1")); });
  motion.g = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  motion.times = {1};
  const PreciseTrajectory y = arbitrate(motion, std::array{0.0});
  EXPECT_EQ(y.values[0], Precise(midpoint(Interval("0.1"))));
}

TEST(Arbiter, StopsBeforeASingularityAndSaysSo) {
  Motion motion = decay(2, 20).motion;
  motion.f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * sqr(x[0]); });
  const PreciseTrajectory y = arbitrate(motion, std::array{1.0, 1.0});  // 1 / (1 - t)
  EXPECT_THAT(y.why, HasSubstr("singular"));
  EXPECT_EQ(y.times, 10u);  // up to t = 0.9
  EXPECT_NEAR(y.reached, 1, 1e-3);
  EXPECT_EQ(y.values.size(), 10u);
  EXPECT_EQ(y.error.size(), 10u);
}

/// v' = -tanh(1000 v): sinh(1000 v) = sinh(1000 v_0) e^{-1000 t}. Far out all derivatives but the first vanish.
TEST(Arbiter, AndSeriesInDoublesDoNotStepOverWhatTheirSeriesDoNotKnow) {
  Motion motion;
  motion.f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -tanh(1000.0 * x[0]); });
  motion.g = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  motion.times = {0, 0.1, 0.35, 0.395, 0.4, 0.405, 0.41};
  for (double start : {0.4, 0.05}) {
    const PreciseTrajectory y = arbitrate(motion, std::array{start});
    const std::vector<double> doubles = integrateByTaylor(motion, std::array{start});
    ASSERT_EQ(y.times, motion.times.size()) << y.why;
    for (std::size_t t = 1; t < motion.times.size(); ++t) {
      const Wide grown = sinh(1000 * Wide(start)) * exp(-1000 * Wide(motion.times[t]));
      const Wide exact = log(grown + sqrt(grown * grown + 1)) / 1000;
      EXPECT_LT(abs(widened(y.values[t]) - exact), Wide(1e-28)) << start << " at " << motion.times[t];
      EXPECT_LT(abs(Wide(doubles[t]) - exact), Wide(1e-11)) << start << " at " << motion.times[t];
    }
  }
}

/// x' = 1 - tanh²(k (t - 1.03)), a pulse of which a series at its beginning says nothing: x(2) - x(0) = 2/k.
TEST(Arbiter, AndSeriesInDoublesDoNotStepOverAPulse) {
  for (double steepness : {40.0, 400.0}) {
    Motion motion;
    motion.f = record(
        1, 0, [&](auto t, const auto&, const auto&, auto& dx) { dx[0] = 1.0 - sqr(tanh(steepness * (t - 1.03))); });
    motion.g = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
    motion.times = {0, 2};
    const Wide k(steepness), centre(1.03), exact = 1 + (tanh(k * (2 - centre)) + tanh(k * centre)) / k;
    const PreciseTrajectory y = arbitrate(motion, std::array{1.0});
    EXPECT_LT(relativeError(y.values[1], exact), 1e-28) << steepness;
    EXPECT_NEAR(integrateByTaylor(motion, std::array{1.0})[1], exact.convert_to<double>(), 1e-12) << steepness;
  }
}

/// ẍ = -100 x - sign ẋ from rest at 0.3: turns at k π/10, each time nearer to 0 by 0.02.
TEST(Arbiter, AndSeriesInDoublesLocateJumps) {
  Motion motion;
  motion.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -100.0 * x[0] - sign(x[1]);
  });
  motion.g = record(2, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  for (int i = 1; i <= 16; ++i) motion.times.push_back(i * 0.125);
  const std::array start{0.3, 0.0};
  const PreciseTrajectory y = arbitrate(motion, start);
  const std::vector<double> inDoubles = integrateByTaylor(motion, start);
  ASSERT_EQ(y.times, 16u) << y.why;
  const Wide pi = acos(Wide(-1));
  for (std::size_t i = 0; i < 16; ++i) {
    const Wide t(motion.times[i]);
    const int half = static_cast<int>((t * 10 / pi).convert_to<double>());  // half swings that are over
    const Wide side = half % 2 == 0 ? 1 : -1, centre = side / 100;
    const Wide amplitude = Wide(0.3) - Wide(2 * half + 1) / 100;
    const Wide exact = centre + amplitude * cos(t * 10);
    EXPECT_LT(abs(widened(y.values[i]) - exact), Wide(1e-30)) << t;
    EXPECT_LT(y.error[i], 1e-30);
    EXPECT_NEAR(inDoubles[i], exact.convert_to<double>(), 1e-13);
  }
}

/// ẋ = |sin t|, a switch that only time passes, at 0 as well.
TEST(Arbiter, LocatesKinksInTime) {
  Motion motion;
  motion.f = record(1, 0, [](auto t, const auto&, const auto&, auto& dx) { dx[0] = abs(sin(t)); });
  motion.g = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  motion.times = {1, 4, 7, 10};
  const std::array start{0.5};
  const PreciseTrajectory y = arbitrate(motion, start);
  ASSERT_EQ(y.times, 4u) << y.why;
  for (std::size_t i = 0; i < 4; ++i) {
    const Wide t(motion.times[i]);
    const Wide exact = Wide(0.5) + 2 * static_cast<int>(i) + 1 - cos(t) * (i % 2 == 0 ? 1 : -1);
    EXPECT_LT(abs(widened(y.values[i]) - exact), Wide(1e-30)) << t;
  }
}

/// ẋ = 1 - |x|/2 starts where its kink is: what is seen at the start is the start, not what comes a tick behind it.
TEST(Arbiter, SeesTheStartWhereAKinkIs) {
  Motion motion;
  motion.f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = 1.0 - abs(x[0]) / 2.0; });
  motion.g = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  motion.times = {0, 0.5};
  const PreciseTrajectory y = arbitrate(motion, std::array{0.0});
  ASSERT_EQ(y.times, 2u) << y.why;
  EXPECT_EQ(y.values[0], 0);
  EXPECT_LT(relativeError(y.values[1], 2 - 2 * exp(Wide(-0.25))), 1e-28);
}

/// ẍ = 1 - cos t from rest at zero: the series at the start begins with t⁴/24.
TEST(Arbiter, AndSeriesInDoublesBeginAtRestWithAForceThatBeginsAtZero) {
  Motion motion;
  motion.f = record(2, 0, [](auto t, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = 1.0 - cos(t);
  });
  motion.g = record(2, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  motion.times = {1, 4, 10};
  const std::array start{0.0, 0.0};
  const PreciseTrajectory y = arbitrate(motion, start);
  const std::vector<double> inDoubles = integrateByTaylor(motion, start);
  ASSERT_EQ(y.times, 3u) << y.why;
  for (std::size_t i = 0; i < 3; ++i) {
    const Wide t(motion.times[i]), exact = t * t / 2 + cos(t) - 1;
    EXPECT_LT(relativeError(y.values[i], exact), 1e-28) << t;
    EXPECT_NEAR(inDoubles[i], exact.convert_to<double>(), 1e-13 * inDoubles[i]) << t;
  }
}

TEST(Arbiter, EvaluatesAMotionWithoutStatesDirectly) {
  const PreciseTrajectory y = arbitrate(line().motion, std::array{0.1});
  ASSERT_EQ(y.times, 2u);
  EXPECT_EQ(y.values[1], 2 * Precise(0.1) + 2);
}

TEST(SeriesInDoubles, KeepTheirRelativeErrorWhereAMotionDecays) {
  const Motion motion = decay(100, 20).motion;
  const std::vector<double> y = integrateByTaylor(motion, std::array{1.0, 1.3});
  ASSERT_EQ(y.size(), 21u);
  for (std::size_t t = 0; t <= 20; ++t)
    EXPECT_LT(relativeError(Precise(y[t]), exp(-Wide(1.3) * Wide(motion.times[t]))), 1e-12) << motion.times[t];
}

TEST(SeriesInDoubles, AgreeWithTheArbiterToRounding) {
  const Motion motion = oscillator(3, 30).motion;
  const std::array start{1.1, 0.0, 2.3};
  const std::vector<double> y = integrateByTaylor(motion, start);
  const PreciseTrajectory exact = arbitrate(motion, start);
  ASSERT_EQ(y.size(), exact.values.size());
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], exact.values[i].convert_to<double>(), 1e-14) << i;
}

TEST(SeriesInDoubles, HaveNoValuesBeyondASingularity) {
  Motion motion = decay(2, 20).motion;
  motion.f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * sqr(x[0]); });
  const std::vector<double> y = integrateByTaylor(motion, std::array{1.0, 1.0});  // 1 / (1 - t)
  ASSERT_EQ(y.size(), 21u);
  EXPECT_NEAR(y[9], 10, 1e-11);
  EXPECT_TRUE(std::isnan(y[10]) && std::isnan(y[20]));
}

TEST(Arbiter, RefusesStartValuesOrOptionsThatMakeNoSense) {
  EXPECT_THROW(arbitrate(decay().motion, std::array{1.0}), std::invalid_argument);
  EXPECT_THROW(arbitrate(decay().motion, std::array{1.0, 1.0}, {4, 1e-30}), std::invalid_argument);
  EXPECT_THROW(arbitrate(decay().motion, std::array{1.0, 1.0}, {30, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace gamut
