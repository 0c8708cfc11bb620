// Laws of the element types: what their equations are, what power they bring in, and that they say what they are.
#include "mechanics/elements/all.hpp"

#include <gmock/gmock.h>

#include "machines.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/bodies.hpp"
#include "mechanics/description/words.hpp"
#include "mechanics/joints.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using testing::RandomStates;

/// dy/dt = ∂y/∂x f(t, x) of an output that does not depend on time itself.
double rateOf(const std::string& output, const Mechanism& mechanism, const std::vector<double>& x, double t = 0) {
  const Program f = recordMotion(mechanism), y = recordOutputs(mechanism, {}, {output}).differentiated();
  const std::vector<double> dx = Evaluator<double>(f)(t, x), dy = Evaluator<double>(y)(t, x);
  double rate = 0;
  for (std::size_t i = 0; i < x.size(); ++i) rate += dy[1 + i] * dx[i];
  return rate;
}

double outputAt(const Mechanism& mechanism, const std::string& output, const std::vector<double>& x, double t = 0) {
  return Evaluator<double>(recordOutputs(mechanism, {}, {output}))(t, x)[0];
}

/// A hinge in a skew direction on another, with a body and gravity.
Mechanism skewPair() {
  Mechanism m;
  m.add(Revolute{"first", "inertial", "A", Axis(1, 2, -1)});
  m.add(Link{"boom", "A", "B", {0.2, 0.3, -0.8}, {{axisX, 1, 0.3}}});
  m.add(Revolute{"second", "B", "C", Axis(0, 1, 2)});
  m.add(Mass{"far", "C", 1.5, {0.0, 0.05, 0.4}, {0.2, 0.25, 0.1, 0.0, 0.01, 0.0}});
  m.setGravity({0.5, -1.0, -9.0});
  return m;
}

// ---- What a type says of itself -------------------------------------------------------------------------------------

TEST(ElementTypes, HaveNamesOfTheirOwnAndSayWhatTheyAre) {
  std::vector<std::string> types;
  for (const Described& type : elementTypes()) {
    EXPECT_EQ(std::ranges::count(types, type.type()), 0) << type.type();
    types.push_back(type.type());
    EXPECT_FALSE(type.summary().empty()) << type.type();
    for (const auto& [word, written, isInitial, example] : wordsOf(type).keys) {
      if (word.unit == "unit/s") continue;  // of a state: whatever unit it has
      EXPECT_NO_THROW(dimensionOf(word.unit)) << type.type() << "." << word.key;
    }
  }
}

/// One of each, on a hinge and a slider; `added` is looked at.
Mechanism withOneOfEach() {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "A", axisY, 0.3, 0.1});
  m.add(Prismatic{"slide", "A", "B", axisX, 0.5, 0.2});
  m.add(Revolute{"driven", "B", "C", axisZ});
  m.add(Weld{"weld", "C", "D", {{axisX, 1, 0.0}}});
  m.add(Link{"rod", "D", "E", {0.0, 0.2, 1.0}});
  m.add(Mass{"body", "E", 2.0});
  m.add(Spring{"spring", "inertial", "E", 3.0, 1.0, 0.1, {0.0, 0.0, -5.0}});
  m.add(JointSpring{"torsion", "hinge", 4.0});
  m.add(Force{"push", "E", {Expression::parse("3 N * sin(2*t/(1 s))"), 0.0, 1.0}});
  m.add(JointForce{"motor", "hinge", Expression::parse("-2 N m * hinge.angle - lag")});
  m.add(Drive{"shaft", "driven", Expression::parse("0.4 rad * sin(3*t/(1 s))")});
  m.add(Prismatic{"rack", "E", "F", axisY});
  m.add(Mass{"carriage", "F", 0.5, {0.0, 0.1, 0.0}});
  m.add(Coupling{"gear", "rack", "hinge", -0.2, 0.1});
  m.add(State{"lag", Expression::parse("0 N m"), Expression::parse("(1 N m * hinge.rate * 1 s - lag)/(0.1 s)")});
  m.add(Bushing{"mount", "A", "E", {1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}, {1.0, 2.0, 2.0}, {0.1, 0.1, 0.1}});
  m.add(JointFriction{"dry", "slide", 0.5, 0.1});
  m.add(SmoothedJointFriction{"smooth", "hinge", 0.5, 0.1, 0.2});
  m.add(JointStop{"stop", "slide", -0.2, 0.3, 40.0, 1.0});
  m.add(PlaneContact{"touch", "A", "E", {0.0, 0.0, 0.0}, {0.0, 0.1, 0.0}, Axis(1, 0, 2), 3.0, 20.0, 0.5, 0.25, 0.125});
  m.add(Motor{"geared", "hinge", Expression::parse("0.2 N m - 0.1 N m s * hinge.rate"), 5.0, 0.01, 0.02});
  m.add(Distance{"gap", "inertial", "E"});
  m.add(RelativeMotion{"seen", "A", "E", axisZ});
  m.add(Sphere{"ball", "E", 0.125});
  m.add(Capsule{"upright", "A", 0.25, 1.0, axisZ});
  m.add(Cuboid{"block", "inertial", {0.5, 0.5, 0.5}, {0.0, 3.0, 0.0}});
  m.add(Hull{"wedge", "inertial", {{0.0, 3.0, 0.0}, {0.5, 3.0, 0.0}, {0.0, 3.5, 0.0}, {0.0, 3.0, 0.5}}});
  m.add(Separation{"apart", "upright", "ball"});
  m.setGravity({0.0, 0.0, -9.81});
  return m;
}

