// What closures hold anyway, as their loops are built: it is left out, and machines move as if it had not been asked.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/elements/all.hpp"
#include "tests/mechanics/four_bar.hpp"

namespace gamut {
namespace left_out_rows {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

Closure closing(const std::string& as, const Axis& axis = axisZ) {
  Closure closure = testing::pinned();
  closure.as = as;
  closure.axis = axis;
  if (as == "hinge" || as == "cylinder") closure.toAxis = axis;
  return closure;
}

std::string refusalOf(const std::function<void()>& what) {
  try {
    what();
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "";
}

/// The four-bar about `axis`, whose bars lie along `bar`, on `ground`; bars lie `heights` apart along the axis, one
/// behind the other.
struct Bars {
  Axis axis = axisZ;
  std::array<double, 3> bar = {1.0, 0.0, 0.0}, normal = {0.0, 0.0, 1.0};
  std::vector<Described> ground = {};
  std::string on = "inertial";
  std::array<const char*, 3> heights = {"0", "0", "0"};
};

Mechanism fourBar(const Closure& closure, const Bars& bars = {}) {
  Mechanism m;
  const auto along = [&](const char* length, const char* height) {
    const auto component = [&](std::size_t i) {
      const mpq_class value = parseAmount(length).value * bars.bar[i] + parseAmount(height).value * bars.normal[i];
      return Expression(Amount{value, 0, {}});
    };
    return ExpressionVector{component(0), component(1), component(2)};
  };
  for (const Described& element : bars.ground) m.add(element);
  m.add(Revolute{"A", bars.on, "K1", bars.axis, 1.0, 4.0});
  m.add(Mass{"crank", "K1", 1.0, along("0.15", "0"), {0.01, 0.01, 0.01, 0.0, 0.0, 0.0}});
  m.add(Link{"ab", "K1", "PB", along("0.3", bars.heights[0])});
  m.add(Revolute{"B", "PB", "K2", bars.axis, -0.5, 0.0});
  m.add(Mass{"coupler", "K2", 2.0, along("0.4", "0"), {0.1, 0.1, 0.1, 0.0, 0.0, 0.0}});
  m.add(Link{"bc", "K2", "C1", along("0.8", bars.heights[1])});
  m.add(Link{"ground", bars.on, "PD", along("0.9", "0")});
  m.add(Revolute{"D", "PD", "K3", bars.axis, 1.6, 0.0});
  m.add(Link{"dc", "K3", "C2", along("0.6", bars.heights[2])});
  m.add(closure);
  return m;
}

/// Both move alike from some states of the loop, not all of them closed.
void expectAlike(const Mechanism& one, const Mechanism& other) {
  ASSERT_EQ(one.stateNames(), other.stateNames());
  Assembly<double> a(one), b(other);
  std::vector<double> x = a.initialState();
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], b.initialState()[i], 1e-13) << i;
  for (int k = 0; k < 5; ++k) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += 0.03 * std::sin(static_cast<double>(k * 7 + 3 * i));
    a.setState(x);
    b.setState(x);
    const std::vector<double> expected = a.rates(), found = b.rates();
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-11 * (1 + std::abs(expected[i]))) << k << " " << i;
  }
}

TEST(LeftOutRows, AreABallsAcrossThePlaneOfItsLoop) {
  const Mechanism pinned = fourBar(closing("pin")), ball = fourBar(closing("ball"));
  EXPECT_THAT(pinned.leftOut(), IsEmpty());
  EXPECT_THAT(ball.dependents(), ElementsAre("B.angle", "D.angle"));
  ASSERT_EQ(ball.leftOut().size(), 1U);
  EXPECT_EQ(ball.leftOut()[0].sentence,
            "'C' holds 2 of its 3 rows, as its points stay together along z of 'C2' whatever the joints between its "
            "frames do; it bears nothing there");
  expectAlike(pinned, ball);
}

TEST(LeftOutRows, AreThreeOfAHinge) {
  for (const char* as : {"hinge", "cylinder"}) {
    const Mechanism hinge = fourBar(closing(as));
    ASSERT_EQ(hinge.leftOut().size(), 1U);
    EXPECT_THAT(hinge.leftOut()[0].sentence, HasSubstr("its axes stay parallel"));
    expectAlike(fourBar(closing("pin")), hinge);
  }
}

