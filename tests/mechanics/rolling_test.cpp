// What rolls or glides without slip: no point that touches slips, Newton's and Euler's laws hold with the forces that
// are measured, and motions of textbooks are met.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "machines.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

using testing::placeOf;
using testing::RandomStates;
using testing::statesOf;

constexpr double wheelRadius = 0.3, crownRadius = 0.05, fall = 9.0;

class MovingOutputs {
 public:
  MovingOutputs(const Mechanism& mechanism, const std::vector<std::string>& names)
      : motion_(recordMotion(mechanism)),
        outputs_(recordOutputs(mechanism, {}, names)),
        rates_(recordOutputs(mechanism, {}, names).differentiated()) {}

  std::vector<double> at(const std::vector<double>& x) { return outputs_(0.0, x); }
  /// By time, along the motion.
  std::vector<double> ratesAt(const std::vector<double>& x) {
    const std::vector<double> dx = motion_(0.0, x), dy = rates_(0.0, x);
    const std::size_t outputs = dy.size() / (1 + x.size());
    std::vector<double> result(outputs, 0.0);
    for (std::size_t o = 0; o < outputs; ++o)
      for (std::size_t i = 0; i < x.size(); ++i) result[o] += dy[outputs + o * x.size() + i] * dx[i];
    return result;
  }

 private:
  Evaluator<double> motion_, outputs_, rates_;
};

std::vector<std::string> componentsOf(const std::string& name) { return {name + ".x", name + ".y", name + ".z"}; }

std::vector<std::string> allOf(const std::vector<std::vector<std::string>>& lists) {
  std::vector<std::string> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

using Triple = std::array<double, 3>;
Triple crossed(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Triple tripleAt(const std::vector<double>& y, std::size_t from) { return {y[from], y[from + 1], y[from + 2]}; }

const std::array<Expression, 6> lopsidedInertia{0.1, 0.2, 0.25, 0.01, -0.02, 0.03};

/// A wheel with a body that is not symmetric and a rider on its axle.
Mechanism unicycleWith(double rounding) {
  Mechanism m;
  m.add(RollingWheel{"wheel", "inertial", "W", wheelRadius, rounding});
  m.add(Mass{"body", "W", 2.0, {0.02, -0.01, 0.03}, lopsidedInertia});
  m.add(Revolute{"axle", "W", "A", axisY});
  m.add(Mass{"rider", "A", 1.5, {0.0, 0.05, 0.4}, lopsidedInertia});
  m.setGravity({0.0, 0.0, -fall});
  return m;
}

Mechanism ballMachine(const std::array<Expression, 6>& inertia, bool withPendulum) {
  Mechanism m;
  m.add(RollingBall{"ball", "inertial", "B", wheelRadius});
  m.add(Mass{"body", "B", 2.0, {0.0, 0.0, 0.0}, inertia});
  if (withPendulum) {
    m.add(Revolute{"axle", "B", "A", Axis(1, 2, -2)});
    m.add(Mass{"weight", "A", 1.5, {0.0, 0.05, -0.1}, lopsidedInertia});
  }
  m.setGravity({0.0, 0.0, -fall});
  return m;
}

const std::array<Expression, 6> roundInertia{0.1, 0.1, 0.1, 0.0, 0.0, 0.0};

// ---- No slip --------------------------------------------------------------------------------------------------------

class RollingWheels : public ::testing::TestWithParam<double> {};

TEST_P(RollingWheels, DoNotSlipWhereTheyTouch) {
  const double rounding = GetParam();
  const Mechanism m = unicycleWith(rounding);
  MovingOutputs outputs(m, allOf({componentsOf("W.position"),
                                  componentsOf("W.velocity"),
                                  componentsOf("W.angular_velocity"),
                                  {"wheel.x", "wheel.y", "wheel.heading", "wheel.lean"}}));
  MovingOutputs place(m, {"wheel.x", "wheel.y", "W.position.x", "W.position.y", "W.position.z"});
  RandomStates random;
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<double> x = statesOf(m, random, 1.4), y = outputs.at(x), rates = place.ratesAt(x);
    const Triple centre = tripleAt(y, 0), velocity = tripleAt(y, 3), omega = tripleAt(y, 6), touching{y[9], y[10], 0.0};
    const Triple arm{touching[0] - centre[0], touching[1] - centre[1], touching[2] - centre[2]};
    const Triple turned = crossed(omega, arm);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(velocity[i] + turned[i], 0.0, 1e-13);
      EXPECT_NEAR(rates[2 + i], velocity[i], 1e-13) << "positions and velocities of the centre";
    }
    EXPECT_NEAR(centre[2], rounding + (wheelRadius - rounding) * std::cos(y[12]), 1e-15);
  }
}