TEST(ElementTypes, GiveAValueForAllThatTheySayCanBeMeasured) {
  const Mechanism mechanism = withOneOfEach();
  std::vector<std::string> missing;
  for (const Described& type : elementTypes())
    if (std::ranges::none_of(mechanism.elements(), [&](const Described& e) { return e.type() == type.type(); }))
      missing.push_back(type.type());
  EXPECT_THAT(missing, ::testing::IsSubsetOf({"universal", "cylindrical", "screw", "planar", "spherical", "skate",
                                              "rolling-wheel", "rolling-ball", "free", "play", "guide-play", "closure",
                                              "rod", "rigid-stop", "table-drive"}))
      << "have tests of their own";
  Assembly<double> assembly(mechanism);
  for (const std::string& quantity : mechanism.outputQuantities())
    EXPECT_TRUE(std::isfinite(assembly.output(quantity))) << quantity;
  EXPECT_EQ(mechanism.stateNames(),
            (std::vector<std::string>{"hinge.angle", "slide.displacement", "hinge.rate", "slide.rate", "lag"}));
}

TEST(ElementTypes, MoveAlikeInEveryScalar) {
  const Mechanism mechanism = withOneOfEach();
  RandomStates states;
  const Program recorded = recordMotion(mechanism);
  for (int round = 0; round < 20; ++round) {
    const std::vector<double> x = states(5, 0.8);
    const double t = 0.1 * round;
    const auto rates = [&]<class S>(S /*scalar*/) {
      Assembly<S> assembly(mechanism);
      assembly.setState(std::vector<S>(x.begin(), x.end()), S(t));
      return assembly.rates();
    };
    const std::vector<double> a = rates(0.0), e = Evaluator<double>(recorded)(t, x);
    const std::vector<Interval> b = rates(Interval(0.0));
    const std::vector<Samples> c = rates(Samples(0.0));
    const std::vector<Fuzzy> d = rates(Fuzzy(0.0));
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double scale = 1e-12 * (1 + std::abs(a[i]));
      EXPECT_NEAR(e[i], a[i], scale) << i;
      EXPECT_NEAR(midpoint(b[i]), a[i], scale) << i;
      EXPECT_LE(width(b[i]), 100 * scale) << i;
      EXPECT_NEAR(c[i][0], a[i], scale) << i;
      EXPECT_NEAR(midpoint(d[i].cut(0.0)), a[i], scale) << i;
    }
  }
}

// ---- Joints made of joints ----------------------------------------------------------------------------------------

/// The same programs as those of the joints that it consists of, with a frame between them.
TEST(UniversalJoint, IsTwoHingesThatMeet) {
  Mechanism one, two;
  one.add(Universal{"cardan", "inertial", "C", Axis(1, 2, 0), axisY, 0.3, 0.1, -0.2, 0.4});
  two.add(Revolute{"first", "inertial", "B", Axis(1, 2, 0), 0.3, 0.1});
  two.add(Revolute{"second", "B", "C", axisY, -0.2, 0.4});
  for (Mechanism* m : {&one, &two}) {
    m->add(Mass{"body", "C", 1.5, {0.1, 0.05, 0.4}, {0.2, 0.25, 0.1, 0.0, 0.01, 0.0}});
    m->setGravity({0.5, -1.0, -9.0});
  }
  EXPECT_TRUE(isIdentical(recordMotion(one), recordMotion(two)));
  EXPECT_EQ(one.stateNames(),
            (std::vector<std::string>{"cardan.angle1", "cardan.angle2", "cardan.rate1", "cardan.rate2"}));
  EXPECT_EQ(Assembly<double>(one).initialState(), Assembly<double>(two).initialState());
  one.add(JointSpring{"spring", "cardan.angle2", 3.0});
  two.add(JointSpring{"spring", "second", 3.0});
  EXPECT_TRUE(isIdentical(recordMotion(one), recordMotion(two)));
  EXPECT_THROW(one.add(JointSpring{"wrong", "cardan", 3.0}), std::invalid_argument) << "it has two coordinates";
}

