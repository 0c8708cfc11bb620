// What is measured of a motion, against equations written down by hand and against laws of mechanics: balance of power
// and of momentum, and a Newton-Euler recursion in inertial axes that shares nothing with the elements.
#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "machines.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using testing::RandomStates;
using V = Vector3<double>;

V vectorOf(const Assembly<double>& assembly, const std::string& name) {
  return {assembly.output(name + ".x"), assembly.output(name + ".y"), assembly.output(name + ".z")};
}

/// dy/dt along the motion.
double rateInTime(const std::string& output, const Mechanism& mechanism, const std::vector<double>& x, double t = 0) {
  const Program f = recordMotion(mechanism), y = recordOutputs(mechanism, {}, {output});
  // time as a further state
  const Program alone = record(y.states() + 1, 0, 1, [&](auto, const auto& s, const auto&, auto& out) {
    Assembly<Recorded> assembly(mechanism);
    assembly.setState(std::vector<Recorded>(s.begin(), s.end() - 1), s[s.size() - 1]);
    out[0] = assembly.output(output);
  });
  std::vector<double> extended = x, dx = Evaluator<double>(f)(t, x);
  extended.push_back(t);
  dx.push_back(1);
  const std::vector<double> dy = Evaluator<double>(alone.differentiated())(t, extended);
  double rate = 0;
  for (std::size_t i = 0; i < dx.size(); ++i) rate += dy[1 + i] * dx[i];
  return rate;
}

Mechanism pendulum() {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "A", axisX, 0.3, 0.1});
  m.add(Link{"rod", "A", "B", {0.0, 0.0, Interval("-0.7")}});
  m.add(Mass{"bob", "B", Interval("2.5")});
  m.setGravity({0.0, 0.0, Interval("-9.81")});
  return m;
}

/// m g cos φ + m L φ̇² along the rod and nothing across, φ̈ = −g/L sin φ; the hinge bears no moment.
TEST(Reaction, OfAPendulumIsWhatItsEquationSays) {
  Assembly<double> arm(pendulum());
  RandomStates states;
  for (int i = 0; i < 50; ++i) {
    const std::vector<double> x = i == 0 ? std::vector<double>{0, 0} : states(2);
    arm.setState(x);
    const double tension = 2.5 * 9.81 * std::cos(x[0]) + 2.5 * 0.7 * x[1] * x[1];
    for (const char* name : {"hinge.reaction", "rod.reaction"}) {
      EXPECT_LE((vectorOf(arm, std::string(name) + ".force") - V(0, 0, tension)).norm(), 1e-13 * (30 + tension));
      EXPECT_LE(vectorOf(arm, std::string(name) + ".moment").norm(), 1e-13 * (30 + tension));
    }
    const double acceleration = -9.81 / 0.7 * std::sin(x[0]);
    EXPECT_NEAR(arm.output("hinge.acceleration"), acceleration, 1e-12);
    EXPECT_NEAR(arm.output("B.angular_acceleration.x"), acceleration, 1e-12);
    // B = L (0, sin φ, −cos φ)
    const double c = std::cos(x[0]), s = std::sin(x[0]), w2 = x[1] * x[1];
    const V expected = 0.7 * V(0, acceleration * c - w2 * s, acceleration * s + w2 * c);
    EXPECT_LE((vectorOf(arm, "B.acceleration") - expected).norm(), 1e-12 * (1 + expected.norm()));
    EXPECT_LE((vectorOf(arm, "bob.acceleration") - expected).norm(), 1e-12 * (1 + expected.norm()));
  }
}

TEST(Reaction, IsEnclosed) {
  const Mechanism m = pendulum();
  const Program g = recordOutputs(m, {"bob.mass"}, {"hinge.reaction.force.z", "hinge.acceleration"});
  Evaluator<Interval> enclosed(g);
  enclosed.setParameters(std::vector<Interval>{Interval(2.4, 2.6)});
  const std::vector<Interval> box = {Interval(0.3, 0.31), Interval(0.9, 1.1)}, y = enclosed(0.0, box);
  Assembly<Interval> direct(m, {"bob.mass"}, std::vector<Interval>{Interval(2.4, 2.6)});
  direct.setState(box);
  Evaluator<double> at(g);
  for (double mass : {2.4, 2.5, 2.6})
    for (double angle : {0.3, 0.305, 0.31})
      for (double rate : {0.9, 1.0, 1.1}) {
        const double tension = mass * 9.81 * std::cos(angle) + mass * 0.7 * rate * rate;
        EXPECT_TRUE(contains(y[0], tension));
        EXPECT_TRUE(contains(direct.output("hinge.reaction.force.z"), tension));
        EXPECT_TRUE(contains(direct.output("hinge.acceleration"), -9.81 / 0.7 * std::sin(angle)));
      }
  EXPECT_LE(width(y[0]),
            1.05 * (2.6 * (9.81 * std::cos(0.3) + 0.7 * 1.21) - 2.4 * (9.81 * std::cos(0.31) + 0.7 * 0.81)));
}

