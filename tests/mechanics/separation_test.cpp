// Distances of shapes against closed forms, and against the nearest points of segments found by clamping, in a hundred
// digits (C. Ericson, Exact-Time Collision Detection, 2005, section 5.1.9): no tolerance.
#include "mechanics/elements/separation.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <random>

#include "mechanics/assembly.hpp"
#include "mechanics/elements/all.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using Exact = boost::multiprecision::cpp_bin_float_100;
using ExactVector = std::array<Exact, 3>;
using Triple = std::array<double, 3>;

Exact exactDot(const ExactVector& x, const ExactVector& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
ExactVector movedAlong(const ExactVector& x, const ExactVector& y, const Exact& s) {
  return {x[0] + s * y[0], x[1] + s * y[1], x[2] + s * y[2]};
}
Exact exactlyClamped(const Exact& s, const Exact& most) { return s < -most ? Exact(-most) : s > most ? most : s; }

struct StraightRod {
  Triple middle, direction;
  double radius = 0, length = 0;

  ExactVector centre() const { return {middle[0], middle[1], middle[2]}; }
  ExactVector unit() const {
    const ExactVector d{direction[0], direction[1], direction[2]};
    const Exact size = sqrt(exactDot(d, d));
    return {d[0] / size, d[1] / size, d[2] / size};
  }
  Exact half() const { return Exact(length) / 2; }
  Capsule capsule(const std::string& name) const {
    return {name,
            "inertial",
            radius,
            length,
            Axis(direction[0], direction[1], direction[2]),
            {middle[0], middle[1], middle[2]}};
  }
};

Exact distanceOf(const StraightRod& one, const StraightRod& other) {
  const ExactVector a = one.unit(), b = other.unit(), w = movedAlong(one.centre(), other.centre(), Exact(-1));
  const Exact g = exactDot(a, b), size = 1 - g * g;
  Exact s = size > Exact("1e-60") ? exactlyClamped((g * exactDot(b, w) - exactDot(a, w)) / size, one.half()) : Exact(0);
  const Exact t = exactlyClamped(exactDot(b, w) + g * s, other.half());
  s = exactlyClamped(g * t - exactDot(a, w), one.half());
  const ExactVector d = movedAlong(movedAlong(w, a, s), b, -t);
  return sqrt(exactDot(d, d)) - one.radius - other.radius;
}

Mechanism pairOf(const Described& one, const Described& other) {
  Mechanism m;
  m.add(State{"x"});
  m.add(one);
  m.add(other);
  m.add(Separation{"apart", one.name(), other.name()});
  return m;
}

Interval enclosedDistance(const Mechanism& m) { return Assembly<Interval>(m).output("apart.distance"); }
Interval enclosedDistance(const StraightRod& one, const StraightRod& other) {
  return enclosedDistance(pairOf(one.capsule("one"), other.capsule("other")));
}

/// Of what is recorded, as studies are.
Interval recordedDistance(const Mechanism& m) {
  return Evaluator<Interval>(recordOutputs(m, {}, {"apart.distance"}))(Interval(0.0), {Interval(0.0)})[0];
}

bool holdsExactly(const Interval& x, const Exact& value) {
  return Exact(x.lower()) <= value && value <= Exact(x.upper());
}

// ---- Closed forms ---------------------------------------------------------------------------------------------------

TEST(Separation, OfSpheresIsThatOfTheirCentresWithoutTheirRadii) {
  const Mechanism m =
      pairOf(Sphere{"one", "inertial", 0.25, {1.0, 2.0, 0.0}}, Sphere{"other", "inertial", 0.5, {4.0, 6.0, 0.0}});
  EXPECT_TRUE(isEqual(enclosedDistance(m), Interval(4.25)));
  EXPECT_EQ(Assembly<double>(m).output("apart.distance"), 4.25);
  const Mechanism same = pairOf(Sphere{"one", "inertial", 0.25}, Sphere{"other", "inertial", 0.5});
  EXPECT_TRUE(isEqual(enclosedDistance(same), Interval(-0.75))) << "one in the other";
}

/// Segments for which the distance is a double, and so are all that lead to it.
TEST(Separation, OfCapsulesIsExactWhereAllNumbersAre) {
  const Triple x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const struct {
    const char* what;
    StraightRod one, other;
    double distance;
  } cases[] = {{"parallel, side by side", {{0, 0, 0}, x, 0.25, 2}, {{0.5, 3, 4}, x, 0.5, 4}, 4.25},
               {"parallel, opposed", {{0, 0, 0}, x, 0.25, 2}, {{0.5, 3, 4}, {-1, 0, 0}, 0.5, 4}, 4.25},
               {"parallel, one behind the other", {{0, 0, 0}, x, 0, 2}, {{6, 3, 0}, x, 0, 2}, 5},
               {"on one line", {{0, 0, 0}, z, 0.25, 2}, {{0, 0, 5}, z, 0.25, 4}, 1.5},
               {"on one line, overlapping", {{0, 0, 0}, z, 0.25, 2}, {{0, 0, 1}, z, 0.25, 4}, -0.5},
               {"one within the other", {{0, 0, 0}, z, 0.25, 8}, {{0, 0, 1}, z, 0.125, 2}, -0.375},
               {"the same", {{1, 2, 3}, y, 0.5, 2}, {{1, 2, 3}, y, 0.5, 2}, -1},
               {"crossing", {{0, 0, 0}, x, 0.5, 4}, {{1, 0.5, 3}, y, 0.25, 4}, 2.25},
               {"crossing, through each other", {{0, 0, 0}, x, 0.5, 4}, {{1, 0.5, 0}, y, 0.25, 4}, -0.75},
               {"one beside the end of the other", {{0, 0, 0}, x, 0, 4}, {{6, 0, 3}, y, 0, 4}, 5},
               {"an end against the middle", {{0, 0, 0}, x, 0.5, 4}, {{0, 3, 0}, y, 0.5, 2}, 1},
               {"ends", {{0, 0, 0}, x, 0, 2}, {{4, 4 + 2, 0}, y, 0, 4}, 5},
               {"no length", {{0, 0, 0}, x, 0.5, 0}, {{0, 3, 4}, y, 0.5, 0}, 4},
               {"no length, against the middle", {{0, 0, 0}, x, 0.5, 4}, {{1, 3, 4}, y, 0.5, 0}, 4},
               {"no length, in the middle", {{0, 0, 0}, x, 0.5, 4}, {{1, 0, 0}, y, 0.5, 0}, -1}};
  for (const auto& [what, one, other, distance] : cases)
    for (const bool isSwapped : {false, true}) {
      const StraightRod &first = isSwapped ? other : one, &second = isSwapped ? one : other;
      EXPECT_EQ(distanceOf(first, second), distance) << what;
      EXPECT_TRUE(isEqual(enclosedDistance(first, second), Interval(distance)))
          << what << ": " << toString(enclosedDistance(first, second));
      const Mechanism m = pairOf(first.capsule("one"), second.capsule("other"));
      EXPECT_EQ(Assembly<double>(m).output("apart.distance"), distance) << what;
      EXPECT_EQ(Evaluator<double>(recordOutputs(m, {}, {"apart.distance"}))(0, {0})[0], distance) << what;
    }
}

TEST(Separation, FromABoxIsThatFromItsNearestPoint) {
  const struct {
    const char* what;
    ExpressionVector centre;
    double distance;
  } cases[] = {{"before a face", {5.0, 0.5, -1.0}, 3.75},      {"before an edge", {4.0, 6.0, 1.0}, 4.75},
               {"before a corner", {2.0, 4.0, 5.0}, 2.75},     {"inside", {0.5, 1.75, 0.0}, -0.5},
               {"in the middle", {0.0, 0.0, 0.0}, -1.25},      {"on a face", {-1.0, 0.0, 0.0}, -0.25},
               {"before another face", {0.0, -4.0, 0.0}, 1.75}};
  for (const auto& [what, centre, distance] : cases)
    for (const bool isSwapped : {false, true}) {
      const Described box = Cuboid{"box", "inertial", {2.0, 4.0, 6.0}}, ball = Sphere{"ball", "inertial", 0.25, centre};
      const Mechanism m = isSwapped ? pairOf(ball, box) : pairOf(box, ball);
      EXPECT_TRUE(isEqual(enclosedDistance(m), Interval(distance))) << what << ": " << toString(enclosedDistance(m));
      EXPECT_EQ(Assembly<double>(m).output("apart.distance"), distance) << what;
    }
  Mechanism turned;  // a quarter turn, and a frame that is no shape
  turned.add(State{"x"});
  turned.add(Cuboid{"box", "inertial", {2.0, 4.0, 6.0}, {1.0, 0.0, 0.0}, {{axisZ, 1, 0.0}}});
  turned.add(Link{"arm", "inertial", "tip", {7.0, 4.0, 0.0}});
  turned.add(Separation{"apart", "tip", "box"});
  EXPECT_TRUE(isEqual(enclosedDistance(turned), Interval(5.0)));
}

/// Found where the slope of the square, which rises, changes its sign.
Exact distanceFromBox(const ExactVector& x, const ExactVector& a, const Exact& half, const Triple& size) {
  const auto beyond = [&](const ExactVector& y, std::size_t i) {
    const Exact h = Exact(size[i]) / 2;
    return y[i] > h ? Exact(y[i] - h) : y[i] < -h ? Exact(y[i] + h) : Exact(0);
  };
  Exact low = -half, high = half;
  for (int halving = 0; halving < 340; ++halving) {
    const Exact s = (low + high) / 2;
    const ExactVector y = movedAlong(x, a, s);
    Exact slope = 0;
    for (std::size_t i = 0; i < 3; ++i) slope += a[i] * beyond(y, i);
    (slope < 0 ? low : high) = s;
  }
  const ExactVector y = movedAlong(x, a, low), d{beyond(y, 0), beyond(y, 1), beyond(y, 2)};
  const Exact apart = sqrt(exactDot(d, d));
  return apart < Exact("1e-60") ? Exact(0) : apart;  // it comes in, but for the last digits of s
}
Exact distanceFromBox(const StraightRod& rod, const Triple& size) {
  return distanceFromBox(rod.centre(), rod.unit(), rod.half(), size) - rod.radius;
}

TEST(Separation, OfACapsuleFromABoxIsExactWhereAllNumbersAre) {
  const Triple x{1, 0, 0}, z{0, 0, 1}, size{2, 4, 6};
  const struct {
    const char* what;
    StraightRod rod;
    double distance;
  } cases[] = {{"along a face", {{4, 0, 0}, z, 0.25, 2}, 2.75},
               {"along an edge", {{4, 6, 0}, z, 0.25, 2}, 4.75},
               {"an end before a face", {{5, 1, 1}, x, 0.5, 4}, 1.5},
               {"an end before an edge", {{6, 6, 0}, x, 0, 4}, 5},
               {"beside, beyond the box", {{4, 0, 8}, z, 0.25, 2}, 4.75},
               {"across an edge", {{0, 5, 7}, x, 0.5, 8}, 4.5},
               {"through two faces", {{0, 0, 0}, x, 0.5, 8}, -0.5},
               {"inside", {{0, 0, 0}, x, 0.5, 1}, -0.5},
               {"no length", {{4, 6, 0}, x, 0.5, 0}, 4.5}};
  for (const auto& [what, rod, distance] : cases) {
    const Mechanism m = pairOf(rod.capsule("rod"), Cuboid{"box", "inertial", {2.0, 4.0, 6.0}});
    EXPECT_NEAR(Assembly<double>(m).output("apart.distance"), distance, 1e-15) << what;
    EXPECT_TRUE(contains(enclosedDistance(m), distance)) << what;
    EXPECT_TRUE(contains(recordedDistance(m), distance)) << what;
    EXPECT_LE(width(recordedDistance(m)), 1e-15) << what;
    EXPECT_LE(abs(distanceFromBox(rod, size) - distance), Exact(1e-15)) << what;
  }
}

// ---- Two boxes ------------------------------------------------------------------------------------------------------

struct ExactBox {
  ExactVector middle;
  std::array<ExactVector, 3> axes;
  Triple size;
};

/// Of all edges of either the least distance from the other, by bisection: where boxes overlap, an edge of one comes
/// into the other.
Exact distanceOf(const ExactBox& one, const ExactBox& other) {
  Exact least = 1e9;
  for (const bool isSwapped : {false, true}) {
    const ExactBox &edged = isSwapped ? other : one, &solid = isSwapped ? one : other;
    for (std::size_t along = 0; along < 3; ++along)
      for (const unsigned sides : {0U, 1U, 2U, 3U}) {
        ExactVector middle = movedAlong(edged.middle, solid.middle, Exact(-1)), x, a;
        for (std::size_t k = 1; k < 3; ++k)
          middle = movedAlong(middle, edged.axes[(along + k) % 3],
                              Exact(edged.size[(along + k) % 3]) / ((sides >> (k - 1) & 1U) != 0 ? 2 : -2));
        for (std::size_t i = 0; i < 3; ++i)
          x[i] = exactDot(middle, solid.axes[i]), a[i] = exactDot(edged.axes[along], solid.axes[i]);
        least = std::min(least, distanceFromBox(x, a, Exact(edged.size[along]) / 2, solid.size));
      }
  }
  return least;
}

struct Crate {
  Triple middle{}, size{1, 1, 1};
  std::array<double, 4> turn{1, 0, 0, 0};  // a quaternion of any length

  Cuboid cuboid(const std::string& name) const {
    const Quaternion<Expression> quaternion{turn[0], turn[1], turn[2], turn[3]};
    return {name,
            "inertial",
            {size[0], size[1], size[2]},
            {middle[0], middle[1], middle[2]},
            {{axisX, 0, 0.0, "", quaternion}}};
  }
  ExactBox exact() const {
    const Exact w = turn[0], x = turn[1], y = turn[2], z = turn[3], n = w * w + x * x + y * y + z * z;
    return {{middle[0], middle[1], middle[2]},
            {ExactVector{(w * w + x * x - y * y - z * z) / n, 2 * (x * y + w * z) / n, 2 * (x * z - w * y) / n},
             ExactVector{2 * (x * y - w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z + w * x) / n},
             ExactVector{2 * (x * z + w * y) / n, 2 * (y * z - w * x) / n, (w * w - x * x - y * y + z * z) / n}},
            size};
  }
};

Mechanism pairOf(const Crate& one, const Crate& other) { return pairOf(one.cuboid("one"), other.cuboid("other")); }
/// Along the axes, turned by a quarter about one, or by the angle whose cosine is 3/5 or 4/5.
TEST(Separation, OfTwoBoxesHoldsWhatIsKnown) {
  const std::array<double, 4> along{1, 0, 0, 0}, quarter{1, 0, 0, 1}, turned{2, 0, 0, 1}, leaning{3, 1, 0, 0};
  const struct {
    const char* what;
    Crate one, other;
    double distance;
  } cases[] = {{"faces", {{0, 0, 0}, {2, 4, 6}}, {{5, 1, 1}, {2, 2, 2}, along}, 3},
               {"faces, of a quarter turn", {{0, 0, 0}, {2, 4, 6}}, {{0, 6, 0}, {2, 4, 6}, quarter}, 3},
               {"edges along each other", {{0, 0, 0}, {2, 2, 2}}, {{5, 6, 0}, {2, 2, 4}, along}, 5},
               {"corners", {{0, 0, 0}, {2, 2, 2}}, {{3, 4, 4}, {2, 2, 2}, along}, 3},
               {"touching faces", {{0, 0, 0}, {2, 2, 2}}, {{2, 0, 0}, {2, 2, 2}, along}, 0},
               {"touching edges", {{0, 0, 0}, {2, 2, 2}}, {{2, 2, 0}, {2, 2, 2}, along}, 0},
               {"touching corners", {{0, 0, 0}, {2, 2, 2}}, {{2, 2, 2}, {2, 2, 2}, along}, 0},
               {"a corner over an edge", {{0, 0, 0}, {2, 2, 2}}, {{1, 2, 5}, {2, 2, 2}, along}, 3},
               {"in the middle", {{0, 0, 0}, {2, 2, 2}}, {{0, 0, 0}, {1, 1, 1}, along}, 0},
               {"the same", {{0, 0, 0}, {2, 2, 2}}, {{0, 0, 0}, {2, 2, 2}, along}, 0},
               {"a rod through a plate", {{0, 0, 0}, {8, 8, 0.5}}, {{1, 1, 0}, {0.5, 0.5, 8}, along}, 0},
               {"a turned rod through it", {{0, 0, 0}, {8, 8, 0.5}}, {{1, 1, 0}, {0.5, 0.5, 8}, turned}, 0},
               {"a leaning rod through it", {{0, 0, 0}, {8, 8, 0.5}}, {{1, 1, 0}, {0.5, 0.5, 8}, leaning}, 0},
               {"no thickness", {{0, 0, 0}, {2, 2, 0}}, {{0, 0, 4}, {2, 2, 0}, along}, 4},
               {"no thickness, crossing", {{0, 0, 0}, {2, 2, 0}}, {{0, 0, 0}, {2, 0, 2}, along}, 0},
               {"points", {{0, 0, 0}, {0, 0, 0}}, {{0, 3, 4}, {0, 0, 0}, along}, 5},
               {"an edge before a face", {{0, 0, 0}, {2, 2, 2}}, {{7, 0, 0}, {5, 5, 2}, turned}, 2.5},
               {"tiny",
                {{0, 0, 0}, {0x1p-20, 0x1p-20, 0x1p-20}},
                {{0x1p-18, 0, 0}, {0x1p-20, 0x1p-20, 0x1p-20}, along},
                3 * 0x1p-20},
               {"far", {{0, 0, 0}, {2, 2, 2}}, {{0x1p20, 0, 0}, {2, 2, 2}, along}, 0x1p20 - 2}};
  for (const auto& [what, one, other, distance] : cases)
    for (const bool isSwapped : {false, true}) {
      const Crate &first = isSwapped ? other : one, &second = isSwapped ? one : other;
      EXPECT_LE(abs(distanceOf(first.exact(), second.exact()) - distance), Exact("1e-50")) << what;
      const Mechanism m = pairOf(first, second);
      const Interval direct = enclosedDistance(m), recorded = recordedDistance(m);
      EXPECT_TRUE(contains(direct, distance)) << what << ": " << toString(direct);
      EXPECT_TRUE(contains(recorded, distance)) << what << ": " << toString(recorded);
      if (distance > 0) {
        EXPECT_LE(width(direct), 1e-14 * distance) << what << ": " << toString(direct);
        EXPECT_LE(width(recorded), 1e-12 * distance) << what << ": " << toString(recorded);
      }
      EXPECT_NEAR(Assembly<double>(m).output("apart.distance"), distance, 1e-15 * distance) << what;
      EXPECT_NEAR(Evaluator<double>(recordOutputs(m, {}, {"apart.distance"}))(0, {0})[0], distance, 1e-15 * distance)
          << what;
    }
}

// ---- Any segments ---------------------------------------------------------------------------------------------------

class Segments : public ::testing::Test {
 protected:
  double number(double most = 1) { return std::uniform_real_distribution<double>(-most, most)(random_); }
  StraightRod rod(double size = 1) {
    return {{number(size), number(size), number(size)}, {number(), number(), number()}, 0.125, 1 + number()};
  }
  std::mt19937 random_{7};
};

TEST_F(Segments, AreAsFarApartAsTheirNearestPoints) {
  double widest = 0;
  for (int i = 0; i < 4000; ++i) {
    const StraightRod one = rod(), other = rod();
    const Exact exact = distanceOf(one, other);
    const Interval enclosed = enclosedDistance(one, other);
    ASSERT_TRUE(holdsExactly(enclosed, exact)) << i << ": " << toString(enclosed) << " without " << exact;
    if (exact + 0.25 > 1e-3) widest = std::max(widest, width(enclosed));
  }
  EXPECT_LE(widest, 1e-11);
}

/// From at right angles to hardly turned against each other: what is left out where they cross at a small angle.
TEST_F(Segments, ThatAreNearlyParallelAreEnclosed) {
  for (int i = 0; i < 2000; ++i) {
    StraightRod one = rod(0.1), other = one;
    const double turn = std::exp2(-20 * std::abs(number()));
    for (std::size_t k = 0; k < 3; ++k) {
      other.direction[k] += turn * number();
      other.middle[k] += (i % 2 == 0 ? 0.5 : turn) * number();
    }
    other.length = 1 + number();
    const Exact exact = distanceOf(one, other);
    const Interval enclosed = enclosedDistance(one, other);
    ASSERT_TRUE(holdsExactly(enclosed, exact)) << i << ": " << toString(enclosed) << " without " << exact;
    if (exact + 0.25 > 0.1) {
      ASSERT_LE(width(enclosed), 6.2e-4 * one.length * other.length);
    }
  }
}

/// Lengths and places in intervals: what holds for their values lies in what is said of all.
TEST_F(Segments, OfIntervalsHoldThoseOfTheirValues) {
  for (int i = 0; i < 300; ++i) {
    const StraightRod one = rod(), other = rod();
    const Mechanism m = pairOf(one.capsule("one"), other.capsule("other"));
    const std::vector<std::string> free = {"one.length", "other.radius", "one.centre.x", "other.centre.y"};
    const double spread = std::exp2(-8 * std::abs(number()));
    const auto about = [&](double value) {
      return Interval(value - spread * std::abs(value), value + spread * std::abs(value));
    };
    const std::vector<Interval> box = {about(one.length), about(other.radius), about(one.middle[0]),
                                       about(other.middle[1])};
    const Interval enclosed = Assembly<Interval>(m, free, box).output("apart.distance");
    for (int sample = 0; sample < 10; ++sample) {
      const auto in = [&](const Interval& x) {
        return std::clamp(x.lower() + (0.5 + 0.5 * number()) * (x.upper() - x.lower()), x.lower(), x.upper());
      };
      StraightRod first = one, second = other;
      first.length = in(box[0]), second.radius = in(box[1]), first.middle[0] = in(box[2]),
      second.middle[1] = in(box[3]);
      ASSERT_TRUE(holdsExactly(enclosed, distanceOf(first, second))) << i;
    }
  }
}

TEST_F(Segments, AreAsFarFromABoxAsTheirNearestPoints) {
  double widest = 0;
  for (int i = 0; i < 2000; ++i) {
    StraightRod one = rod(2);
    if (i % 4 == 0) one.direction[static_cast<std::size_t>(i / 4 % 3)] *= std::exp2(-40 * std::abs(number()));
    const Triple size{1 + number(), 1 + number(), 1 + number()};
    const Exact exact = distanceFromBox(one, size);
    const Mechanism m = pairOf(Cuboid{"box", "inertial", {size[0], size[1], size[2]}}, one.capsule("rod"));
    const Interval enclosed = enclosedDistance(m);
    ASSERT_TRUE(holdsExactly(enclosed, exact)) << i << ": " << toString(enclosed) << " without " << exact;
    ASSERT_NEAR(Assembly<double>(m).output("apart.distance"), static_cast<double>(exact), 1e-7) << i;
    if (exact + 0.125 > 1e-3) widest = std::max(widest, width(enclosed));
  }
  EXPECT_LE(widest, 1e-8);
}

/// What is recorded is the same number in every scalar, also where a plane is known to hold all of it.
TEST_F(Segments, AreMeasuredAlikeInEveryScalar) {
  for (const bool isPlanar : {false, true}) {
    Mechanism m;
    m.add(Revolute{"hinge", "inertial", "A", axisY, 0.3, 0.1});
    m.add(Link{"boom", "A", "B", {0.25, isPlanar ? 0.0 : 0.5, -1.0}});
    m.add(Revolute{"elbow", "B", "C", isPlanar ? axisY : axisX});
    m.add(Mass{"bob", "C", 1.0, {0.0, 0.0, -0.5}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}});
    m.add(Capsule{"one", "A", 0.125, 0.75, axisX, {0.0, 0.0, -0.5}});
    m.add(Capsule{"other", "C", 0.25, 0.5, axisZ, {0.0, 0.0, -0.25}});
    m.add(Separation{"apart", "other", "one"});
    const Program recorded = recordOutputs(m, {}, {"apart.distance"});
    for (int i = 0; i < 200; ++i) {
      const std::vector<double> x = {number(3), number(3), 0, 0};
      const auto valueIn = [&]<class S>(S /*scalar*/) {
        Assembly<S> assembly(m);
        assembly.setState(std::vector<S>(x.begin(), x.end()));
        return assembly.output("apart.distance");
      };
      const double value = valueIn(0.0);
      const Interval enclosed = valueIn(Interval(0.0)),
                     again = Evaluator<Interval>(recorded)(Interval(0.0), {x[0], x[1], 0, 0})[0];
      EXPECT_FALSE(isDisjoint(enclosed, again));
      if (value + 0.375 < 1e-3) continue;
      EXPECT_NEAR(midpoint(enclosed), value, 1e-5) << i;
      EXPECT_NEAR(Evaluator<double>(recorded)(0, x)[0], value, 1e-5);
      EXPECT_NEAR(valueIn(Samples(0.0))[0], value, 1e-12);
      EXPECT_NEAR(midpoint(valueIn(Fuzzy(0.0)).cut(0.0)), value, 1e-5);
    }
  }
}