TEST(CylindricalJoint, IsASliderAndAHingeOnOneAxis) {
  Mechanism one, two;
  one.add(Cylindrical{"sleeve", "inertial", "C", Axis(1, 2, 0), 0.3, 0.1, -0.2, 0.4});
  two.add(Prismatic{"slide", "inertial", "B", Axis(1, 2, 0), 0.3, 0.1});
  two.add(Revolute{"turn", "B", "C", Axis(1, 2, 0), -0.2, 0.4});
  for (Mechanism* m : {&one, &two}) {
    m->add(Mass{"body", "C", 1.5, {0.1, 0.05, 0.4}, {0.2, 0.25, 0.1, 0.0, 0.01, 0.0}});
    m->setGravity({0.5, -1.0, -9.0});
  }
  EXPECT_TRUE(isIdentical(recordMotion(one), recordMotion(two)));
  EXPECT_EQ(Assembly<double>(one).initialState(), Assembly<double>(two).initialState());
  EXPECT_EQ(one.unitOf("sleeve.angle_rate"), "rad/s");
  EXPECT_EQ(one.unitOf("sleeve.displacement"), "m");
}

TEST(PlanarJoint, IsTwoSlidersAndAHinge) {
  Mechanism one, two;
  one.add(Planar{"table", "inertial", "C", Axis(0, -1, 0), 0.3, 0.1, -0.2, 0.4, 0.5, 0.6});
  two.add(Prismatic{"first", "inertial", "A", axisZ, 0.3, 0.1});
  two.add(Prismatic{"second", "A", "B", axisX, -0.2, 0.4});
  two.add(Revolute{"turn", "B", "C", Axis(0, -1, 0), 0.5, 0.6});
  for (Mechanism* m : {&one, &two}) {
    m->add(Mass{"body", "C", 1.5, {0.1, 0.05, 0.4}, {0.2, 0.25, 0.1, 0.0, 0.01, 0.0}});
    m->setGravity({0.5, -1.0, -9.0});
  }
  EXPECT_TRUE(isIdentical(recordMotion(one), recordMotion(two)));
  EXPECT_EQ(Assembly<double>(one).initialState(), Assembly<double>(two).initialState());
  Mechanism oblique;
  oblique.add(Planar{"table", "inertial", "C", Axis(1, 1, 0)});
  EXPECT_EQ(oblique.faults(oblique.elements()[0], {}).at(0).key, "axis");
}

/// (J + m (c² + h²)) β̈ = m h g·u + (c × m Aᵀ g)·u for a body whose centre lies at c across the axis u, with the lead 2π
/// h.
TEST(ScrewJoint, TurnsAsItSlides) {
  Mechanism m;
  m.add(Screw{"screw", "inertial", "C", axisZ, Expression(2.0) * Expression(pi()) * Expression(0.25), 0.3, 2.0});
  m.add(Mass{"body", "C", 2.0, {0.5, 0.0, 0.0}, {0.5, 0.5, 0.75, 0.0, 0.0, 0.0}});
  m.setGravity({0.0, 3.0, -9.0});
  Assembly<double> assembly(m);
  EXPECT_NEAR(assembly.output("C.position.z"), 0.25 * 0.3, 1e-16);
  EXPECT_NEAR(assembly.output("C.velocity.z"), 0.25 * 2.0, 1e-16);
  EXPECT_NEAR(assembly.rates()[1],
              (2.0 * 0.25 * -9.0 + 2.0 * 0.5 * 3.0 * std::cos(0.3)) / (0.75 + 2.0 * (0.25 + 0.0625)), 1e-14);
}

// ---- Orientations -------------------------------------------------------------------------------------------------

/// A ball joint stands at the start as a link that is turned likewise.
TEST(Orientation, IsThatOfTheSameFixedRotations) {
  const std::vector<std::vector<FixedRotation>> orientations = {
      rollPitchYaw(0.3, -0.7, 1.1),
      rollPitchYaw(0.0, pi() / Interval(2.0), 0.4),
      {{axisX, 1, 0.0}, {Axis(1, 2, -2), 0, 0.4}, {Axis(0, -1, 0), 3, 0.2}},
      {byQuaternion({0.5, -1.0, 2.0, 0.25})},
      {{axisZ, 2, 0.0}, byQuaternion({0.0, 0.0, -3.0, 0.0})},
      {}};
  for (const std::vector<FixedRotation>& orientation : orientations) {
    Mechanism m;
    m.add(Spherical{"ball", "inertial", "A", orientation});
    m.add(Mass{"body", "A", 1.0, {0.0, 0.0, 0.5}, {0.1, 0.2, 0.25, 0.0, 0.0, 0.0}});
    m.add(Weld{"weld", "inertial", "B", orientation});
    m.add(Free{"free", "inertial", "C", {1.0, 2.0, 3.0}, {0.0, 0.0, 0.0}, orientation});
    m.add(Mass{"bird", "C", 1.0, {0.0, 0.0, 0.5}, {0.1, 0.2, 0.25, 0.0, 0.0, 0.0}});
    Assembly<double> assembly(m);
    EXPECT_LT((assembly.frame("A").R - assembly.frame("B").R).norm(), 1e-15);
    EXPECT_LT((assembly.frame("C").R - assembly.frame("B").R).norm(), 1e-15);
    EXPECT_LT((assembly.frame("C").positionInInertial() - Vector3<double>(1.0, 2.0, 3.0)).norm(), 1e-15);
    Assembly<Interval> enclosed(m);
    for (int i = 0; i < 9; ++i) EXPECT_LE(width(enclosed.frame("A").R(i / 3, i % 3)), 1e-14);
  }
}

