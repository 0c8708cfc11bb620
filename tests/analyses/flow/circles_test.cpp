// Images of boxes in which angles go far round, as directions of play do.
#include "analyses/flow/circles.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <random>

#include "analyses/flow/flow.hpp"
#include "analyses/flow/image.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {
namespace {

/// The double next above pi: all directions.
const double allRound = std::nextafter(std::numbers::pi, 4.0);

/// Plays of radii 2⁻⁷, 2⁻⁸, …, 2⁻¹¹, 2⁻⁷, … in a row behind a point at (1, ½): x, y, and the distance from the origin.
/// Eccentricities, then directions.
Program plays(int count) {
  return record(2 * count, 0, 3, [count](auto, const auto& p, const auto&, auto& y) {
    auto across = 0.0 * p[0] + 1.0, up = 0.0 * p[0] + 0.5;
    for (int j = 0; j < count; ++j) {
      const auto off = std::ldexp(1.0, -7 - j % 5) * p[j];
      across = across + off * cos(p[count + j]);
      up = up + off * sin(p[count + j]);
    }
    y[0] = across;
    y[1] = up;
    y[2] = sqrt(sqr(across) + sqr(up));
  });
}

Box boxOfPlays(int count, double most) {
  Box box(static_cast<std::size_t>(count), Interval(0.0, most));
  box.resize(2 * static_cast<std::size_t>(count), Interval(-allRound, allRound));
  return box;
}

double radiusOfPlays(int count) {
  double sum = 0;
  for (int j = 0; j < count; ++j) sum += std::ldexp(1.0, -7 - j % 5);
  return sum;  // exact
}

/// A point of a disc in a row of discs lies anywhere in a disc of the sum of their radii.
TEST(CircleImage, IsThatOfDiscsInARowHoweverManyThereAre) {
  for (const int count : {1, 2, 3, 10, 30}) {
    SCOPED_TRACE(count);
    const Image image = findImage(plays(count), 0, boxOfPlays(count, 1), {boxOfPlays(count, 0.25)}, {}, -1, nullptr,
                                  count < 3 ? imageWork : 0);
    for (std::size_t level = 0; level < 2; ++level) {
      const double radius = radiusOfPlays(count) * (level == 0 ? 1.0 : 0.25);
      for (const auto& [output, middle] : {std::pair(0, 1.0), std::pair(1, 0.5)}) {
        const Interval& found = image.ranges[level][static_cast<std::size_t>(output)];
        EXPECT_LE(found.lower(), middle - radius);
        EXPECT_GE(found.upper(), middle + radius);
        EXPECT_LE(width(found), 2 * radius * (1 + 1e-9));
      }
      // A disc around a point that is √1.25 away, which is not in it.
      const Interval distance = sqrt(Interval(1.25)), reach = image.ranges[level][2];
      EXPECT_LE(reach.lower(), (distance - radius).upper());
      EXPECT_GE(reach.upper(), (distance + radius).lower());
      EXPECT_LE(width(reach), 2 * radius * (count < 3 ? 1.001 : count < 30 ? 1.01 : 1.04));
    }
  }
}

/// Directions that are known to a radian: sectors of discs.
TEST(CircleImage, IsNoneOnceItIsCancelled) {
  std::atomic<bool> isCancelled = false;
  const auto found = [&] { return imageUnlessCancelled(plays(3), 0, boxOfPlays(3, 1), {}, 6, &isCancelled, {}); };
  EXPECT_TRUE(found().has_value());
  isCancelled = true;
  EXPECT_FALSE(found().has_value());
}

TEST(CircleImage, IsThatOfSectorsInARow) {
  constexpr int count = 10;
  Box box = boxOfPlays(count, 1);
  for (std::size_t i = count; i < box.size(); ++i) box[i] = Interval(-1.0, 1.0);
  const Image image = findImage(plays(count), 0, box, {}, {}, -1, nullptr, 0);
  const double radius = radiusOfPlays(count);
  const Interval across = image.ranges[0][0], up = image.ranges[0][1], rise = radius * sin(Interval(1.0));
  EXPECT_LE(across.lower(), 1);
  EXPECT_GE(across.upper(), 1 + radius);
  EXPECT_LE(width(across), radius * (1 + 1e-9));
  EXPECT_LE(up.lower(), (0.5 - rise).upper());
  EXPECT_GE(up.upper(), (0.5 + rise).lower());
  EXPECT_LE(width(up), 2 * rise.upper() * (1 + 1e-9));
  const OutputExtremes& extremes = image.extremes[0];
  EXPECT_NEAR(Evaluator<double>(plays(count))(0.0, extremes.leastAt)[0], across.lower(), 1e-9);
  EXPECT_NEAR(Evaluator<double>(plays(count))(0.0, extremes.greatestAt)[0], across.upper(), 1e-9);
}

TEST(CircleImage, TellsWhereItIsExtreme) {
  const Program g = plays(10);
  const std::vector<Box> levels{boxOfPlays(10, 0.5)};
  const Image image = findImage(g, 0, boxOfPlays(10, 1), levels, {}, -1, nullptr);
  ASSERT_EQ(image.levelExtremes.size(), 1U);
  Evaluator<double> evaluator(g);
  for (std::size_t level = 0; level < 2; ++level)
    for (std::size_t o = 0; o < 3; ++o) {
      const OutputExtremes& extremes = level == 0 ? image.extremes[o] : image.levelExtremes[0][o];
      const Interval& range = image.ranges[level][o];
      for (const auto& [at, end] : {std::pair(extremes.leastAt, range.lower()), {extremes.greatestAt, range.upper()}}) {
        ASSERT_EQ(at.size(), 20U);
        for (std::size_t i = 0; i < at.size(); ++i)
          EXPECT_TRUE(contains(level == 0 ? boxOfPlays(10, 1)[i] : levels[0][i], at[i]));
        EXPECT_NEAR(evaluator(0.0, at)[o], end, 0.03 * width(range));
      }
    }
}

/// Of second order alone, whichever way it bends: what is found holds points on the circles' edges, all round.
TEST(CircleImage, HoldsWhatBends) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int round = 0; round < 20; ++round) {
    std::vector<double> c(14);
    for (double& each : c) each = any(random) * (round % 4 == 0 ? 0.05 : 1);
    const double n = round % 2 == 0 ? 3 : 0.1;
    const Program g = record(4, 0, 1, [&](auto, const auto& p, const auto&, auto& y) {
      const auto a = p[0] * cos(p[2]), b = p[0] * sin(p[2]), d = p[1] * cos(p[3]), e = p[1] * sin(p[3]);
      y[0] = n * (c[0] * a + c[1] * b + c[2] * d + c[3] * e) + c[4] * sqr(a) + c[5] * sqr(b) + c[6] * sqr(d) +
             c[7] * sqr(e) + c[8] * a * b + c[9] * a * d + c[10] * a * e + c[11] * b * d + c[12] * b * e +
             c[13] * d * e;
    });
    const Box box{Interval(0.0, 1.0), Interval(-0.5, 0.75), Interval(-allRound, allRound),
                  Interval(-allRound, allRound)};
    const CircleImage circles = imageByCircles(g, 0, box, {}, -1, nullptr, {});
    Evaluator<Interval> evaluator(g);
    Interval all = Interval::empty();
    for (const double r : {0.0, 0.5, 1.0})
      for (const double q : {-0.5, 0.0, 0.75})
        for (int i = 0; i < 60; ++i)
          for (int k = 0; k < 60; ++k) {
            const std::vector<Interval> at{r, q, -3.14 + i * 6.28 / 59, -3.14 + k * 6.28 / 59};
            const Interval y = evaluator(Interval(0.0), at)[0];
            EXPECT_TRUE(isSubset(y, circles.ranges[0][0]));
            all = hull(all, y);
          }
    EXPECT_LE(width(circles.ranges[0][0]), (n > 1 ? 2.0 : 3.5) * width(all));
  }
}

