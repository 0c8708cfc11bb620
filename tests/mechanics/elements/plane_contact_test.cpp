// A sphere that touches a plane: forces against formulas written by hand, balances, and motions that are known.
#include <gmock/gmock.h>

#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/program/linear_form.hpp"
#include "tests/mechanics/machines.hpp"

namespace gamut {
namespace {

using testing::RandomStates;
using Three = Vector3<double>;

/// On z alone, above the ground.
Mechanism drop(const PlaneContact& contact, double mass = 2.0) {
  Mechanism m;
  m.add(Prismatic{"lift", "inertial", "A", axisZ});
  m.add(Mass{"ball", "A", mass});
  m.add(contact);
  return m;
}

PlaneContact ground() {
  PlaneContact contact{"ground", "inertial", "A"};
  contact.radius = 0.25;
  contact.stiffness = 1000.0;
  contact.damping = 0.5;
  return contact;
}

double outputOf(const Mechanism& m, const std::string& name, const std::vector<double>& x) {
  Assembly<double> assembly(m);
  assembly.setState(x);
  return assembly.output(name);
}

TEST(PlaneContact, PushesByDepthAndSpeedOfEnteringAndNeverPulls) {
  const Mechanism m = drop(ground());
  const auto force = [&](double z, double rate) { return outputOf(m, "ground.normal_force", {z, rate}); };
  EXPECT_EQ(force(0.5, -1.0), 0);
  EXPECT_EQ(force(0.25, -1.0), 0);
  EXPECT_EQ(force(0.125, 0.0), 125);
  EXPECT_EQ(force(0.125, -1.0), 125 * 1.5);
  EXPECT_EQ(force(0.125, 1.0), 125 * 0.5);
  EXPECT_EQ(force(0.125, 2.0), 0);
  EXPECT_EQ(force(0.125, 3.0), 0);
  EXPECT_EQ(outputOf(m, "ground.gap", {0.125, 3.0}), -0.125);
  EXPECT_EQ(outputOf(m, "ground.power", {0.125, 1.0}), 62.5);
  EXPECT_EQ(outputOf(m, "energy.springs", {0.125, 1.0}), 500 / 64.0);
  EXPECT_EQ(Evaluator<double>(recordMotion(m))(0.0, std::vector<double>{0.125, -1.0})[1], 125 * 1.5 / 2);
}

TEST(PlaneContact, TakesANormalOfAnyLength) {
  PlaneContact skew = ground(), same = skew;
  skew.normal = Axis(0, 300, 400);
  same.normal = Axis(0, 0.75, 1);
  for (const std::vector<double>& x : {std::vector<double>{0.2, -0.5}, {0.3, 0.25}, {0.5, 0.0}}) {
    const double gap = 0.8 * x[0] - 0.25, rate = 0.8 * x[1];
    const double force = 1000 * std::max(-gap, 0.0) * (1 - 0.5 * rate);
    for (const PlaneContact& contact : {skew, same}) {
      EXPECT_NEAR(outputOf(drop(contact), "ground.gap", x), gap, 1e-15);
      EXPECT_NEAR(outputOf(drop(contact), "ground.force.y", x), 0.6 * force, 1e-12);
      EXPECT_NEAR(outputOf(drop(contact), "ground.force.z", x), 0.8 * force, 1e-12);
    }
  }
}

/// Where a radius, a damping and a normal are numbers, kinks are at zeros of what is linear in states without rounding:
/// those are passed as if they were smooth.
TEST(PlaneContact, HasKinksWhereSomethingLinearIsZero) {
  PlaneContact skew = ground();
  skew.radius = Interval("0.3");
  skew.damping = Interval("0.7");
  skew.normal = Axis(1, 0, 2);
  const Program motion = recordMotion(drop(skew));
  int kinks = 0;
  for (const Node& node : motion.nodes())
    if (node.op == Op::abs) {
      ++kinks;
      EXPECT_TRUE(linearFormOf(motion, node.a));
    }
  EXPECT_EQ(kinks, 2);
}

/// A wheel of radius 0.3 m about y, which rolls along x.
Mechanism wheel(double friction, double slipRate) {
  Mechanism m;
  m.add(Prismatic{"path", "inertial", "X", axisX});
  m.add(Prismatic{"lift", "X", "Z", axisZ, 0.3});
  m.add(Revolute{"turn", "Z", "W", axisY});
  m.add(Mass{"wheel", "W", 2.0, {0.0, 0.0, 0.0}, {0.05, 0.09, 0.05, 0.0, 0.0, 0.0}});
  PlaneContact road{"road", "inertial", "W"};
  road.radius = 0.3;
  road.stiffness = 2e4;
  road.damping = 0.5;
  road.friction = friction;
  road.slipRate = slipRate;
  m.add(road);
  m.setGravity({0.0, 0.0, -10.0});
  return m;
}

TEST(PlaneContact, HasFrictionAgainstTheSlipOfAWheel) {
  const Mechanism m = wheel(0.4, 0.1);
  // states: path, lift, turn, and their rates; turning about y the wheel's foot moves to -x
  const double depth = 1.0 / 1024, press = 2e4 * depth, slip = 0.5 - 0.3 * 1.25;
  const std::vector<double> x = {1.0, 0.3 - depth, 0.7, 0.5, 0.0, 1.25};
  const double friction = 0.4 * press * slip / std::hypot(slip, 0.1);
  EXPECT_NEAR(outputOf(m, "road.normal_force", x), press, 1e-9);
  EXPECT_NEAR(outputOf(m, "road.slip.x", x), slip, 1e-15);
  EXPECT_NEAR(outputOf(m, "road.slip", x), slip, 1e-15);
  EXPECT_NEAR(outputOf(m, "road.force.x", x), -friction, 1e-9);
  EXPECT_NEAR(outputOf(m, "road.friction_force", x), friction, 1e-9);
  EXPECT_NEAR(outputOf(m, "road.power", x), -friction * slip, 1e-9);
  const std::vector<double> dx = Evaluator<double>(recordMotion(m))(0.0, x);
  EXPECT_NEAR(dx[3], -friction / 2, 1e-9);
  EXPECT_NEAR(dx[4], press / 2 - 10, 1e-9);
  EXPECT_NEAR(dx[5], 0.3 * friction / 0.09, 1e-9);
}

/// Where the wheel is symmetric about its axis, how far it has turned is in none of the equations.
TEST(PlaneContact, OfAWheelDoesNotAskHowFarItHasTurned) {
  const Program motion = recordMotion(wheel(0.4, 0.1));
  for (const Node& node : motion.nodes()) EXPECT_TRUE(node.op != Op::sin && node.op != Op::cos);
}

// ---- Two moving bodies ----------------------------------------------------------------------------------------------

/// The contact's force on `to` [N, inertial axes] and where it acts, by the motion of both frames.
struct ByHand {
  double gap, normal, power;
  Three force, slip, place;
};
ByHand byHand(const Assembly<double>& assembly, const PlaneContact& contact, const Three& normal,
              const std::array<double, 5>& numbers) {
  const auto [radius, stiffness, damping, friction, slipRate] = numbers;
  const Frame<double>&p = assembly.frame(contact.from), &b = assembly.frame(contact.to);
  const auto point = [&](const ExpressionVector& v) {
    return Three(assembly.number(v[0]), assembly.number(v[1]), assembly.number(v[2]));
  };
  const Three n = p.R * normal.normalized();
  const Three o = p.R * (p.r + point(contact.fromPoint)), c = b.R * (b.r + point(contact.toPoint));
  ByHand is;
  is.place = c - radius * n;
  const auto velocity = [&](const Frame<double>& k) {
    return Three(k.R * (k.v + k.omega.cross(Three(k.R.transpose() * is.place - k.r))));
  };
  const Three u = velocity(b) - velocity(p);
  is.gap = n.dot(c - o) - radius;
  is.normal = stiffness * std::max(-is.gap, 0.0) * std::max(1 - damping * n.dot(u), 0.0);
  is.slip = u - n * n.dot(u);
  is.force = n * is.normal - is.slip * (friction * is.normal / std::hypot(is.slip.norm(), slipRate));
  is.power = is.force.dot(u);
  return is;
}

PlaneContact skewContact(const std::string& from, const std::string& to) {
  PlaneContact contact{"touch", from, to, {0.1, -0.2, 0.05}, {-0.05, 0.1, 0.02}, Axis(1, -2, 3)};
  contact.radius = 1.25;
  contact.stiffness = 400.0;
  contact.damping = 0.125;
  contact.friction = 0.375;
  contact.slipRate = 0.25;
  return contact;
}
const std::array<double, 5> skewNumbers = {1.25, 400, 0.125, 0.375, 0.25};
const Three skewNormal(1, -2, 3);

/// Two bodies that fly freely, from a base that does not move.
Mechanism twoFlyers() {
  Mechanism m;
  m.add(Weld{"tilt", "inertial", "T", {{Axis(1, 1, 0), 0, 0.4}}});
  m.add(Free{"one", "T", "P"});
  m.add(Mass{"plate", "P", 3.0, {0.1, 0.0, -0.05}, {0.4, 0.5, 0.3, 0.02, -0.03, 0.05}});
  m.add(Free{"two", "T", "B"});
  m.add(Mass{"ball", "B", 1.5, {0.0, 0.05, 0.1}, {0.2, 0.25, 0.1, 0.0, 0.01, 0.0}});
  return m;
}

/// A slider and hinges between the frames; `from` and `to` on one branch, in either order, or on two.
Mechanism branches() {
  Mechanism m;
  m.add(Revolute{"base", "inertial", "R", Axis(1, 2, -1)});
  m.add(Link{"boom", "R", "S", {0.2, 0.1, -0.1}, {{axisX, 1, 0.3}}});
  m.add(Mass{"boom body", "S", 2.0, {0.1, -0.2, 0.3}, {0.4, 0.5, 0.3, 0.02, -0.03, 0.05}});
  m.add(Prismatic{"slide", "S", "U", Axis(1, 0, -3)});
  m.add(Screw{"screw", "U", "V", axisY, 0.1});
  m.add(Mass{"inner", "V", 1.5, {0.0, 0.05, 0.1}, {0.2, 0.25, 0.1, 0.0, 0.01, 0.0}});
  m.add(Spherical{"wrist", "S", "X"});
  m.add(Mass{"outer", "X", 0.5, {0.0, 0.05, 0.1}, {0.2, 0.25, 0.1, 0.0, 0.01, 0.0}});
  return m;
}

/// d/dt of an output along the motion.
double rateOfOutput(const Mechanism& m, const std::string& output, const std::vector<double>& x, double& scale) {
  const std::vector<double> dx = Evaluator<double>(recordMotion(m))(0.0, x),
                            dy = Evaluator<double>(recordOutputs(m, {}, {output}).differentiated())(0.0, x);
  double rate = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    rate += dy[1 + i] * dx[i];
    scale += std::abs(dy[1 + i] * dx[i]);
  }
  return rate;
}

struct Ends {
  bool isFree;
  const char *from, *to;
};

TEST(PlaneContact, IsWhatIsWrittenByHandBetweenMovingBodies) {
  int touching = 0;
  for (const Ends& ends : {Ends{true, "P", "B"}, Ends{true, "B", "P"}, Ends{true, "inertial", "B"},
                           Ends{true, "B", "inertial"}, Ends{false, "V", "X"}, Ends{false, "X", "V"},
                           Ends{false, "R", "V"}, Ends{false, "V", "R"}, Ends{false, "inertial", "V"}}) {
    Mechanism m = ends.isFree ? twoFlyers() : branches();
    const PlaneContact contact = skewContact(ends.from, ends.to);
    m.add(contact);
    RandomStates states;
    Assembly<double> assembly(m);
    for (int round = 0; round < 6; ++round) {
      std::vector<double> x = assembly.initialState();
      const std::vector<double> moved = states(x.size(), 0.5);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += moved[i];
      const std::vector<std::string> names = m.stateNames();
      for (std::size_t i = 0; i < x.size(); ++i)  // a rotation, whatever the states were
        if (names[i].ends_with("quaternion.w")) Eigen::Map<Eigen::Vector4d>(&x[i]).normalize();
      assembly.setState(x);
      const ByHand is = byHand(assembly, contact, skewNormal, skewNumbers);
      touching += is.normal > 0 ? 1 : 0;
      const double scale = 1e-12 * (1 + is.normal);
      EXPECT_NEAR(assembly.output("touch.gap"), is.gap, 1e-13);
      EXPECT_NEAR(assembly.output("touch.normal_force"), is.normal, scale);
      EXPECT_NEAR(assembly.output("touch.slip"), is.slip.norm(), 1e-13);
      EXPECT_NEAR(assembly.output("touch.power"), is.power, 10 * scale);
      const Matrix3<double> r = assembly.frame(contact.from).R;
      const Three force = r.transpose() * is.force, slip = r.transpose() * is.slip;
      EXPECT_NEAR(assembly.output("touch.friction_force"), (is.force - is.normal * r * skewNormal.normalized()).norm(),
                  scale);
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(assembly.output(std::string("touch.force.") + components[static_cast<std::size_t>(i)]), force[i],
                    scale);
        EXPECT_NEAR(assembly.output(std::string("touch.slip.") + components[static_cast<std::size_t>(i)]), slip[i],
                    1e-13);
      }
      // what the machine gains is what the contact brings in; of what flies freely, momentum is kept
      double whole = 1;
      EXPECT_NEAR(rateOfOutput(m, "energy.kinetic", x, whole), is.power, 1e-12 * whole) << ends.from << ends.to;
      double stored = 1;
      EXPECT_LE(is.power + rateOfOutput(m, "energy.springs", x, stored), 1e-12 * (stored + std::abs(is.power)));
      if (!ends.isFree || std::string(ends.from) == "inertial" || std::string(ends.to) == "inertial") continue;
      for (const char* kept : {"momentum.x", "momentum.y", "momentum.z", "angular_momentum.x", "angular_momentum.y",
                               "angular_momentum.z"}) {
        double parts = 1;
        EXPECT_NEAR(rateOfOutput(m, kept, x, parts), 0, 1e-12 * parts) << kept;
      }
    }
  }
  EXPECT_GT(touching, 30);
}