/// R = Rz(yaw) Ry(pitch) Rx(roll).
TEST(Orientation, ByRollPitchAndYawIsThatOfRobotics) {
  Mechanism m;
  m.add(Weld{"weld", "inertial", "B", rollPitchYaw(0.3, -0.7, 1.1)});
  m.add(State{"x"});
  const Eigen::Matrix3d expected =
      (Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(-0.7, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  EXPECT_LT((Assembly<double>(m).frame("B").R - expected).norm(), 1e-15);
  EXPECT_TRUE(m.isParameter("weld.rotation.pitch"));
}

TEST(Orientation, OfAZeroQuaternionIsNone) {
  Mechanism m;
  EXPECT_THROW(m.add(Spherical{"ball", "inertial", "A", {byQuaternion({0.0, 0.0, 0.0, 0.0})}}), std::invalid_argument);
}

// ---- Forces ---------------------------------------------------------------------------------------------------------

TEST(ForceElement, BringsInThePowerOfItsForceAndMoment) {
  Mechanism m = skewPair();
  m.add(Force{"push", "C", {2.0, -1.0, 0.5}, {0.3, 0.2, -0.4}, {0.1, -0.2, 0.3}});
  m.add(Link{"arm", "C", "P", {0.1, -0.2, 0.3}});
  RandomStates states;
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> x = states(4, 1.5);
    Assembly<double> assembly(m);
    assembly.setState(x);
    const Frame<double>& p = assembly.frame("P");
    const double power = p.velocityInInertial().dot(Vector3<double>(2.0, -1.0, 0.5)) +
                         (p.R * p.omega).dot(Vector3<double>(0.3, 0.2, -0.4));
    EXPECT_NEAR(rateOf("energy", m, x), power, 1e-11);
  }
}

TEST(ForceElement, OfAFrameTurnsWithIt) {
  Mechanism m = skewPair();
  m.add(Force{"thrust", "C", {0.0, 0.0, 4.0}, {0.0, 0.5, 0.0}, {0.1, 0.0, 0.0}, "frame"});
  RandomStates states;
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> x = states(4, 1.5);
    Assembly<double> assembly(m);
    assembly.setState(x);
    const Frame<double>& c = assembly.frame("C");
    const Vector3<double> force(0.0, 0.0, 4.0),
        moment = Vector3<double>(0.0, 0.5, 0.0) + Vector3<double>(0.1, 0.0, 0.0).cross(force);
    EXPECT_NEAR(rateOf("energy", m, x), force.dot(c.v) + moment.dot(c.omega), 1e-11);
  }
}

TEST(JointForceElement, IsTheMomentThatItsExpressionSays) {
  Mechanism m;
  m.addParameter("k", Interval("3"), "N m");
  m.add(Revolute{"hinge", "inertial", "A", axisX});
  m.add(Mass{"disc", "A", 1.0, {0.0, 0.0, 0.0}, {0.5, 0.5, 0.5, 0.0, 0.0, 0.0}});
  m.add(JointForce{"law", "hinge", Expression::parse("-k*hinge.angle^3 - 0.2 N m s^2 * hinge.rate*abs(hinge.rate)")});
  const Program f = recordMotion(m, {"k"});
  Evaluator<double> motion(f);
  motion.setParameters(std::vector<double>{4.0});
  RandomStates states;
  for (int i = 0; i < 50; ++i) {
    const std::vector<double> x = states(2);
    EXPECT_NEAR(motion(0.0, x)[1], (-4 * x[0] * x[0] * x[0] - 0.2 * x[1] * std::abs(x[1])) / 0.5, 1e-12);
  }
}

