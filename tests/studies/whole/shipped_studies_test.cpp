// The studies that are shipped, run as they are (with fewer samples), against published figures.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mechanics/assembly.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

Results runShipped(const std::string& name, std::size_t samples) {
  RunOptions options;
  options.jobs = 2;
  options.samples = samples;
  return run(readStudy(GAMUT_SOURCE_DIR "/studies/examples/" + name + "/study.toml"), options);
}

std::size_t rowOf(const Results& results, double time) {
  return static_cast<std::size_t>(std::find(results.time.begin(), results.time.end(), time) - results.time.begin());
}

/// To the last printed digit, cut off as the sources do.
double printed(double value) { return std::trunc(value * 1e4) / 1e4; }

/// The published row of plain intervals: the point's local coordinates turned back by the frame's rotation.
Vector3<Interval> publishedNaiveTip() {
  const Study study = readStudy(GAMUT_SOURCE_DIR "/studies/examples/tip_position/study.toml");
  Assembly<Interval> assembly(study.mechanism);
  std::vector<Interval> state = assembly.initialState();
  state[0] = study.uncertain[0].uncertain.range;
  assembly.setState(state);
  const Frame<Interval>& tip = assembly.frame("tip");
  return tip.R * tip.r;
}

TEST(TipPosition, ReproducesBothPublishedRows) {  // LNCS 5045, section 4.2
  const Vector3<Interval> naive = publishedNaiveTip();
  EXPECT_EQ(printed(naive[1].lower()), 1.1993);
  EXPECT_EQ(printed(naive[1].upper()), 1.3853);
  EXPECT_EQ(printed(naive[2].lower()), -0.1947);
  EXPECT_EQ(printed(naive[2].upper()), -0.0086);
  const Results results = runShipped("tip_position", 200);
  const Bounds& polynomials = results.interval.at;
  EXPECT_EQ(printed(polynomials.lower(0, 0)), 1.2859);
  EXPECT_EQ(printed(polynomials.upper(0, 0)), 1.2987);
  EXPECT_EQ(printed(polynomials.lower(0, 1)), -0.1830);
  EXPECT_EQ(printed(polynomials.upper(0, 1)), -0.0204);
  const Bounds& direct = results.interval.direct;  // the point carried from frame to frame: between the two
  for (int j = 0; j < 2; ++j) {
    const auto output = static_cast<std::size_t>(j);
    const Interval found(direct.lower(0, output), direct.upper(0, output));
    EXPECT_TRUE(isSubset(found, naive[j + 1]));
    EXPECT_TRUE(isSubset(Interval(polynomials.lower(0, output), polynomials.upper(0, output)), found));
  }
}

TEST(TipPosition, HoldsTheExactRange) {
  const Results results = runShipped("tip_position", 200);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(results.stochastic.relativeTolerance, 0) << "nothing is integrated";
  // Both outputs rise with the angle, so that the corners, which are sampled, give the exact range.
  EXPECT_LT(results.comparison.maximum, 1.001);
  for (std::size_t level = 1; level < results.fuzzy.alpha.size(); ++level)
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_GE(results.fuzzy.outer[level].lower(0, j), results.fuzzy.outer[level - 1].lower(0, j));
      EXPECT_LE(results.fuzzy.outer[level].upper(0, j), results.fuzzy.outer[level - 1].upper(0, j));
    }
  const Bounds& core = results.fuzzy.outer.back();
  EXPECT_LT(core.upper(0, 0) - core.lower(0, 0), 1e-14);
}