TEST_P(RollingWheels, ObeyNewtonAndEuler) {
  const Mechanism m = unicycleWith(GetParam());
  MovingOutputs motion(m, allOf({componentsOf("momentum"), componentsOf("angular_momentum"), {"energy"}}));
  MovingOutputs now(
      m, {"wheel.x", "wheel.y", "wheel.heading", "wheel.normal_force", "wheel.longitudinal_force",
          "wheel.lateral_force", "centre_of_mass.position.x", "centre_of_mass.position.y", "wheel.squared_grip"});
  RandomStates random;
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<double> x = statesOf(m, random, 1.2), y = now.at(x), change = motion.ratesAt(x);
    const double c = std::cos(y[2]), s = std::sin(y[2]), weight = 3.5 * fall;
    const Triple force{y[4] * c - y[5] * s, y[4] * s + y[5] * c, y[3]};
    const Triple moment = crossed({y[0], y[1], 0.0}, force), ofWeight = crossed({y[6], y[7], 0.0}, {0.0, 0.0, -weight});
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(change[i], force[i] - (i == 2 ? weight : 0.0), 1e-10);
      EXPECT_NEAR(change[3 + i], moment[i] + ofWeight[i], 1e-10);
    }
    EXPECT_NEAR(change[6], 0.0, 1e-10) << "no power where nothing slips";
    EXPECT_NEAR(y[8], (y[4] * y[4] + y[5] * y[5]) / (y[3] * y[3]), 1e-12 * (1 + y[8]));
  }
}

INSTANTIATE_TEST_SUITE_P(CrownRadii, RollingWheels, ::testing::Values(0.0, crownRadius, 0.99 * wheelRadius));

/// A disc of moments A about a diameter and C about its axle, on an edge, that goes round at Ω to where it leans by θ
/// and turns by ω against the frame that leans: what Euler's equation about the point that touches leaves of lean,
///   (C + m r²) ω Ω cos θ − (C + m r² − A) Ω² sin θ cos θ = m g r sin θ.
TEST(RollingWheelMotion, IsSteadyOnACircle) {
  constexpr double mass = 2.0, a = 0.045, c = 0.09, lean = 0.4, precession = 1.5;
  Mechanism m;
  m.add(RollingWheel{"wheel", "inertial", "W", wheelRadius});
  m.add(Mass{"body", "W", mass, {0.0, 0.0, 0.0}, {a, c, a, 0.0, 0.0, 0.0}});
  m.setGravity({0.0, 0.0, -fall});
  const double turn =
      (mass * fall * wheelRadius * std::sin(lean) +
       (c + mass * wheelRadius * wheelRadius - a) * precession * precession * std::sin(lean) * std::cos(lean)) /
      ((c + mass * wheelRadius * wheelRadius) * precession * std::cos(lean));
  std::vector<double> x(m.stateNames().size(), 0.0);
  x[placeOf(m, "wheel.lean")] = lean;
  x[placeOf(m, "wheel.heading")] = 0.7;
  x[placeOf(m, "wheel.heading_rate")] = -precession;  // to the right, where it leans
  x[placeOf(m, "wheel.rate")] = turn;
  const std::vector<double> dx = Evaluator<double>(recordMotion(m))(0.0, x);
  for (const char* speed : {"wheel.heading_rate", "wheel.lean_rate", "wheel.rate"})
    EXPECT_NEAR(dx[placeOf(m, speed)], 0.0, 1e-13) << speed;
}