/// A rotor that spins at Ω in a fork that turns at ω: the fork's joint bears J Ω ω across both axes.
TEST(Reaction, OfASpinningRotorIsGyroscopic) {
  Mechanism m;
  m.add(Revolute{"fork", "inertial", "F", axisZ, 0.4, 2.0});
  m.add(Revolute{"spin", "F", "R", axisX, 0.2, 30.0});
  m.add(Mass{"rotor", "R", 3.0, {0.0, 0.0, 0.0}, {0.05, 0.03, 0.03, 0.0, 0.0, 0.0}});
  Assembly<double> gyroscope(m);
  EXPECT_NEAR(gyroscope.output("fork.reaction.moment.y"), 0.05 * 30 * 2, 1e-12);
  EXPECT_NEAR(gyroscope.output("fork.reaction.moment.x"), 0, 1e-12);
  EXPECT_NEAR(gyroscope.output("fork.reaction.moment.z"), 0, 1e-12) << "the hinge is free";
  EXPECT_NEAR(gyroscope.output("spin.acceleration"), 0, 1e-12);
  // in the axes of the rotor, which is turned by 0.2 rad
  EXPECT_NEAR(gyroscope.output("spin.reaction.moment.y"), 3 * std::cos(0.2), 1e-12);
  EXPECT_NEAR(gyroscope.output("spin.reaction.moment.z"), -3 * std::sin(0.2), 1e-12);
}

/// Bodies of the spatial arm by their motion alone: what their momentum changes by, less gravity and the tether's pull,
/// is what the joint in front of them exerts.
TEST(Reaction, OfASpatialArmIsNewtonsAndEulersByTheBodiesBehind) {
  struct Body {
    std::string name, frame;
    double mass;
    V centre;
    std::array<double, 6> inertia;
  };
  const std::vector<Body> bodies = {{"column", "A", 2.0, {0.1, -0.2, 0.3}, {0.4, 0.5, 0.3, 0.02, -0.03, 0.05}},
                                    {"boomBody", "D", 1.5, {0.0, 0.05, 0.4}, {0.2, 0.25, 0.1, 0.0, 0.01, 0.0}},
                                    {"carriage", "E", 0.7, {0.02, 0.0, 0.03}, {0.03, 0.02, 0.04, 0.0, 0.0, 0.0}},
                                    {"hand", "F", 0.4, {0.1, 0.2, -0.1}, {0.01, 0.02, 0.015, 0.001, 0.002, -0.001}}};
  const V gravity(0.5, -1.0, -9.0);
  // element, frame, first body behind it
  const std::vector<std::tuple<std::string, std::string, std::size_t>> joints = {
      {"base", "A", 0}, {"offset", "B", 1}, {"hip", "C", 1}, {"boom", "D", 1}, {"slide", "E", 2}, {"wrist", "F", 3}};
  Mechanism m = testing::spatialArm(Interval("0.8"));
  Assembly<double> arm(m);
  RandomStates states;
  for (int round = 0; round < 20; ++round) {
    arm.setState(states(8, 1.5));
    for (const auto& [joint, frame, first] : joints) {
      const V origin = arm.frame(frame).R * arm.frame(frame).r;
      V force = V::Zero(), moment = V::Zero();
      for (std::size_t b = first; b < bodies.size(); ++b) {
        const Body& body = bodies[b];
        const Matrix3<double> r = arm.frame(body.frame).R;
        const auto& [xx, yy, zz, xy, yz, zx] = body.inertia;
        Matrix3<double> theta;
        theta << xx, xy, zx, xy, yy, yz, zx, yz, zz;
        theta = r * theta * r.transpose();
        const V omega = vectorOf(arm, body.frame + ".angular_velocity"),
                omegaDot = vectorOf(arm, body.frame + ".angular_acceleration"),
                centre = vectorOf(arm, body.name + ".position");
        const V needed = body.mass * (vectorOf(arm, body.name + ".acceleration") - gravity);
        force += needed;
        moment += theta * omegaDot + omega.cross(theta * omega) + (centre - origin).cross(needed);
      }
      // the tether holds the hand
      const V here = vectorOf(arm, "F.position") + arm.frame("F").R * V(0.1, 0.0, 0.2), there(1.0, 1.5, -0.5);
      const V pull = arm.output("tether.force") * (here - there).normalized();
      force -= pull;
      moment -= (here - origin).cross(pull);
      const Matrix3<double>& r = arm.frame(frame).R;
      const double scale = 1e-11 * (10 + force.norm() + moment.norm());
      EXPECT_LE((r * vectorOf(arm, joint + ".reaction.force") - force).norm(), scale) << joint;
      EXPECT_LE((r * vectorOf(arm, joint + ".reaction.moment") - moment).norm(), scale) << joint;
    }
  }
}

