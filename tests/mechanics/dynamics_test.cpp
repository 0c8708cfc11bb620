// Laws that hold for every mechanism: energy, power, agreement of formulations, and bodies with a known motion.
#include <gmock/gmock.h>

#include "machines.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/bodies.hpp"
#include "mechanics/joints.hpp"
#include "mechanics/model.hpp"
#include "mechanics/springs.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

using testing::RandomStates;
using Vector = Vector3<double>;

/// dy/dt = ∂y/∂x f(x) of an output along the motion.
double rateAlong(const std::string& output, const Mechanism& mechanism, const std::vector<double>& x) {
  const Program f = recordMotion(mechanism), y = recordOutputs(mechanism, {}, {output}).differentiated();
  const std::vector<double> dx = Evaluator<double>(f)(0.0, x), dy = Evaluator<double>(y)(0.0, x);
  double rate = 0;
  for (std::size_t i = 0; i < x.size(); ++i) rate += dy[1 + i] * dx[i];
  return rate;
}

/// x mapped into where the spatial arm's tether cannot have length zero.
std::vector<double> armState(RandomStates& states) {
  std::vector<double> x = states(8, 1.5);
  x[2] *= 0.2;
  return x;
}

TEST(Energy, IsKeptByTheDoublePendulum) {
  RandomStates states;
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(rateAlong("energy", testing::doublePendulum(axisY), states(4)), 0, 1e-11);
}

TEST(Energy, IsKeptByASpatialArmOnSprings) {
  RandomStates states;
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(rateAlong("energy", testing::spatialArm(), armState(states)), 0, 1e-10);
}

TEST(Energy, IsTakenByDampersAtTheRateTheyDissipate) {
  const Mechanism damped = testing::spatialArm(0.8);
  RandomStates states;
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> x = armState(states);
    Assembly<double> arm(damped);
    arm.setState(x);
    const auto anchored = MovingPoint<double>{{0.1, 0.0, 0.2}, {0, 0, 0}};
    const MovingPoint<double> end = arm.frame("F").inInertial(anchored);
    const Vector chord = end.position - Vector(1.0, 1.5, -0.5);
    const double lengthRate = chord.dot(end.velocity) / chord.norm();
    const double dissipated = 0.8 * (lengthRate * lengthRate + x[5] * x[5] + x[6] * x[6]);
    EXPECT_NEAR(rateAlong("energy", damped, x), -dissipated, 1e-10);
  }
}

TEST(Velocity, IsTheRateOfPosition) {
  RandomStates states;
  const Mechanism mechanism = testing::spatialArm();
  Assembly<double> arm(mechanism);
  for (int i = 0; i < 5; ++i) {
    const std::vector<double> x = armState(states);
    arm.setState(x);
    for (const char* place : {"C", "E", "hand"})
      for (const char* component : {".x", ".y", ".z"}) {
        const std::string name = place;
        EXPECT_NEAR(rateAlong(name + ".position" + component, mechanism, x), arm.output(name + ".velocity" + component),
                    1e-13);
      }
    const Frame<double>& hand = arm.frame("F");
    EXPECT_LT((hand.R * hand.r - hand.positionInInertial()).norm(), 1e-14);
    EXPECT_LT((hand.R * hand.v - hand.velocityInInertial()).norm(), 1e-14);
  }
}

/// Two hinges in skew directions with bodies off their axes, springs on a joint and to the ground.
Mechanism sprungPair() {
  Mechanism m;
  m.add(Revolute{"first", "inertial", "A", Axis(1, 2, -1)});
  m.add(Mass{"near", "A", 2.0, {0.1, -0.2, 0.3}, {0.4, 0.5, 0.3, 0.02, -0.03, 0.05}});
  m.add(Link{"boom", "A", "B", {0.2, 0.3, -0.8}, {{axisX, 1, 0.3}}});
  m.add(Revolute{"second", "B", "C", Axis(0, 1, 2)});
  m.add(Mass{"far", "C", 1.5, {0.0, 0.05, 0.4}, {0.2, 0.25, 0.1, 0.0, 0.01, 0.0}});
  m.add(Spring{"tether", "inertial", "C", 30.0, 0.6, 0.3, {1.0, 1.5, -0.5}, {0.1, 0.0, 0.2}});
  m.add(JointSpring{"hipSpring", "second", 4.0, 0.2, 0.3});
  m.setGravity({0.5, -1.0, -9.0});
  return m;
}

