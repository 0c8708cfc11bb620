// Thinned guaranteed bands still hold the full ones, also along the straight lines that a plot draws between points.
#include <gmock/gmock.h>

#include <cmath>
#include <cstddef>
#include <limits>

#include "reports/curves.hpp"
#include "tests/reports/example_results.hpp"

namespace gamut {
namespace {

/// The line drawn through (time, line) at t.
double drawn(const std::vector<double>& time, const std::vector<double>& line, double t) {
  std::size_t j = 1;
  while (j + 1 < time.size() && time[j] < t) ++j;
  const double share = (t - time[j - 1]) / (time[j] - time[j - 1]);
  return std::lerp(line[j - 1], line[j], share);
}

void expectHolds(const Curves& thin, const Band& outer, const Curves& full, const Band& inner) {
  for (std::size_t i = 0; i < full.time.size(); ++i) {
    EXPECT_LE(drawn(thin.time, outer.lower, full.time[i]), inner.lower[i]) << full.time[i];
    EXPECT_GE(drawn(thin.time, outer.upper, full.time[i]), inner.upper[i]) << full.time[i];
  }
}

TEST(ThinnedCurves, KeepGuaranteedAndPossibleBandsOutside) {
  for (const std::size_t points : {2u, 3u, 17u, 100u, 299u}) {
    const Curves full = curvesOf(example::pendulum(301, 1, 3), 0);
    const Curves thin = thinned(full, points);
    ASSERT_LE(thin.time.size(), points);
    ASSERT_EQ(thin.time.front(), full.time.front());
    ASSERT_EQ(thin.time.back(), full.time.back());
    expectHolds(thin, thin.guaranteed, full, full.guaranteed);
    expectHolds(thin, thin.tube, full, full.tube);
    for (std::size_t level = 0; level < 3; ++level) expectHolds(thin, thin.possible[level], full, full.possible[level]);
  }
}

TEST(ThinnedCurves, AreUnchangedWhereFewEnough) {
  const Curves full = curvesOf(example::pendulum(61, 1), 0);
  EXPECT_EQ(thinned(full, 61).time, full.time);
  EXPECT_EQ(thinned(full, 61).guaranteed.lower, full.guaranteed.lower);
}

TEST(Tube, CoversBothIntervalsThatMeetAtATime) {
  const Results results = example::pendulum(61, 1);
  const Curves curves = curvesOf(results, 0);
  for (std::size_t i = 0; i + 1 < 61; ++i) {
    for (const std::size_t row : {i, i + 1}) {
      EXPECT_LE(curves.tube.lower[i], results.interval.over.lower(row, 0));
      EXPECT_GE(curves.tube.upper[i], results.interval.over.upper(row, 0));
    }
  }
}

TEST(CurvesAroundTheirReference, KeepTheirWidths) {
  const Curves curves = curvesOf(example::pendulum(), 0), around = aroundReference(curves);
  EXPECT_TRUE(around.tube.empty());
  for (std::size_t i = 0; i < curves.time.size(); ++i) {
    EXPECT_EQ(around.median[i], 0);
    EXPECT_NEAR(around.guaranteed.upper[i] - around.guaranteed.lower[i],
                curves.guaranteed.upper[i] - curves.guaranteed.lower[i], 1e-12);
  }
}

}  // namespace
}  // namespace gamut