TEST(PlaneContact, MovesAlikeInEveryScalarAndFormulation) {
  for (const bool isFree : {true, false}) {
    Mechanism m = isFree ? twoFlyers() : branches();
    m.add(isFree ? skewContact("P", "B") : skewContact("V", "X"));
    RandomStates states;
    const Program sparse = recordMotion(m, {}, Formulation::sparse),
                  articulated = recordMotion(m, {}, Formulation::articulated);
    for (int round = 0; round < 5; ++round) {
      std::vector<double> x = Assembly<double>(m).initialState();
      const std::vector<double> moved = states(x.size(), 0.3);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += moved[i];
      const auto rates = [&]<class S>(S /*scalar*/) {
        Assembly<S> assembly(m);
        assembly.setState(std::vector<S>(x.begin(), x.end()));
        return assembly.rates();
      };
      const std::vector<double> a = rates(0.0), e = Evaluator<double>(sparse)(0.0, x),
                                f = Evaluator<double>(articulated)(0.0, x);
      const std::vector<Interval> b = rates(Interval(0.0));
      const std::vector<Samples> c = rates(Samples(0.0));
      const std::vector<Fuzzy> d = rates(Fuzzy(0.0));
      for (std::size_t i = 0; i < a.size(); ++i) {
        const double scale = 1e-10 * (1 + std::abs(a[i]));
        EXPECT_NEAR(e[i], a[i], scale);
        EXPECT_NEAR(f[i], a[i], scale);
        EXPECT_NEAR(midpoint(b[i]), a[i], scale);
        EXPECT_LE(width(b[i]), scale);
        EXPECT_NEAR(c[i][0], a[i], scale);
        EXPECT_NEAR(midpoint(d[i].cut(0.0)), a[i], scale);
      }
    }
  }
}

