// When an output comes to its least and greatest: at the output time that comes nearer to what is known between two.
#include "studies/results/extremes.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

namespace gamut {
namespace {

/// One output at 0 s, 1 s and so on, known at these times and, with the one before, over what lies between.
Results guaranteed(const std::vector<double>& lower, const std::vector<double>& upper, double beyond) {
  Results results;
  const std::size_t times = lower.size();
  results.horizon = static_cast<double>(times - 1);
  results.outputs.push_back({"height", "bob.position.z", "m"});
  results.interval.present = true;
  results.interval.at = results.interval.over = Bounds(times, 1);
  for (std::size_t i = 0; i < times; ++i) {
    results.time.push_back(static_cast<double>(i));
    results.interval.at.lower(i, 0) = lower[i];
    results.interval.at.upper(i, 0) = upper[i];
    results.interval.over.lower(i, 0) = i > 0 ? std::min(lower[i - 1], lower[i]) - beyond : lower[i];
    results.interval.over.upper(i, 0) = i > 0 ? std::max(upper[i - 1], upper[i]) + beyond : upper[i];
  }
  return results;
}

struct When {
  std::string least, greatest;
  bool operator==(const When&) const = default;
};

When whenOf(const Results& results) {
  const MotionRange range = motionRange(results, 0, MotionRange::Source::ofProof).value();
  return {whenText(results, range.least), whenText(results, range.greatest)};
}

/// What is let go at rest hardly moves at first: its greatest height is where it starts.
TEST(Extremes, OfWhatIsLetGoAtRestAreAtItsStart) {
  const std::vector<double> falls{9.9, 9.8999, 9.0, 7.0};
  std::vector<double> above = falls;
  for (double& bound : above) bound += 0.01;
  EXPECT_EQ(whenOf(guaranteed(falls, above, 1e-6)), (When{"at 3 s", "at 0 s"}));
  const std::vector<double> rises{7.0, 9.0, 9.8999, 9.9};
  above = rises;
  for (double& bound : above) bound += 0.01;
  EXPECT_EQ(whenOf(guaranteed(rises, above, 1e-6)), (When{"at 0 s", "at 3 s"}));
}

TEST(Extremes, ThatNoOutputTimeComesNearAreBetweenTwo) {
  EXPECT_EQ(whenOf(guaranteed({0, 1, 0.9, 0}, {0, 1, 0.9, 0}, 0.1)).greatest, "between 0 s and 1 s");
}

/// A start that is exactly known is not where a bound comes from that lies beyond it in the digits that are told.
TEST(Extremes, BeyondWhatIsToldOfAnOutputTimeAreBetweenTwo) {
  EXPECT_EQ(whenOf(guaranteed({12.7, -5, -42, -30}, {12.7, -4, -35, -20}, 0.043)).greatest, "between 0 s and 1 s");
  EXPECT_EQ(whenOf(guaranteed({12.7, -5, -42, -30}, {12.7, -4, -35, -20}, 0.0004)).greatest, "at 0 s");
}

/// Roundings choose the instant of what is zero.
TEST(Extremes, OfWhatIsZeroButForRoundingHaveNoTime) {
  const Results results = guaranteed({0.5, 0.4, -1e-12, 0.3}, {1, 0.9, 0.5, 0.8}, 0);
  const MotionRange range = motionRange(results, 0, MotionRange::Source::ofProof).value();
  EXPECT_EQ(whenText(results, range.least), "at 2 s");
  EXPECT_EQ(range.size(), 1);
  const Results rises = guaranteed({1e-13, 0.5, 0.8, 1}, {0.1, 0.6, 0.9, 1.1}, 0);
  EXPECT_EQ(whenLeast(rises, motionRange(rises, 0, MotionRange::Source::ofProof).value()), "at 0 s");
  EXPECT_EQ(whenLeast(results, range), "");
  EXPECT_EQ(whenGreatest(results, range), "at 0 s");
}

TEST(Extremes, OfWhatIsConservedAreThroughout) {
  EXPECT_EQ(whenOf(guaranteed({1, 1, 1, 1}, {2, 2, 2, 2}, 0)), (When{"throughout", "throughout"}));
}

}  // namespace
}  // namespace gamut