/// Whatever the plane, and however the ground moves it.
TEST(LeftOutRows, AreTheSameInEveryPlane) {
  Weld tilt{"tilt", "inertial", "P", {{Axis(1, 2, 3), 0, 0.7}, {axisX, 1, 0.0}}};
  const Axis skew(2, -1, 2);
  const Bars across{.axis = axisX, .bar = {0.0, 1.0, 0.0}, .normal = {1.0, 0.0, 0.0}};
  const Bars oblique{.axis = skew, .bar = {0.5, 1.0, 0.0}, .normal = {2.0, -1.0, 2.0}};
  const Bars tilted{.ground = {tilt}, .on = "P"};
  const Bars moving{.ground = {Prismatic{"cart", "inertial", "Q", Axis(1, 0, 1), 0.0, 2.0}, Mass{"body", "Q", 3.0},
                               Revolute{"tower", "Q", "P", axisY, 0.2, 0.3}},
                    .on = "P"};
  for (const Bars& bars : {across, oblique, tilted, moving}) {
    const Mechanism pin = fourBar(closing("pin", bars.axis), bars);
    expectAlike(pin, fourBar(closing("ball"), bars));
    expectAlike(pin, fourBar(closing("hinge", bars.axis), bars));
  }
}

/// The plane of each pivot is tilted by itself, about the line from one to the other.
TEST(LeftOutRows, AreKnownWherePivotsAreTiltedAlike) {
  const auto tilted = [](const Closure& closure, const Expression& other) {
    Mechanism m;
    m.addParameter("tilt", Interval("0.4"), "rad");
    m.add(Weld{"onA", "inertial", "PA", {{axisX, 0, Expression::named("tilt")}}});
    m.add(Revolute{"A", "PA", "K1", axisZ, 1.0, 4.0});
    m.add(Mass{"crank", "K1", 1.0, {0.1, 0.0, 0.0}, {0.01, 0.01, 0.01, 0.0, 0.0, 0.0}});
    m.add(Link{"ab", "K1", "PB", {0.3, 0.0, 0.0}});
    m.add(Revolute{"B", "PB", "K2", axisZ, -0.5, 0.0});
    m.add(Link{"bc", "K2", "C1", {0.8, 0.0, 0.0}});
    m.add(Link{"ground", "inertial", "PD", {0.9, 0.0, 0.0}, {{axisX, 0, other}}});
    m.add(Revolute{"D", "PD", "K3", axisZ, 1.6, 0.0});
    m.add(Link{"dc", "K3", "C2", {0.6, 0.0, 0.0}});
    m.add(closure);
    return m;
  };
  const Expression same = Expression::named("tilt");
  expectAlike(tilted(closing("pin"), same), tilted(closing("hinge"), same));
  EXPECT_THAT(tilted(closing("hinge"), same).leftOut()[0].restsOn, ::testing::Not(::testing::Contains("tilt")));
  EXPECT_THAT(refusalOf([&] { tilted(closing("hinge"), Interval("0.41")); }), HasSubstr("closed by 5 coordinates"));
}

/// Bars side by side: what they are apart adds up to nothing, exactly.
TEST(LeftOutRows, HoldWhereOffsetsAddToZero) {
  const auto ball = [](const char* last) { return fourBar(closing("ball"), {.heights = {"0.1", "0.2", last}}); };
  EXPECT_THAT(ball("0.3").dependents(), ElementsAre("B.angle", "D.angle"));
  expectAlike(fourBar(closing("pin")), ball("0.3"));
  EXPECT_THAT(refusalOf([&] { ball("0.31"); }), HasSubstr("the points of 'C' lie 0.01 m apart"));
}

TEST(LeftOutRows, RestOnTheNumbersThatMakeThemHold) {
  const Mechanism m = fourBar(closing("ball"));
  EXPECT_THAT(m.leftOut()[0].restsOn,
              UnorderedElementsAre("ab.vector.z", "bc.vector.z", "ground.vector.z", "dc.vector.z", "C.from_point.x",
                                   "C.from_point.y", "C.from_point.z", "C.to_point.x", "C.to_point.y", "C.to_point.z"));
  const std::vector<double> length{0.31}, height{0.01};
  EXPECT_NO_THROW(Assembly<double>(m, {"ab.vector.x"}, length));
  EXPECT_THAT(refusalOf([&] { Assembly<double>(m, {"ab.vector.z"}, height); }),
              HasSubstr("'ab.vector.z' is uncertain, but the loop 'C' can be closed for its nominal value alone"));
}

