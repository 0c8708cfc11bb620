// The nearest points of shapes, and the rate of their distance, against those of all combinations of their corners, in
// a hundred digits (C. Carathéodory: the least vector of a hull is that of three points): no tolerance.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "mechanics/assembly.hpp"
#include "mechanics/elements/all.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut::nearest_points_test {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_100;
using Point = std::array<Exact, 3>;
using Points = std::vector<Point>;
using Triple = std::array<double, 3>;

Exact dot(const Point& x, const Point& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Point plus(const Point& x, const Point& y, const Exact& s = 1) {
  return {x[0] + s * y[0], x[1] + s * y[1], x[2] + s * y[2]};
}
Point minus(const Point& x, const Point& y) { return plus(x, y, -1); }
Point cross(const Point& x, const Point& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

/// Of two shapes that are apart.
struct Nearest {
  Point one, other;
  Exact square() const { return dot(minus(one, other), minus(one, other)); }
};

/// Of the hulls of two sets of points, in general position.
Nearest nearestOf(const Points& one, const Points& other) {
  std::vector<Nearest> pairs;
  for (const Point& x : one)
    for (const Point& y : other) pairs.push_back({x, y});
  Nearest nearest = pairs.front();
  const auto take = [&](const Nearest& pair) {
    if (pair.square() < nearest.square()) nearest = pair;
  };
  const auto between = [](const Nearest& p, const Nearest& q, const Exact& s) {
    return Nearest{plus(p.one, minus(q.one, p.one), s), plus(p.other, minus(q.other, p.other), s)};
  };
  const auto vector = [](const Nearest& pair) { return minus(pair.one, pair.other); };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    take(pairs[i]);
    for (std::size_t j = i + 1; j < pairs.size(); ++j) {
      const Point a = minus(vector(pairs[j]), vector(pairs[i]));
      if (const Exact s = -dot(vector(pairs[i]), a) / dot(a, a); s > 0 && s < 1) take(between(pairs[i], pairs[j], s));
      for (std::size_t k = j + 1; k < pairs.size(); ++k) {
        const Point b = minus(vector(pairs[k]), vector(pairs[i])), normal = cross(a, b);
        const Exact area = dot(normal, normal);
        if (area < Exact("1e-60")) continue;
        const Point y = minus(plus({0, 0, 0}, normal, dot(vector(pairs[i]), normal) / area), vector(pairs[i]));
        const Exact s = dot(cross(y, b), normal) / area, t = dot(cross(a, y), normal) / area;
        if (!(s > 0 && t > 0 && s + t < 1)) continue;
        const Exact both = s + t;
        take(between(pairs[i], between(pairs[j], pairs[k], t / both), both));
      }
    }
  }
  return nearest;
}

enum class Kind { ball, rod, crate, wedge };
constexpr Kind kinds[] = {Kind::ball, Kind::rod, Kind::crate, Kind::wedge};

/// A shape that slides along an axis, from where it stands, turned there.
struct Standing {
  Kind kind = Kind::ball;
  std::vector<Triple> points;  // of which it is the hull, in its axes
  double radius = 0;
  std::array<double, 4> turn{1, 0, 0, 0};  // a quaternion of any length
  Triple place{};

  Points exact(double slide) const {
    const Exact w = turn[0], x = turn[1], y = turn[2], z = turn[3], n = w * w + x * x + y * y + z * z;
    const std::array<Point, 3> rows = {
        Point{(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n},
        Point{2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n},
        Point{2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n}};
    Points all;
    for (const Triple& p : points) {
      const Point own{p[0], p[1], p[2]};
      all.push_back({place[0] + slide + dot(rows[0], own), place[1] + dot(rows[1], own), place[2] + dot(rows[2], own)});
    }
    return all;
  }
  void addTo(Mechanism& m, const std::string& name, const std::string& from) const {
    const std::string at = name + "_frame";
    const Quaternion<Expression> quaternion{turn[0], turn[1], turn[2], turn[3]};
    m.add(Link{name + "_link", from, at, {place[0], place[1], place[2]}, {{axisX, 0, 0.0, "", quaternion}}});
    const Triple& far = points.back();
    std::vector<ExpressionVector> corners;
    for (const Triple& p : points) corners.push_back({p[0], p[1], p[2]});
    switch (kind) {
      case Kind::ball:
        m.add(Sphere{name, at, radius});
        break;
      case Kind::rod:
        m.add(Capsule{name, at, radius, 2 * far[2], axisZ});
        break;
      case Kind::crate:
        m.add(Cuboid{name, at, {2 * far[0], 2 * far[1], 2 * far[2]}});
        break;
      case Kind::wedge:
        m.add(Hull{name, at, corners, radius});
        break;
    }
  }
};

const std::vector<std::string> outputs = {"apart.from.x", "apart.from.y", "apart.from.z",   "apart.to.x",
                                          "apart.to.y",   "apart.to.z",   "apart.distance", "apart.rate"};

/// The first on a slider along x.
Mechanism slidingPair(const Standing& one, const Standing& other, bool isSwapped = false) {
  Mechanism m;
  m.add(Prismatic{"slider", "inertial", "slid"});
  m.add(Mass{"body", "slid", 1.0});
  one.addTo(m, "one", "slid");
  other.addTo(m, "other", "inertial");
  m.add(isSwapped ? Separation{"apart", "other", "one"} : Separation{"apart", "one", "other"});
  return m;
}

std::vector<Interval> recorded(const Mechanism& m, double slide, double rate) {
  return Evaluator<Interval>(recordOutputs(m, {}, outputs))(Interval(0.0), {slide, rate});
}
std::vector<Interval> direct(const Mechanism& m, double slide, double rate) {
  Assembly<Interval> assembly(m);
  assembly.setState(std::vector<Interval>{slide, rate});
  std::vector<Interval> values;
  for (const std::string& output : outputs) values.push_back(assembly.output(output));
  return values;
}

bool isInside(const Interval& x, const Interval& outer) {
  return outer.lower() <= x.lower() && x.upper() <= outer.upper();
}
bool holds(const Interval& x, const Exact& value) { return Exact(x.lower()) <= value && value <= Exact(x.upper()); }

class NearestPoints : public ::testing::Test {
 protected:
  double number(double most = 1) { return std::uniform_real_distribution<double>(-most, most)(random_); }
  Standing any(Kind kind, double far) {
    Standing one{kind, {{0, 0, 0}}, kind == Kind::crate ? 0 : 0.0625, {number(), number(), number(), number()}, {}};
    for (double& x : one.place) x = number(far);
    const Triple half{0.25 + 0.2 * number(), 0.25 + 0.2 * number(), 0.5 + 0.4 * number()};
    if (kind == Kind::rod) one.points = {{0, 0, -half[2]}, {0, 0, half[2]}};
    if (kind == Kind::wedge) one.points.assign(4, {});
    if (kind == Kind::wedge)
      for (Triple& p : one.points) p = {number(0.7), number(0.7), number(0.7)};
    if (kind != Kind::crate) return one;
    one.points.clear();
    for (const double x : {-half[0], half[0]})
      for (const double y : {-half[1], half[1]})
        for (const double z : {-half[2], half[2]}) one.points.push_back({x, y, z});
    return one;
  }
  std::mt19937 random_{5};
};

TEST_F(NearestPoints, AreThoseOfAllShapes) {
  for (const Kind first : kinds)
    for (const Kind second : kinds) {
      const bool areBoxes = first == Kind::crate && second == Kind::crate;
      for (int i = 0, looked = 0; looked < (areBoxes ? 2 : 4) && i < 100; ++i) {
        const Standing one = any(first, 0.2);
        Standing other = any(second, 0.5);
        other.place[static_cast<std::size_t>(i % 3)] += i % 2 == 0 ? 1.6 : -1.6;
        const double slide = number(0.2), rate = number(2);
        const Nearest cores = nearestOf(one.exact(slide), other.exact(0));
        const Exact apart = sqrt(cores.square());
        if (apart < 0.2) continue;
        ++looked;
        const Point direction = plus({0, 0, 0}, minus(cores.other, cores.one), 1 / apart);
        const Point from = plus(cores.one, direction, one.radius), to = plus(cores.other, direction, -other.radius);
        std::vector<Exact> exact{
            from[0], from[1], from[2], to[0], to[1], to[2], apart - one.radius - other.radius, -direction[0] * rate};
        const bool isSwapped = i % 2 == 1;
        if (isSwapped) std::swap_ranges(exact.begin(), exact.begin() + 3, exact.begin() + 3);
        const Mechanism m = slidingPair(one, other, isSwapped);
        const Program program = recordOutputs(m, {}, outputs);
        const std::vector<Interval> all = Evaluator<Interval>(program)(Interval(0.0), {slide, rate});
        const std::vector<Interval> alike = direct(m, slide, rate);
        const std::vector<double> about = Evaluator<double>(program)(0, {slide, rate});
        for (std::size_t k = 0; k < outputs.size(); ++k) {
          const std::string what = outputs[k] + " of " + std::to_string(static_cast<int>(first)) + " and " +
                                   std::to_string(static_cast<int>(second)) + ", " + std::to_string(i);
          ASSERT_TRUE(holds(all[k], exact[k])) << what << ": " << toString(all[k]) << " without " << exact[k];
          ASSERT_TRUE(holds(alike[k], exact[k])) << what << ": " << toString(alike[k]) << " without " << exact[k];
          ASSERT_LE(width(all[k]), 1e-6) << what;
          ASSERT_LE(width(alike[k]), 1e-6) << what;
          ASSERT_NEAR(about[k], static_cast<double>(exact[k]), 1e-11) << what;
        }
      }
    }
}

/// Of bodies that turn: the rate is by how much the distance grows.
TEST_F(NearestPoints, ComeApartAsTheDistanceGrows) {
  for (const Kind first : kinds)
    for (const Kind second : kinds) {
      const Standing one = any(first, 0.2), other = any(second, 0.2);
      Mechanism m;
      m.add(Revolute{"hinge", "inertial", "A", axisY});
      m.add(Mass{"first", "A", 1.0, {0.0, 0.0, -0.5}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}});
      m.add(Link{"base", "inertial", "B", {1.5, 1.25, 0.25}});
      m.add(Revolute{"other_hinge", "B", "C", axisX});
      m.add(Mass{"second", "C", 1.0, {0.0, 0.0, -0.5}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}});
      one.addTo(m, "one", "A");
      other.addTo(m, "other", "C");
      m.add(Separation{"apart", "one", "other"});
      Evaluator<double> evaluate(recordOutputs(m, {}, outputs));
      const double a = number(), b = number(), u = number(), v = number(), h = 1e-6;
      const double rate = evaluate(0, {a, b, u, v})[7], ahead = evaluate(0, {a + h * u, b + h * v, u, v})[6],
                   behind = evaluate(0, {a - h * u, b - h * v, u, v})[6];
      ASSERT_GT(behind, 0.05);
      EXPECT_NEAR(rate, (ahead - behind) / (2 * h), 1e-6) << static_cast<int>(first) << static_cast<int>(second);
    }
}