TEST(PlaneContact, EnclosesTheForcesOfABox) {
  Mechanism m = twoFlyers();
  m.add(skewContact("P", "B"));
  Assembly<Interval> boxes(m);
  Assembly<double> points(m);
  std::mt19937_64 random(5);
  const auto uniform = [&](double bound) { return std::uniform_real_distribution<>(-bound, bound)(random); };
  const std::vector<std::string> outputs = {"touch.gap",     "touch.normal_force", "touch.friction_force",
                                            "touch.force.x", "touch.slip",         "touch.slip.y",
                                            "touch.power",   "energy.springs"};
  for (int round = 0; round < 40; ++round) {
    const std::vector<double> middle = points.initialState();
    std::vector<Interval> box;
    for (const double value : middle) {
      const double centre = value + uniform(0.4), radius = 0.02 * (1 + uniform(1.0));
      box.emplace_back(centre - radius, centre + radius);
    }
    boxes.setState(box);
    std::vector<Interval> bounds;
    for (const std::string& output : outputs) bounds.push_back(boxes.output(output));
    for (const Interval& bound : bounds) EXPECT_LT(width(bound), 1e5);
    for (int trial = 0; trial < 8; ++trial) {
      std::vector<double> x;
      for (const Interval& side : box)
        x.push_back(std::uniform_real_distribution<>(side.lower(), std::nextafter(side.upper(), side.lower()))(random));
      // in intervals of one point, so that rounding counts
      Assembly<Interval> exact(m);
      exact.setState(std::vector<Interval>(x.begin(), x.end()));
      for (std::size_t k = 0; k < outputs.size(); ++k)
        EXPECT_FALSE(isDisjoint(exact.output(outputs[k]), bounds[k])) << outputs[k];
    }
  }
}

