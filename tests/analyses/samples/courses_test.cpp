// Courses of what varies in time are what they are said to be: within their interval and below their rate, exactly.
#include "analyses/samples/courses.hpp"

#include <algorithm>
#include <cmath>

#include "tests/analyses/reference.hpp"

namespace gamut::testing {
namespace {

/// y = w(t) for the number drawn.
Program courseOf(const VaryingQuantity& quantity) {
  const Program itself = record(0, 1, 1, [](auto, const auto&, const auto& p, auto& y) { y[0] = p[0]; });
  return withCourses(itself, {quantity}, 1.0, 40.0);
}

Precise valueAt(Evaluator<Precise>& course, double drawn, const Precise& t) {
  course.setParameters(Vector{Precise(drawn)});
  return course(t, Vector{})[0];
}

TEST(Courses, StayInTheIntervalAndBelowTheRate) {
  for (const VaryingQuantity& quantity :
       {VaryingQuantity{0, Interval(-1, 1), 0.0}, VaryingQuantity{0, Interval(2, 2.5), 2.1, 0.3},
        VaryingQuantity{0, Interval("[-0.1, 0.7]"), 0.7, 100.0}}) {
    Evaluator<Precise> course(courseOf(quantity));
    Precise least(1e9), most(-1e9);
    for (int i = 0; i <= 200; ++i) {
      const double drawn = std::clamp(quantity.range.lower() + width(quantity.range) * i / 200, quantity.range.lower(),
                                      quantity.range.upper());
      for (int k = 0; k < 50; ++k) {
        const Precise t(k * 0.11), step(0x1p-30);
        const Precise w = valueAt(course, drawn, t);
        EXPECT_THAT(quantity.range, Encloses(w)) << drawn;
        least = std::min(least, w);
        most = std::max(most, w);
        if (std::isfinite(quantity.rate)) {
          EXPECT_LT(abs(valueAt(course, drawn, t + step) - w), quantity.rate * step) << drawn;
        }
      }
    }
    // All of the interval is seen.
    EXPECT_LT(least, quantity.range.lower() + 0.01 * width(quantity.range));
    EXPECT_GT(most, quantity.range.upper() - 0.01 * width(quantity.range));
  }
}

TEST(Courses, OfTheEndsAndTheNominalValueStandStill) {
  const VaryingQuantity quantity{0, Interval(-1, 3), 0.5};
  Evaluator<Precise> course(courseOf(quantity));
  for (double drawn : {-1.0, 0.5, 3.0})
    for (double t : {0.0, 0.3, 7.0})
      EXPECT_LT(abs(valueAt(course, drawn, Precise(t)) - drawn), drawn == 0.5 ? Precise(0) + 1e-300 : Precise(1e-9));
}

TEST(Courses, SwitchAndSwing) {
  Evaluator<Precise> course(courseOf({0, Interval(-1, 1), 0.0}));
  int atAnEnd = 0, between = 0;
  double turns = 0;
  for (int i = 0; i < 200; ++i) {
    const double drawn = -0.95 + 0.0095 * i;
    Precise before(0);
    for (int k = 0; k < 60; ++k) {
      const Precise w = valueAt(course, drawn, Precise(k * 0.1));
      ++(abs(w) > 0.99 ? atAnEnd : between);
      turns += w * before < 0 ? 1 : 0;
      before = w;
    }
  }
  EXPECT_GT(atAnEnd, 3000);
  EXPECT_GT(between, 3000);
  EXPECT_GT(turns / 200, 5);
}

TEST(Courses, AreAsFastAsTheMotion) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * x[0];
  });
  EXPECT_NEAR(fastestTurn(f, {0.0, 0.0, 49.0}), 7, 1e-12);
}

}  // namespace
}  // namespace gamut::testing