TEST(RollingBalls, DoNotSlipWhereTheyTouch) {
  const Mechanism m = ballMachine(lopsidedInertia, true);
  MovingOutputs outputs(
      m, allOf({componentsOf("B.position"), componentsOf("B.velocity"), componentsOf("B.angular_velocity")}));
  MovingOutputs place(m, {"ball.x", "ball.y", "B.position.x", "B.position.y", "B.position.z"});
  RandomStates random;
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<double> x = statesOf(m, random), y = outputs.at(x);
    const Triple velocity = tripleAt(y, 3), turned = crossed(tripleAt(y, 6), {0.0, 0.0, -wheelRadius});
    const std::vector<double> rates = place.ratesAt(x);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(velocity[i] + turned[i], 0.0, 1e-14);
      EXPECT_NEAR(rates[2 + i], velocity[i], 1e-14);
    }
    EXPECT_EQ(y[2], wheelRadius);
  }
}

TEST(RollingBalls, ObeyNewtonAndEuler) {
  for (const auto& [inertia, withPendulum] :
       {std::pair{roundInertia, false}, {roundInertia, true}, {lopsidedInertia, false}, {lopsidedInertia, true}}) {
    const Mechanism m = ballMachine(inertia, withPendulum);
    MovingOutputs motion(m, allOf({componentsOf("momentum"), componentsOf("angular_momentum"), {"energy"}}));
    MovingOutputs now(m, {"ball.x", "ball.y", "ball.friction.x", "ball.friction.y", "ball.normal_force",
                          "centre_of_mass.position.x", "centre_of_mass.position.y"});
    RandomStates random;
    for (int trial = 0; trial < 10; ++trial) {
      const std::vector<double> x = statesOf(m, random);
      const std::vector<double> y = now.at(x), change = motion.ratesAt(x);
      const double weight = (withPendulum ? 3.5 : 2.0) * fall;
      const Triple force = tripleAt(y, 2), moment = crossed({y[0], y[1], 0.0}, force);
      const Triple ofWeight = crossed({y[5], y[6], 0.0}, {0.0, 0.0, -weight});
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(change[i], force[i] - (i == 2 ? weight : 0.0), 1e-11);
        EXPECT_NEAR(change[3 + i], moment[i] + ofWeight[i], 1e-11);
      }
      EXPECT_NEAR(change[6], 0.0, 1e-11);
    }
  }
}

/// A ball on a turntable goes round in circles, at 2/7 of its speed if it is homogeneous (J. A. Burns, Am. J. Phys. 49,
/// 1981): of the velocity in the inertial frame, v̇ = Ω × v · 2/7.
TEST(RollingBalls, GoRoundOnATurntable) {
  constexpr double turning = 3.0;
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "table", axisZ});
  m.add(Drive{"motor", "hinge", Expression::parse("3 rad * t/(1 s)")});
  m.add(RollingBall{"ball", "table", "B", wheelRadius});
  const double inertia = 0.4 * 2.0 * wheelRadius * wheelRadius;
  m.add(Mass{"body", "B", 2.0, {0.0, 0.0, 0.0}, {inertia, inertia, inertia, 0.0, 0.0, 0.0}});
  m.setGravity({0.0, 0.0, -fall});
  MovingOutputs outputs(m, allOf({componentsOf("B.velocity"), componentsOf("B.acceleration")}));
  RandomStates random;
  for (int trial = 0; trial < 10; ++trial) {
    const std::vector<double> y = outputs.at(statesOf(m, random));
    EXPECT_NEAR(y[3], -2.0 / 7 * turning * y[1], 1e-13);
    EXPECT_NEAR(y[4], 2.0 / 7 * turning * y[0], 1e-13);
    EXPECT_NEAR(y[5], 0.0, 1e-13);
  }
}

// ---- The skate ------------------------------------------------------------------------------------------------------

