// Closest approaches: the least distance of a motion, when it comes and where, against closed forms.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "reports/approaches.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"

namespace gamut::approach_test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// ---- From bounds alone ----------------------------------------------------------------------------------------------

struct Column {
  std::string quantity;
  std::vector<double> at;  // at output times: ± 0.01
  double beyond;           // between these
};

/// Output times 0 s, 1 s, …
Results resultsOf(const std::vector<Column>& columns) {
  Results results;
  const std::size_t times = columns.front().at.size();
  results.horizon = static_cast<double>(times - 1);
  for (std::size_t i = 0; i < times; ++i) results.time.push_back(static_cast<double>(i));
  results.interval.present = true;
  results.interval.at = results.interval.over = Bounds(times, columns.size());
  for (std::size_t j = 0; j < columns.size(); ++j) {
    results.outputs.push_back({columns[j].quantity, columns[j].quantity, "m"});
    for (std::size_t i = 0; i < times; ++i) {
      const double here = columns[j].at[i], before = columns[j].at[i > 0 ? i - 1 : 0];
      const double beyond = i > 0 ? columns[j].beyond : 0;
      results.interval.at.lower(i, j) = here - 0.01;
      results.interval.at.upper(i, j) = here + 0.01;
      results.interval.over.lower(i, j) = std::min(here, before) - 0.01 - beyond;
      results.interval.over.upper(i, j) = std::max(here, before) + 0.01 + beyond;
    }
  }
  return results;
}

std::vector<std::pair<double, double>> timesOf(const Results& results) {
  std::vector<std::pair<double, double>> times;
  const std::vector<Approach> all = approachesOf(results);
  for (const Approach::Range& span : all.at(0).when) times.emplace_back(span.lower, span.upper);
  return times;
}

TEST(Approach, IsWhereBoundsComeAsLow) {
  const Results once = resultsOf({{"gap.distance", {5, 3, 1, 2, 4}, 0}});
  EXPECT_THAT(timesOf(once), ElementsAre(std::pair(1.0, 3.0)));
  EXPECT_NEAR(approachesOf(once)[0].least.lower, 0.99, 1e-12);
  EXPECT_NEAR(approachesOf(once)[0].least.upper, 1.01, 1e-12);
  EXPECT_TRUE(approachesOf(once)[0].isAtAllTimes);
  EXPECT_THAT(timesOf(resultsOf({{"gap.distance", {5, 1, 3, 3, 1.015, 4}, 0}})),
              ElementsAre(std::pair(0.0, 2.0), std::pair(3.0, 5.0)));
  EXPECT_THAT(timesOf(resultsOf({{"gap.distance", {1, 2, 3}, 0}})), ElementsAre(std::pair(0.0, 1.0)));
  EXPECT_THAT(timesOf(resultsOf({{"gap.distance", {5, 4, 3.5, 1}, 0.1}})), ElementsAre(std::pair(2.0, 3.0)));
  EXPECT_TRUE(approachesOf(resultsOf({{"gap.rate", {1, 2, 3}, 0}})).empty());
}

TEST(Approach, IsWhereTheRateMayBeZero) {
  const Column wide{"gap.distance", {1.02, 1.01, 1, 1.01, 1.02}, 0.1};
  EXPECT_THAT(timesOf(resultsOf({wide})), ElementsAre(std::pair(0.0, 4.0)));
  EXPECT_THAT(timesOf(resultsOf({wide, {"gap.rate", {-1, -0.5, -0.25, 0.5, 1}, 0}})), ElementsAre(std::pair(2.0, 3.0)));
  EXPECT_THAT(timesOf(resultsOf({wide, {"other.rate", {-1, -0.5, -0.25, 0.5, 1}, 0}})),
              ElementsAre(std::pair(0.0, 4.0)));
  EXPECT_THAT(timesOf(resultsOf({wide, {"gap.rate", {1, 1, 1, 1, 1}, 0}})), ElementsAre(std::pair(0.0, 0.0)));
  EXPECT_THAT(timesOf(resultsOf({wide, {"gap.rate", {-1, -1, -1, -1, -1}, 0}})), ElementsAre(std::pair(4.0, 4.0)));
  Results jumps = resultsOf({wide, {"gap.rate", {-1, -1, -1, 1, 1}, 0}});  // where it strikes at 2 s
  jumps.interval.over.lower(3, 1) = 0.9;
  EXPECT_THAT(timesOf(jumps), ElementsAre(std::pair(2.0, 2.0)));
  jumps.interval.over.lower(3, 1) = jumps.interval.over.upper(3, 1) = NAN;  // nothing is known of it
  EXPECT_THAT(timesOf(jumps), ElementsAre(std::pair(2.0, 3.0)));
}