TEST(Load, ThatDependsOnAccelerationsIsNoLoad) {
  // A rotor whose inertia stands in a load alone would be seen by one formulation and not by another.
  struct Rotor final : Load<Recorded> {
    explicit Rotor(Variable<Recorded>& v) : variable(v) {}
    void applyForce() override { variable.force -= 3.0 * variable.acceleration; }
    Variable<Recorded>& variable;
  };
  EXPECT_THROW(record(2, 0,
                      [](auto, const auto& x, const auto&, auto& dx) {
                        Frame<Recorded> ground, arm;
                        Variable<Recorded> angle("arm.angle");
                        RevoluteJoint<Recorded> hinge(ground, arm, angle, axisX);
                        MassElement<Recorded> mass(arm, 1.0, {0.0, 0.0, -1.0});
                        Rotor rotor(angle);
                        Chain<Recorded> chain;
                        chain << hinge << mass << rotor;
                        System<Recorded> system({angle}, chain, ground, {0.0, 0.0, -9.81});
                        angle.position = x[0];
                        angle.rate = x[1];
                        dx[0] = x[1];
                        dx[1] = system.accelerations()[0];
                      }),
               std::logic_error);
}

TEST(SpringElement, IsRecordedWhereItsInitialLengthIsZero) {
  Mechanism m;
  m.add(Prismatic{"slide", "inertial", "A", axisX});
  m.add(Mass{"block", "A", 1.0});
  m.add(Spring{"spring", "inertial", "A", 100.0, 0.1});
  EXPECT_NEAR(Evaluator<double>(recordMotion(m))(0.0, std::vector<double>{0.3, 0.0})[1], -20, 1e-13);
}

// ---- Drives ---------------------------------------------------------------------------------------------------------

/// l q̈ = −g sin q − ẍ cos q  for a pendulum whose pivot moves by x(t) along the horizontal.
TEST(DriveElement, ShakesAPendulumAsItsEquationSays) {
  Mechanism m;
  m.addParameter("amplitude", Interval("0.3"), "m");
  m.addParameter("period", Interval("1.6"), "s");
  m.add(Prismatic{"rail", "inertial", "cart", axisX});
  m.add(Revolute{"hinge", "cart", "A", axisY});
  m.add(Link{"rod", "A", "B", {0.0, 0.0, Interval("-0.7")}});
  m.add(Mass{"bob", "B", 2.0});
  m.add(Drive{"shaker", "rail", Expression::parse("amplitude * sin(2*pi*t/period)")});
  m.setGravity({0.0, 0.0, Interval("-9.81")});
  const Program f = recordMotion(m, {"amplitude"});
  EXPECT_EQ(f.states(), 2);
  Evaluator<double> motion(f);
  motion.setParameters(std::vector<double>{0.25});
  RandomStates states;
  for (int i = 0; i < 50; ++i) {
    const std::vector<double> x = states(2);
    const double t = 0.07 * i, w = 2 * M_PI / 1.6, shake = -0.25 * w * w * std::sin(w * t);
    EXPECT_NEAR(motion(t, x)[1], (-9.81 * std::sin(x[0]) + shake * std::cos(x[0])) / 0.7, 1e-11);
  }
  // About y a positive angle moves what hangs down towards −x.
  EXPECT_NEAR(outputAt(m, "bob.position.x", {0.3, 0.0}, 0.4),
              0.3 * std::sin(2 * M_PI * 0.4 / 1.6) - 0.7 * std::sin(0.3), 1e-14);
}

/// Its rates are derivatives of one another: central differences.
TEST(DriveElement, HasTheRatesOfItsExpression) {
  Mechanism m;
  m.add(Revolute{"crank", "inertial", "A", Axis(1, 1, 0)});
  m.add(Revolute{"free", "A", "B", axisZ});
  m.add(Mass{"bob", "B", 1.0, {0.4, 0.1, 0.2}});
  m.add(
      Drive{"shaft", "crank", Expression::parse("0.3 rad * exp(-t/(1 s)) * sqrt(1 + (t/(1 s))^2) * tanh(t/(0.3 s))")});
  const auto at = [&](const char* what, double t) { return outputAt(m, what, {0.2, 0.0}, t); };
  for (double t : {0.1, 0.5, 2.0}) {
    const double h = 1e-5;
    EXPECT_NEAR(at("crank.rate", t), (at("crank.angle", t + h) - at("crank.angle", t - h)) / (2 * h), 1e-9);
  }
}