/// Accelerations and rates of momentum are derivatives of what they are derived from, along the motion.
TEST(Measurements, AreEachOthersDerivatives) {
  Mechanism m = testing::spatialArm(Interval("0.8"));
  m.add(RelativeMotion{"seen", "B", "F", axisZ, {0.3, -0.1, 0.2}, {0.1, 0.2, 0.4}});
  RandomStates states;
  for (int round = 0; round < 5; ++round) {
    const std::vector<double> x = states(8, 1.0);
    Assembly<double> arm(m);
    arm.setState(x);
    for (const char* component : {".x", ".y", ".z"})
      for (const auto& [value, rate] : std::vector<std::pair<std::string, std::string>>{
               {"F.position", "F.velocity"},
               {"F.velocity", "F.acceleration"},
               {"F.angular_velocity", "F.angular_acceleration"},
               {"hand.velocity", "hand.acceleration"},
               {"seen.position", "seen.velocity"},
               {"seen.velocity", "seen.acceleration"},
               {"seen.angular_velocity", "seen.angular_acceleration"},
               {"centre_of_mass.position", "centre_of_mass.velocity"},
               {"centre_of_mass.velocity", "centre_of_mass.acceleration"}}) {
        const double expected = rateInTime(value + component, m, x);
        EXPECT_NEAR(arm.output(rate + component), expected, 1e-11 * (10 + std::abs(expected))) << rate << component;
      }
    EXPECT_NEAR(arm.output("wrist.acceleration"), rateInTime("wrist.rate", m, x), 1e-10);
    EXPECT_NEAR(arm.output("energy.gravity") + arm.output("energy.springs"), arm.output("energy.potential"), 1e-12);
    EXPECT_NEAR(arm.output("energy.kinetic") + arm.output("energy.potential"), arm.output("energy"), 1e-12);
  }
}

/// Ȧ = A [ω]: of roll, pitch and yaw by their kinematic equation, of the rotation vector by its exponential.
TEST(Orientation, TurnsBackToTheRotationMatrix) {
  Mechanism m;
  m.add(Revolute{"a", "inertial", "A", axisZ});
  m.add(Revolute{"b", "A", "B", axisY});
  m.add(Revolute{"c", "B", "C", axisX});
  m.add(RelativeMotion{"seen", "A", "C"});
  m.add(Mass{"body", "C", 1.0, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}});
  Assembly<double> arm(m);
  RandomStates states;
  for (int i = 0; i < 50; ++i) {
    std::vector<double> x = states(6, 1.5);
    arm.setState(x);
    EXPECT_NEAR(arm.output("C.orientation.yaw"), x[0], 1e-13);
    EXPECT_NEAR(arm.output("C.orientation.pitch"), x[1], 1e-13);
    EXPECT_NEAR(arm.output("C.orientation.roll"), x[2], 1e-13);
    EXPECT_NEAR(arm.output("seen.orientation.yaw"), 0, 1e-13);
    EXPECT_NEAR(arm.output("seen.orientation.pitch"), x[1], 1e-13);
    const V turn = vectorOf(arm, "C.rotation_vector");
    const Matrix3<double> r = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    EXPECT_LE((r - arm.frame("C").R).norm(), 1e-13);
  }
}