/// Up to two variables are eliminated on rows, more are solved with the inertia matrix: both are M q̈ = Q.
TEST(EquationsOfMotion, AreSolvedByTheKinetostaticInertiaMatrix) {
  RandomStates states;
  Assembly<double> pair(sprungPair()), arm(testing::spatialArm(0.3));
  for (int i = 0; i < 100; ++i)
    for (Assembly<double>* machine : {&pair, &arm}) {
      const bool isArm = machine == &arm;
      machine->setState(isArm ? armState(states) : states(4, 1.5));
      const Eigen::MatrixXd inertia = machine->system().inertiaMatrix();
      const std::vector<double> forces = machine->system().residual();
      const Eigen::VectorXd expected = symmetricSolved(inertia, Eigen::VectorXd::Map(forces.data(), inertia.rows()));
      const std::vector<double> a = machine->accelerations();
      for (int j = 0; j < inertia.rows(); ++j)
        EXPECT_NEAR(a[static_cast<std::size_t>(j)], expected[j], 1e-10 * expected.norm()) << isArm;
    }
}

TEST(EquationsOfMotion, LeaveNoForceAtTheAccelerationsFound) {
  RandomStates states;
  Assembly<double> arm(testing::spatialArm(0.3));
  for (int i = 0; i < 20; ++i) {
    arm.setState(armState(states));
    arm.accelerations();
    arm.system().doForce();
    // d'Alembert: applied and inertia forces of the whole machine are in balance along every joint.
    for (double force : arm.system().generalisedForces()) EXPECT_NEAR(force, 0, 1e-10);
  }
}

TEST(EquationsOfMotion, OfTheSpatialArmAreEnclosedByIntervalsAndKeptByTheProgram) {
  const Mechanism mechanism = testing::spatialArm(0.3);
  Assembly<double> doubles(mechanism);
  Assembly<Interval> intervals(mechanism);
  const Program program = recordMotion(mechanism);
  Evaluator<double> recorded(program);
  Evaluator<Interval> enclosed(program);
  RandomStates states;
  for (int i = 0; i < 50; ++i) {
    const std::vector<double> x = armState(states);
    const std::vector<Interval> box(x.begin(), x.end());
    doubles.setState(x);
    intervals.setState(box);
    const std::vector<double> a = doubles.accelerations(), b = recorded(0.0, x);
    const std::vector<Interval> c = intervals.accelerations(), d = enclosed(Interval(0.0), box);
    for (std::size_t j = 0; j < 4; ++j) {
      const double scale = 1e-11 * (1 + std::abs(a[j]));
      EXPECT_NEAR(b[4 + j], a[j], scale);
      EXPECT_FALSE(isDisjoint(c[j], d[4 + j])) << "two enclosures of one number";
      EXPECT_NEAR(midpoint(c[j]), a[j], scale);
      EXPECT_NEAR(midpoint(d[4 + j]), a[j], scale);
    }
  }
}

TEST(EquationsOfMotion, NameTheVariableThatMovesNoMass) {
  Mechanism m;
  m.add(Revolute{"spin", "inertial", "K1", axisZ});
  m.add(Mass{"onTheAxis", "K1", 1.0});
  try {
    recordMotion(m);
    FAIL() << "a point mass on the axis has no inertia about it";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("spin.angle moves no mass"));
  }
}

// ---- Power: what goes into an ideal element comes out of it ---------------------------------------------------------

Vector random3(RandomStates& states) {
  const std::vector<double> x = states(3);
  return {x[0], x[1], x[2]};
}

void givePower(Frame<double>& from, Frame<double>& to, Variable<double>& q, Element<double>& element) {
  RandomStates states;
  for (int i = 0; i < 20; ++i) {
    from.omega = random3(states);
    from.v = random3(states);
    q.position = states(1)[0];
    q.rate = states(1)[0];
    element.doMotion();
    from.clearForces();
    element.clearForces();
    to.f = random3(states);
    to.tau = random3(states);
    element.doForce();
    const double in = from.f.dot(from.v) + from.tau.dot(from.omega) + q.force * q.rate;
    EXPECT_NEAR(in, to.f.dot(to.v) + to.tau.dot(to.omega), 1e-12);
  }
}