TEST(DriveElement, IsRefusedWhereItCannotBe) {
  const auto complaint = [](const Described& drive) -> std::string {
    Mechanism m;
    m.add(Revolute{"hinge", "inertial", "A", axisX, 0.1});
    m.add(Revolute{"second", "A", "B", axisX});
    m.add(Mass{"bob", "B", 1.0, {0.0, 0.0, 1.0}});
    try {
      m.add(drive);
      m.check();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no complaint";
  };
  EXPECT_THAT(complaint(Drive{"d", "hinge", 0.0}), HasSubstr("'hinge' has initial values, but is driven by 'd'"));
  for (const char* motion : {"abs(sin(t/(1 s)))", "where(t > 1 s, 1, 0)", "min(t/(1 s), 1)", "0.1*sign(t - 1 s)"})
    EXPECT_THAT(complaint(Drive{"d", "second", Expression::parse(motion)}), HasSubstr("has a kink or a jump"))
        << motion;
  EXPECT_THAT(complaint(Drive{"d", "hing", 0.0}), HasSubstr("unknown joint 'hing'"));
  EXPECT_THAT(complaint(Drive{"d", "second", Expression::parse("hinge.angle")}),
              HasSubstr("'hinge.angle' changes in motion"));
  EXPECT_THAT(complaint(Drive{"d", "second", Expression::parse("3 m * t")}), HasSubstr("'d.position'"));
  EXPECT_EQ(complaint(Drive{"d", "second", Expression::parse("3 rad * t/(1 s)")}), "no complaint");
}

/// What would not be seen is not asked for in vain.
TEST(DriveElement, IsRefusedAProfileThatItsJointIsNoHeightOf) {
  const auto complaint = [](const Described& drive) -> std::string {
    Mechanism m;
    m.addParameter("still", Interval(0.0), "m/s");
    m.add(Revolute{"hinge", "inertial", "A", axisX});
    m.add(Prismatic{"slide", "A", "B", Axis(0, 0, -2)});
    m.add(Cylindrical{"sleeve", "B", "C", axisZ});
    m.add(Mass{"bob", "C", 1.0, {0.0, 0.0, 1.0}});
    try {
      m.add(drive);
    } catch (const WrongNumber& error) {
      return error.problem() + "; " + error.expected();
    }
    return "no complaint";
  };
  const Expression turning = Expression::parse("3 rad/s*t"), sliding = Expression::parse("3 m/s*t");
  EXPECT_EQ(complaint(Drive{"d", "hinge", turning, {5.0}}),
            "'d.profile_speed': the motion of the joint 'hinge.angle' is no height of a profile: it turns; none, or a "
            "joint that slides, alone and across `along`");
  EXPECT_THAT(complaint(Drive{"d", "hinge", turning, {Expression::named("still")}}), HasSubstr("it turns"));
  EXPECT_THAT(complaint(Drive{"d", "sleeve.displacement", sliding, {5.0}}), HasSubstr("moves in other ways too"));
  EXPECT_THAT(complaint(Drive{"d", "slide", sliding, {5.0, axisZ}}), HasSubstr("it slides along the way ahead"));
  TimeTable table;
  table.times = table.values = {0, 1};
  EXPECT_THAT(complaint(TableDrive{"d", "hinge", table, {5.0}}), HasSubstr("it turns"));
  for (const Drive& drive : {Drive{"d", "hinge", turning}, Drive{"d", "hinge", turning, {0.0}},
                             Drive{"d", "slide", sliding, {5.0}}, Drive{"d", "sleeve.displacement", sliding}})
    EXPECT_EQ(complaint(drive), "no complaint");
}

// ---- Couplings ------------------------------------------------------------------------------------------------------

/// A motor of inertia J drives a pendulum of inertia I by q_motor = i q + c: (I + i² J) q̈ = -m g l sin q + i M,
/// whichever of both is the state.
TEST(CouplingElement, IsAGear) {
  const double i = -20, c = 0.3, inertia = 2 * 0.5 * 0.5 + 0.1, motorInertia = 1e-3, q = 0.4, u = 0.7, moment = 0.9;
  const auto machine = [&](bool motorFollows) {
    Mechanism m;
    m.add(Revolute{"arm", "inertial", "A", axisX});
    m.add(Mass{"bob", "A", 2.0, {0.0, 0.0, -0.5}, {0.1, 0.0, 0.1, 0.0, 0.0, 0.0}});
    m.add(Revolute{"motor", "inertial", "M", axisX});
    m.add(Mass{"rotor", "M", 0.0, {0.0, 0.0, 0.0}, {motorInertia, motorInertia, 0.0, 0.0, 0.0, 0.0}});
    m.add(JointForce{"drive", "motor", moment});
    m.add(motorFollows ? Coupling{"gear", "motor", "arm", i, c} : Coupling{"gear", "arm", "motor", 1 / i, -c / i});
    m.setGravity({0.0, 0.0, -10.0});
    return m;
  };
  const double expected = (-2 * 10 * 0.5 * std::sin(q) + i * moment) / (inertia + i * i * motorInertia);
  for (const bool motorFollows : {true, false}) {
    Assembly<double> assembly(machine(motorFollows));
    assembly.setState(motorFollows ? std::vector<double>{q, u} : std::vector<double>{i * q + c, i * u});
    EXPECT_NEAR(assembly.output("arm.angle"), q, 1e-14);
    EXPECT_NEAR(assembly.output("motor.rate"), i * u, 1e-13);
    EXPECT_NEAR(assembly.accelerations()[0], expected * (motorFollows ? 1 : i), 1e-11);
    EXPECT_NEAR(assembly.output("energy.kinetic"), 0.5 * (inertia + i * i * motorInertia) * u * u, 1e-13);
  }
}

/// A rack: the slider's mass is felt as m r² by the pinion.
TEST(CouplingElement, JoinsTurningToSliding) {
  Mechanism m;
  m.add(Revolute{"pinion", "inertial", "A", axisX});
  m.add(Prismatic{"rack", "inertial", "B", axisY});
  m.add(Mass{"carriage", "B", 3.0});
  m.add(JointForce{"push", "rack", 6.0});
  m.add(Coupling{"teeth", "rack", "pinion", Expression::parse("0.25 m/rad")});
  Assembly<double> assembly(m);  // the pinion itself has no mass
  EXPECT_DOUBLE_EQ(assembly.accelerations()[0], 6 * 0.25 / (3 * 0.25 * 0.25));
  EXPECT_NO_THROW(m.checkMasses());
  EXPECT_EQ(m.unitOf("teeth.offset"), "m");
}

/// As a robot's fingers follow one that a study drives: the gear may be there before the drive is.
TEST(CouplingElement, FollowsADrive) {
  for (const bool isGearFirst : {false, true}) {
    Mechanism m;
    m.add(Revolute{"crank", "inertial", "A", axisX});
    m.add(Revolute{"wheel", "inertial", "B", axisX});
    m.add(Revolute{"free", "B", "C", axisX});
    m.add(Mass{"disc", "B", 0.0, {0.0, 0.0, 0.0}, {2.0, 2.0, 0.0, 0.0, 0.0, 0.0}});
    m.add(Mass{"bob", "C", 1.0, {0.0, 1.0, 0.0}});
    const Coupling gear{"gear", "wheel", "crank", 3.0};
    if (isGearFirst) m.add(gear);
    m.add(Drive{"shaft", "crank", Expression::parse("0.5 rad * (t/(1 s))^2")});
    if (!isGearFirst) m.add(gear);
    Assembly<double> assembly(m);
    assembly.setState(std::vector<double>{0.0, 0.0}, 2.0);
    EXPECT_DOUBLE_EQ(assembly.output("wheel.angle"), 6.0);
    EXPECT_DOUBLE_EQ(assembly.output("wheel.rate"), 6.0);
    EXPECT_DOUBLE_EQ(assembly.accelerations()[0], -3.0) << "the bob stays where it is, as the wheel runs away";
    EXPECT_DOUBLE_EQ(assembly.output("shaft.force"), 3.0 * 2.0 * 3.0);
  }
}

TEST(CouplingElement, IsRefusedWhereItCannotBe) {
  const auto complaint = [](const std::vector<Described>& added) -> std::string {
    Mechanism m;
    m.add(Revolute{"a", "inertial", "A", axisX});
    m.add(Revolute{"b", "A", "B", axisX});
    m.add(Prismatic{"c", "B", "C", axisX});
    m.add(Revolute{"moved", "C", "D", axisX, 0.1});
    m.add(Mass{"bob", "D", 1.0, {0.0, 0.0, 1.0}});
    try {
      for (const Described& element : added) m.add(element);
      m.check();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "no complaint";
  };
  EXPECT_EQ(complaint({Coupling{"g", "b", "a"}, Coupling{"h", "c", "b"}}), "no complaint");
  EXPECT_THAT(complaint({Coupling{"g", "a", "a"}}), HasSubstr("the joint 'a.angle' follows itself"));
  EXPECT_THAT(complaint({Coupling{"g", "b", "a"}, Coupling{"h", "b", "c"}}), HasSubstr("driven twice"));
  EXPECT_THAT(complaint({Coupling{"g", "b", "a"}, Coupling{"h", "a", "b"}}),
              HasSubstr("the joint 'a.angle' is driven by 'h' after 'b.angle' follows it"));
  EXPECT_EQ(complaint({Coupling{"g", "b", "a"}, Drive{"d", "a", 0.0}}), "no complaint");
  EXPECT_THAT(complaint({Coupling{"g", "moved", "a"}}), HasSubstr("'moved' has initial values"));
  EXPECT_THAT(complaint({Coupling{"g", "b", "a", Expression::parse("2 m/rad")}}), HasSubstr("'g.ratio'"));
}

// ---- States ---------------------------------------------------------------------------------------------------------

TEST(StateElement, KnowsThatANumberWrittenTwiceIsOne) {
  Mechanism m;
  m.add(State{"x", 1.0, Expression::parse("-sign(x + y - 0.3)")});
  m.add(State{"y", 1.0, Expression::parse("-2*sign(x + y - 0.30)")});
  m.add(State{"z", 1.0, Expression::parse("sign(x + y - 0.31)")});
  EXPECT_EQ(jumpsOf(recordMotion(m)).size(), 2);  // one surface, and another one
}

TEST(StateElement, IsADifferentialEquationWithoutAnyMechanism) {
  Mechanism m;
  for (const auto& [name, value] : {std::pair{"a", "1.5"}, {"b", "1"}, {"c", "1"}, {"d", "3"}})
    m.addParameter(name, Interval(value));
  m.add(State{"prey", 1.0, Expression::parse("prey*(a - b*predator)")});
  m.add(State{"predator", 2.0, Expression::parse("predator*(c*prey - d)")});
  const Program f = recordMotion(m, {"a"});
  Evaluator<double> motion(f);
  motion.setParameters(std::vector<double>{1.25});
  const std::vector<double> dx = motion(0.0, std::vector<double>{0.75, 0.5});
  EXPECT_EQ(dx[0], 0.75 * (1.25 - 0.5));
  EXPECT_EQ(dx[1], 0.5 * (0.75 - 3));
}

TEST(StateElement, TakesTimeForAPlainNumberWhereNothingHasAUnit) {
  Mechanism m;
  m.add(State{"x", 1.0, Expression::parse("sin(2*pi*t) - x*t")});
  EXPECT_NO_THROW(m.check());
  EXPECT_NEAR(Evaluator<double>(recordMotion(m))(0.25, std::vector<double>{2.0})[0], 0.5, 1e-15);
  m.add(State{"y", Expression::parse("1 m"), Expression::parse("y*sin(2*pi*t)")});
  EXPECT_THROW(m.check(), WrongNumber);
}

TEST(StateElement, HasItsRateInItsUnitPerSecond) {
  Mechanism m;
  m.add(State{"level", Expression::parse("2 m"), Expression::parse("-level/(3 s)")});
  EXPECT_NO_THROW(m.check());
  EXPECT_EQ(m.unitOf("level"), "m");
  m.add(State{"wrong", Expression::parse("2 m"), Expression::parse("-wrong * (3 s)")});
  EXPECT_THROW(m.check(), UnitError);
}

// ---- Measurements ---------------------------------------------------------------------------------------------------

TEST(Measurements, HaveTheRatesThatTheySay) {
  Mechanism m = skewPair();
  m.add(Distance{"gap", "A", "C", {1.0, 0.5, 2.0}, {0.1, 0.2, 0.3}});
  m.add(RelativeMotion{"seen", "A", "C"});
  RandomStates states;
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> x = states(4, 1.5);
    EXPECT_NEAR(rateOf("gap.length", m, x), outputAt(m, "gap.rate", x), 1e-13);
    for (const char* c : {"x", "y", "z"})
      EXPECT_NEAR(rateOf(std::string("seen.position.") + c, m, x), outputAt(m, std::string("seen.velocity.") + c, x),
                  1e-13);
  }
}

TEST(Measurements, OfAngleIsThatBetweenTheAxes) {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "A", axisX});
  m.add(Mass{"bob", "A", 1.0, {0.0, 0.0, 1.0}});
  m.add(RelativeMotion{"tilt", "inertial", "A", axisZ});
  for (const double angle : {0.3, -0.7, 2.9})
    EXPECT_NEAR(outputAt(m, "tilt.angle", {angle, 0.0}), std::abs(angle), 1e-15);
}

