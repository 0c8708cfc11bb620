// Flows where bounds are most likely to miss a term: equations at the edge of their domain, stiff, fast, over twelve
// orders of magnitude; up to eight states and four parameters with thin, nearly thin and wide components; sub-boxes
// that touch the ends; series whose coefficients vanish in long runs.
#include <cmath>

#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

/// Options that a user may choose but should not need.
FlowOptions wildOptions(Points& points, int highestDegree) {
  FlowOptions options;
  options.order = points.integer(4, 30);
  options.tolerance = points.integer(0, 2) == 0 ? 0.0 : std::pow(10.0, -points.integer(4, 16));
  options.degree = points.integer(0, 2) == 0 ? -1 : points.integer(1, highestDegree);
  options.frameDegree = points.integer(-1, 4);
  options.split = points.integer(0, 2) > 0;
  options.splitDefect = std::pow(10.0, -points.integer(3, 8));
  options.maxPieces = points.integer(1, 6);
  options.jobs = points.integer(1, 2);
  return options;
}

/// Two boxes inside `box`, each inside the one before; some sides keep an end, some shrink to a point.
std::vector<Box> wildLevels(Points& points, const Box& box) {
  std::vector<Box> levels;
  for (int level = 0; level < 2; ++level) {
    const Box outer = levels.empty() ? box : levels.back();
    Box& inner = levels.emplace_back();
    for (const Interval& side : outer) {
      const int choice = points.integer(0, 3);
      const double span = side.upper() - side.lower();
      const auto inside = [&](double value) { return std::clamp(value, side.lower(), side.upper()); };
      const double lower = choice == 0 ? side.lower() : inside(side.lower() + span * points.uniform(0, 0.5));
      const double upper = choice == 1 ? side.upper() : inside(side.upper() - span * points.uniform(0, 0.5));
      inner.push_back(choice == 3 ? Interval(lower) : Interval(std::min(lower, upper), std::max(lower, upper)));
    }
  }
  return levels;
}

/// Right-hand sides for a ≈ 1 and b ≈ 0 (both of order one), at time s of order one.
void hostileField(int kind, const Recorded& s, const Recorded& a, const Recorded& b, const Recorded& p, Recorded& u,
                  Recorded& v) {
  switch (kind) {
    case 0:  // the square root's edge
      u = sqrt(a - 0.9) * 0.3, v = -b;
      return;
    case 1:  // a pole ahead
      u = -0.2 / (a - 0.85), v = sin(30.0 * s) * a;
      return;
    case 2:  // the logarithm's edge
      u = log(a - 0.9) * 0.05, v = a * b;
      return;
    case 3:  // fast rotation
      u = b, v = -a * p * 400.0;
      return;
    case 4:  // stiff
      u = -50.0 * (a - cos(s)), v = a - b;
      return;
    case 5:  // relaxation oscillator
      u = b, v = 5.0 * (1.0 - sqr(a)) * b - a;
      return;
    default:
      u = sin(a * b * 3.0 + s), v = cos(a - b) * p;
  }
}

class HostileField : public ::testing::TestWithParam<int> {};

