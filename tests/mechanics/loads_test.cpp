// Loads against formulas written by hand: bushing, friction, stops, motors, a base that shakes.
#include <gmock/gmock.h>

#include "machines.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using testing::RandomStates;
using V = Vector3<double>;

/// A disc of 0.5 kg m² on a hinge about x.
Mechanism disc() {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "A", axisX});
  m.add(Mass{"disc", "A", 1.0, {0.0, 0.0, 0.0}, {0.5, 0.5, 0.5, 0.0, 0.0, 0.0}});
  return m;
}

double accelerationAt(const Mechanism& m, double angle, double rate) {
  return Evaluator<double>(recordMotion(m))(0.0, std::vector<double>{angle, rate})[1];
}

TEST(JointFriction, IsCoulombsAndViscous) {
  Mechanism m = disc();
  m.add(JointFriction{"dry", "hinge", 3.0, 0.25});
  EXPECT_NEAR(accelerationAt(m, 0.2, 4), (-3 - 0.25 * 4) / 0.5, 1e-13);
  EXPECT_NEAR(accelerationAt(m, 0.2, -4), (3 + 0.25 * 4) / 0.5, 1e-13);
  EXPECT_NEAR(accelerationAt(m, 0.2, 0), 0, 1e-13);
  Assembly<double> assembly(m);
  assembly.setState(std::vector<double>{0.2, -4});
  EXPECT_NEAR(assembly.output("dry.force"), 4, 1e-13);
  EXPECT_NEAR(assembly.output("dry.power"), -16, 1e-13);
}

TEST(JointFriction, DrivesNothing) {
  for (const bool isSmooth : {false, true}) {
    Mechanism m = disc();
    if (isSmooth)
      m.add(SmoothedJointFriction{"dry", "hinge", -3.0, 0.0, 0.1});
    else
      m.add(JointFriction{"dry", "hinge", -3.0, 0.25});
    EXPECT_THROW(m.check(), std::invalid_argument);
  }
}

TEST(SmoothedJointFriction, ComesToCoulombsBeyondItsSlipRate) {
  Mechanism m = disc();
  m.add(SmoothedJointFriction{"dry", "hinge", 3.0, 0.0, 0.1});
  for (const double rate : {-0.3, -0.1, 0.0, 0.05, 0.1, 2.0})
    EXPECT_NEAR(accelerationAt(m, 0.2, rate), -3 * std::tanh(rate / 0.1) / 0.5, 1e-13);
  Mechanism wrong = disc();
  wrong.add(SmoothedJointFriction{"dry", "hinge", 3.0, 0.0, 0.0});
  EXPECT_THROW(wrong.check(), std::invalid_argument);
}

TEST(JointStop, PushesBackFromBothEnds) {
  Mechanism m = disc();
  m.add(JointStop{"stop", "hinge", -0.5, 0.25, 100.0, 2.0});
  EXPECT_EQ(accelerationAt(m, 0.2, 3), 0);
  EXPECT_EQ(accelerationAt(m, -0.5, -3), 0);
  EXPECT_NEAR(accelerationAt(m, 0.35, 0.1), -100 * 0.1 * (1 + 2 * 0.1) / 0.5, 1e-12);
  EXPECT_NEAR(accelerationAt(m, 0.35, -0.1), -100 * 0.1 * (1 - 2 * 0.1) / 0.5, 1e-12);
  EXPECT_NEAR(accelerationAt(m, -0.7, -0.1), 100 * 0.2 * (1 + 2 * 0.1) / 0.5, 1e-12);
  Mechanism wrong = disc();
  wrong.add(JointStop{"stop", "hinge", 0.5, 0.5, 100.0});
  EXPECT_THROW(wrong.check(), std::invalid_argument);
  for (const JointStop& outwards :
       {JointStop{"stop", "hinge", -0.5, 0.5, -100.0}, JointStop{"stop", "hinge", -0.5, 0.5, 100.0, -1.0}}) {
    Mechanism pushed = disc();
    pushed.add(outwards);
    EXPECT_THROW(pushed.check(), std::invalid_argument);
  }
}