TEST(Power, PassesThroughRevoluteJoints) {
  for (const Axis& axis : {axisX, axisY, axisZ, Axis(0, 0, -1), Axis(1, -2, 3)}) {
    Frame<double> from, to;
    Variable<double> angle;
    RevoluteJoint<double> joint(from, to, angle, axis);
    givePower(from, to, angle, joint);
  }
}

TEST(Power, PassesThroughPrismaticJoints) {
  for (const Axis& axis : {axisX, axisY, axisZ, Axis(0, -2, 0), Axis(3, 1, 1)}) {
    Frame<double> from, to;
    Variable<double> path;
    PrismaticJoint<double> joint(from, to, path, axis);
    givePower(from, to, path, joint);
  }
}

TEST(Power, PassesThroughRigidLinks) {
  Frame<double> from, to;
  Variable<double> none;
  RigidLink<double> link(from, to, {0.3, -0.4, 1.2}, Rotation<double>(Axis(1, 1, 3), 0.8));
  givePower(from, to, none, link);
}

// ---- Bodies with a known motion -------------------------------------------------------------------------------------

TEST(Oscillator, OfMassAndSpringFollowsItsEquation) {
  Mechanism m;
  m.addParameter("stiffness", 40.0);
  m.add(Prismatic{"slide", "inertial", "K1", axisX, 0.3, 0.2});
  m.add(Mass{"block", "K1", 2.5});
  m.add(Spring{"spring", "inertial", "K1", Expression::named("stiffness"), 0.5, 1.5, {-1.0, 0.0, 0.0}});
  const Program f = recordMotion(m, {"stiffness"});
  Evaluator<double> evaluate(f);
  evaluate.setParameters(std::vector<double>{30.0});
  RandomStates states;
  for (int i = 0; i < 100; ++i) {
    const std::vector<double> x = states(2, 0.9);
    // 2.5 s̈ = −30 (s + 1 − 0.5) − 1.5 ṡ
    EXPECT_NEAR(evaluate(0.0, x)[1], (-30 * (x[0] + 0.5) - 1.5 * x[1]) / 2.5, 1e-13);
  }
}

TEST(Oscillator, OfATorsionalSpringFollowsItsEquation) {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "K1", Axis(1, 2, 2), 0.3, 0.2});
  m.add(Mass{"disc", "K1", 2.0, {0.0, 0.0, 0.0}, {0.5, 0.5, 0.5, 0.0, 0.0, 0.0}});
  m.add(JointSpring{"spring", "hinge", 3.0, 0.25, 0.125});
  const Program f = recordMotion(m);
  Evaluator<double> motion(f);
  const std::vector<double> x = {0.75, -2.0};
  EXPECT_NEAR(motion(0.0, x)[1], (-3.0 * 0.5 + 0.125 * 2.0) / 0.5, 1e-13);
}

