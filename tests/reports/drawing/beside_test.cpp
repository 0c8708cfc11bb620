// What is drawn beside a motion lies where the numbers are, and says of which instant it is.
#include "reports/drawing/beside.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "reports/drawing/paper.hpp"
#include "reports/page/instant.hpp"
#include "reports/sections/contribution.hpp"
#include "tests/reports/example_results.hpp"

namespace gamut::besides {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Corner {
  double x = 0, y = 0;
};

/// The corners of the path of this class, whatever line they are of.
std::vector<Corner> cornersOf(const std::string& shapes, const std::string& kind) {
  const auto begin = shapes.find("class=\"" + kind + "\"");
  if (begin == std::string::npos) throw std::logic_error("no path " + kind);
  const auto from = shapes.find("d=\"", begin) + 3;
  std::string path = shapes.substr(from, shapes.find('"', from) - from), spaced;
  for (const char c : path)
    spaced += c == 'M' || c == 'l' || c == 'Z' ? std::string{' ', c, ' '} : c == '-' ? " -" : std::string{c};
  std::istringstream text(spaced);
  std::vector<Corner> corners;
  std::string word;
  while (text >> word) {
    if (word == "Z") continue;
    Corner next;
    text >> next.x >> next.y;
    if (word == "l") next.x += corners.back().x, next.y += corners.back().y;
    corners.push_back(next);
  }
  return corners;
}

double valueAt(const BesideMoment& moment, const Corner& corner) {
  return moment.low - corner.y / besideHeight * (moment.high - moment.low);
}

TEST(Beside, DrawsMembershipsToTheLeftAndProbabilitiesToTheRight) {
  const Results results = example::pendulum(61, 2);
  const std::vector<BesideMoment> moments = besideOf(results, 1);
  ASSERT_GT(moments.size(), 10u);
  for (const BesideMoment& moment : moments) {
    const auto row = static_cast<std::size_t>(std::ranges::find(results.time, moment.time) - results.time.begin());
    ASSERT_LT(row, 61u);
    EXPECT_TRUE(moment.isProbable && moment.isPossible);
    const double finest = 1e-4 * (moment.high - moment.low);
    std::vector<Corner> ends = cornersOf(moment.shapes, "beside-guaranteed");
    EXPECT_NEAR(valueAt(moment, ends.front()), results.interval.at.lower(row, 1), finest);
    EXPECT_NEAR(valueAt(moment, ends.back()), results.interval.at.upper(row, 1), finest);
    // No corner of the stairs lies inside a cut of a higher level than its own.
    for (const Corner& corner : cornersOf(moment.shapes, "beside-possible")) {
      EXPECT_LE(corner.x, 0);
      const double alpha = -corner.x / besideWidth, value = valueAt(moment, corner);
      const auto level = static_cast<std::size_t>(std::ceil(10 * alpha - 1e-6));
      EXPECT_TRUE(value <= results.fuzzy.outer[level].lower(row, 1) + 2 * finest ||
                  value >= results.fuzzy.outer[level].upper(row, 1) - 2 * finest)
          << alpha;
    }
    const std::vector<Corner> share = cornersOf(moment.shapes, "beside-share");
    ASSERT_EQ(share.size(), 7u);
    for (std::size_t q = 0; q < 5; ++q) {
      EXPECT_NEAR(share[q + 1].x, besideWidth * results.stochastic.probabilities[q], 0.1);
      EXPECT_NEAR(valueAt(moment, share[q + 1]), results.stochastic.quantiles[q](row, 1), finest);
    }
  }
}

/// Bounds that are proved take the place of quantiles, at their own times; at the instant that matters there is a
/// moment besides.
TEST(Beside, ShowsProvedBoundsWhereTheyAreKnown) {
  Results results = example::pendulum(61, 2);
  DistributionResult& d = results.distribution;
  d.present = true;
  d.time = {results.time[20]};
  d.point = {0, 1, 2};
  const double low = results.interval.at.lower(20, 0), high = results.interval.at.upper(20, 0);
  const double none = std::numeric_limits<double>::quiet_NaN();
  d.value = Grid({1, 2, 3}, {low, 0.5 * (low + high), high, none, none, none});
  d.lower = d.sampled = Grid({1, 2, 3}, {0, 0.25, 1, none, none, none});
  d.upper = Grid({1, 2, 3}, {0, 0.75, 1, none, none, none});
  d.gaps = d.excess = Grid({1, 2}, {0.5, none});
  const std::vector<BesideMoment> moments = besideOf(results, 0);
  ASSERT_EQ(moments.size(), 2u);
  EXPECT_EQ(moments[0].time, results.time[20]);
  EXPECT_EQ(moments[1].time, results.time[60]);
  EXPECT_THAT(moments[1].shapes, Not(HasSubstr("beside-bounds")));
  for (const Corner& corner : cornersOf(moments[0].shapes, "beside-bounds")) {
    const double value = valueAt(moments[0], corner), middle = 0.5 * (low + high), p = corner.x / besideWidth;
    const bool isUpper = std::abs(p - (value < middle ? 0.75 : 1)) < 1e-3,
               isLower = std::abs(p - (value < middle ? 0 : 0.25)) < 1e-3;
    EXPECT_TRUE(isUpper || isLower || std::abs(value - middle) < 1e-3 * (high - low)) << p << " " << value;
  }
  EXPECT_EQ(&nearestTo(moments, 0), &moments[0]);
  EXPECT_EQ(&nearestTo(moments, 2.9), &moments[1]);
}

TEST(Beside, IsEmptyWhereNothingIsKnown) {
  Results results = example::pendulum(61, 1);
  results.interval = {};
  results.stochastic = {};
  results.fuzzy = {};
  EXPECT_TRUE(besideOf(results, 0).empty());
  EXPECT_EQ(besideTemplate({}, "nothing"), "");
}

/// On paper the shapes lie on the axis of the motion, which their transformation tells; spreads are counted from the
/// middle.
TEST(Beside, LiesOnTheAxisOfTheMotionOnPaper) {
  const Results results = example::pendulum(61, 1);
  const Plot plot = plotOf(results, 0);
  const std::vector<BesideMoment> moments = besideOf(results, 0);
  const BesideMoment& moment = moments.back();
  for (const double around : {0.0, moment.middle}) {
    const std::string svg = drawPlotWith(moment, around, around == 0 ? plot : aroundMiddle(plot), "Plot of it");
    const auto from = svg.find("matrix(") + 7;
    std::istringstream text(svg.substr(from, svg.find(')', from) - from));
    double across = 0, no = 0, never = 0, upwards = 0, x = 0, bottom = 0;
    text >> across >> no >> never >> upwards >> x >> bottom;
    const double top = bottom - besideHeight * upwards;
    // Of the vertical axis two ticks tell where its numbers are.
    std::vector<Corner> ticks;
    for (auto at = svg.find("class=\"tick end\""); at != std::string::npos;
         at = svg.find("class=\"tick end\"", at + 1)) {
      const auto y = svg.find("y=\"", at) + 3, text0 = svg.find('>', at) + 1;
      ticks.push_back({std::stod(svg.substr(text0)), std::stod(svg.substr(y)) - 3.5});
    }
    ASSERT_GT(ticks.size(), 2u);
    const double perUnit = (ticks.back().y - ticks.front().y) / (ticks.back().x - ticks.front().x);
    EXPECT_NEAR(ticks.front().y + perUnit * (moment.low - around - ticks.front().x), bottom, 0.3);
    EXPECT_NEAR(ticks.front().y + perUnit * (moment.high - around - ticks.front().x), top, 0.3);
  }
}

}  // namespace
}  // namespace gamut::besides