/// (I + J n²) q̈ = n (τ − d n q̇).
TEST(Motor, AddsItsRotorToTheJoint) {
  Mechanism m = disc();
  m.add(Motor{"motor", "hinge", Expression::parse("0.3 N m - 0.01 N m * hinge.angle"), 20.0, 0.002, 0.005});
  EXPECT_NEAR(accelerationAt(m, 0.5, 1.5), 20 * (0.3 - 0.005 - 0.005 * 20 * 1.5) / (0.5 + 0.002 * 400), 1e-13);
  Assembly<double> assembly(m);
  assembly.setState(std::vector<double>{0.5, 1.5});
  EXPECT_NEAR(assembly.output("motor.rate"), 30, 1e-13);
  EXPECT_NEAR(assembly.output("motor.power"), 20 * (0.295 - 0.15) * 1.5, 1e-13);
  EXPECT_NEAR(assembly.output("energy.kinetic"), 0.5 * (0.5 + 0.8) * 2.25, 1e-13);
  // what arrives behind the gear turns the disc alone
  EXPECT_NEAR(assembly.output("hinge.reaction.moment.x"), 0.5 * assembly.output("hinge.acceleration"), 1e-13);
}

/// k (U - k n q̇)/R: what a motor of direct current does at a voltage U follows from its own speed. Power, which
/// follows from that moment, is no ingredient of it.
TEST(Motor, MayBeDrivenByItsOwnSpeed) {
  const double k = 0.05, voltage = 12, resistance = 0.5, ratio = 20;
  Mechanism m = disc();
  m.add(Motor{"motor", "hinge",
              Expression::parse("0.05 N m/ampere*(12 W/ampere - 0.05 J/ampere*motor.rate)/(0.5 W/ampere^2)"), ratio,
              0.002});
  m.check();
  for (const double rate : {-3.0, 0.0, 1.5}) {
    const double moment = k * (voltage - k * ratio * rate) / resistance;
    EXPECT_NEAR(accelerationAt(m, 0.5, rate), ratio * moment / (0.5 + 0.002 * 400), 1e-11);
  }
  Mechanism wrong = disc();
  wrong.add(Motor{"motor", "hinge", Expression::parse("1 N m - 1 s*motor.power"), ratio});
  EXPECT_THROW(wrong.check(), WrongNumber);
  Mechanism through = disc();  // by the way of another
  through.add(Motor{"motor", "hinge", Expression::parse("1 s*other.power"), ratio});
  through.add(Motor{"other", "hinge", Expression::parse("1 N m s*motor.rate + 1 s*motor.power"), ratio});
  EXPECT_THROW(through.check(), WrongNumber);
}

/// dE/dt is the power of the motors, dampers and friction, in both formulations, on a tree of many joints.
TEST(Motor, OnAnArmIsTheSameInBothFormulations) {
  Mechanism m = testing::spatialArm(Interval("0.8"));
  for (const char* joint : {"base", "hip", "slide", "wrist"})
    m.add(Motor{std::string("motor ") + joint, joint, Expression::parse("0.2 N m"), 3.0, 0.02, 0.001});
  m.add(Motor{"second", "hip", 0.0, 5.0, 0.01});
  const Program sparse = recordMotion(m, {}, Formulation::sparse),
                articulated = recordMotion(m, {}, Formulation::articulated);
  const Program energy = recordOutputs(m, {}, {"energy"}).differentiated();
  RandomStates states;
  for (int round = 0; round < 10; ++round) {
    const std::vector<double> x = states(8, 1.2), a = Evaluator<double>(sparse)(0.0, x),
                              b = Evaluator<double>(articulated)(0.0, x), de = Evaluator<double>(energy)(0.0, x);
    Assembly<double> arm(m);
    arm.setState(x);
    const std::vector<double> c = arm.rates();
    double rate = 0, power = 0, scale = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_NEAR(a[i], b[i], 1e-10 * (1 + std::abs(a[i])));
      EXPECT_NEAR(a[i], c[i], 1e-10 * (1 + std::abs(a[i])));
      rate += de[1 + i] * a[i];
      scale += std::abs(de[1 + i] * a[i]);
    }
    for (const char* joint : {"base", "hip", "slide", "wrist"})
      power += arm.output(std::string("motor ") + joint + ".power");
    power -= 0.8 * (x[5] * x[5] + x[6] * x[6]);  // dampers of hip and slide
    const std::vector<double> dLength =
        Evaluator<double>(recordOutputs(m, {}, {"tether.length"}).differentiated())(0.0, x);
    double tether = 0;
    for (std::size_t i = 0; i < x.size(); ++i) tether += dLength[1 + i] * a[i];
    power -= 0.8 * tether * tether;
    EXPECT_NEAR(rate, power, 1e-11 * (1 + scale));
  }
}

