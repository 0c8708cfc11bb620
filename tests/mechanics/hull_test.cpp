// Convex polyhedra: what the hull of points is, and distances from it against those of all combinations of points, in a
// hundred digits. The difference of two hulls is that of the differences of their points, and its least vector is that
// of three of them, or zero, which then is in the simplex of four (C. Carathéodory): no tolerance.
#include "mechanics/elements/hull.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <optional>
#include <random>

#include "mechanics/assembly.hpp"
#include "mechanics/elements/all.hpp"
#include "mechanics/model.hpp"
#include "mechanics/polyhedron.hpp"
#include "mechanics/skeleton.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut::hull_test {
namespace {

using Exact = boost::multiprecision::cpp_bin_float_100;
using Point = std::array<Exact, 3>;
using Points = std::vector<Point>;

Exact dot(const Point& x, const Point& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
Point minus(const Point& x, const Point& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }
Point plus(const Point& x, const Point& y, const Exact& s) {
  return {x[0] + s * y[0], x[1] + s * y[1], x[2] + s * y[2]};
}
Point cross(const Point& x, const Point& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
const Exact nothing("1e-80");

/// Of the least vector of the hull; of a hull of differences that of two hulls.
Exact leastNorm(const Points& all) {
  Exact least = dot(all[0], all[0]);
  const auto take = [&](const Point& x) { least = std::min(least, dot(x, x)); };
  const std::size_t n = all.size();
  for (std::size_t i = 0; i < n; ++i) {
    take(all[i]);
    for (std::size_t j = i + 1; j < n; ++j) {
      const Point a = minus(all[j], all[i]);
      const Exact size = dot(a, a);
      if (size < nothing) continue;
      if (const Exact s = -dot(all[i], a) / size; s > 0 && s < 1) take(plus(all[i], a, s));
      for (std::size_t k = j + 1; k < n; ++k) {
        const Point b = minus(all[k], all[i]), normal = cross(a, b);
        const Exact area = dot(normal, normal);
        if (area < nothing) continue;
        const Point foot = plus({0, 0, 0}, normal, dot(all[i], normal) / area), y = minus(foot, all[i]);
        const Exact s = dot(cross(y, b), normal) / area, t = dot(cross(a, y), normal) / area;
        if (s > 0 && t > 0 && s + t < 1) take(foot);
        for (std::size_t l = k + 1; l < n; ++l) {
          const Exact volume = dot(normal, minus(all[l], all[i]));
          if (abs(volume) < nothing) continue;
          const auto isInside = [&](const Point& p, const Point& q, const Point& r, const Point& far) {
            const Point plane = cross(minus(q, p), minus(r, p));
            return dot(plane, p) * dot(plane, minus(p, far)) >= 0;  // zero lies on the side of `far`
          };
          if (isInside(all[i], all[j], all[k], all[l]) && isInside(all[i], all[j], all[l], all[k]) &&
              isInside(all[i], all[k], all[l], all[j]) && isInside(all[j], all[k], all[l], all[i]))
            return 0;
        }
      }
    }
  }
  return sqrt(least);
}

/// How deep zero lies in the hull.
Exact depth(const Points& all) {
  Exact least = 1e9;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      for (std::size_t k = j + 1; k < all.size(); ++k) {
        const Point normal = cross(minus(all[j], all[i]), minus(all[k], all[i]));
        const auto side = [&](const Point& x) { return dot(normal, minus(x, all[i])); };
        const auto above = std::ranges::count_if(all, [&](const Point&x) { return side(x) > nothing; }),
                   below = std::ranges::count_if(all, [&](const Point&x) { return side(x) < -nothing; });
        if ((above == 0) != (below == 0))
          least = std::min(least, Exact(abs(side({0, 0, 0})) / sqrt(dot(normal, normal))));
      }
  return least;
}

Exact distanceOf(const Points& one, const Points& other) {
  Points differences;
  for (const Point& x : one)
    for (const Point& y : other) differences.push_back(minus(x, y));
  return leastNorm(differences);
}

/// A shape's points, and how it stands.
struct Standing {
  std::vector<std::array<double, 3>> points;
  std::array<double, 4> turn{1, 0, 0, 0};  // a quaternion of any length
  std::array<double, 3> place{};

  Points exact() const {
    const Exact w = turn[0], x = turn[1], y = turn[2], z = turn[3], n = w * w + x * x + y * y + z * z;
    const std::array<Point, 3> rows = {
        Point{(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n},
        Point{2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n},
        Point{2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n}};
    Points all;
    for (const auto& p : points) {
      const Point own{p[0], p[1], p[2]};
      all.push_back({place[0] + dot(rows[0], own), place[1] + dot(rows[1], own), place[2] + dot(rows[2], own)});
    }
    return all;
  }
  /// On a frame of its own: a box of this size, or the hull of the points.
  void addTo(Mechanism& m, const std::string& name, const std::optional<std::array<double, 3>>& size = {}) const {
    const Quaternion<Expression> quaternion{turn[0], turn[1], turn[2], turn[3]};
    m.add(Link{name + "_link",
               "inertial",
               name + "_frame",
               {place[0], place[1], place[2]},
               {{axisX, 0, 0.0, "", quaternion}}});
    std::vector<ExpressionVector> corners;
    for (const auto& p : points) corners.push_back({p[0], p[1], p[2]});
    if (size)
      m.add(Cuboid{name, name + "_frame", {(*size)[0], (*size)[1], (*size)[2]}});
    else if (points.size() == 1)
      m.add(Sphere{name, name + "_frame", 0.0});
    else if (points.size() == 2)
      m.add(Capsule{name, name + "_frame", 0.0, points[0][2] - points[1][2], axisZ});
    else
      m.add(Hull{name, name + "_frame", corners});
  }
};

std::vector<std::array<double, 3>> cornersOf(const std::array<double, 3>& size) {
  std::vector<std::array<double, 3>> corners;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5}) corners.push_back({x * size[0], y * size[1], z * size[2]});
  return corners;
}

Interval enclosed(const Mechanism& m) {
  return Evaluator<Interval>(recordOutputs(m, {}, {"apart.distance"}))(Interval(0.0), {Interval(0.0)})[0];
}
bool holdsExactly(const Interval& x, const Exact& value) {
  return Exact(x.lower()) <= value && value <= Exact(x.upper());
}

Polyhedron hullOf(const std::vector<std::array<double, 3>>& points) {
  std::vector<Polyhedron::Point> exact;
  for (const auto& p : points) exact.push_back({p[0], p[1], p[2]});
  return Polyhedron(exact);
}

// ---- The hull -------------------------------------------------------------------------------------------------------

TEST(Polyhedron, HasTheCornersEdgesAndFacesOfItsHull) {
  auto cube = cornersOf({2, 2, 2});
  for (const std::array<double, 3>& besides : std::vector<std::array<double, 3>>{
           {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {0.5, -0.5, -1}})  // inside, on a face, on an edge, once more
    cube.push_back(besides);
  const Polyhedron box = hullOf(cube);
  EXPECT_EQ(box.corners().size(), 8U);
  EXPECT_EQ(box.edges().size(), 12U);
  EXPECT_EQ(box.faces().size(), 6U);
  EXPECT_EQ(box.directions().size(), 3U);
  EXPECT_EQ(box.normals().size(), 3U);
  EXPECT_DOUBLE_EQ(box.spread(), 2);
  for (const auto& face : box.faces()) {
    EXPECT_TRUE(isEqual(face.offset, Interval(1.0)));
    EXPECT_EQ(face.sides.size(), 4U);
  }
  const Polyhedron octahedron = hullOf({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  EXPECT_EQ(octahedron.edges().size(), 12U);
  EXPECT_EQ(octahedron.faces().size(), 8U);
  EXPECT_EQ(octahedron.normals().size(), 4U);
  EXPECT_NEAR(octahedron.spread(), 4, 1e-12);  // angles of 60 degrees
  EXPECT_TRUE(hullOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {3, 2, 0}}).faces().empty());
  EXPECT_TRUE(hullOf({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).faces().empty());
}

/// Of any points: all are behind all faces, and V - E + F = 2.
TEST(Polyhedron, OfAnyPointsIsClosedAndHoldsThem) {
  std::mt19937 random(3);
  for (int i = 0; i < 20; ++i) {
    std::uniform_int_distribution<int> grid(-3, 3);  // many in one plane
    std::vector<std::array<double, 3>> points;
    for (int k = 0; k < 4 + i; ++k) points.push_back({0.25 * grid(random), 0.125 * grid(random), 0.5 * grid(random)});
    const Polyhedron hull = hullOf(points);
    if (hull.faces().empty()) continue;
    EXPECT_EQ(hull.corners().size() + hull.faces().size(), hull.edges().size() + 2);
    std::size_t sides = 0;
    for (const auto& face : hull.faces()) {
      sides += face.sides.size();
      for (const auto& p : points) {
        Interval height = -face.offset;
        for (std::size_t k = 0; k < 3; ++k) height = height + face.normal[k] * Interval(p[k]);
        EXPECT_LE(height.lower(), 0);
      }
    }
    EXPECT_EQ(sides, 2 * hull.edges().size());
  }
}

// ---- Distances ------------------------------------------------------------------------------------------------------

class Hulls : public ::testing::Test {
 protected:
  double number(double most = 1) { return std::uniform_real_distribution<double>(-most, most)(random_); }
  Standing any(std::size_t points, double far) {
    Standing one{{}, {number(), number(), number(), number()}, {number(far), number(far), number(far)}};
    for (std::size_t i = 0; i < points; ++i) one.points.push_back({number(), number(), number()});
    if (points == 1) one.points = {{0, 0, 0}};
    if (points == 2) {
      const double half = std::abs(number());
      one.points = {{0, 0, half}, {0, 0, -half}};
    }
    return one;
  }
  std::mt19937 random_{11};
};

TEST_F(Hulls, AreAsFarFromAllShapesAsTheirNearestPoints) {
  double widest = 0;
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 48; ++i) {
    const std::size_t kind = static_cast<std::size_t>(i) % 4;
    const Standing hull = any(i % 8 < 6 ? 4 : 6, 0.5);
    Standing other = any(std::array<std::size_t, 4>{1, 2, 4, 1}[kind], i % 12 < 4 ? 0.3 : 1.7);
    std::optional<std::array<double, 3>> size;
    if (kind == 3) {
      size = {1 + number(), 1 + number(), 1 + number()};
      other.points = cornersOf(*size);
    }
    Mechanism m;
    m.add(State{"x"});
    hull.addTo(m, "one");
    other.addTo(m, "other", size);
    m.add(i % 2 == 0 ? Separation{"apart", "one", "other"} : Separation{"apart", "other", "one"});
    Exact exact = distanceOf(hull.exact(), other.exact());
    if (kind == 0 && exact == 0) {
      Points seen = hull.exact();
      for (Point& x : seen) x = minus(x, other.exact()[0]);
      exact = -depth(seen);
    }
    const Interval recorded = enclosed(m), found = Assembly<Interval>(m).output("apart.distance");
    ASSERT_TRUE(holdsExactly(found, exact)) << i << ": " << toString(found) << " without " << exact;
    ASSERT_TRUE(holdsExactly(recorded, exact)) << i << ": " << toString(recorded) << " without " << exact;
    ASSERT_NEAR(Evaluator<double>(recordOutputs(m, {}, {"apart.distance"}))(0, {0})[0], static_cast<double>(exact),
                1e-9)
        << i;
    if (exact <= 0 || exact > 1e-3) widest = std::max(widest, width(found));
    ++(exact > 0 ? apart : overlapping);
  }
  EXPECT_LE(widest, 1e-10);
  EXPECT_GE(std::min(apart, overlapping), 8);
}

/// A sliver, of a thickness t that is lost beside its length: distances from it, and 1/sin²(a/2) of its sharpest angle,
/// with tan a = t/√(1 + t²).
TEST_F(Hulls, MayBeThin) {
  for (const double thickness : {1e-3, 0x1p-24, 1e-9, 1e-14, 1e-30}) {
    const Standing thin{{{0, 0, 0}, {1, 0, 0}, {1, thickness, 0}, {0, 0, thickness}}, {1, 0, 0, 0}, {0, 0, 0}};
    Standing ball{{{0, 0, 0}}, {1, 0, 0, 0}, {0.5, 0.25, 0.125}};
    Mechanism m;
    m.add(State{"x"});
    thin.addTo(m, "one");
    ball.addTo(m, "other");
    m.add(Separation{"apart", "one", "other"});
    EXPECT_TRUE(m.faults(m.elements()[2], {}).empty()) << thickness;
    const Exact exact = distanceOf(thin.exact(), ball.exact());
    const Interval found = Assembly<Interval>(m).output("apart.distance");
    EXPECT_TRUE(holdsExactly(found, exact)) << thickness << ": " << toString(found);
    EXPECT_TRUE(holdsExactly(enclosed(m), exact)) << thickness;
    const Exact t = thickness, cosine = sqrt((1 + t * t) / (1 + 2 * t * t)), spread = 2 / (1 - cosine);
    const double told = hullOf(thin.points).spread();
    EXPECT_GE(Exact(told), spread) << thickness;
    EXPECT_LE(Exact(told), spread * (1 + Exact("1e-12"))) << thickness;
  }
}

/// A box is the hull of its corners.
TEST_F(Hulls, OfABoxsCornersAreTheBox) {
  for (int i = 0; i < 40; ++i) {
    const std::array<double, 3> size{1 + number(), 1 + number(), 1 + number()}, second{1 + number(), 1 + number(), 1};
    Standing box = any(0, 1), other = any(0, 1);
    box.points = cornersOf(size);
    other.points = cornersOf(second);
    std::array<Interval, 2> found;
    for (const bool isHull : {false, true}) {
      Mechanism m;
      m.add(State{"x"});
      box.addTo(m, "one", isHull ? std::nullopt : std::optional(size));
      other.addTo(m, "other", second);
      m.add(Separation{"apart", "one", "other"});
      found[isHull ? 1 : 0] = Assembly<Interval>(m).output("apart.distance");
    }
    EXPECT_FALSE(isDisjoint(found[0], found[1])) << i;
    EXPECT_LE(width(hull(found[0], found[1])), 1e-10) << i << ": " << toString(found[0]) << toString(found[1]);
  }
}

TEST(Hull, IsDrawnByItsEdges) {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "A", axisY});
  m.add(Mass{"bob", "A", 1.0, {0.0, 0.0, -0.5}});
  m.add(Hull{"wedge", "A", {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, 0.125});
  const Skeleton skeleton = skeletonOf(m);
  EXPECT_EQ(std::ranges::count(skeleton.parts, Skeleton::Kind::shape, &Skeleton::Part::kind), 6);
}

TEST(Hull, RefusesWhatIsNone) {
  const auto faultsOf = [](const Hull& hull) {
    Mechanism m;
    m.add(hull);
    return m.faults(m.elements()[0], {});
  };
  const std::vector<ExpressionVector> flat = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 1.0, 0.0}};
  ASSERT_EQ(faultsOf(Hull{"hull", "inertial", flat}).size(), 1U);
  EXPECT_EQ(faultsOf(Hull{"hull", "inertial", flat})[0].key, "points");
  std::vector<ExpressionVector> solid = flat;
  solid.push_back({0.0, 0.0, 1.0});
  EXPECT_TRUE(faultsOf(Hull{"hull", "inertial", solid}).empty());
  EXPECT_EQ(faultsOf(Hull{"hull", "inertial", solid, -1.0}).size(), 1U);
  EXPECT_EQ(faultsOf(Hull{"hull", "inertial", std::vector<ExpressionVector>(41, solid[0])}).size(), 1U);
  std::vector<ExpressionVector> sliver = flat;
  sliver[3] = {1.0, 1e-200, 1e-200};
  EXPECT_EQ(faultsOf(Hull{"hull", "inertial", sliver}).size(), 1U);
  solid[1][0] = Expression::named("length");
  EXPECT_EQ(faultsOf(Hull{"hull", "inertial", solid}).size(), 1U);
}

}  // namespace
}  // namespace gamut::hull_test
