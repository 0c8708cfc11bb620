// Studies of all postures of a mechanism: against closed forms and equations in 34 digits that know nothing of it, with
// tolerances, whole turns and limits, and what is refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "analyses/samples/arbiter.hpp"
#include "studies/analyses/postures.hpp"
#include "studies/machine.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/analyses/roots/six_joints.hpp"

namespace gamut::postures {
namespace {

using ::testing::HasSubstr;
using Number = Precise;
using Point = std::vector<Number>;
using testing::Turn;

const Number turn = 8 * atan(Number(1));

std::string element(const std::string& type, const std::string& name, const std::string& keys) {
  return "[[mechanism.element]]\ntype = \"" + type + "\"\nname = \"" + name + "\"\n" + keys + "\n";
}

std::string hinge(const std::string& name, const std::string& from, const std::string& to,
                  const std::string& axis = "z") {
  return element("revolute", name, "from = \"" + from + "\"\nto = \"" + to + "\"\naxis = \"" + axis + "\"");
}

std::string link(const std::string& name, const std::string& from, const std::string& to, const std::string& vector,
                 const std::string& rotation = "") {
  return element("link", name,
                 "from = \"" + from + "\"\nto = \"" + to + "\"\nvector = [" + vector + "]" +
                     (rotation.empty() ? "" : "\nrotation = " + rotation));
}

std::string uncertain(const std::string& quantity, const std::string& interval) {
  return "[[uncertain]]\nquantity = \"" + quantity + "\"\ninterval = \"" + interval + "\"\n";
}

std::string studyOf(const std::string& asked, const std::string& mechanism) {
  return "[study]\nanalysis = \"kinematics\"\ncompare = [\"interval\"]\n[postures]\n" + asked + "[mechanism]\n" +
         mechanism + "[[output]]\nquantity = \"tool.position.x\"\n";
}

const std::string atTarget = "frame = \"tool\"\ngoal = \"target\"\n";

Results runOf(const std::string& text) { return run(Machine(readStudyText(text, "s.toml")), {}); }

bool holds(const Interval& x, const Number& value) { return Number(x.lower()) <= value && value <= Number(x.upper()); }

/// In how many postures it lies, angles but for turns.
int postureOf(const PosturesResult& found, const Point& q, const std::vector<bool>& turns) {
  int many = 0;
  for (std::size_t k = 0; k < found.number.size(); ++k) {
    bool isThere = true;
    for (std::size_t i = 0; i < q.size(); ++i) {
      const Interval range(found.lower(k, i), found.upper(k, i));
      bool isHere = false;
      for (const int by : {-1, 0, 1}) isHere = isHere || ((by == 0 || turns[i]) && holds(range, q[i] + by * turn));
      isThere = isThere && isHere;
    }
    many += isThere ? 1 : 0;
  }
  return many;
}

/// Each of these is one posture, and they are all.
void expectAll(const PosturesResult& found, const std::vector<Point>& exact, const std::string& where) {
  EXPECT_TRUE(found.isComplete) << where << found.why;
  EXPECT_EQ(found.open, 0) << where;
  EXPECT_EQ(found.number.size(), exact.size()) << where;
  for (const Point& q : exact) EXPECT_EQ(postureOf(found, q, std::vector<bool>(q.size(), true)), 1) << where;
}

/// A share of each number's tolerance: corners, then inside.
std::vector<Point> sharesOf(std::size_t many, int count) {
  std::vector<Point> points;
  for (int k = 0; k < count; ++k) {
    Point point;
    for (std::size_t i = 0; i < many; ++i)
      point.emplace_back(k % 2 == 0 ? ((k / 2 >> i) % 2 == 0 ? -1.0 : 1.0)
                                    : ((37 * k + 11 * static_cast<int>(i)) % 64) / 32.0 - 1);
    points.push_back(point);
  }
  return points;
}

// ---- In the plane
// -----------------------------------------------------------------------------------------------------

std::string planar(const std::string& x, const std::string& y, const std::string& angle, const std::string& tolerance) {
  return "parameters = { a = \"0.5 m\", b = \"0.4 m\", c = \"0.2 m\" }\n" + hinge("A", "inertial", "K1") +
         link("l1", "K1", "E1", "\"a\", 0, 0") + hinge("B", "E1", "K2") + link("l2", "K2", "E2", "\"b\", 0, 0") +
         hinge("C", "E2", "K3") + link("l3", "K3", "tool", "\"c\", 0, 0") +
         link("goal", "inertial", "target", "\"" + x + "\", \"" + y + "\", 0",
              "[{ axis = \"z\", angle = \"" + angle + "\" }]") +
         uncertain("a", tolerance) + uncertain("b", tolerance) + uncertain("c", tolerance);
}

/// Both elbows.
std::vector<Point> elbows(const Point& lengths, const Number& x, const Number& y, const Number& angle) {
  std::vector<Point> found;
  const Number u = x - lengths[2] * cos(angle), v = y - lengths[2] * sin(angle);
  const Number c = (u * u + v * v - lengths[0] * lengths[0] - lengths[1] * lengths[1]) / (2 * lengths[0] * lengths[1]);
  if (abs(c) > 1) return found;
  for (const int side : {1, -1}) {
    const Number bend = side * acos(c);
    const Number first = atan2(v, u) - atan2(lengths[1] * sin(bend), lengths[0] + lengths[1] * cos(bend));
    found.push_back({first, bend, angle - first - bend});
  }
  for (Point& q : found)
    for (Number& each : q) each -= turn * round(each / turn);
  return found;
}

/// With angles that pass the seam of a turn, at and about straight on.
TEST(Postures, InThePlaneAreBothElbows) {
  for (const int degrees : {-180, -60, 0, 90, 170, 180})
    for (const double tolerance : {0.0, 0.1, 3.0}) {
      const std::string angle = std::to_string(degrees) + " deg",
                        text = tolerance == 0 ? "± 0.0001 %" : "± " + std::to_string(tolerance) + " %";
      const Results results = runOf(studyOf(atTarget, planar("0.6 m", "0.3 m", angle, text)));
      const PosturesResult& found = results.of<PosturesResult>();
      for (const Point& share : sharesOf(3, 24)) {
        const Number part = tolerance == 0 ? Number("0.000001") : Number(tolerance) / 100;
        const Point lengths{Number("0.5") * (1 + part * share[0]), Number("0.4") * (1 + part * share[1]),
                            Number("0.2") * (1 + part * share[2])};
        expectAll(found, elbows(lengths, Number("0.6"), Number("0.3"), turn * degrees / 360), angle + " " + text);
      }
    }
}

TEST(Postures, OutOfReachAreNone) {
  const Results results = runOf(studyOf(atTarget, planar("1.2 m", "0.3 m", "0", "± 1 %")));
  EXPECT_TRUE(results.of<PosturesResult>().isComplete);
  EXPECT_TRUE(results.of<PosturesResult>().number.empty());
}

/// Stretched out for some lengths, beyond reach for others: never said to be complete, and none is lost.
TEST(Postures, OnTheBorderOfReachAreLeftOpen) {
  const std::string arm = "parameters = { a = \"0.5 m\" }\n" + hinge("A", "inertial", "K1") +
                          link("l1", "K1", "E1", "\"a\", 0, 0") + hinge("B", "E1", "K2") +
                          link("l2", "K2", "tool", "\"0.4 m\", 0, 0") +
                          link("goal", "inertial", "target", "\"0.9 m\", 0, 0") + uncertain("a", "± 0.5 %");
  const Results results = runOf(studyOf(atTarget + "match = \"position\"\n", arm));
  const PosturesResult& found = results.of<PosturesResult>();
  EXPECT_FALSE(found.isComplete);
  EXPECT_GT(found.open, 0);
  EXPECT_FALSE(found.why.empty());
  EXPECT_TRUE(std::ranges::none_of(found.always, [](std::int64_t always) { return always != 0; }));
}

TEST(Postures, WithinLimitsAreThoseThere) {
  const std::string arm = planar("0.6 m", "0.3 m", "170 deg", "± 0.1 %");
  const Results one = runOf(studyOf(atTarget + "ranges = { B = [0, \"150 deg\"] }\n", arm));
  EXPECT_TRUE(one.of<PosturesResult>().isComplete);
  ASSERT_EQ(one.of<PosturesResult>().number.size(), 1);
  EXPECT_GT(one.of<PosturesResult>().lower(0, 1), 0);
  // The elbow bends by 0.7394 ± 0.004: there for some lengths.
  const Results some = runOf(studyOf(atTarget + "ranges = { B = [\"0.7394 rad\", \"150 deg\"] }\n", arm));
  EXPECT_FALSE(some.of<PosturesResult>().isComplete);
  EXPECT_EQ(some.of<PosturesResult>().always, (std::vector<std::int64_t>{0}));
  EXPECT_EQ(some.of<PosturesResult>().open, 0);
  const Results none = runOf(studyOf(atTarget + "angles = \"5 deg\"\n", arm));
  EXPECT_TRUE(none.of<PosturesResult>().isComplete);
  EXPECT_TRUE(none.of<PosturesResult>().number.empty());
}

// ---- In space
// -----------------------------------------------------------------------------------------------------------

/// The arm of tests/analyses/roots/six_joints.hpp.
std::string sixJoints(const std::array<std::string, 3>& place, const std::array<std::string, 4>& quaternion,
                      const std::string& tolerance) {
  std::string text = "parameters = { p0 = \"0.4318 m\", p1 = \"-0.0203 m\", p2 = \"0.4318 m\", p3 = \"0.1501 m\" }\n" +
                     hinge("J1", "inertial", "K1") + link("L1", "K1", "E1", "0, \"p3\", 0") +
                     hinge("J2", "E1", "K2", "y") + link("L2", "K2", "E2", "\"p0\", 0, 0") +
                     hinge("J3", "E2", "K3", "y") + link("L3", "K3", "E3", "\"p1\", 0, \"p2\"") +
                     hinge("J4", "E3", "K4") + hinge("J5", "K4", "K5", "y") + hinge("J6", "K5", "tool") +
                     link("goal", "inertial", "target", place[0] + ", " + place[1] + ", " + place[2],
                          "{ quaternion = [" + quaternion[0] + ", " + quaternion[1] + ", " + quaternion[2] + ", " +
                              quaternion[3] + "] }");
  for (const char* each : {"p0", "p1", "p2", "p3"}) text += uncertain(each, tolerance);
  return text;
}

TEST(Postures, OfAnArmOfSixJointsAreItsEight) {
  const std::array<std::string, 3> place{"0.52", "0.29", "0.31"};
  const std::array<std::string, 4> quaternion{"0.6", "-0.4", "0.5", "0.3"};
  for (const auto& [percent, text] : {std::pair{"0.0001", "± 0.0001 %"}, {"0.1", "± 0.1 %"}, {"0.5", "± 0.5 %"}}) {
    const Results results = runOf(studyOf(atTarget, sixJoints(place, quaternion, text)));
    for (const Point& share : sharesOf(4, 20)) {
      Point p{Number("0.4318"), Number("-0.0203"), Number("0.4318"), Number("0.1501")};
      for (std::size_t i = 0; i < 4; ++i) p[i] *= 1 + Number(percent) / 100 * share[i];
      for (const std::string& each : place) p.emplace_back(each);
      Number length(0);
      for (const std::string& each : quaternion) length += Number(each) * Number(each);
      for (const std::string& each : quaternion) p.emplace_back(Number(each) / sqrt(length));
      const std::vector<Point> exact = testing::posturesOf(p);
      ASSERT_EQ(exact.size(), 8);
      expectAll(results.of<PosturesResult>(), exact, text);
    }
  }
}

/// That of general form with sixteen postures (R. Manseur & K. L. Doty, International Journal of Robotics Research 8,
/// 1989), in the form of J. Denavit & R. Hartenberg.
struct Denavit {
  const char *a, *d, *degrees;
};
constexpr std::array<Denavit, 6> sixteen{
    {{"0.3", "0", "90"}, {"1", "0", "1"}, {"0", "0.2", "90"}, {"1.5", "0", "1"}, {"0", "0", "90"}, {"0", "0", "1"}}};
constexpr std::array<const char*, 3> there{"-1.140175", "0", "0"};
constexpr std::array<const char*, 4> turned{"0.2852214", "-0.1964304", "0.6470919", "0.6793289"};

std::string general(const std::string& tolerance) {
  std::string text = "parameters = { a1 = \"0.3 m\", a2 = \"1 m\", d3 = \"0.2 m\", a4 = \"1.5 m\" }\n",
              from = "inertial";
  for (int i = 1; i <= 6; ++i) {
    const std::string number = std::to_string(i), to = i == 6 ? "tool" : "K" + number;
    const auto [a, d, degrees] = sixteen[i - 1];
    text += hinge("J" + number, from, "T" + number) +
            link("L" + number, "T" + number, to,
                 (a == std::string("0") ? "0" : "\"a" + number + "\"") + std::string(", 0, ") +
                     (d == std::string("0") ? "0" : "\"d" + number + "\""),
                 "[{ axis = \"x\", angle = \"" + std::string(degrees) + " deg\" }]");
    from = to;
  }
  text += link(
      "goal", "inertial", "target", std::string(there[0]) + ", " + there[1] + ", " + there[2],
      "{ quaternion = [" + std::string(turned[0]) + ", " + turned[1] + ", " + turned[2] + ", " + turned[3] + "] }");
  for (const char* each : {"a1", "a2", "d3", "a4"}) text += uncertain(each, tolerance);
  return text;
}

/// Where the hand is at q, less where it shall be: three of place, the vector part of the turn that is left.
Point offAt(const Point& q, const Point& share, const Number& part) {
  Turn<Number> hand{1, 0, 0, 0};
  Point place{0, 0, 0};
  int quantity = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    hand = hand * Turn<Number>{cos(q[i] / 2), 0, 0, sin(q[i] / 2)};
    const auto length = [&](const char* text) {
      return std::string(text) == "0" ? Number(0) : Number(Number(text) * (1 + part * share[quantity++]));
    };
    const Number a = length(sixteen[i].a), d = length(sixteen[i].d);
    const Turn<Number> moved = hand * Turn<Number>{0, a, 0, d} * Turn<Number>{hand.w, -hand.x, -hand.y, -hand.z};
    place[0] += moved.x, place[1] += moved.y, place[2] += moved.z;
    const Number half = turn * Number(sixteen[i].degrees) / 720;
    hand = hand * Turn<Number>{cos(half), sin(half), 0, 0};
  }
  Number length(0);
  for (const char* each : turned) length += Number(each) * Number(each);
  const Turn<Number> goal{Number(turned[0]) / sqrt(length), -Number(turned[1]) / sqrt(length),
                          -Number(turned[2]) / sqrt(length), -Number(turned[3]) / sqrt(length)};
  const Turn<Number> left = goal * hand;
  return {
      place[0] - Number(there[0]), place[1] - Number(there[1]), place[2] - Number(there[2]), left.x, left.y, left.z};
}

/// Newton's method with differences, from the middle of a posture.
Point rootNear(Point q, const Point& share, const Number& part) {
  const Number step("1e-25");
  for (int k = 0; k < 12; ++k) {
    const Point off = offAt(q, share, part);
    std::array<std::array<Number, 7>, 6> a;
    for (std::size_t j = 0; j < 6; ++j) {
      Point beside = q;
      beside[j] += step;
      const Point moved = offAt(beside, share, part);
      for (std::size_t i = 0; i < 6; ++i) a[i][j] = (moved[i] - off[i]) / step;
    }
    for (std::size_t i = 0; i < 6; ++i) a[i][6] = off[i];
    for (std::size_t p = 0; p < 6; ++p) {
      std::size_t row = p;
      for (std::size_t i = p; i < 6; ++i)
        if (abs(a[i][p]) > abs(a[row][p])) row = i;
      std::swap(a[p], a[row]);
      for (std::size_t i = 0; i < 6; ++i)
        if (i != p) {
          const Number factor = a[i][p] / a[p][p];
          for (std::size_t l = p; l < 7; ++l) a[i][l] -= factor * a[p][l];
        }
    }
    for (std::size_t j = 0; j < 6; ++j) q[j] -= a[j][6] / a[j][j];
  }
  return q;
}

TEST(Postures, OfAnArmOfGeneralFormAreItsSixteen) {
  for (const auto& [percent, text] : {std::pair{"0.0001", "± 0.0001 %"}, {"0.1", "± 0.1 %"}}) {
    const Results results = runOf(studyOf(atTarget, general(text)));
    const PosturesResult& found = results.of<PosturesResult>();
    EXPECT_TRUE(found.isComplete) << found.why;
    EXPECT_EQ(found.number.size(), 16U);
    EXPECT_LT(found.cpu, 60);
    for (const Point& share : sharesOf(4, 6))
      for (std::size_t k = 0; k < found.number.size(); ++k) {
        Point q;
        for (std::size_t i = 0; i < 6; ++i) q.emplace_back((found.lower(k, i) + found.upper(k, i)) / 2);
        const Point root = rootNear(q, share, Number(percent) / 100);
        for (std::size_t i = 0; i < 6; ++i)
          EXPECT_TRUE(holds({found.lower(k, i), found.upper(k, i)}, root[i]))
              << k << ' ' << i << ' ' << root[i].str(20);
      }
  }
}

/// Four joints, with the tool's turn about the vertical alone.
TEST(Postures, OfFourJointsDropWhatNoJointChanges) {
  const std::string scara =
      "parameters = { a = \"325 mm\", b = \"225 mm\" }\n" + hinge("A", "inertial", "K1") +
      link("l1", "K1", "E1", "\"a\", 0, 0") + hinge("B", "E1", "K2") + link("l2", "K2", "E2", "\"b\", 0, 0") +
      element("prismatic", "lift", "from = \"E2\"\nto = \"K3\"\naxis = \"z\"") + hinge("D", "K3", "tool") +
      link("goal", "inertial", "target", "\"300 mm\", \"-150 mm\", \"-50 mm\"",
           "[{ axis = \"z\", angle = \"100 deg\" }]") +
      uncertain("a", "± 0.5 %") + uncertain("b", "± 0.5 %");
  const Results results = runOf(studyOf(atTarget + "displacements = \"200 mm\"\n", scara));
  for (const Point& share : sharesOf(2, 12)) {
    const Number x("0.3"), y("-0.15"), a = Number("0.325") * (1 + Number("0.005") * share[0]),
                                       b = Number("0.225") * (1 + Number("0.005") * share[1]);
    std::vector<Point> exact;
    for (const Point& q : elbows({a, b, 0}, x, y, turn * 100 / 360))
      exact.push_back({q[0], q[1], Number("-0.05"), q[2]});
    ASSERT_EQ(exact.size(), 2);
    expectAll(results.of<PosturesResult>(), exact, "four joints");
  }
}

/// Without the last joint, about the axis in which the tool points.
TEST(Postures, OfAnAxisLeaveItsTurnOpen) {
  const std::array<std::string, 3> place{"0.52", "0.29", "0.31"};
  const std::array<std::string, 4> quaternion{"0.6", "-0.4", "0.5", "0.3"};
  std::string arm = sixJoints(place, quaternion, "± 0.1 %");
  arm.replace(arm.find(hinge("J6", "K5", "tool")), hinge("J6", "K5", "tool").size(),
              link("L6", "K5", "tool", "0, 0, 0"));
  const Results results = runOf(studyOf(atTarget + "match = \"axis\"\n", arm));
  for (const Point& share : sharesOf(4, 20)) {
    Point p{Number("0.4318"), Number("-0.0203"), Number("0.4318"), Number("0.1501")};
    for (std::size_t i = 0; i < 4; ++i) p[i] *= 1 + share[i] / 1000;
    for (const std::string& each : place) p.emplace_back(each);
    Number length(0);
    for (const std::string& each : quaternion) length += Number(each) * Number(each);
    for (const std::string& each : quaternion) p.emplace_back(Number(each) / sqrt(length));
    std::vector<Point> exact = testing::posturesOf(p);
    for (Point& q : exact) q.pop_back();
    expectAll(results.of<PosturesResult>(), exact, "axis");
  }
}

/// A four-bar whose crank is driven: all ways to assemble it.
TEST(Postures, OfALoopAreAllItsAssemblies) {
  const std::string linkage =
      "parameters = { a = \"0.3 m\", b = \"0.8 m\", c = \"0.6 m\", d = \"0.9 m\" }\n" + hinge("A", "inertial", "K1") +
      element("drive", "motor", "joint = \"A\"\nposition = \"60 deg\"") + link("ab", "K1", "PB", "\"a\", 0, 0") +
      hinge("B", "PB", "K2") + link("bc", "K2", "C1", "\"b\", 0, 0") + link("ground", "inertial", "PD", "\"d\", 0, 0") +
      element("revolute", "D", "from = \"PD\"\nto = \"K3\"\naxis = \"z\"\ninitial = { angle = 1.9 }") +
      link("dc", "K3", "tool", "\"c\", 0, 0") + element("closure", "C", "as = \"pin\"\nfrom = \"tool\"\nto = \"C1\"") +
      uncertain("a", "± 1 %") + uncertain("c", "± 1 %");
  const Results results = runOf(studyOf("angles = \"180 deg\"\n", linkage));
  for (const Point& share : sharesOf(2, 12)) {
    const Number a = Number("0.3") * (1 + share[0] / 100), c = Number("0.6") * (1 + share[1] / 100), b("0.8"), d("0.9");
    const Number crank = turn / 6, x = a * cos(crank) - d, y = a * sin(crank);  // of the crank's end from D
    const Number long2 = x * x + y * y, across = (long2 + c * c - b * b) / (2 * sqrt(long2) * c);
    std::vector<Point> exact;
    for (const int side : {1, -1}) {
      const Number rocker = atan2(y, x) + side * acos(across);
      const Number coupler = atan2(c * sin(rocker) - y, c * cos(rocker) - x) - crank;
      exact.push_back({coupler, rocker});
    }
    for (Point& q : exact)
      for (Number& each : q) each -= turn * round(each / turn);
    expectAll(results.of<PosturesResult>(), exact, "loop");
  }
}

// ---- What is refused
// ----------------------------------------------------------------------------------------------------

std::string refusalOf(const std::string& asked, const std::string& mechanism) {
  try {
    readStudyText(studyOf(asked, mechanism), "s.toml");
  } catch (const StudyError& error) {
    return error.what();
  }
  return "it was read";
}

TEST(Postures, AreRefusedWhereEquationsAreNotAsMany) {
  const std::string arm = planar("0.6 m", "0.3 m", "0", "± 1 %");
  EXPECT_THAT(refusalOf(atTarget + "match = \"position\"\n", arm),
              HasSubstr("'tool' at 'target' is 2 equations for 3 coordinates; expected as many: drives for 1 of the "
                        "coordinates, or a match that asks for more"));
  EXPECT_THAT(refusalOf("frame = \"tool\"\ngoal = \"target\"\n",
                        hinge("A", "inertial", "K") + link("l", "K", "tool", "1, 0, 0") +
                            link("goal", "inertial", "target", "0, 1, 0", "[{ axis = \"z\", angle = 1 }]")),
              HasSubstr("is 3 equations for 1 coordinate; expected as many: a match that asks for less"));
  EXPECT_THAT(refusalOf("frame = \"tool\"\ngoal = \"target\"\nmatch = \"position\"\n",
                        hinge("A", "inertial", "K") + hinge("B", "K", "K2") + link("l", "K2", "tool", "1, 0, 0") +
                            link("goal", "inertial", "target", "0, 1, 0.5")),
              HasSubstr("no coordinate changes tool.position.z, which is not as of 'target'"));
}

TEST(Postures, AreRefusedWithTheKeyInPlace) {
  const std::string arm = planar("0.6 m", "0.3 m", "0", "± 1 %");
  EXPECT_THAT(refusalOf("frame = \"tol\"\ngoal = \"target\"\n", arm), HasSubstr("s.toml:5:9: unknown frame 'tol'"));
  EXPECT_THAT(refusalOf("frame = \"tool\"\n", arm), HasSubstr("postures.goal is not said"));
  EXPECT_THAT(refusalOf(atTarget + "ranges = { Q = [0, 1] }\n", arm), HasSubstr("unknown"));
  EXPECT_THAT(refusalOf(atTarget + "ranges = { A = [1, 0] }\n", arm), HasSubstr("ends before it begins"));
  EXPECT_THAT(refusalOf(atTarget + "ranges = { A = [\"1 m\", \"2 m\"] }\n", arm), HasSubstr("is not in rad"));
  EXPECT_THAT(refusalOf(atTarget + "ranges = { A = [1] }\n", arm), HasSubstr("postures.ranges.A has 1 entries"));
  EXPECT_THAT(refusalOf(atTarget, element("prismatic", "S", "from = \"inertial\"\nto = \"tool\"\naxis = \"x\"") +
                                      link("goal", "inertial", "target", "1, 0, 0")),
              HasSubstr("how far 'S.displacement' is looked at is not said; expected postures.ranges, or "
                        "postures.displacements"));
}

/// In the unit of the range, else in that of the initial value, and outward.
TEST(Postures, AreToldInTheUnitsOfTheStudy) {
  const std::string mechanism = planar("0.6 m", "0.3 m", "0.5 rad", "± 1 %");
  const auto told = [&](const std::string& ranges) {
    return runOf(studyOf(atTarget + ranges, mechanism)).of<PosturesResult>();
  };
  const PosturesResult degrees = told("ranges = { A = [\"-170 deg\", \"170 deg\"] }\n");
  EXPECT_EQ(degrees.units, "deg, rad, rad");
  ASSERT_GT(degrees.number.size(), 0U);
  const std::string line = degrees.told()[1];
  double lower = 0, upper = 0;
  ASSERT_EQ(std::sscanf(line.c_str() + line.find("A.angle"), "A.angle in [%lf, %lf] deg, B.angle", &lower, &upper), 2)
      << line;
  const Number perDegree = acos(Number(-1)) / 180;
  EXPECT_LE(lower * perDegree, degrees.lower(0, 0));
  EXPECT_GE(upper * perDegree, degrees.upper(0, 0));
  EXPECT_LT(upper - lower, 1.001 * (degrees.upper(0, 0) - degrees.lower(0, 0)) * 180 / 3.14159);
  EXPECT_EQ(told("angles = \"170 deg\"\n").units, "deg, deg, deg");
}

}  // namespace
}  // namespace gamut::postures