// ---- Any boxes ------------------------------------------------------------------------------------------------------

class Boxes : public Segments {
 protected:
  Crate crate(double size) {
    Crate one{{number(size), number(size), number(size)}, {1 + number(), 1 + number(), 1 + number()}};
    for (double& part : one.turn) part = number();
    return one;
  }
};

TEST_F(Boxes, AreAsFarApartAsTheirNearestPoints) {
  double widest = 0;
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 200; ++i) {
    const Crate one = crate(1), other = crate(1.5);
    const Exact exact = distanceOf(one.exact(), other.exact());
    const Mechanism m = pairOf(one, other);
    const Interval enclosed = enclosedDistance(m);
    ASSERT_TRUE(holdsExactly(enclosed, exact)) << i << ": " << toString(enclosed) << " without " << exact;
    ASSERT_NEAR(Assembly<double>(m).output("apart.distance"), static_cast<double>(exact), 1e-9) << i;
    ++(exact > 0 ? apart : overlapping);
    if (exact == 0 || exact > 1e-3) widest = std::max(widest, width(enclosed));
  }
  EXPECT_LE(widest, 1e-11);
  EXPECT_GE(std::min(apart, overlapping), 50);
}

/// Hardly turned against each other, faces and edges along each other but for that.
TEST_F(Boxes, ThatAreNearlyParallelAreEnclosed) {
  for (int i = 0; i < 150; ++i) {
    const double turn = std::exp2(-26 * std::abs(number()));
    const Crate one{{0, 0, 0}, {1 + number(), 1 + number(), 1 + number()}};
    const Crate other{{number(2), number(2), i % 3 == 0 ? turn * number() : number(2)},
                      {1 + number(), 1 + number(), i % 3 == 0 ? one.size[2] : 1 + number()},
                      {1, turn * number(), turn * number(), turn * number()}};
    const Exact exact = distanceOf(one.exact(), other.exact());
    const Mechanism m = pairOf(one, other);
    const Interval enclosed = enclosedDistance(m);
    ASSERT_TRUE(holdsExactly(enclosed, exact)) << i << ": " << toString(enclosed) << " without " << exact;
    if (exact > 0.1) {
      ASSERT_LE(width(enclosed), 6.2e-4);  // lengths² leastSize/4/(2 distance)
    }
  }
}