TEST(DoublePendulum, KeepsEverySampleInsideOverThreeSeconds) {
  const Results results = runShipped("double_pendulum", 200);
  ASSERT_EQ(results.time.size(), 301U);
  EXPECT_EQ(results.time[rowOf(results, 0.57)], 0.57);
  EXPECT_EQ(results.interval.reached, 3.0) << results.interval.why;
  EXPECT_EQ(results.stochastic.reached, 3.0) << results.stochastic.why;
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  ASSERT_EQ(results.requirements.size(), 2U);
  EXPECT_EQ(results.requirements[0].word, Decision::met);
  EXPECT_EQ(results.requirements[1].word, Decision::partly);
  EXPECT_LT(results.requirements[1].probabilityUpper - results.requirements[1].probabilityLower, 0.01);
  for (std::size_t i = 0; i < results.time.size(); ++i)
    for (std::size_t j = 0; j < results.outputs.size(); ++j) {
      const double lower = results.interval.at.lower(i, j), upper = results.interval.at.upper(i, j);
      ASSERT_LE(lower, upper);
      // what holds over an interval holds at both its ends
      EXPECT_LE(results.interval.over.lower(i, j), lower);
      EXPECT_GE(results.interval.over.upper(i, j), upper);
      for (const Bounds& cut : results.fuzzy.outer) {
        EXPECT_GE(cut.lower(i, j), lower);
        EXPECT_LE(cut.upper(i, j), upper);
      }
      for (std::size_t level = 0; level < results.fuzzy.alpha.size(); ++level) {
        const double inner = results.fuzzy.inner[level].lower(i, j);
        if (std::isnan(inner)) continue;
        const double error = results.stochastic.error(i, j);
        EXPECT_GE(inner, results.fuzzy.outer[level].lower(i, j) - error);
        EXPECT_LE(results.fuzzy.inner[level].upper(i, j), results.fuzzy.outer[level].upper(i, j) + error);
      }
    }
}

/// Least and greatest sway and travel (mm) of the mast at 5 s, of all courses of the wind from 0 N to 600 N. Its
/// equations are linear: either is reached by the wind that is at one end wherever a unit impulse's answer, read
/// backwards, is above zero, and at the other elsewhere (Runge-Kutta, the areas by trapezoids).
std::array<double, 4> worstCourses(double mastStiffness, double damperStiffness) {
  using State = std::array<double, 4>;  // sway, travel and their rates
  constexpr double head = 800, weight = 40, mastDamping = 120, damperDamping = 50, gust = 600, step = 1e-3;
  const auto rates = [&](const State& x) {
    const double suspension = damperStiffness * x[1] + damperDamping * x[3];
    const double top = (suspension - mastStiffness * x[0] - mastDamping * x[2]) / head;
    return State{x[2], x[3], top, -suspension / weight - top};
  };
  const auto ahead = [](State x, const State& rate, double h) {
    for (std::size_t i = 0; i < 4; ++i) x[i] += h * rate[i];
    return x;
  };
  State x{0, 0, 1 / head, -1 / head};
  std::array<double, 4> worst{};
  for (int i = 0; i < 5000; ++i) {
    const State a = rates(x), b = rates(ahead(x, a, step / 2)), c = rates(ahead(x, b, step / 2)),
                d = rates(ahead(x, c, step));
    const State last = x;
    for (std::size_t j = 0; j < 4; ++j) x[j] += step / 6 * (a[j] + 2 * b[j] + 2 * c[j] + d[j]);
    for (std::size_t j = 0; j < 2; ++j) {
      const double moved = 1e3 * gust * step * (last[j] + x[j]) / 2;
      worst[2 * j + (moved > 0 ? 1 : 0)] += moved;
    }
  }
  return worst;
}

TEST(MastInWind, HoldsTheWorstCoursesAndHardlyMore) {
  std::array<double, 4> worst{};
  for (int i = 0; i <= 4; ++i)
    for (int k = 0; k <= 4; ++k) {
      const std::array<double, 4> there = worstCourses(19400 + 300 * i, 855 + 22.5 * k);
      for (std::size_t j = 0; j < 4; j += 2) {
        worst[j] = std::fmin(worst[j], there[j]);
        worst[j + 1] = std::fmax(worst[j + 1], there[j + 1]);
      }
    }
  Study study = readStudy(GAMUT_SOURCE_DIR "/studies/examples/mast_in_wind/study.toml");
  study.requirements.clear();
  RunOptions options;
  options.jobs = 2;
  options.samples = 64;
  const Results results = run(study, options);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  ASSERT_EQ(results.interval.reached, 5.0) << results.interval.why;
  const std::size_t row = rowOf(results, 5.0);
  for (std::size_t j = 0; j < 2; ++j) {
    SCOPED_TRACE(results.outputs[j].name);
    const double lower = results.interval.at.lower(row, j), upper = results.interval.at.upper(row, j);
    EXPECT_LE(lower, worst[2 * j]);
    EXPECT_GE(upper, worst[2 * j + 1]);
    EXPECT_LE(upper - lower, 1.05 * (worst[2 * j + 1] - worst[2 * j]));
  }
}

}  // namespace
}  // namespace gamut