/// A driven joint's drive moves the rotor as well.
TEST(Motor, IsMovedByADrive) {
  Mechanism m = disc();
  m.add(Drive{"servo", "hinge", Expression::parse("0.7 rad * sin(3*t/(1 s))")});
  m.add(Motor{"motor", "hinge", 0.0, 20.0, 0.002});
  Assembly<double> assembly(m);
  assembly.setState({}, 0.4);
  EXPECT_NEAR(assembly.output("servo.force"), (0.5 + 0.8) * -0.7 * 9 * std::sin(1.2), 1e-13);
}

/// A body on six coordinates; the bushing's forces are those of its springs for small turns.
Mechanism suspended() {
  Mechanism m;
  m.add(Prismatic{"x", "inertial", "X", axisX});
  m.add(Prismatic{"y", "X", "Y", axisY});
  m.add(Prismatic{"z", "Y", "Z", axisZ});
  m.add(Revolute{"a", "Z", "P", axisX});
  m.add(Revolute{"b", "P", "Q", axisY});
  m.add(Revolute{"c", "Q", "R", axisZ});
  m.add(Mass{"body", "R", 2.0, {0.1, -0.05, 0.2}, {0.2, 0.3, 0.25, 0.01, 0.02, -0.01}});
  return m;
}

Bushing bushing(double damping) {
  return {"mount",
          "inertial",
          "R",
          {100.0, 200.0, 300.0},
          {damping, 2 * damping, 3 * damping},
          {10.0, 20.0, 15.0},
          {damping, damping / 2, damping / 3},
          {0.3, 0.1, -0.2},
          {0.05, -0.1, 0.15}};
}

