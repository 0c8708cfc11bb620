// Shipped studies of clearances and tolerances: what they guarantee against the worst case that can be found.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "scalars/evaluation/evaluator.hpp"
#include "studies/machine.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

Study shippedStudy(const std::string& file) { return readStudy(GAMUT_SOURCE_DIR "/studies/examples/" + file); }

/// Values of the machine's numbers inside its box where sign times the output is as great as one quantity after another
/// makes it, again and again: at an end of its interval, or, where that goes all round, in any direction.
std::vector<double> worstOf(const Machine& machine, std::size_t output, double sign) {
  const Program& g = machine.motion.motion.g;
  Evaluator<double> evaluator(g);
  std::vector<double> at = machine.motion.nominal;
  const auto value = [&] {
    evaluator.setParameters(std::span(at).subspan(static_cast<std::size_t>(g.states())));
    return sign * evaluator(0.0, std::vector<double>(at.begin(), at.begin() + g.states()))[output];
  };
  for (const int slot : machine.motion.slot) {  // away from where others have no influence
    const Interval& range = machine.box[static_cast<std::size_t>(slot)];
    at[static_cast<std::size_t>(slot)] = midpoint(range);
  }
  const auto goesRound = [&](int slot) { return width(machine.box[static_cast<std::size_t>(slot)]) > 6; };
  std::vector<int> slots = machine.motion.slot;
  std::ranges::stable_partition(slots, goesRound);  // directions first: an eccentricity of zero has none
  double best = value();
  for (int round = 0; round < 20; ++round)
    for (const int slot : slots) {
      const Interval& range = machine.box[static_cast<std::size_t>(slot)];
      double& own = at[static_cast<std::size_t>(slot)];
      const int steps = goesRound(slot) ? 360 : 1;
      double kept = own;
      for (int i = 0; i <= steps; ++i) {
        own = std::clamp(range.lower() + i * width(range) / steps, range.lower(), range.upper());
        if (const double found = value(); found > best) best = found, kept = own;
      }
      own = kept;
    }
  return at;
}

class ClearanceStudies : public ::testing::TestWithParam<std::string> {};

/// No wider than 1.05 times the worst case, which they hold, at every level of membership too.
TEST_P(ClearanceStudies, HoldTheWorstCaseAndHardlyMore) {
  Study study = shippedStudy(GetParam() + "/study.toml");
  RunOptions options;
  options.jobs = 2;
  options.samples = 64;
  const Machine machine(study);
  const Results results = run(machine, options);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_GE(study.uncertain.size(), 20U);
  Evaluator<Interval> evaluator(machine.motion.motion.g);
  const auto at = [&](std::size_t output, double sign) {
    const std::vector<double> worst = worstOf(machine, output, sign);
    const std::vector<Interval> numbers(worst.begin(), worst.end());
    evaluator.setParameters(numbers);
    return evaluator(Interval(0.0), std::vector<Interval>{})[output];
  };
  for (std::size_t o = 0; o < study.outputs.size(); ++o) {
    SCOPED_TRACE(study.outputs[o].name);
    const Interval least = at(o, -1), greatest = at(o, 1);
    const double lower = results.interval.at.lower(0, o), upper = results.interval.at.upper(0, o);
    EXPECT_LE(lower, least.upper());
    EXPECT_GE(upper, greatest.lower());
    EXPECT_LE(upper - lower, 1.05 * (greatest.lower() - least.upper()));
  }
}

/// Each contributor's share of the worst case, as it were without it, and of the variance: neither is missing.
TEST_P(ClearanceStudies, TellEachContributorsShare) {
  Study study = shippedStudy(GetParam() + "/study.toml");
  RunOptions options;
  options.jobs = 2;
  options.samples = 64;
  const Results results = run(study, options);
  ASSERT_TRUE(results.sensitivity.present);
  for (std::size_t o = 0; o < 2; ++o) {
    double pinched = 0, total = 0;
    for (std::size_t q = 0; q < study.uncertain.size(); ++q) {
      EXPECT_GE(results.sensitivity.pinched(0, o, q), 0) << study.uncertain[q].quantity;
      pinched += results.sensitivity.pinched(0, o, q);
      total += results.sensitivity.totalSampled(0, o, q);
    }
    // Shares of a sum are 1 together; what a play's two or three numbers do counts with each of them.
    EXPECT_GT(pinched, 0.9);
    EXPECT_LT(pinched, 2);
    EXPECT_GT(total, 0.95);
    EXPECT_LT(total, 1.2);
  }
}

/// Along a sweep: all five plays together are a disc of 4.2 mm, at each position and between them.
TEST(SweepOfFiveArms, IsADiscOfPlayAllAlong) {
  Study study = shippedStudy("five_arm_with_play/sweep.toml");
  std::erase_if(study.uncertain,
                [](const UncertainQuantity& q) { return q.quantity.find("_pin.") == std::string::npos; });
  ASSERT_EQ(study.uncertain.size(), 10U);
  RunOptions options;
  options.samples = 64;
  const Results results = run(study, options);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_EQ(results.interval.reached, 1.0);
  constexpr double disc = 4.2, rounded = 1e-9;  // mm; the formula of the error has decimals
  for (std::size_t i = 0; i < results.time.size(); ++i)
    for (std::size_t o = 0; o < 2; ++o) {
      const Bounds &at = results.interval.at, &over = results.interval.over;
      EXPECT_LE(at.lower(i, o), -disc + rounded);
      EXPECT_GE(at.upper(i, o), disc - rounded);
      EXPECT_LE(at.upper(i, o) - at.lower(i, o), 1.01 * 2 * disc);
      EXPECT_LE(over.lower(i, o), at.lower(i, o));
      EXPECT_GE(over.upper(i, o), at.upper(i, o));
      EXPECT_LE(over.upper(i, o) - over.lower(i, o), 1.2 * 2 * disc);
    }
}

TEST(SweepOfFiveArms, IsTightInAllViews) {
  Study study = shippedStudy("five_arm_with_play/sweep.toml");
  EXPECT_THAT(study.notes, ::testing::IsEmpty());
  RunOptions options;
  options.samples = 64;
  const Results results = run(study, options);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LE(results.comparison.maximum, 1.05);
  for (const double gap : results.fuzzy.transformation.gap.data) EXPECT_LE(gap, 0.05);
  for (std::size_t level = 1; level < results.fuzzy.alpha.size(); ++level)
    for (std::size_t i = 0; i < results.time.size(); ++i)
      for (std::size_t o = 0; o < 2; ++o) {
        EXPECT_GE(results.fuzzy.outer[level].lower(i, o), results.fuzzy.outer[level - 1].lower(i, o));
        EXPECT_LE(results.fuzzy.outer[level].upper(i, o), results.fuzzy.outer[level - 1].upper(i, o));
      }
}

INSTANTIATE_TEST_SUITE_P(Study, ClearanceStudies, ::testing::Values("tolerance_stack", "five_arm_with_play"),
                         [](const auto& study) { return study.param; });

}  // namespace
}  // namespace gamut