TEST(Approach, IsToldUpToWhereTheProofComes) {
  Results results = resultsOf({{"gap.distance", {5, 3, 1, 0.5}, 0}});
  for (Bounds* bounds : {&results.interval.at, &results.interval.over}) bounds->lower(3, 0) = bounds->upper(3, 0) = NAN;
  const Approach approach = approachesOf(results).at(0);
  EXPECT_EQ(approach.until, 2);
  EXPECT_FALSE(approach.isAtAllTimes);
  EXPECT_THAT(approachLines(results, {approach})[0], HasSubstr("(up to 2 s)"));
  for (Bounds* bounds : {&results.interval.at, &results.interval.over})
    for (std::size_t i = 0; i < 3; ++i) bounds->lower(i, 0) = -INFINITY, bounds->upper(i, 0) = INFINITY;
  EXPECT_TRUE(approachesOf(results).empty());
}

TEST(Approach, HasItsPlaceAtTheseTimesAlone) {
  const Results results = resultsOf(
      {{"gap.distance", {5, 3, 1, 2, 4}, 0}, {"gap.from.x", {9, 7, 5, 3, 1}, 0}, {"gap.to.z", {1, 2, 3, 4, 5}, 0.5}});
  const Approach approach = approachesOf(results).at(0);
  ASSERT_TRUE(approach.from[0] && approach.to[2]);
  EXPECT_FALSE(approach.from[1] || approach.to[0]);
  EXPECT_NEAR(approach.from[0]->lower, 2.99, 1e-12);
  EXPECT_NEAR(approach.from[0]->upper, 7.01, 1e-12);
  EXPECT_NEAR(approach.to[2]->lower, 1.49, 1e-12);
  EXPECT_NEAR(approach.to[2]->upper, 4.51, 1e-12);
  EXPECT_EQ(approachLines(results, {approach})[0].find("from"), std::string::npos);  // y is not known
}

TEST(Approach, IsToldInTheUnitsOfItsOutputs) {
  Results results = resultsOf({{"gap.distance", {5, 3, 1, 2, 4}, 0},
                               {"gap.to.x", {9, 7, 5, 3, 1}, 0},
                               {"gap.to.y", {2, 2, 2, 2, 2}, 0},
                               {"gap.to.z", {1, 2, 3, 4, 5}, 0}});
  results.outputs[0].name = "clearance";
  results.outputs[0].unit = "mm";
  results.outputs[2].unit = "cm";
  EXPECT_THAT(approachLines(results, approachesOf(results)),
              ElementsAre(AllOf(StartsWith("clearance is least at ["), HasSubstr("] mm, between 1 s and 3 s to (["),
                                HasSubstr("] m, ["), HasSubstr("] cm, ["), EndsWith("] m)"))));
}

// ---- Runs -----------------------------------------------------------------------------------------------------------