/// Two arms about axes at right angles, far from parallel: thin as all else, and the same recorded.
TEST_F(Boxes, OnMovingArmsAreAsFarApartAsInClosedForm) {
  Mechanism m;
  m.add(Revolute{"one", "inertial", "A", axisY});
  m.add(Mass{"first", "A", 1.0, {0.0, 0.0, -0.5}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}});
  m.add(Cuboid{"left", "A", {0.125, 0.25, 1.0}, {0.0, 0.0, -0.5}});
  m.add(Link{"base", "inertial", "B", {0.5, 0.75, 0.25}});
  m.add(Revolute{"other", "B", "C", axisX});
  m.add(Mass{"second", "C", 1.0, {0.0, 0.0, -0.5}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}});
  m.add(Cuboid{"right", "C", {0.25, 0.125, 0.75}, {0.125, 0.0, -0.5}});
  m.add(Separation{"apart", "left", "right"});
  Evaluator<Interval> recorded(recordOutputs(m, {}, {"apart.distance"}));
  Evaluator<double> asNumber(recordOutputs(m, {}, {"apart.distance"}));
  for (int i = 0; i < 60; ++i) {
    const std::vector<double> x = {number(3), number(3), 0, 0};
    const Exact c = cos(Exact(x[0])), s = sin(Exact(x[0])), k = cos(Exact(x[1])), z = sin(Exact(x[1]));
    const ExactBox left{{-s / 2, 0, -c / 2}, {ExactVector{c, 0, -s}, {0, 1, 0}, {s, 0, c}}, {0.125, 0.25, 1}},
        right{{Exact(0.625), Exact(0.75) + z / 2, Exact(0.25) - k / 2},
              {ExactVector{1, 0, 0}, {0, k, z}, {0, -z, k}},
              {0.25, 0.125, 0.75}};
    const Exact exact = distanceOf(left, right);
    const Interval enclosed = recorded(Interval(0.0), {x[0], x[1], 0, 0})[0];
    ASSERT_TRUE(holdsExactly(enclosed, exact)) << i << ": " << toString(enclosed) << " without " << exact;
    if (exact > 0.01) {
      ASSERT_LE(width(enclosed), 1e-9) << i;
    }
    ASSERT_NEAR(asNumber(0, x)[0], static_cast<double>(exact), 1e-9) << i;
  }
}

// ---- What is refused ------------------------------------------------------------------------------------------------

TEST(Separation, RefusesLengthsBelowZero) {
  for (const Described& negative :
       {Described(Sphere{"shape", "inertial", -1.0}), Described(Capsule{"shape", "inertial", -1.0, 1.0}),
        Described(Capsule{"shape", "inertial", 1.0, -1.0}), Described(Cuboid{"shape", "inertial", {1.0, -1.0, 1.0}})}) {
    Mechanism one;
    one.add(negative);
    EXPECT_EQ(one.faults(one.elements()[0], {}).size(), 1U);
  }
}

}  // namespace
}  // namespace gamut