/// About one axis the rotation vector is the angle, of which it is an enclosure, from none on.
TEST(Orientation, TheRotationVectorIsTheAngle) {
  Mechanism m;
  m.add(Revolute{"a", "inertial", "A", axisY});
  m.add(Mass{"body", "A", 1.0, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}});
  Assembly<Interval> turned(m);
  Assembly<double> sampled(m);
  for (const double angle : {0.0, 1e-300, 1e-9, -1e-5, 0.1, -0.75, 1.0, 2.0, -3.0, 3.14}) {
    turned.setState(std::vector<Interval>{angle, 0.0});
    sampled.setState(std::vector<double>{angle, 0.0});
    const Interval found = turned.output("A.rotation_vector.y");
    const double left = 3.2 - std::abs(angle);
    EXPECT_TRUE(contains(found, angle)) << found << " " << angle;
    EXPECT_LE(width(found), 1e-13 * std::abs(angle) / left) << angle;
    EXPECT_TRUE(isEqual(turned.output("A.rotation_vector.x"), Interval(0.0)));
    EXPECT_NEAR(sampled.output("A.rotation_vector.y"), angle, 1e-14 * std::abs(angle) / left);
  }
}

/// However little is known of an orientation, its rotation vector is no longer than π in any direction.
TEST(Orientation, TheRotationVectorIsNowhereBeyondHalfATurn) {
  Mechanism m;
  m.add(Revolute{"a", "inertial", "A", axisY});
  m.add(Mass{"body", "A", 1.0, {0.0, 0.0, 0.0}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}});
  Assembly<Interval> turned(m);
  for (const Interval& angle : {Interval(3.0, 3.3), Interval(-4.0, 4.0), halfPi() + halfPi()}) {
    turned.setState(std::vector<Interval>{angle, 0.0});
    const Interval found = turned.output("A.rotation_vector.y");
    EXPECT_LE(magnitude(found), 3.1415926535897940) << angle;
    EXPECT_TRUE(contains(found, std::max(angle.lower(), -3.0))) << found << " " << angle;  // -4 is 2.3
  }
}

/// Without forces from outside, momentum and the angular momentum about the origin stay; with gravity they change by
/// it.
TEST(Momentum, ChangesByForcesFromOutside) {
  Mechanism m = testing::spatialArm(Interval("0.8"));
  RandomStates states;
  for (int round = 0; round < 5; ++round) {
    const std::vector<double> x = states(8, 1.0);
    Assembly<double> arm(m);
    arm.setState(x);
    const double mass = 2.0 + 1.5 + 0.7 + 0.4;
    const V here = vectorOf(arm, "F.position") + arm.frame("F").R * V(0.1, 0.0, 0.2), there(1.0, 1.5, -0.5);
    const V pull = arm.output("tether.force") * (here - there).normalized();
    // the base frame stands at the origin
    const Matrix3<double>& r = arm.frame("A").R;
    const V force = r * vectorOf(arm, "base.reaction.force") + mass * V(0.5, -1.0, -9.0) + pull;
    const V moment = r * vectorOf(arm, "base.reaction.moment") + here.cross(pull) +
                     vectorOf(arm, "centre_of_mass.position").cross(mass * V(0.5, -1.0, -9.0));
    for (int i = 0; i < 3; ++i) {
      const std::string component = std::string(".") + components[static_cast<std::size_t>(i)];
      EXPECT_NEAR(rateInTime("momentum" + component, m, x), force[i], 1e-11 * (10 + force.norm()));
      EXPECT_NEAR(rateInTime("angular_momentum" + component, m, x), moment[i], 1e-11 * (10 + moment.norm()));
      EXPECT_NEAR(arm.output("momentum" + component), mass * arm.output("centre_of_mass.velocity" + component), 1e-12);
    }
  }
}

/// One joint driven, one free: energy grows by what the drive and the motor bring in.
TEST(DriveForce, BringsInThePowerThatTheEnergyGrowsBy) {
  Mechanism m;
  m.add(Revolute{"shoulder", "inertial", "A", axisY});
  m.add(Link{"upper", "A", "B", {0.0, 0.0, -0.8}});
  m.add(Mass{"elbow", "B", 1.5, {0.0, 0.05, 0.4}, {0.2, 0.25, 0.1, 0.0, 0.01, 0.0}});
  m.add(Revolute{"joint", "B", "C", Axis(1, 2, 0)});
  m.add(Mass{"hand", "C", 0.5, {0.1, 0.0, -0.6}, {0.02, 0.025, 0.01, 0.0, 0.001, 0.0}});
  m.add(Drive{"servo", "shoulder", Expression::parse("0.7 rad * sin(3*t/(1 s))")});
  m.add(JointForce{"motor", "joint", Expression::parse("0.4 N m - 0.3 N m s * joint.rate")});
  m.add(Force{"push", "C", {1.0, 2.0, 3.0}, {0.1, 0.2, 0.3}, {0.1, 0.0, 0.2}});
  m.setGravity({0.0, 0.0, Interval("-9.81")});
  for (const double t : {0.0, 0.3, 0.9}) {
    const std::vector<double> x = {0.4, -1.2};
    Assembly<double> arm(m);
    arm.setState(x, t);
    EXPECT_NEAR(rateInTime("energy", m, x, t),
                arm.output("servo.power") + arm.output("motor.power") + arm.output("push.power"), 1e-11);
    EXPECT_NEAR(arm.output("servo.power"), arm.output("servo.force") * arm.output("shoulder.rate"), 1e-12);
    EXPECT_NEAR(arm.output("servo.force"), arm.output("shoulder.reaction.moment.y"), 1e-12);
    EXPECT_NEAR(arm.output("shoulder.acceleration"), -0.7 * 9 * std::sin(3 * t), 1e-12);
  }
}