/// What turns at 1 rad/s above the floor, which is at z = 0: its shape, and that of the floor.
Study turning(const std::string& shape, const std::string& floor, const std::string& further) {
  return readStudyText(R"(
    [study]
    title = "Over the floor"
    analysis = "dynamics"
    horizon = 2
    output_step = 0.02
    compare = ["interval", "stochastic"]
    [mechanism.parameters]
    start = "60 deg"
    length = "1 m"
    height = "1.5 m"
    [[mechanism.element]]
    type = "link"
    name = "post"
    from = "inertial"
    to = "top"
    vector = [0.25, 0.5, "height"]
    [[mechanism.element]]
    type = "revolute"
    name = "hinge"
    from = "top"
    to = "arm"
    axis = "y"
    initial = { angle = "-start", rate = 1 }
    [[mechanism.element]]
    type = "mass"
    name = "body"
    at = "arm"
    mass = 1
    inertia = [0.1, 0.1, 0.1]
    [[mechanism.element]]
    name = "moved"
    at = "arm"
    )" + shape + R"([[mechanism.element]]
    name = "floor"
    at = "inertial"
    )" + floor + R"([[mechanism.element]]
    type = "separation"
    name = "gap"
    from = "moved"
    to = "floor"
    [[output]]
    quantity = "gap.distance"
    [[output]]
    quantity = "gap.rate"
    [[output]]
    quantity = "gap.from.x"
    [[output]]
    quantity = "gap.from.y"
    [[output]]
    quantity = "gap.from.z"
    [[output]]
    quantity = "gap.to.x"
    [[output]]
    quantity = "gap.to.y"
    [[output]]
    quantity = "gap.to.z"
    [stochastic]
    samples = 256
    )" + further,
                       "floor.toml");
}

std::string uncertain(const std::string& quantity, int percent) {
  return "[[uncertain]]\nquantity = \"" + quantity + "\"\ninterval = \"± " + std::to_string(percent) + " %\"\n";
}

Results runOf(const Study& study) {
  RunOptions options;
  options.jobs = 2;
  return run(study, options);
}

bool holds(const Approach::Range& range, double lower, double upper) {
  return range.lower <= lower && upper <= range.upper;
}
double widthOf(const Approach::Range& range) { return range.upper - range.lower; }

const std::string rod =
    "type = \"capsule\"\nradius = \"50 mm\"\nlength = \"length\"\ncentre = [0, 0, \"-0.5 length\"]\n";

/// Whether some motion may be nearest then.
bool canBe(const Approach& approach, double time) {
  return std::ranges::any_of(approach.when, [&](const Approach::Range& span) { return holds(span, time, time); });
}

/// The end of a rod over a rod along x: nearest where it hangs, which is after the angle.
TEST(ApproachOfRods, IsWhereTheEndIsLowest) {
  for (const int percent : {1, 3, 15}) {
    const double p = 0.01 * percent, start = std::numbers::pi / 3;
    const Results results =
        runOf(turning(rod, "type = \"capsule\"\nradius = \"100 mm\"\nlength = 4\naxis = \"x\"\ncentre = [0, 0.5, 0]\n",
                      uncertain("length", percent) + uncertain("start", percent)));
    EXPECT_EQ(results.comparison.verdict, Agreement::inside) << percent;
    const Approach approach = approachesOf(results).at(0);
    const double low = 1.5 - 1 - p - 0.15, high = 1.5 - 1 + p - 0.15;  // height - length - radii
    EXPECT_TRUE(holds(approach.least, low + 1e-12, high - 1e-12)) << percent;
    EXPECT_LE(widthOf(approach.least), 1.05 * (high - low)) << percent;
    for (const double share : {-1.0, -0.3, 0.0, 0.5, 1.0})
      EXPECT_TRUE(canBe(approach, start * (1 + share * p))) << percent << ' ' << share;
    ASSERT_TRUE(approach.from[0] && approach.from[1] && approach.from[2] && approach.to[0] && approach.to[2]);
    EXPECT_TRUE(holds(*approach.from[0], 0.25, 0.25)) << percent;  // below the hinge
    EXPECT_TRUE(holds(*approach.from[1], 0.5, 0.5)) << percent;
    EXPECT_LE(widthOf(*approach.from[1]), 1e-9) << percent;
    EXPECT_TRUE(holds(*approach.from[2], low + 0.1 + 1e-12, high + 0.1 - 1e-12)) << percent;
    EXPECT_TRUE(holds(*approach.to[0], 0.25, 0.25)) << percent;
    EXPECT_TRUE(holds(*approach.to[2], 0.1, 0.1)) << percent;
    if (percent > 3) continue;
    ASSERT_EQ(approach.when.size(), 1U) << percent;
    EXPECT_LE(widthOf(approach.when[0]), 2 * start * p + 0.06) << percent;
    EXPECT_LE(widthOf(*approach.from[0]), 2 * widthOf(approach.when[0])) << percent;
    EXPECT_LE(widthOf(*approach.to[2]), 0.02) << percent;
  }
}