/// A second hinge of a door holds nothing that the first one does not.
TEST(LeftOutRows, AreAllOfADoorsSecondHinge) {
  for (const char* as : {"hinge", "ball", "pin"}) {
    Mechanism m;
    m.add(Revolute{"first", "inertial", "door", axisZ, 0.3, 1.0});
    m.add(Mass{"leaf", "door", 20.0, {0.4, 0.0, 1.0}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}});
    Closure second = closing(as);
    second.from = "inertial";
    second.to = "door";
    second.fromPoint = second.toPoint = {0.0, 0.0, 1.9};
    m.add(second);
    EXPECT_FALSE(m.isClosed());
    ASSERT_EQ(m.leftOut().size(), 1U);
    EXPECT_THAT(m.leftOut()[0].sentence, HasSubstr("holds none of its"));
    Assembly<double> assembly(m);
    EXPECT_EQ(assembly.rates()[0], 1.0);
    EXPECT_EQ(assembly.output("C.force.x"), 0.0);
  }
}

/// Hinges whose axes meet in one point: of the last one its axis is left to be held. With arcs a, b, c, d between the
/// axes, cos of the arc from crank to rocker is that of b.
TEST(LeftOutRows, AreTheThreeOfPointsOfSphericalLinkages) {
  const double a = 0.4, b = 0.9, c = 0.8, d = 1.0;
  Mechanism m;
  const auto arc = [&](const char* name, const char* from, const char* to, double angle) {
    m.add(Weld{name, from, to, {{axisX, 0, angle}}});
  };
  m.add(Revolute{"A", "inertial", "K1", axisZ, 0.7, 1.0});
  m.add(Mass{"crank", "K1", 1.0, {0.3, 0.0, 0.0}, {0.01, 0.02, 0.03, 0.0, 0.0, 0.0}});
  arc("ab", "K1", "PB", a);
  m.add(Revolute{"B", "PB", "K2", axisZ, 1.0, 0.0});
  arc("bc", "K2", "C1", b);
  arc("ground", "inertial", "PD", d);
  m.add(Revolute{"D", "PD", "K3", axisZ, 1.0, 0.0});
  arc("dc", "K3", "C2", c);
  m.add(closing("hinge"));
  EXPECT_THAT(m.dependents(), ElementsAre("B.angle", "D.angle"));
  const Assembly<double> assembly(m);
  const Frame<double>&one = assembly.frame("C1"), &other = assembly.frame("C2");
  EXPECT_NEAR(std::abs(one.R.col(2).dot(other.R.col(2))), 1, 1e-14);
  EXPECT_NEAR(assembly.frame("PB").R.col(2).dot(other.R.col(2)), std::cos(b), 1e-14);
  EXPECT_NEAR(assembly.frame("PD").R.col(2).dot(one.R.col(2)), std::cos(c), 1e-14);
}

TEST(LeftOutRows, AreNoneWhereAJointTurnsAnotherWay) {
  Mechanism m;
  m.add(Revolute{"A", "inertial", "K1", axisZ, 0.0, 0.0});
  m.add(Mass{"body", "K1", 1.0, {1.0, 0.0, 0.0}});
  m.add(Link{"arm", "K1", "K2", {1.0, 0.0, 0.0}});
  m.add(Universal{"U", "K2", "K3"});
  m.add(Link{"other", "K3", "K4", {1.0, 0.0, 0.0}});
  m.add(Planar{"P", "inertial", "K5"});
  Closure ball = closing("ball");
  ball.from = "K4";
  ball.to = "K5";
  m.add(ball);
  EXPECT_THAT(m.leftOut(), IsEmpty());
  EXPECT_EQ(m.dependents().size(), 3U);
}

TEST(LeftOutRows, MakeLoopsThatCannotCloseKnown) {
  Closure hinge = closing("hinge");
  hinge.toAxis = Axis(0, 1, 1);
  EXPECT_THAT(refusalOf([&] { fourBar(hinge); }), HasSubstr("the axes of 'C' are not parallel"));
}

}  // namespace
}  // namespace left_out_rows
}  // namespace gamut