TEST_F(NearestPoints, OfASphereInABoxOrAnotherSphereAreEnclosed) {
  const Standing ball{Kind::ball, {{0, 0, 0}}, 0.25, {1, 0, 0, 0}, {0.25, 0, 0}};
  Standing crate{Kind::crate, {{-1, -1, -1}, {1, 1, 1}}};
  const Mechanism inside = slidingPair(ball, crate);
  for (const std::vector<Interval>& values : {recorded(inside, 0.25, 1), direct(inside, 0.25, 1)}) {
    EXPECT_TRUE(contains(values[0], 0.75));  // x = 0.5, and the radius any way
    EXPECT_TRUE(contains(values[0], 0.25));
    EXPECT_LE(width(values[0]), 0.6);
    EXPECT_TRUE(contains(values[6], -0.75));
    EXPECT_TRUE(contains(values[7], 1.0)) << toString(values[7]);  // it comes out to x = 1
    EXPECT_LE(width(values[7]), 4);
  }
  const Mechanism both = slidingPair(ball, Standing{Kind::ball, {{0, 0, 0}}, 0.5, {1, 0, 0, 0}, {0.75, 0, 0}});
  const std::vector<double> values = Evaluator<double>(recordOutputs(both, {}, outputs))(0, {0.25, 2});
  EXPECT_EQ(values, (std::vector<double>{0.75, 0, 0, 0.25, 0, 0, -0.5, -2}));  // 0.5 and 0.75, in each other
}