TEST(PlaneContact, SaysWhatMakesNoSense) {
  const auto messageOfCheck = [](const std::function<void(PlaneContact&)>& change) -> std::string {
    PlaneContact contact = ground();
    contact.friction = 0.5;
    contact.slipRate = 0.01;
    change(contact);
    try {
      drop(contact).check();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  using ::testing::HasSubstr;
  EXPECT_EQ(messageOfCheck([](PlaneContact&) {}), "");
  EXPECT_EQ(messageOfCheck([](PlaneContact& c) { c.friction = c.slipRate = 0.0; }), "");
  EXPECT_THAT(messageOfCheck([](PlaneContact& c) { c.stiffness = 0.0; }),
              HasSubstr("the stiffness of 'ground' is not positive"));
  EXPECT_THAT(messageOfCheck([](PlaneContact& c) { c.radius = -0.1; }),
              HasSubstr("the radius of 'ground' is negative"));
  EXPECT_THAT(messageOfCheck([](PlaneContact& c) { c.damping = -0.1; }),
              HasSubstr("the damping of 'ground' is negative"));
  EXPECT_THAT(messageOfCheck([](PlaneContact& c) { c.friction = -0.1; }),
              HasSubstr("the friction of 'ground' is negative"));
  EXPECT_THAT(messageOfCheck([](PlaneContact& c) { c.slipRate = 0.0; }),
              HasSubstr("the slip rate of 'ground' is not positive"));
  EXPECT_THAT(messageOfCheck([](PlaneContact& c) { c.slipRate = -0.1; }),
              HasSubstr("the slip rate of 'ground' is not positive"));
  EXPECT_THROW(Axis(0, 0, 0), std::invalid_argument);
}

// ---- Motions that are known ---------------------------------------------------------------------------------------

/// By steps of Runge and Kutta, of fourth order.
std::vector<double> movedBy(const Mechanism& m, double horizon, double step, std::vector<double> x = {}) {
  Evaluator<double> motion(recordMotion(m));
  if (x.empty()) x = Assembly<double>(m).initialState();
  const auto along = [&](const std::vector<double>& dx, double h) {
    std::vector<double> y = x;
    for (std::size_t i = 0; i < x.size(); ++i) y[i] += h * dx[i];
    return y;
  };
  const int steps = static_cast<int>(std::lround(horizon / step));
  for (int k = 0; k < steps; ++k) {
    const double t = k * step, half = step / 2;
    const std::vector<double> a = motion(t, x), b = motion(t + half, along(a, half)),
                              c = motion(t + half, along(b, half)), d = motion(t + step, along(c, step));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += step / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return x;
}

/// A wheel that does not turn at first slides at 4 m/s, and rolls in the end: with J = ½ m r², at 2/3 of that. It
/// slides for v/(3 μ g) seconds.
TEST(PlaneContact, LetsAWheelSlipUntilItRolls) {
  const Mechanism m = wheel(0.5, 1e-3);
  const double depth = 2 * 10 / 2e4, v = 4;
  std::vector<double> x = {0, 0.3 - depth, 0, v, 0, 0};
  const double until = v / (3 * 0.5 * 10);
  x = movedBy(m, until / 2, 2e-5, x);
  EXPECT_NEAR(x[3], v - 0.5 * 10 * until / 2, 1e-4);
  x = movedBy(m, until / 2 + 0.05, 2e-5, x);
  EXPECT_NEAR(x[3], 2 * v / 3, 1e-4);
  EXPECT_NEAR(x[3], 0.3 * x[5], 1e-4);
}

/// What rolls by a coupling and what rolls by friction arrive together: the second creeps by slip_rate times F/(μ N).
TEST(PlaneContact, RollsLikeACoupling) {
  Mechanism rolling;
  rolling.add(Prismatic{"path", "inertial", "X", axisX});
  rolling.add(Link{"height", "X", "Z", {0.0, 0.0, 0.3}});
  rolling.add(Revolute{"turn", "Z", "W", axisY});
  rolling.add(Mass{"wheel", "W", 2.0, {0.0, 0.0, 0.0}, {0.05, 0.09, 0.05, 0.0, 0.0, 0.0}});
  rolling.add(Coupling{"roll", "path", "turn", 0.3});
  Mechanism touching = wheel(0.9, 5e-4);
  const Expression torque = Expression::parse("1.2 N m * cos(3*t/(1 s))");
  for (Mechanism* m : {&rolling, &touching}) m->add(JointForce{"engine", "turn", torque});
  const std::vector<double> a = movedBy(rolling, 1.0, 1e-3),
                            b = movedBy(touching, 1.0, 2e-5, {0, 0.3 - 20 / 2e4, 0, 0, 0, 0});
  // m r² + J = 0.27 kg m², so φ̈ = 1.2 cos 3t / 0.27
  EXPECT_NEAR(a[1], 1.2 * std::sin(3.0) / 3 / 0.27, 1e-9);
  EXPECT_NEAR(b[2], a[0], 2e-4);
  EXPECT_NEAR(b[0], 0.3 * a[0], 2e-4);
  EXPECT_NEAR(b[5], a[1], 2e-4);
}

/// A ball with J = 2/5 m r² rolls down a slope of 20° at 5/7 g sin 20°; on six coordinates, its axes anyhow.
TEST(PlaneContact, LetsABallRollDownASlope) {
  Mechanism m;
  m.add(Weld{"slope", "inertial", "S", {{axisY, 0, Interval("0.35")}}});
  Free ball{"ball", "S", "B"};
  ball.position = {0.0, 0.0, 0.1};
  ball.orientation = {{Axis(1, 2, 3), 0, 0.8}};
  m.add(ball);
  m.add(Mass{"body", "B", 1.0, {0.0, 0.0, 0.0}, {0.004, 0.004, 0.004, 0.0, 0.0, 0.0}});
  PlaneContact contact{"touch", "S", "B"};
  contact.radius = 0.1;
  contact.stiffness = 1e4;
  contact.damping = 2.0;
  contact.friction = 0.6;
  contact.slipRate = 1e-3;
  m.add(contact);
  m.setGravity({0.0, 0.0, -9.8125});
  Assembly<double> end(m);
  end.setState(movedBy(m, 0.5, 5e-5));
  const double expected = 5.0 / 7 * 9.8125 * std::sin(0.35) * 0.5;
  EXPECT_NEAR(end.output("ball.velocity.x"), expected, 2e-3);
  EXPECT_NEAR(end.output("ball.velocity.y"), 0, 1e-8);
  EXPECT_NEAR(end.output("touch.force.x"), -2.0 / 7 * 9.8125 * std::sin(0.35), 1e-3);
}

/// Sent off at 2 m/s with a backspin of 60 rad/s, a ball comes back at (5 v − 2 r ω)/7.
TEST(PlaneContact, SendsABallWithBackspinBack) {
  Mechanism m;
  Planar plane{"ball", "inertial", "B", axisY};
  m.add(plane);
  m.add(Mass{"body", "B", 1.0, {0.0, 0.0, 0.0}, {0.004, 0.004, 0.004, 0.0, 0.0, 0.0}});
  PlaneContact contact{"touch", "inertial", "B"};
  contact.radius = 0.1;
  contact.stiffness = 1e4;
  contact.friction = 0.6;
  contact.slipRate = 1e-3;
  m.add(contact);
  m.setGravity({0.0, 0.0, -10.0});
  const std::vector<std::string> names = m.stateNames();  // about y: first z, then x, then the angle
  const std::vector<double> x = movedBy(m, 0.8, 5e-5, {0.1 - 10 / 1e4, 0, 0, 0, 2, -60});
  EXPECT_NEAR(x[4], (5 * 2.0 - 2 * 0.1 * 60) / 7, 1e-3);
}

/// From 0.2 m a ball comes back as high as before if nothing is lost, and else with −v' where
/// v' + ln(1 − d v')/d = −v − ln(1 + d v)/d ... of a stop without weight: what it loses is the same for any stiffness.
TEST(PlaneContact, LetsABallBounce) {
  PlaneContact hard = ground();
  hard.damping = 0.0;
  hard.stiffness = 1e5;
  Mechanism m = drop(hard);
  m.setGravity({0.0, 0.0, -10.0});
  const double fall = std::sqrt(2 * 0.2 / 10);
  std::vector<double> x = movedBy(m, 2 * fall, 1e-5, {0.45, 0.0});
  EXPECT_NEAR(x[0], 0.45, 2e-3);
  hard.damping = 0.25;
  Mechanism lossy = drop(hard);  // no weight, so that the law of the impact is exact
  x = movedBy(lossy, 0.05, 1e-5, {0.2501, -2.0});
  // v dv = −k/m x (1 + d v) dx: v/d − ln(1 + d v)/d² is the same on both ways out of x = 0
  const auto potential = [](double v) { return v / 0.25 - std::log(1 + 0.25 * v) / 0.0625; };
  EXPECT_GT(x[0], 0.25);
  EXPECT_NEAR(potential(-x[1]), potential(2.0), 1e-6);
  EXPECT_LT(x[1], 1.6);
}

}  // namespace
}  // namespace gamut