TEST(Outputs, AreExpressionsOfWhateverCanBeMeasured) {
  const Mechanism m = testing::doublePendulum();
  const std::vector<double> x = {0.4, -0.3, 1.0, 2.0};
  const double y = outputAt(m, "tip.position.y", x), z = outputAt(m, "tip.position.z", x);
  EXPECT_NEAR(outputAt(m, "sqrt(tip.position.y^2 + tip.position.z^2) + t*1 m/(1 s)", x, 0.5), std::hypot(y, z) + 0.5,
              1e-15);
  EXPECT_THROW(outputAt(m, "tip.position.y + nothing", x), std::invalid_argument);
}

// ---- Trees in O(n) --------------------------------------------------------------------------------------------------

TEST(ArticulatedBodies, NeedAsManyOperationsAJointHoweverManyThereAre) {
  const auto operations = [](int joints) {
    Mechanism m;
    for (int i = 0; i < joints; ++i) {
      const std::string n = std::to_string(i);
      m.add(Revolute{"joint" + n, i == 0 ? "inertial" : "E" + std::to_string(i - 1), "K" + n,
                     i % 2 == 0 ? axisZ : axisY});
      m.add(Mass{"body" + n, "K" + n, 1.0 + 0.1 * i, {0.1, 0.2, 0.3}, {0.3, 0.4, 0.5, 0.01, 0.02, 0.03}});
      m.add(Link{"link" + n, "K" + n, "E" + n, {0.1, 0.0, 0.5}});
    }
    m.setGravity({0.0, 0.0, -9.81});
    return recordMotion(m, {}, Formulation::articulated).operations();
  };
  const int eight = operations(8), sixteen = operations(16), thirtyTwo = operations(32);
  EXPECT_EQ(thirtyTwo - sixteen, 2 * (sixteen - eight));
  EXPECT_LE(thirtyTwo, 15000);
  RecordProperty("operations of 32 joints", thirtyTwo);
}

}  // namespace
}  // namespace gamut