/// Any point of what faces, or lies along, the other one.
TEST_F(NearestPoints, OfWhatIsParallelAreAllEnclosed) {
  const Standing rod{Kind::rod, {{0, 0, -1}, {0, 0, 1}}, 0.25},
      far{Kind::rod, {{0, 0, -0.5}, {0, 0, 0.5}}, 0.5, {1, 0, 0, 0}, {3, 0, 1.25}};
  const Mechanism rods = slidingPair(rod, far);
  for (const std::vector<Interval>& values : {recorded(rods, 0, 1), direct(rods, 0, 1)}) {
    EXPECT_TRUE(contains(values[0], 0.25)) << toString(values[0]);
    for (const std::size_t z : {2, 5}) EXPECT_TRUE(isInside(Interval(0.75, 1.0), values[z])) << toString(values[z]);
    EXPECT_TRUE(contains(values[7], -1.0));
  }
  std::vector<Interval> known = recorded(rods, 0, 1);  // that they are parallel
  EXPECT_LE(width(known[0]), 1e-12);
  for (const std::size_t z : {2, 5}) EXPECT_TRUE(isInside(known[z], Interval(0.5, 1.25))) << toString(known[z]);
  const Standing crate{Kind::crate, {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}},
      other{Kind::crate, {{-1, -0.25, -1}, {1, 0.25, 1}}, 0, {1, 0, 0, 0}, {2, 0.5, 1}};
  const Mechanism crates = slidingPair(crate, other);
  for (const std::vector<Interval>& values : {recorded(crates, 0, 1), direct(crates, 0, 1)}) {
    EXPECT_TRUE(contains(values[0], 0.5)) << toString(values[0]);
    EXPECT_TRUE(contains(values[3], 1.0)) << toString(values[3]);
    for (const std::size_t y : {1, 4}) EXPECT_TRUE(isInside(Interval(0.25, 0.5), values[y])) << toString(values[y]);
    for (const std::size_t z : {2, 5}) EXPECT_TRUE(isInside(Interval(0.0, 0.5), values[z])) << toString(values[z]);
  }
  known = recorded(crates, 0, 1);
  EXPECT_LE(width(known[0]), 1e-12);
  EXPECT_LE(width(known[3]), 1e-12);
  for (const std::size_t k : {1, 2, 4, 5}) EXPECT_LE(width(known[k]), 0.75) << toString(known[k]);
}