/// A corner, and then the other one, which comes as low; between them all of the bottom.
TEST(ApproachOfBoxes, IsWhereEitherCornerIsLowest) {
  const std::string crate =
      "type = \"box\"\nsize = [\"0.4 m\", \"0.2 m\", \"length\"]\ncentre = [0, 0, \"-0.5 length\"]\n";
  for (const int percent : {1, 5}) {
    const double p = 0.01 * percent, start = std::numbers::pi / 3;
    const Results results = runOf(
        turning(crate, "type = \"box\"\nsize = [4, 4, 0.25]\ncentre = [0, 0, -0.125]\n", uncertain("length", percent)));
    EXPECT_EQ(results.comparison.verdict, Agreement::inside) << percent;
    const Approach approach = approachesOf(results).at(0);
    const double low = 1.5 - std::hypot(1 + p, 0.2), high = 1.5 - std::hypot(1 - p, 0.2);
    EXPECT_TRUE(holds(approach.least, low + 1e-12, high - 1e-12)) << percent;
    EXPECT_LE(widthOf(approach.least), 1.2 * (high - low)) << percent;
    for (const double share : {-1.0, -0.3, 0.0, 0.5, 1.0})
      for (const double side : {-1.0, 1.0})
        EXPECT_TRUE(canBe(approach, start + side * std::atan2(0.2, 1 + share * p))) << percent << ' ' << share;
    EXPECT_GE(approach.when.size(), 2U) << percent;
    for (const double time : {0.1, 0.5, 0.75, 0.93, 1.35, 1.9}) EXPECT_FALSE(canBe(approach, time)) << percent << time;
    EXPECT_TRUE(holds(*approach.from[0], 0.25, 0.25)) << percent;  // right below the hinge
    EXPECT_TRUE(holds(*approach.from[1], 0.4, 0.6)) << percent;    // both ends of its edge, and what is between
    EXPECT_LE(widthOf(*approach.from[1]), 0.2 + 1e-6) << percent;
    EXPECT_TRUE(holds(*approach.to[1], 0.4, 0.6)) << percent;
    EXPECT_TRUE(holds(*approach.to[2], 0, 0)) << percent;
    EXPECT_LE(widthOf(*approach.to[2]), 1e-6) << percent;
  }
}

TEST(ApproachOfSpheres, IsThatOfTheirCentres) {
  const std::string ball = "type = \"sphere\"\nradius = \"50 mm\"\ncentre = [0, 0, \"-length\"]\n";
  const Results results = runOf(turning(ball, "type = \"sphere\"\nradius = \"100 mm\"\ncentre = [0.25, 0.5, 0]\n",
                                        uncertain("height", 1) + uncertain("start", 2)));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  const Approach approach = approachesOf(results).at(0);
  EXPECT_TRUE(holds(approach.least, 0.335 + 1e-12, 0.365 - 1e-12));
  EXPECT_LE(widthOf(approach.least), 1.05 * 0.03);
  for (const double share : {0.98, 0.99, 1.0, 1.02})
    EXPECT_TRUE(canBe(approach, share * std::numbers::pi / 3)) << share;
  EXPECT_FALSE(canBe(approach, 0.3) || canBe(approach, 1.9));
  EXPECT_TRUE(holds(*approach.to[2], 0.1, 0.1));
  EXPECT_TRUE(holds(*approach.from[2], 0.435, 0.465));
}

}  // namespace
}  // namespace gamut::approach_test