TEST_P(HostileField, HoldsTrajectoriesOnEveryScale) {
  Points points(100 + static_cast<unsigned>(GetParam()));
  for (int round = 0; round < 4; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const double size = std::pow(10.0, points.integer(-12, 12)), second = std::pow(10.0, points.integer(-6, 6));
    Containment c;
    c.f = record(2, 1, [&](auto t, const auto& x, const auto& p, auto& dx) {
      Recorded u, v;
      hostileField(GetParam(), t * (1 / second), x[0] * (1 / size), x[1] * (1 / size), p[0], u, v);
      dx[0] = u * (size / second);
      dx[1] = v * (size / second);
    });
    c.g = record(2, 1, 2, [&](auto t, const auto& x, const auto& p, auto& y) {
      const Recorded a = x[0] * (1 / size), b = x[1] * (1 / size);
      y[0] = a / (6.0 + b + p[0]);
      y[1] = sqrt(sqr(a) + sqr(b) + 0.001) - t * (1 / second);
    });
    const double width = std::pow(10.0, -points.uniform(1.5, 9));
    c.box = {size * (1.0 + Interval(-0.5, 0.5) * (points.integer(0, 2) * width)),
             size * (points.uniform(-0.3, 0.3) + Interval(-1, 1) * (points.integer(0, 1) * width)),
             points.uniform(0.5, 1) + Interval(-1, 1) * (points.integer(0, 1) * width)};
    c.horizon = second * points.uniform(0.1, 0.6);
    c.times = {0.0, c.horizon * 0.3, c.horizon * points.uniform(0.4, 0.9)};
    c.options = wildOptions(points, 5);
    c.levels = wildLevels(points, c.box);
    expectContainment(c, 4, false);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Flow, HostileField, ::testing::Range(0, 7));

TEST(Flow, HoldsTrajectoriesOfManyStatesAndParametersThinAndWide) {
  Points points(41);
  for (int round = 0; round < 16; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const int n = points.integer(3, 8), k = points.integer(0, 4);
    std::vector<double> nominal;
    for (int i = 0; i < n + k; ++i) nominal.push_back(points.uniform(-1, 1));
    Containment c;
    c.f = record(n, k, [&](auto, const auto& x, const auto& p, auto& dx) {
      const auto at = [&](int i) {
        return i < n ? x[static_cast<std::size_t>(i)] : p[static_cast<std::size_t>(i - n)];
      };
      for (Recorded& rate : dx) {
        const Recorded a = at(points.integer(0, n + k - 1)), b = at(points.integer(0, n + k - 1));
        rate = sin(a * b) - 0.5 * a + 0.3 / (2.0 + sqr(b));
      }
    });
    c.g = standardOutputs(n, k);
    int wide = 0;
    for (double value : nominal) {
      const double widths[] = {0.0, 1e-15, 1.2e-13, 1e-6, 0.03};
      int choice = points.integer(0, 4);
      if (choice > 1 && ++wide > 3) choice = 1;  // no more symbols than are quick
      c.box.push_back(value * (1.0 + Interval(-1, 1) * widths[choice]));
    }
    c.horizon = points.uniform(0.1, 0.8);
    c.times = {c.horizon * 0.4};
    c.options = wildOptions(points, 3);
    c.levels = wildLevels(points, c.box);
    expectContainment(c, 4);
    if (HasFatalFailure()) return;
  }
}

/// ẋ = 2t / (1 + t⁴): x = x(0) + atan t². Three of four coefficients at t = 0 are zero.
TEST(Flow, HoldsSolutionsWhoseSeriesHaveGaps) {
  const Program f =
      record(1, 0, [](auto t, const auto&, const auto&, auto& dx) { dx[0] = 2.0 * t / (1.0 + sqr(sqr(t))); });
  const Program g = record(1, 0, 1, [](auto t, const auto& x, const auto&, auto& y) { y[0] = x[0] - atan(sqr(t)); });
  for (int order : {4, 9, 20, 30})
    for (const Interval& start : {Interval(0.5), Interval(0.4, 0.5)}) {
      FlowOptions options;
      options.order = order;
      const bool isLow = order < 9;  // takes very short steps; the gaps are at the start
      const std::vector<double> times = isLow ? std::vector<double>{0.25} : std::vector<double>{0.25, 0.9, 1.7};
      const Tube tube = Flow(f, g, options).enclose({start}, isLow ? 0.375 : 3.0, times);
      ASSERT_EQ(tube.why(), "");
      for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
        const Precise t(tube.times()[i]), rise = atan(Precise(t * t));
        for (double end : {start.lower(), start.upper()}) {
          EXPECT_THAT(tube.states(i)[0], Encloses(Precise(rise + end)))
              << "order " << order << ", t " << tube.times()[i];
          EXPECT_THAT(tube.outputs(i)[0], Encloses(Precise(end)));
        }
      }
    }
}

}  // namespace
}  // namespace gamut::testing