TEST(Bushing, IsLinearInSmallMovements) {
  Mechanism m = suspended();
  Bushing mount = bushing(0.0);
  mount.fromPoint = mount.toPoint = {0.0, 0.0, 0.0};
  m.add(mount);
  Assembly<double> assembly(m);
  const double e = 1e-6;
  assembly.setState(std::vector<double>{e, 2 * e, -e, 3 * e, -e, 2 * e, 0, 0, 0, 0, 0, 0});
  EXPECT_NEAR(assembly.output("mount.force.x"), -100 * e, 1e-15);
  EXPECT_NEAR(assembly.output("mount.force.y"), -400 * e, 1e-15);
  EXPECT_NEAR(assembly.output("mount.force.z"), 300 * e, 1e-15);
  EXPECT_NEAR(assembly.output("mount.moment.x"), -30 * e, 1e-9);
  EXPECT_NEAR(assembly.output("mount.moment.y"), 20 * e, 1e-9);
  EXPECT_NEAR(assembly.output("mount.moment.z"), -30 * e, 1e-9);
  assembly.setState(std::vector<double>{0, 0, 0, 0.8, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_NEAR(assembly.output("mount.moment.x"), -10 * std::sin(0.8), 1e-13);
}

/// Between two moving frames its forces are those of its energy, and its dampers take some.
TEST(Bushing, KeepsEnergyWithoutDampersAndLosesItByThem) {
  for (const double damping : {0.0, 0.7}) {
    Mechanism m = suspended();
    m.add(Link{"arm", "R", "S", {0.2, 0.1, 0.0}, {{axisX, 0, 0.4}}});
    m.add(Revolute{"d", "S", "T", Axis(1, 2, 3)});
    m.add(Mass{"tail", "T", 1.0, {0.0, 0.2, 0.3}, {0.1, 0.1, 0.1, 0.0, 0.0, 0.0}});
    Bushing mount = bushing(damping);
    mount.from = "T";
    mount.to = "X";
    m.add(mount);
    m.add(RelativeMotion{"seen", "T", "X", axisZ, mount.fromPoint, mount.toPoint});
    const Program f = recordMotion(m), energy = recordOutputs(m, {}, {"energy"}).differentiated();
    RandomStates states;
    for (int round = 0; round < 5; ++round) {
      const std::vector<double> x = states(14, 0.8), dx = Evaluator<double>(f)(0.0, x),
                                de = Evaluator<double>(energy)(0.0, x);
      Assembly<double> assembly(m);
      assembly.setState(x);
      double rate = 0, scale = 1, power = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        rate += de[1 + i] * dx[i];
        scale += std::abs(de[1 + i] * dx[i]);
      }
      const double linear[3] = {damping, 2 * damping, 3 * damping}, angular[3] = {damping, damping / 2, damping / 3};
      for (std::size_t i = 0; i < 3; ++i) {
        const double v = assembly.output(std::string("seen.velocity.") + components[i]),
                     w = assembly.output(std::string("seen.angular_velocity.") + components[i]);
        power -= linear[i] * v * v + angular[i] * w * w;
      }
      EXPECT_NEAR(rate, power, 1e-12 * scale);
    }
  }
}

/// l φ̈ = −g sin φ − b(t) cos φ, as if a slider moved the pivot with this acceleration; positions are seen from it.
TEST(BaseAcceleration, ShakesAPendulum) {
  Mechanism m;
  m.addParameter("amplitude", Interval("3"), "m/s^2");
  m.setBaseAcceleration({Expression::parse("amplitude * sin(4*t/(1 s))"), 0.0, 0.5});
  m.add(Revolute{"hinge", "inertial", "A", axisY});
  m.add(Link{"rod", "A", "B", {0.0, 0.0, Interval("-0.7")}});
  m.add(Mass{"bob", "B", 2.0});
  m.setGravity({0.0, 0.0, Interval("-9.81")});
  Assembly<double> arm(m);
  const Program f = recordMotion(m, {"amplitude"});
  Evaluator<double> motion(f);
  motion.setParameters(std::vector<double>{2.0});
  RandomStates states;
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> x = states(2);
    const double t = 0.1 * i, g = 9.81 + 0.5;
    // about y a positive angle moves the bob to −x
    const auto expected = [&](double amplitude) {
      return (-g * std::sin(x[0]) + amplitude * std::sin(4 * t) * std::cos(x[0])) / 0.7;
    };
    EXPECT_NEAR(motion(t, x)[1], expected(2.0), 1e-12);
    arm.setState(x, t);
    EXPECT_NEAR(arm.output("hinge.acceleration"), expected(3.0), 1e-12);
    EXPECT_NEAR(arm.output("B.acceleration.z"), 0.7 * (expected(3.0) * std::sin(x[0]) + x[1] * x[1] * std::cos(x[0])),
                1e-12);
    EXPECT_NEAR(arm.output("hinge.reaction.force.z"),
                2 * (g * std::cos(x[0]) + 3.0 * std::sin(4 * t) * std::sin(x[0]) + 0.7 * x[1] * x[1]), 1e-11);
  }
  Mechanism wrong;
  wrong.add(Revolute{"hinge", "inertial", "A", axisY});
  EXPECT_THROW(
      {
        wrong.setBaseAcceleration({Expression::parse("1 m/s^2 * sin(hinge.angle)"), 0.0, 0.0});
        wrong.check();
      },
      std::invalid_argument);
}

}  // namespace
}  // namespace gamut