/// Nearly parallel, and turned so little that rounding could tell nothing of it.
TEST_F(NearestPoints, OfRodsAtAnyAngleAreEnclosed) {
  for (int i = 0; i < 400; ++i) {
    const double angle = std::exp2(-30 * std::abs(number()));
    const Standing one{Kind::rod, {{0, 0, -1}, {0, 0, 1}}, 0.125};
    const Standing other{Kind::rod,
                         {{0, 0, -0.75}, {0, 0, 0.75}},
                         0.25,
                         {1, angle * number(), angle * number(), 0},
                         {1 + number(0.2), number(0.5), number(1.2)}};
    const Nearest cores = nearestOf(one.exact(0), other.exact(0));
    const Exact apart = sqrt(cores.square());
    const Point direction = plus({0, 0, 0}, minus(cores.other, cores.one), 1 / apart);
    const Point from = plus(cores.one, direction, one.radius), to = plus(cores.other, direction, -other.radius);
    const Mechanism m = slidingPair(one, other);
    for (const std::vector<Interval>& values : {recorded(m, 0, 1), direct(m, 0, 1)})
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_TRUE(holds(values[k], from[k])) << i << ": " << toString(values[k]) << " without " << from[k];
        ASSERT_TRUE(holds(values[3 + k], to[k])) << i << ": " << toString(values[3 + k]) << " without " << to[k];
        ASSERT_LE(width(values[k]), 2.6);
      }
  }
}

/// Boxes in planes, and a rod through a plate: bounds hold what is in both.
TEST_F(NearestPoints, OfSolidsThatOverlapAreAnywhereInBoth) {
  const Standing plate{Kind::crate, {{-2, -2, -0.125}, {2, 2, 0.125}}},
      pole{Kind::crate, {{-0.25, -0.25, -2}, {0.25, 0.25, 2}}, 0, {3, 1, 0, 0}, {0.5, 0, 0}};
  const Mechanism m = slidingPair(plate, pole);
  for (const std::vector<Interval>& values : {recorded(m, 0, 1), direct(m, 0, 1)})
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(contains(values[k], k == 0 ? 0.5 : 0.0)) << toString(values[k]);
}

}  // namespace
}  // namespace gamut::nearest_points_test