// A heavy top on three revolute joints about z, y, x: angles ψ, θ, φ, with the body rates
// ω = (φ̇ − ψ̇ sinθ, θ̇ cosφ + ψ̇ cosθ sinφ, −θ̇ sinφ + ψ̇ cosθ cosφ), obeys  J ω̇ + ω × J ω = c × m Rᵀ g.
TEST(Top, OnThreeRevoluteJointsFollowsEulersEquation) {
  const Vector c(0.1, -0.2, 0.4), g(0.3, 0.7, -9.81);
  const double mass = 1.3;
  Matrix3<double> theta;
  theta << 0.4, 0.02, -0.03, 0.02, 0.5, 0.05, -0.03, 0.05, 0.3;
  Frame<double> k0, k1, k2, k3;
  Variable<double> psi, pitch, phi;
  RevoluteJoint<double> yaw(k0, k1, psi, axisZ), tilt(k1, k2, pitch, axisY), roll(k2, k3, phi, axisX);
  MassElement<double> body(k3, mass, c, theta);
  Chain<double> chain;
  chain << yaw << tilt << roll << body;
  System<double> system({psi, pitch, phi}, chain, k0, g);

  const Matrix3<double> j = theta + mass * (c.squaredNorm() * Matrix3<double>::Identity() - c * c.transpose());
  RandomStates states;
  for (int i = 0; i < 100; ++i) {
    const std::vector<double> x = states(6, 1.4);
    psi.position = x[0], pitch.position = x[1], phi.position = x[2];
    psi.rate = x[3], pitch.rate = x[4], phi.rate = x[5];
    const std::vector<double> a = system.accelerations();
    const double st = std::sin(x[1]), ct = std::cos(x[1]), sf = std::sin(x[2]), cf = std::cos(x[2]);
    const double yawRate = x[3], tiltRate = x[4], rollRate = x[5];
    const Vector omega(rollRate - yawRate * st, tiltRate * cf + yawRate * ct * sf, -tiltRate * sf + yawRate * ct * cf);
    const Vector omegaDot(
        a[2] - a[0] * st - yawRate * ct * tiltRate,
        a[1] * cf - tiltRate * sf * rollRate + a[0] * ct * sf + yawRate * (-st * tiltRate * sf + ct * cf * rollRate),
        -a[1] * sf - tiltRate * cf * rollRate + a[0] * ct * cf + yawRate * (-st * tiltRate * cf - ct * sf * rollRate));
    const Matrix3<double> r = (Eigen::AngleAxisd(x[0], Vector::UnitZ()) * Eigen::AngleAxisd(x[1], Vector::UnitY()) *
                               Eigen::AngleAxisd(x[2], Vector::UnitX()))
                                  .toRotationMatrix();
    const Vector balance = j * omegaDot + omega.cross(j * omega) - c.cross(mass * (r.transpose() * g));
    EXPECT_LT(balance.norm(), 1e-11 * (1 + omegaDot.norm()));
    EXPECT_LT((k3.R - r).norm(), 1e-14);
  }
}

// ---- A user's own element -------------------------------------------------------------------------------------------

/// A screw about z that advances by `lead` a radian. Motion and force are all that is written down.
template <class S>
class ScrewJoint final : public Transmission<S> {
 public:
  ScrewJoint(Frame<S>& from, Frame<S>& to, Variable<S>& angle, double lead)
      : Transmission<S>(from, to), angle_(angle), lead_(lead) {}

  void doMotion(MotionLevel level = MotionLevel::all) override {
    const Frame<S>& k = this->from_;
    Frame<S>& moved = this->to_;
    turn_ = Rotation<S>(axisZ, angle_.position);
    d_ = u_ * (S(lead_) * angle_.position);
    moved.R = turn_.after(k.R);
    moved.r = turn_.toChild(k.r + d_);
    if (level == MotionLevel::position) return;
    // Without velocities, the same equations hold with rate and ω zero.
    const bool still = level == MotionLevel::acceleration;
    const S rate = still ? S(0.0) : angle_.rate;
    const Vector3<S> omega = still ? zeroVector<S>() : k.omega, own = u_ * rate, slid = u_ * (S(lead_) * rate);
    moved.omegaDot = turn_.toChild(k.omegaDot + omega.cross(own)) + u_ * angle_.acceleration;
    moved.a = turn_.toChild(k.a + offsetAcceleration(omega, k.omegaDot) * d_ + S(2.0) * omega.cross(slid)) +
              u_ * (S(lead_) * angle_.acceleration);
    if (still) return;
    moved.omega = turn_.toChild(k.omega) + own;
    moved.v = turn_.toChild(k.v + k.omega.cross(d_)) + slid;
  }

  void doForce(ForceKind = ForceKind::all) override {
    const Vector3<S> force = turn_.toParent(this->to_.f);
    this->from_.f += force;
    this->from_.tau += turn_.toParent(this->to_.tau) + d_.cross(force);
    angle_.force += u_.dot(this->to_.tau) + S(lead_) * u_.dot(this->to_.f);
  }

  std::vector<Speed<S>*> speeds() const override { return {&angle_}; }

