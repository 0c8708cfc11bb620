// The description of a mechanism: its names, units and complaints; and the helpers for names and rotations.
#include "mechanics/description/mechanism.hpp"
#include "mechanics/elements/all.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "mechanics/assembly.hpp"
#include "mechanics/description/names.hpp"
#include "mechanics/model.hpp"
#include "mechanics/rotation.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "tests/mechanics/machines.hpp"

namespace gamut {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using testing::doublePendulum;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The sentence with which `action` is refused.
template <class Action>
std::string complaint(Action action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Names, TheNearestIsFewestTyposAway) {
  const std::vector<std::string> known = {"shoulder.angle", "elbow.angle", "upper.length"};
  EXPECT_EQ(nearestName("uper.length", known), "upper.length");
  EXPECT_EQ(nearestName("ELBOW.angel", known), "elbow.angle");
  EXPECT_EQ(nearestName("anything", {}), "");
  EXPECT_EQ(unknownName("quantity", "elbow.angel", known),
            "unknown quantity 'elbow.angel'; did you mean 'elbow.angle'?");
}

TEST(Names, TheNearestIsNoneThatIsFarAway) {
  const std::vector<std::string> known = {"shoulder.angle", "tip"};
  EXPECT_EQ(nearestName("top", known), "tip");
  EXPECT_EQ(nearestName("mass", known), "");
  EXPECT_EQ(nearestName("shuoldr.angel", known), "shoulder.angle");
  EXPECT_EQ(nearestName("shlangle", known), "");
  EXPECT_EQ(unknownName("quantity", "mass", known), "unknown quantity 'mass'");
}

TEST(Names, WhatIsExpectedAreNearNamesOrSomeOfAll) {
  const std::vector<std::string> known = {"tip.x", "tip.y", "tip.z", "rod.length", "base"};
  EXPECT_EQ(expectedName("tip.w", known), "'tip.x', 'tip.y' or 'tip.z'");
  EXPECT_EQ(expectedName("length", known), "'rod.length'");
  EXPECT_EQ(expectedName("rod.mass", known), "'rod.length'");
  EXPECT_EQ(expectedName("something", known), "one of: tip.x, tip.y, tip.z, rod.length, base");
  EXPECT_EQ(expectedName("something", std::vector<std::string>(14, "k")),
            "one of: k, k, k, k, k, k, k, k, k, k, k, k and 2 more");
  EXPECT_EQ(expectedName("f1.moment", {"j1.reaction.moment.x", "f1.force", "f1.power"}),
            "'f1.force', 'f1.power' or 'j1.reaction.moment.x'");
  EXPECT_EQ(expectedName("hinge.position", {"hinge.angle", "t", "hinge.rate", "hinge.power", "hinge.force", "tip.x"}),
            "one of: hinge.angle, hinge.rate, hinge.power, hinge.force");
  EXPECT_EQ(expectedName("hinge", {"hinge.angle", "t", "hinge.rate", "hinge.power", "hinge.force"}),
            "one of: hinge.angle, hinge.rate, hinge.power, hinge.force");
  EXPECT_EQ(oneOf({"base"}), "base");
  EXPECT_EQ(oneOf({"base", "tip"}), "one of: base, tip");
  EXPECT_EQ(expectedName("something", {"base"}), "'base'");
  EXPECT_EQ(expectedName("something", {}), "one that was defined before; there is none yet");
}

TEST(Mechanism, RefusesInertiaThatNoBodyHas) {
  const auto found = [](const std::vector<Expression>& inertia) {
    Mechanism m;
    m.addParameter("moment", 1.0);
    m.add(Revolute{"hinge", "inertial", "K1", axisX, 0.0, 0.0});
    Mass mass{"bob", "K1", 1.0};
    std::copy(inertia.begin(), inertia.end(), mass.inertia.begin());
    m.add(mass);
    return complaint([&] { m.check(); });
  };
  const std::string negative = "the inertia of 'bob' has a negative principal moment";
  const std::string triangle = "the inertia of 'bob' has a principal moment above the sum of the other two";
  EXPECT_EQ(found({-1.0, 1.0, 1.0}), negative);
  EXPECT_EQ(found({1.0, 1.0, 1.0, 0.0, 0.0, 1.5}), negative);
  EXPECT_EQ(found({1.0, 1.0, 1.0, -0.9, -0.9, -0.9}), negative);  // only the determinant tells
  EXPECT_EQ(found({1.0, 1.0, 2.001}), triangle);
  EXPECT_EQ(found({1.0, 1.0, 1.0, 0.0, 0.6, 0.0}), triangle);  // principal moments 0.4, 1, 1.6
  EXPECT_EQ(found({Expression::named("moment", -1.0), 1.0, 1.0}), negative);
  // Bodies: a point, a rod, a plate whose decimals are no doubles, one askew, intervals that hold one.
  EXPECT_EQ(found({0.0, 0.0, 0.0}), "no complaint");
  EXPECT_EQ(found({0.0, 1.0, 1.0}), "no complaint");
  EXPECT_EQ(found({Interval("0.1"), Interval("0.2"), Interval("0.3")}), "no complaint");
  EXPECT_EQ(found({1.0, 1.0, 1.0, 0.0, 0.5, 0.0}), "no complaint");
  EXPECT_EQ(found({Interval(-1.0, 1.0), 1.0, Interval(1.0, 3.0)}), "no complaint");
}

TEST(Mechanism, NamesItsStatesPositionsFirst) {
  EXPECT_THAT(doublePendulum().stateNames(),
              ElementsAre("shoulder.angle", "elbow.angle", "shoulder.rate", "elbow.rate"));
  EXPECT_THAT(testing::spatialArm().stateNames(), Contains("slide.displacement"));
}

TEST(Mechanism, NamesEveryNumberThatMayBeUncertain) {
  const Mechanism m = doublePendulum();
  EXPECT_THAT(m.quantities(), AllOf(Contains("shoulder.angle"), Contains("elbow.rate"), Contains("upper.length"),
                                    Contains("tip.mass"), Contains("tip.inertia.xx"), Contains("gravity.z")));
  EXPECT_TRUE(isEqual(m.nominal("upper.length"), 1.0));
  EXPECT_TRUE(isEqual(m.nominal("gravity.z"), Interval("-9.81")));
  EXPECT_TRUE(isEqual(m.nominal("shoulder.rate"), Interval("0.43")));
  EXPECT_EQ(complaint([&] { m.nominal("uper.length"); }),
            "unknown quantity 'uper.length'; did you mean 'upper.length'?");
}

TEST(Mechanism, NumbersFollowFromParametersByFormulas) {
  Mechanism m;
  m.addParameter("length", Interval(2.0), "m");
  m.addParameter("density", Interval(3.0));
  m.addDerived("half", Expression::parse("length/2"));
  m.addDerived("square", Expression::parse("half^2 + (1 m)^2"));
  m.add(Revolute{"hinge", "inertial", "K1", axisX, Expression::parse("30 deg * length/(2 m)")});
  m.add(Link{"rod", "K1", "K2", {0.0, 0.0, Expression::parse("-half - 50 cm")}});
  m.add(Mass{"bob", "K2", Expression::parse("density*length/(1 m)")});
  EXPECT_EQ(m.unitOf("half"), "m");
  EXPECT_EQ(m.unitOf("square"), "m^2");
  m.addParameter("share", Interval(0.5));
  m.add(Mass{"half bob", "K2", Expression::parse("share*density*half/(1 m)")});
  EXPECT_EQ(m.unitOf("share"), "1");
  EXPECT_EQ(m.unitOf("density"), "kg");  // what it must be where it is used
  EXPECT_TRUE(isEqual(m.nominal("square"), Interval(2.0)));
  EXPECT_TRUE(m.isParameter("length"));
  EXPECT_FALSE(m.isParameter("half"));
  EXPECT_TRUE(m.dependsOn(Expression::parse("3*square"), "length"));
  EXPECT_FALSE(m.dependsOn(Expression::parse("3*square"), "density"));
  const Assembly<double> nominal(m), longer(m, {"length"}, std::vector{4.0});
  EXPECT_NEAR(nominal.initialState()[0], 0.52359877559829887, 1e-15);
  EXPECT_NEAR(longer.initialState()[0], 2 * 0.52359877559829887, 1e-15);
  EXPECT_NEAR(longer.output("K2.position.z"), -2.5 * std::cos(longer.initialState()[0]), 1e-14);
  EXPECT_TRUE(isEqual(m.rangeOf(Expression::parse("square"), {{"length", Interval(2, 4)}}), Interval(2, 5)));
}

TEST(Mechanism, RefusesFormulasThatDoNotFit) {
  Mechanism m;
  m.addParameter("length", Interval(2.0), "m");
  m.addParameter("number", Interval(2.0));
  m.addDerived("half", Expression::parse("length/2"));
  const auto complaint = [](auto action) {
    try {
      action();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_THAT(complaint([&] { m.addDerived("a", Expression::parse("length + 1 kg")); }), HasSubstr("adds kg to m"));
  m.addDerived("twice", Expression::parse("2*number*length"));
  EXPECT_EQ(m.unitOf("number"), "1");
  EXPECT_EQ(m.unitOf("twice"), "m");
  EXPECT_THAT(complaint([&] { m.addDerived("a", Expression::parse("2*lenght")); }), HasSubstr("did you mean 'length'"));
  EXPECT_THAT(complaint([&] { m.addDerived("half", Expression::parse("length")); }), HasSubstr("defined twice"));
  EXPECT_THAT(complaint([&] { m.addParameter("half", Interval(1.0)); }), HasSubstr("defined twice"));
  EXPECT_THAT(complaint([&] { m.addParameter("mm", Interval(1.0)); }),
              HasSubstr("cannot be named 'mm': that is a unit"));
  EXPECT_THAT(complaint([&] { m.addParameter("pi", Interval(3.0)); }), HasSubstr("cannot be named 'pi'"));
  EXPECT_THAT(complaint([&] { m.addParameter("energy", Interval(3.0)); }), HasSubstr("cannot be named 'energy'"));
  EXPECT_THAT(complaint([&] {
                m.setGravity({0.0, 0.0, Expression::parse("length/(1 s)")});
              }),
              HasSubstr("'gravity.z': a quantity in m/s; expected one in m/s^2"));
}

TEST(Mechanism, KnowsTheUnitOfEveryQuantity) {
  const Mechanism m = doublePendulum(), arm = testing::spatialArm();
  const std::pair<const char*, const char*> expected[] = {
      {"shoulder.angle", "rad"},    {"elbow.rate", "rad/s"},  {"upper.length", "m"}, {"tip.mass", "kg"},
      {"tip.inertia.xx", "kg m^2"}, {"gravity.z", "m/s^2"},   {"energy", "J"},       {"energy.kinetic", "J"},
      {"tip.position.z", "m"},      {"K2.velocity.y", "m/s"},
  };
  for (const auto& [quantity, unit] : expected) EXPECT_EQ(m.unitOf(quantity), unit) << quantity;
  EXPECT_EQ(arm.unitOf("slide.displacement"), "m");
  EXPECT_EQ(arm.unitOf("slide.rate"), "m/s");
  EXPECT_EQ(arm.unitOf("tether.damping"), "N s/m");
  for (const char* quantity : {"tether.rest_length", "tether.from_point.x", "tether.to_point.z"})
    EXPECT_EQ(arm.unitOf(quantity), "m") << quantity;
  EXPECT_EQ(arm.unitOf("hipSpring.stiffness"), "N m/rad");
  for (const std::string& quantity : arm.quantities()) EXPECT_NE(arm.unitOf(quantity), "") << quantity;
  for (const std::string& quantity : arm.outputQuantities()) EXPECT_NE(arm.unitOf(quantity), "") << quantity;
}

TEST(Mechanism, SaysWhatIsWrongWithAnElement) {
  Mechanism m = doublePendulum();
  EXPECT_THAT(complaint([&] {
                m.add(Link{"extra", "K7", "K8", {0.0, 0.0, 1.0}});
              }),
              HasSubstr("unknown frame 'K7'; did you mean 'K1'?"));
  EXPECT_THAT(complaint([&] {
                m.add(Link{"extra", "K4", "K2", {0.0, 0.0, 1.0}});
              }),
              HasSubstr("the frame 'K2' is defined twice"));
  EXPECT_THAT(complaint([&] { m.add(Mass{"tip", "K4", 1.0}); }), HasSubstr("two elements are named 'tip'"));
  EXPECT_THAT(complaint([&] { m.add(Mass{"", "K4", 1.0}); }), HasSubstr("a mass needs a name"));
  EXPECT_THAT(complaint([&] { m.add(Mass{"K3", "K4", 1.0}); }), HasSubstr("the element 'K3' has the name of a frame"));
  EXPECT_THAT(complaint([&] {
                m.add(Link{"extra", "K4", "tip", {0.0, 0.0, 1.0}});
              }),
              HasSubstr("the frame 'tip' has the name of an element whose position is measured"));
  EXPECT_THAT(complaint([&] {
                m.add(Mass{"extra", "K4", Expression::named("mas")});
              }),
              HasSubstr("unknown parameter 'mas'"));
  EXPECT_THAT(complaint([&] {
                m.add(Mass{"extra", "K4", Expression::named("upper.length")});
              }),
              HasSubstr("the parameter 'upper.length' is in m, but 'extra.mass' is in kg"));
  EXPECT_THAT(complaint([&] {
                m.add(JointSpring{"spring", "sholder", 1.0});
              }),
              HasSubstr("unknown joint 'sholder'; did you mean 'shoulder'?"));
  EXPECT_THAT(complaint([&] { m.add(Spring{"spring", "K1", "K1", 1.0, 1.0}); }), HasSubstr("two different frames"));
  EXPECT_THAT(complaint([&] { m.setGravity({0.0, 0.0, 0.0}); }), HasSubstr("gravity is set twice"));
  EXPECT_THAT(complaint([&] { m.addParameter("tip.mass", 1.0); }), HasSubstr("'tip.mass' is defined twice"));
  EXPECT_THAT(complaint([&] { m.addParameter("big", Interval::entire()); }), HasSubstr("finite"));
  EXPECT_THAT(complaint([&] { Axis(0, 0, 0); }), HasSubstr("all three components are zero"));
}

TEST(Mechanism, SaysWhichJointMovesNoMass) {
  Mechanism m = doublePendulum();
  m.add(Revolute{"wrist", "K4", "K5", axisX});
  EXPECT_THAT(complaint([&] { recordMotion(m); }), HasSubstr("the joint 'wrist' moves no mass"));
  EXPECT_THAT(complaint([] { Mechanism().check(); }), HasSubstr("no joint"));
}

TEST(Mechanism, SaysWhichNameIsNoParameterOrOutput) {
  const Mechanism m = doublePendulum();
  EXPECT_EQ(complaint([&] { recordMotion(m, {"uper.length"}); }),
            "unknown parameter 'uper.length'; did you mean 'upper.length'?");
  EXPECT_THAT(complaint([&] { recordMotion(m, {"tip.mass", "tip.mass"}); }), HasSubstr("named twice"));
  EXPECT_THAT(complaint([&] { recordOutputs(m, {}, {"tip.positon.z"}); }),
              HasSubstr("unknown output quantity 'tip.positon.z'; did you mean 'tip.position.z'?"));
  EXPECT_THAT(complaint([&] { Assembly<double>(m).setState(std::vector<double>{1.0}); }), HasSubstr("4 states, not 1"));
}

TEST(Mechanism, StartsAtItsInitialState) {
  const Assembly<Interval> arm(doublePendulum());
  EXPECT_TRUE(isEqual(arm.initialState()[0], 0.75 * pi()));
  EXPECT_TRUE(isEqual(arm.initialState()[3], Interval("0.67")));
  EXPECT_TRUE(isEqual(arm.output("shoulder.angle"), 0.75 * pi()));
}

TEST(Mechanism, MayGiveAnInitialValueByAParameter) {
  Mechanism m;
  m.addParameter("tilt", 0.5);
  m.add(Revolute{"hinge", "inertial", "K1", axisX, Expression::named("tilt", -2.0)});
  m.add(Mass{"bob", "K1", 1.0, {0.0, 0.0, -1.0}});
  EXPECT_EQ(m.unitOf("tilt"), "rad");
  EXPECT_EQ(Assembly<double>(m).initialState()[0], -1.0);
  EXPECT_EQ(Assembly<double>(m, {"tilt"}, std::vector<double>{0.25}).initialState()[0], -0.5);
}

TEST(Outputs, OfTheRecordedProgramAreThoseOfTheAssembly) {
  const Mechanism m = testing::spatialArm();
  const std::vector<std::string> names = m.outputQuantities();
  const Program program = recordOutputs(m, {}, names);
  Assembly<double> arm(m);
  const std::vector<double> y = Evaluator<double>(program)(0.0, arm.initialState());
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_NEAR(y[i], arm.output(names[i]), 1e-12 * (1 + std::abs(y[i]))) << names[i];
}

/// Decimals are known as such: those that are equal are one number, those that share an enclosure may be two.
TEST(Outputs, KnowWhichNumbersAreEqual) {
  const auto isZero = [](const char* first, const char* second) {
    Mechanism m;
    m.add(Revolute{"hinge", "inertial", "K", axisX});
    m.add(Mass{"a", "K", Expression::parse(first), {0.0, 0.0, 1.0}});
    m.add(Mass{"b", "K", Expression::parse(second), {0.0, 0.0, 2.0}});
    const Program y = recordOutputs(m, {}, {"a.mass - b.mass"});
    const Node& node = y.nodes()[static_cast<std::size_t>(y.outputNodes()[0])];
    return node.op == Op::constant && isEqual(y.constants()[static_cast<std::size_t>(node.a)], Interval(0.0));
  };
  EXPECT_TRUE(isZero("0.1 kg", "100 g"));
  EXPECT_TRUE(isZero("1/3 kg", "1000/3 g"));
  EXPECT_TRUE(isZero("2*pi/7", "4*pi/14"));
  EXPECT_FALSE(isZero("0.1 kg", "0.1000000000000000000001 kg"));
  EXPECT_FALSE(isZero("pi/7", "pi/7 + 1e-30"));
}

TEST(Rotation, ByQuarterTurnsHasExactZeros) {
  for (const Axis& axis : {axisX, Axis(0, -1, 0), axisZ}) {
    const Matrix3<double> a = Rotation<double>(axis, 0.0, 1).matrix(), b = Rotation<double>(axis, 0.0, -3).matrix();
    EXPECT_EQ(a, b);
    EXPECT_EQ(a.cwiseAbs().sum(), 3) << a;
    const Matrix3<double> half = Rotation<double>(axis, 0.5 * 3.14159265358979323846).matrix();
    EXPECT_LT((a - half).norm(), 1e-15);
  }
}

TEST(Rotation, AboutAnObliqueAxisEnclosesTheTurnThatKeepsTheAxis) {
  const Axis axis(1, -2, 2);
  const Matrix3<Interval> a = Rotation<Interval>(axis, 0.7).matrix();
  const Vector3<double> u(1 / 3.0, -2 / 3.0, 2 / 3.0);
  const Matrix3<double> expected = Eigen::AngleAxisd(0.7, u).toRotationMatrix();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(midpoint(a(i, j)), expected(i, j), 1e-15);
  const Vector3<Interval> kept = a * axis.unit<Interval>();
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(isDisjoint(kept[i], axis.unit<Interval>()[i]));
}

TEST(Rotation, AfterAnotherIsTheProductOfTheMatrices) {
  const Rotation<double> a(axisX, 0.3), b(Axis(1, 2, 3), -0.8);
  EXPECT_LT((a.then(b).matrix() - a.matrix() * b.matrix()).norm(), 1e-15);
}

}  // namespace
}  // namespace gamut