/// Chaplygin's sleigh, with its centre of mass b ahead of the edge: v̇ = b ω², ω̇ = −m b v ω/(J + m b²) (S. A. Chaplygin,
/// 1911).
TEST(Skate, IsChaplyginsSleigh) {
  constexpr double mass = 2.0, b = 0.3, inertia = 0.5;
  Mechanism m;
  m.add(Skate{"edge", "inertial", "S"});
  m.add(Mass{"body", "S", mass, {b, 0.0, 0.0}, {1.0, 1.0, inertia, 0.0, 0.0, 0.0}});
  m.setGravity({0.0, 0.0, -fall});
  const Program f = recordMotion(m);
  MovingOutputs outputs(m, {"edge.lateral_force", "body.acceleration.x", "body.acceleration.y"});
  RandomStates random;
  for (int trial = 0; trial < 10; ++trial) {
    const std::vector<double> x = statesOf(m, random), dx = Evaluator<double>(f)(0.0, x);
    const double v = x[placeOf(m, "edge.speed")], omega = x[placeOf(m, "edge.angle_rate")];
    const double angle = x[placeOf(m, "edge.angle")];
    EXPECT_NEAR(dx[placeOf(m, "edge.speed")], b * omega * omega, 1e-13);
    EXPECT_NEAR(dx[placeOf(m, "edge.angle_rate")], -mass * b * v * omega / (inertia + mass * b * b), 1e-13);
    EXPECT_NEAR(dx[placeOf(m, "edge.x")], v * std::cos(angle), 1e-14);
    EXPECT_NEAR(dx[placeOf(m, "edge.y")], v * std::sin(angle), 1e-14);
    EXPECT_NEAR(dx[placeOf(m, "edge.path")], v, 0.0);
    const std::vector<double> y = outputs.at(x);
    EXPECT_NEAR(y[0], mass * (y[2] * std::cos(angle) - y[1] * std::sin(angle)), 1e-12);
  }
}

// ---- On planes that move --------------------------------------------------------------------------------------------

/// All three on a plane that is turned by a hinge and carried by a slider: both formulations give the same motion, and
/// energy is kept.
TEST(Rolling, IsTheSameInBothFormulationsOnAPlaneThatMoves) {
  const auto machine = [](const Described& joint) {
    Mechanism m;
    m.add(Prismatic{"slide", "inertial", "C", Axis(1, 2, 0)});
    m.add(Mass{"carriage", "C", 3.0});
    m.add(Revolute{"tilt", "C", "P", Axis(0, 1, 2)});
    m.add(Mass{"plate", "P", 2.0, {0.1, 0.0, 0.2}, lopsidedInertia});
    m.add(joint);
    m.add(Mass{"body", "B", 1.5, {0.02, 0.05, -0.04}, lopsidedInertia});
    m.setGravity({0.5, -1.0, -9.0});
    return m;
  };
  const std::vector<Described> joints = {RollingWheel{"roll", "P", "B", wheelRadius, crownRadius},
                                         RollingBall{"roll", "P", "B", wheelRadius}, Skate{"roll", "P", "B"}};
  for (const Described& joint : joints) {
    const Mechanism m = machine(joint);
    Evaluator<double> sparse(recordMotion(m)), articulated(recordMotion(m, {}, Formulation::articulated));
    MovingOutputs energy(m, {"energy"});
    RandomStates random;
    for (int trial = 0; trial < 10; ++trial) {
      const std::vector<double> x = statesOf(m, random, 1.2);
      const std::vector<double> a = sparse(0.0, x), b = articulated(0.0, x);
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-11 * (1 + std::fabs(a[i])));
      EXPECT_NEAR(energy.ratesAt(x)[0], 0.0, 1e-11) << joint.type();
    }
  }
}

TEST(Rolling, FaultsAreNamed) {
  const auto range = [](const Expression& number) {
    return number.evaluate<Interval>([](const std::string& name) -> Interval { throw std::logic_error(name); });
  };
  EXPECT_EQ((RollingWheel{"w", "inertial", "W", 0.0}.faults(range).at(0).key), "radius");
  EXPECT_EQ((RollingWheel{"w", "inertial", "W", 0.3, -0.1}.faults(range).at(0).key), "crown_radius");
  EXPECT_EQ((RollingWheel{"w", "inertial", "W", 0.3, 0.3}.faults(range).at(0).key), "crown_radius");
  EXPECT_TRUE((RollingWheel{"w", "inertial", "W", 0.3, 0.29}.faults(range).empty()));
  EXPECT_EQ((RollingWheel{"w", "inertial", "W", 0.3, 0.0, 0.0, 0.0, 0.0, 0.0, 1.58}.faults(range).at(0).key), "lean");
  EXPECT_TRUE((RollingWheel{"w", "inertial", "W", 0.3, 0.0, 0.0, 0.0, 0.0, 0.0, -1.57}.faults(range).empty()));
  EXPECT_EQ((RollingBall{"b", "inertial", "B", -1.0}.faults(range).at(0).key), "radius");
}

}  // namespace
}  // namespace gamut