  MovingPoint<S> inFrom(const MovingPoint<S>& point) const override {
    const Vector3<S> turning = u_ * angle_.rate;
    return {d_ + turn_.toParent(point.position),
            turn_.toParent(point.velocity + turning.cross(point.position)) + u_ * (S(lead_) * angle_.rate)};
  }

 private:
  Variable<S>& angle_;
  double lead_;
  Vector3<S> u_ = axisZ.unit<S>(), d_ = zeroVector<S>();
  Rotation<S> turn_;
};

TEST(Power, PassesThroughAUsersOwnElement) {
  Frame<double> from, to;
  Variable<double> angle;
  ScrewJoint<double> screw(from, to, angle, 0.25);
  givePower(from, to, angle, screw);
}

TEST(UsersOwnElement, NeedsMotionAndForceOnly) {
  const Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    Frame<Recorded> ground, nut;
    Variable<Recorded> angle;
    ScrewJoint<Recorded> screw(ground, nut, angle, 0.25);
    Matrix3<Recorded> inertia = Rotation<Recorded>().matrix();
    MassElement<Recorded> mass(nut, 2.0, {0.0, 0.0, 0.0}, inertia);
    Chain<Recorded> chain;
    chain << screw << mass;
    System<Recorded> system({angle}, chain, ground, {0.0, 0.0, -8.0});
    angle.position = x[0];
    angle.rate = x[1];
    dx[0] = x[1];
    dx[1] = system.accelerations()[0];
  });
  // (Θ + m h²) β̈ = −m g h with the lead h, and the derivative of the program needs nothing from the element.
  EXPECT_NEAR(Evaluator<double>(f)(0.0, std::vector<double>{0.4, 1.0})[1], -2.0 * 8.0 * 0.25 / (1 + 2.0 / 16), 1e-14);
  EXPECT_EQ(f.differentiated().outputs(), 6);
}

/// J u̇ + u × J u = c × m Aᵀ g about the fixed point, and ė = ½ e ∘ (0, u).
TEST(Top, FollowsEulersEquation) {
  Matrix3<double> theta;
  theta << 0.4, 0.02, -0.03, 0.02, 0.5, 0.05, -0.03, 0.05, 0.3;
  const Vector3<double> c(0.1, -0.2, 0.4), g(0.3, 0.7, -9.81);
  const double mass = 1.3;
  const Matrix3<double> j = theta + mass * (c.squaredNorm() * Matrix3<double>::Identity() - c * c.transpose());
  Mechanism m;
  m.add(Spherical{"ball", "inertial", "A"});
  m.add(Mass{"body", "A", mass, {0.1, -0.2, 0.4}, {0.4, 0.5, 0.3, 0.02, 0.05, -0.03}});
  m.setGravity({0.3, 0.7, -9.81});
  testing::RandomStates states;
  for (const Formulation formulation : {Formulation::sparse, Formulation::articulated}) {
    Evaluator<double> motion(recordMotion(m, {}, formulation));
    for (int round = 0; round < 50; ++round) {
      std::vector<double> x = states(7, 1.4);
      const Eigen::Quaterniond e = Eigen::Quaterniond(x[0], x[1], x[2], x[3]).normalized();
      x[0] = e.w(), x[1] = e.x(), x[2] = e.y(), x[3] = e.z();
      const std::vector<double> dx = motion(0.0, x);
      const Vector3<double> u(x[4], x[5], x[6]), uDot(dx[4], dx[5], dx[6]);
      const Vector3<double> moment = c.cross(mass * (e.toRotationMatrix().transpose() * g));
      EXPECT_LT((j * uDot + u.cross(j * u) - moment).norm(), 1e-12 * (1 + uDot.norm()));
      const Eigen::Quaterniond rate = e * Eigen::Quaterniond(0.0, u[0] / 2, u[1] / 2, u[2] / 2);
      EXPECT_NEAR(dx[0], rate.w(), 1e-15);
      EXPECT_NEAR(dx[1], rate.x(), 1e-15);
      EXPECT_NEAR(dx[2], rate.y(), 1e-15);
      EXPECT_NEAR(dx[3], rate.z(), 1e-15);
    }
  }
}

}  // namespace
}  // namespace gamut