std::string complaint(Mechanism& m) {
  try {
    m.check();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Measurements, OfForcesAreNoIngredientOfForces) {
  const auto with = [](const std::string& force) {
    Mechanism m = pendulum();
    m.add(JointForce{"motor", "hinge", Expression::parse(force)});
    return complaint(m);
  };
  EXPECT_EQ(with("-0.1 N m s * hinge.rate"), "");
  EXPECT_THAT(with("0.1 kg m^2 * hinge.acceleration"),
              HasSubstr("'motor.force': 'hinge.acceleration' follows from all"));
  EXPECT_THAT(with("0.1 m * hinge.reaction.force.z"), HasSubstr("'hinge.reaction.force.z' follows from all forces"));
  EXPECT_THAT(with("1 kg m * centre_of_mass.acceleration.z"), HasSubstr("follows from all forces"));
  EXPECT_THAT(with("1 s * motor.power"), HasSubstr("'motor.force': it depends on 'motor.power', which depends on it"));
  Mechanism m = pendulum();
  m.add(JointForce{"one", "hinge", Expression::parse("1 s * two.power")});
  m.add(JointForce{"two", "hinge", Expression::parse("2 s * one.power")});
  EXPECT_THAT(complaint(m), HasSubstr("'one.force': it depends on 'one.power', which depends on it"));
}

/// A filter of an accelerometer: its rate may follow what forces bring about.
TEST(Measurements, OfForcesEnterRatesOfStates) {
  Mechanism m = pendulum();
  m.add(State{"filtered", Expression::parse("0 m/s^2"), Expression::parse("(bob.acceleration.z - filtered)/(0.1 s)")});
  const std::vector<double> x = {0.4, -1.2, 0.3};
  Assembly<double> arm(m);
  arm.setState(x);
  for (const Formulation formulation : {Formulation::sparse, Formulation::articulated})
    EXPECT_NEAR(Evaluator<double>(recordMotion(m, {}, formulation))(0.0, x)[2],
                (arm.output("bob.acceleration.z") - 0.3) / 0.1, 1e-11);
}

TEST(Measurements, AreAlikeInEveryScalar) {
  Mechanism m = testing::spatialArm(Interval("0.8"));
  m.add(RelativeMotion{"seen", "B", "F"});
  RandomStates states;
  const std::vector<double> x = states(8, 1.0);
  const auto outputs = [&]<class S>(S /*scalar*/) {
    Assembly<S> assembly(m);
    assembly.setState(std::vector<S>(x.begin(), x.end()));
    std::vector<S> y;
    for (const std::string& name : m.outputQuantities()) y.push_back(assembly.output(name));
    return y;
  };
  const std::vector<double> a = outputs(0.0), e = Evaluator<double>(recordOutputs(m, {}, m.outputQuantities()))(0.0, x);
  const std::vector<Interval> b = outputs(Interval(0.0)),
                              d = Evaluator<Interval>(recordOutputs(m, {}, m.outputQuantities()))(
                                  0.0, std::vector<Interval>(x.begin(), x.end()));
  const std::vector<Samples> c = outputs(Samples(0.0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double scale = 1e-10 * (1 + std::abs(a[i]));
    EXPECT_NEAR(e[i], a[i], scale) << m.outputQuantities()[i];
    EXPECT_NEAR(midpoint(b[i]), a[i], scale) << m.outputQuantities()[i];
    EXPECT_LE(width(b[i]), 100 * scale) << m.outputQuantities()[i];
    EXPECT_LE(width(d[i]), 100 * scale) << m.outputQuantities()[i];
    EXPECT_NEAR(c[i][0], a[i], scale) << m.outputQuantities()[i];
  }
}

}  // namespace
}  // namespace gamut