/// Whatever is done with sines and cosines, and however far which angle goes.
TEST(CircleImage, HoldsWhatIsAtEveryPoint) {
  const Program g = record(2, 2, 6, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = p[0] * cos(x[0]) + sin(x[1] + 0.5 * x[0]) * p[1];
    y[1] = sqrt(sqr(p[0] + 2.0 + cos(x[0])) + sqr(sin(x[0])));
    y[2] = cos(x[0]) * sin(x[1]) * cos(3.0 * x[0]) + p[1];
    y[3] = abs(cos(x[0]) - p[0]) + x[0];
    y[4] = exp(sin(x[0])) / (1.5 + sqr(cos(x[1])));
    y[5] = sqr(cos(x[0]) + 2.0 * cos(x[1])) - 3.0 * sin(x[0]) * sin(x[1]) + (p[0] + 2.0) * cos(x[0]);
  });
  std::mt19937_64 random(5);
  for (const Interval& angle : {Interval(-allRound, allRound), Interval(0.0, 7.0), Interval(-1.0, 1.5)}) {
    const Box box{angle, Interval(-2.0, 1.0), Interval(0.0, 1.0), Interval(-0.25, 0.5)};
    Box inner = box;
    for (Interval& each : inner)
      each = Interval(midpoint(each) - 0.1 * width(each), midpoint(each) + 0.2 * width(each));
    const CircleImage circles = imageByCircles(g, 0, box, {inner}, -1, nullptr, {});
    ASSERT_EQ(circles.ranges.size(), 2U);
    EXPECT_GT(countFarAngles(g, 0, box), 0U);
    Evaluator<Interval> evaluator(g);
    for (std::size_t level = 0; level < 2; ++level)
      for (int i = 0; i < 4000; ++i) {
        std::vector<Interval> at;
        for (const Interval& range : level == 0 ? box : inner)
          at.emplace_back(std::uniform_real_distribution<double>(range.lower(), range.upper())(random));
        evaluator.setParameters(std::vector<Interval>(at.begin() + 2, at.end()));
        at.resize(2);
        const std::vector<Interval> y = evaluator(Interval(0.0), at);
        for (std::size_t o = 0; o < 6; ++o)
          EXPECT_FALSE(isEmpty(intersection(circles.ranges[level][o], y[o]))) << level << " " << o;
      }
  }
}

TEST(CircleImage, IsOfFarAnglesAlone) {
  const Program g = plays(2);
  Box near = boxOfPlays(2, 1);
  for (std::size_t i = 2; i < 4; ++i) near[i] = Interval(-0.5, 0.5);
  EXPECT_EQ(countFarAngles(g, 0, near), 0U);
  EXPECT_TRUE(imageByCircles(g, 0, near, {}, -1, nullptr, {}).ranges.empty());
}

}  // namespace
}  // namespace gamut::testing
