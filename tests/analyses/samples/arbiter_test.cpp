// The arbiter against closed forms and against an independent method (extrapolation) in wider arithmetic.
#include "analyses/samples/arbiter.hpp"

#include <gmock/gmock.h>

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "analyses/samples/bounded_number.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "tests/analyses/motions.hpp"

namespace gamut {

template <>
struct ScalarTraits<boost::multiprecision::cpp_bin_float_50> {
  static boost::multiprecision::cpp_bin_float_50 constant(const Interval& enclosure) { return midpoint(enclosure); }
};

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

/// What outputs are made of, cancelling or not, with everything that programs can do but jumps.
Program roundedOutputs() {
  return record(0, 3, 12, [](auto, const auto&, const auto& p, auto& y) {
    const auto large = 1e6 * sqr(p[0]) * cos(p[1]), sum = large + p[1];
    y[0] = sum - large - p[1];
    y[1] = min(large, p[1]) - p[1];
    y[2] = max(sin(p[0]), p[2]) - abs(p[2]);
    y[3] = sqrt(sqr(sum) - sqr(large)) * exp(p[2]);
    y[4] = log(sum) - log(large);
    y[5] = 1.0 / (sum - large) - 1.0 / p[1];
    y[6] = atan(sum) - atan(large);
    y[7] = tanh(p[0] * p[2]) - sin(p[0] * p[2]) / cos(p[0] * p[2]);
    y[8] = exp(large * 1e-6) * exp(-p[0]) - 1.0;
    y[9] = sqrt(sqr(p[0]) + sqr(p[1])) - p[0];
    y[10] = abs(sum - large - p[1]);
    y[11] = 3.0 * p[2] - p[2] - p[2] - p[2];
  });
}

template <class Real>
Wide wideOf(const BoundedNumber<Real>& of, bool isOff) {
  return widened(Precise(isOff ? of.off : of.value));
}

/// Against 168 bits, whose own roundings are nothing beside those of 128.
template <class Real>
void expectRoundingsHeld(double a, double b, double c, const char* kind) {
  const Program program = roundedOutputs();
  Evaluator<BoundedNumber<Real>> bounded(program);
  bounded.setParameters(std::vector<BoundedNumber<Real>>{a, b, c});
  const std::vector<BoundedNumber<Real>> found = bounded(0.0, {});
  Evaluator<Wide> wide(program);
  wide.setParameters(std::vector<Wide>{Wide(a), Wide(b), Wide(c)});
  const std::vector<Wide> truth = wide(Wide(0), {});
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Wide off = wideOf(found[i], true), away = abs(wideOf(found[i], false) - truth[i]);
    EXPECT_TRUE(found[i].isKnown()) << kind << ' ' << i;
    EXPECT_LE(away, off) << kind << ' ' << i;
    const double unit = std::numeric_limits<Real>::epsilon().template convert_to<double>();
    EXPECT_LE(off, Wide(1e13 * unit)) << kind << ' ' << i << " of " << truth[i];
  }
}

TEST(BoundedNumber, HoldsWhatRoundingsDo) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<> any(0.1, 1.4);
  for (int i = 0; i < 300; ++i) {
    const double a = any(engine), b = any(engine), c = any(engine);
    expectRoundingsHeld<Precise>(a, b, c, "128 bits");
  }
}

TEST(BoundedNumber, KnowsSignsAndQuotientsWhereTheyAreKnown) {
  using Number = BoundedNumber<double>;
  const Number open(0.25, 0.5), above(0.75, 0.5), zero(0.0), nothing(0.0, 1e-20);
  EXPECT_EQ(sign(above).off, 0);
  EXPECT_EQ(sign(zero).off, 0);
  EXPECT_EQ(sign(open).off, 2);
  EXPECT_EQ(sign(nothing).off, 1);
  EXPECT_FALSE((1.0 / open).isKnown());
  EXPECT_GE((1.0 / above).off, 1 / 0.25 - 1 / 0.75);
  EXPECT_LE((1.0 / above).off, 1.001 * (1 / 0.25 - 1 / 0.75));
  EXPECT_FALSE(log(open).isKnown());
  EXPECT_GE(sqrt(above).off, std::sqrt(0.75) - std::sqrt(0.25));
  EXPECT_GE(sqrt(open).off, std::sqrt(0.25));
  EXPECT_EQ((zero * (1.0 / open)).off, 0);
}

/// Of doubles whose products are none.
TEST(BoundedNumber, HoldsQuotientsOfSmallNumbers) {
  for (const double size : {1e-300, 1e-170, 1e-160, 1e-20, 1e150})
    for (const double by : {1e-308, 1e-300, 1e-161, 1e-20, 1e150})
      for (const double part : {1e-14, 0.1, 0.9}) {
        const double off = by * part;
        const BoundedNumber<double> found = BoundedNumber<double>(size) / BoundedNumber<double>(by, off);
        const Wide truth = Wide(size) / (Wide(by) - Wide(off));
        EXPECT_TRUE(!found.isKnown() || abs(truth - Wide(found.value)) <= Wide(found.off))
            << size << ' ' << by << ' ' << part;
        if (size / by > 1e-290 && size / by < 1e290) {
          EXPECT_LE(found.off, 1.001 * (abs(truth - Wide(found.value)) + 1e-15 * abs(truth)));
        }
      }
}

/// Both integrations round alike where nothing is integrated: what they differ by is no error.
TEST(Arbiter, TellsWhatOutputsAreRoundedBy) {
  Motion motion;
  motion.f = record(1, 1, [](auto, const auto&, const auto&, auto& dx) { dx[0] = 0.0; });
  motion.g = record(1, 1, 2, [](auto, const auto&, const auto& p, auto& y) {
    y[0] = min(p[0] * cos(p[0]), Recorded(0.25)) - 0.25;
    y[1] = p[0];
  });
  motion.times = {0, 1};
  int rounded = 0;
  for (double p = 0.9; p < 1.2; p += 0.01) {  // x cos x is above ¼ and below 1
    const std::array start{0.0, p};
    const PreciseTrajectory y = arbitrate(motion, start);
    ASSERT_EQ(y.rounding.size(), 4u);
    for (const std::size_t i : {0U, 2U}) {
      rounded += y.values[i] != 0 ? 1 : 0;
      EXPECT_LE(abs(y.values[i]), Precise(y.rounding[i]));
      EXPECT_LE(y.rounding[i], y.error[i]);
      EXPECT_LE(y.rounding[i], 1e-37);
      EXPECT_EQ(y.rounding[i + 1], 0);
    }
    std::vector<double> rounding;
    const std::vector<double> doubles = integrateByTaylor(motion, start, nullptr, &rounding);
    for (const std::size_t i : {0U, 2U}) EXPECT_LE(std::abs(doubles[i]), rounding[i]);
  }
  EXPECT_GT(rounded, 0);
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
