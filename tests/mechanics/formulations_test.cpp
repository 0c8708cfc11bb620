// The two formulations of the equations of motion are the same equations, whatever the machine, its units and its
// position; at singular positions of coordinates that are regular ones of the machine, too.
#include <gmock/gmock.h>

#include <functional>
#include <span>

#include "machines.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut {
namespace {

using testing::HighPrecision;
using testing::RandomStates;

const std::array<double, 6> moments{0.1, 0.2, 0.25, 0.01, -0.02, 0.03};
const std::array<Expression, 6> fullInertia{0.1, 0.2, 0.25, 0.01, -0.02, 0.03};

/// Hinges about these axes, a link and a body behind each; `size` scales lengths, `weight` masses.
Mechanism chain(const std::vector<Axis>& axes, bool isPoint, double size = 1, double weight = 1) {
  Mechanism m;
  std::string from = Mechanism::inertialFrame;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::string number = std::to_string(i);
    m.add(Revolute{"joint" + number, from, "K" + number, axes[i]});
    m.add(Link{"link" + number, "K" + number, "E" + number, {0.3 * size, 0.0, -0.4 * size}});
    Mass body{"body" + number, "E" + number, weight};
    if (!isPoint)
      for (std::size_t k = 0; k < 6; ++k)
        body.inertia[k] = Interval(moments[k]) * Interval(weight) * sqr(Interval(size));
    m.add(body);
    from = "E" + number;
  }
  m.setGravity({0.0, 0.0, -10.0 * size});
  return m;
}

std::vector<Axis> alternating(int count) {
  std::vector<Axis> axes;
  for (int i = 0; i < count; ++i) axes.push_back(i % 3 == 0 ? axisZ : i % 3 == 1 ? axisY : axisX);
  return axes;
}

/// A trunk of two joints with three arms of two.
Mechanism tree() {
  Mechanism m = chain({axisX, axisY}, false);
  for (int arm = 0; arm < 3; ++arm) {
    const std::string name = "arm" + std::to_string(arm);
    m.add(Revolute{name + "Hinge", "E1", name + "K", Axis(1, arm, -1)});
    m.add(Link{name + "Link", name + "K", name + "E", {0.1, 0.2 * arm, 0.3}});
    m.add(Mass{name + "Body", name + "E", 0.5, {0.05, 0.0, 0.1}, fullInertia});
    m.add(Prismatic{name + "Slide", name + "E", name + "S", axisZ});
    m.add(Mass{name + "Tip", name + "S", 0.25});
  }
  return m;
}

/// Links that turn in one, two and three steps, about axes that joints are parallel to, too.
Mechanism turnedLinks() {
  Mechanism m;
  std::string from = Mechanism::inertialFrame;
  const std::vector<std::vector<FixedRotation>> turns{{},
                                                      {{axisX, 0, 0.3}},
                                                      {{axisZ, 0, -0.7}, {axisX, 0, 1.1}},
                                                      {{axisZ, 0, 0.4}, {axisY, 0, -0.9}, {axisX, 0, 2.0}},
                                                      {{axisX, 0, 0.2}, {Axis(1, 1, 0), 0, 0.5}},
                                                      {{axisY, 1, 0.0}, {axisY, 0, 0.25}}};
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const std::string n = std::to_string(i);
    m.add(Link{"link" + n, from, "seat" + n, {0.1, -0.2, 0.3}, turns[i]});
    m.add(Revolute{"joint" + n, "seat" + n, "K" + n, i % 2 == 0 ? axisZ : axisX});
    m.add(Mass{"body" + n, "K" + n, 1.0, {0.05, 0.1, -0.2}, fullInertia});
    from = "K" + n;
  }
  m.setGravity({0.5, -1.0, -9.0});
  return m;
}

/// Joints and links without a body of their own between two bodies.
Mechanism wristWithoutMass() {
  Mechanism m = chain({axisZ}, false);
  m.add(Revolute{"roll", "E0", "R", axisX});
  m.add(Revolute{"pitch", "R", "P", axisY});
  m.add(Revolute{"yaw", "P", "Y", axisZ});
  m.add(Mass{"hand", "Y", 0.75, {0.1, 0.2, 0.3}, fullInertia});
  return m;
}

/// A floating trunk with an arm on a ball joint, a screw and a puck that slides on a plane.
Mechanism floatingMachine(double size = 1) {
  Mechanism m;
  m.add(Free{"trunk", "inertial", "T"});
  m.add(Mass{"trunkBody", "T", 2.0, {0.1 * size, -0.2 * size, 0.3 * size}, fullInertia});
  m.add(Link{"shoulder", "T", "S", {0.2 * size, 0.0, 0.4 * size}, {{Axis(1, 2, -2), 0, 0.4}}});
  m.add(Spherical{"ball", "S", "U"});
  m.add(Mass{"arm", "U", 0.7, {0.0, 0.05 * size, -0.3 * size}, fullInertia});
  m.add(Screw{"screw", "U", "W", Axis(0, 2, 1), 0.7 * size});
  m.add(Mass{"nut", "W", 0.4, {0.02 * size, 0.0, 0.03 * size}, fullInertia});
  m.add(Link{"table", "T", "P", {0.0, 0.3 * size, 0.0}, {{axisY, 0, 0.3}}});
  m.add(Planar{"puck", "P", "Q", Axis(0, -1, 0)});
  m.add(Mass{"disc", "Q", 0.3, {0.1 * size, 0.05 * size, 0.0}, fullInertia});
  m.setGravity({0.5, -1.0, -9.0});
  return m;
}

/// Bodies on ball joints, one behind the other.
Mechanism ballChain(int count, bool isPoint) {
  Mechanism m;
  std::string from = Mechanism::inertialFrame;
  for (int i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    m.add(Spherical{"ball" + number, from, "K" + number});
    m.add(Link{"link" + number, "K" + number, "E" + number, {0.0, 0.0, -0.4}});
    Mass body{"body" + number, "E" + number, 1.0};
    body.inertia = isPoint ? std::array<Expression, 6>{1e-3, 1e-3, 2e-3, 0.0, 0.0, 0.0} : fullInertia;
    m.add(body);
    from = "E" + number;
  }
  m.setGravity({0.0, 0.0, -10.0});
  return m;
}

/// Numbers as states: quaternions of length 1, about that of no rotation.
std::vector<double> asStates(const Mechanism& mechanism, std::vector<double> x) {
  const std::vector<std::string> names = mechanism.stateNames();
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!names[i].ends_with("quaternion.w")) continue;
    const auto e = std::span(x).subspan(i, 4);
    e[0] += 1;
    const double length = std::hypot(std::hypot(e[0], e[1]), std::hypot(e[2], e[3]));
    for (double& component : e) component /= length;
  }
  return x;
}

/// The first joint of a chain drives the last by a gear, and the one before a slider on a branch by a rack.
Mechanism geared(int count, bool isPoint = false) {
  Mechanism m = chain(alternating(count), isPoint);
  m.add(Prismatic{"slide", "E0", "S", Axis(1, -1, 2)});
  m.add(Mass{"carriage", "S", 0.5, {0.0, 0.1, 0.2}, fullInertia});
  const std::string last = "joint" + std::to_string(count - 1);
  m.add(Coupling{"gear", last, "joint0", -1.5, 0.25});
  m.add(Coupling{"rack", "slide", "joint" + std::to_string(count - 2), 0.125});
  return m;
}

/// A joint that follows one that follows: of five hinges, two are left.
Mechanism gearedInSeries() {
  Mechanism m = chain(alternating(5), false);
  m.add(Coupling{"first", "joint2", "joint0", 0.5});
  m.add(Coupling{"second", "joint3", "joint2", -2.0, 0.5});
  m.add(Coupling{"third", "joint4", "joint0", 0.25});
  return m;
}

struct Machine {
  std::string name;
  std::function<Mechanism()> make;
};

class Formulations : public ::testing::TestWithParam<Machine> {};

/// At random states, at rest with all coordinates zero, and with all of them equal.
TEST_P(Formulations, AreTheSameEquations) {
  const Mechanism mechanism = GetParam().make();
  const Program sparse = recordMotion(mechanism, {}, Formulation::sparse),
                articulated = recordMotion(mechanism, {}, Formulation::articulated);
  Evaluator<HighPrecision> one(sparse), other(articulated);
  Evaluator<Interval> enclosed(sparse), enclosedArticulated(articulated);
  const auto n = static_cast<std::size_t>(sparse.states());
  RandomStates states;
  for (int round = 0; round < 6; ++round) {
    const std::vector<double> x = asStates(mechanism, round == 0   ? std::vector<double>(n, 0.0)
                                                      : round == 1 ? std::vector<double>(n, 0.5)
                                                                   : states(n, 1.5));
    const std::vector<HighPrecision> a = one(0, {x.begin(), x.end()}), b = other(0, {x.begin(), x.end()});
    const std::vector<Interval> box(x.begin(), x.end()), c = enclosed(0.0, box), d = enclosedArticulated(0.0, box);
    HighPrecision largest(1e-30);
    for (std::size_t i = n / 2; i < n; ++i) largest = std::max(largest, HighPrecision(abs(b[i])));
    for (std::size_t i = n / 2; i < n; ++i) {
      EXPECT_LE(abs(a[i] - b[i]), largest * HighPrecision("1e-38")) << i;
      // 50 digits are the truth up to their own rounding, which is no part of the enclosure.
      EXPECT_LE(HighPrecision(c[i].lower()), a[i] + largest * HighPrecision("1e-38")) << i;
      EXPECT_GE(HighPrecision(c[i].upper()), a[i] - largest * HighPrecision("1e-38")) << i;
      EXPECT_FALSE(isDisjoint(c[i], d[i])) << i;
      EXPECT_LE(width(c[i]), 1e-9 * static_cast<double>(largest)) << "sparse " << i;
      EXPECT_LE(HighPrecision(d[i].lower()), a[i] + largest * HighPrecision("1e-38")) << i;
      EXPECT_GE(HighPrecision(d[i].upper()), a[i] - largest * HighPrecision("1e-38")) << i;
    }
  }
}

TEST_P(Formulations, KeepTheEnergy) {
  const Mechanism mechanism = GetParam().make();
  const Program f = recordMotion(mechanism), y = recordOutputs(mechanism, {}, {"energy"}).differentiated();
  Evaluator<HighPrecision> rate(f), energy(y);
  RandomStates states;
  for (int round = 0; round < 3; ++round) {
    const std::vector<double> x = asStates(mechanism, states(static_cast<std::size_t>(f.states()), 1.5));
    const std::vector<HighPrecision> dx = rate(0, {x.begin(), x.end()}), dy = energy(0, {x.begin(), x.end()});
    HighPrecision power(0), size(0);
    for (std::size_t i = 0; i < x.size(); ++i) {
      power += dy[1 + i] * dx[i];
      size += abs(dy[1 + i] * dx[i]);
    }
    EXPECT_LE(abs(power), size * HighPrecision("1e-14")) << "midpoints of unit axes are no unit vectors";
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, Formulations,
    ::testing::Values(Machine{"oneHinge", [] { return chain({axisY}, true); }},
                      Machine{"twoPerpendicularHinges",
                              [] {
                                return chain({axisZ, axisY}, false);
                              }},
                      Machine{"threePerpendicularHinges", [] { return chain(alternating(3), false); }},
                      Machine{"fourPerpendicularHinges", [] { return chain(alternating(4), false); }},
                      Machine{"sixPerpendicularHinges", [] { return chain(alternating(6), false); }},
                      Machine{"obliqueHinges",
                              [] {
                                return chain({Axis(1, 2, 2), Axis(-2, 1, 2), Axis(0, 1, 1)}, false);
                              }},
                      Machine{"planarChainOfThree", [] { return chain(std::vector<Axis>(3, axisY), true); }},
                      Machine{"planarChainOfFiveBodies", [] { return chain(std::vector<Axis>(5, axisY), false); }},
                      Machine{"planarChainOfTen", [] { return chain(std::vector<Axis>(10, axisY), true); }},
                      Machine{"millimetresAndGrams", [] { return chain(alternating(4), false, 1e-3, 1e-3); }},
                      Machine{"kilometresAndKilotons", [] { return chain(alternating(4), false, 1e3, 1e6); }},
                      Machine{"tree", [] { return tree(); }}, Machine{"turnedLinks", [] { return turnedLinks(); }},
                      Machine{"wristWithoutMass", [] { return wristWithoutMass(); }},
                      Machine{"gearedToOneSpeed", [] { return geared(2); }},
                      Machine{"gearedToTwoSpeeds", [] { return geared(3); }},
                      Machine{"gearedToThreeSpeeds", [] { return geared(4); }},
                      Machine{"gearedToSixSpeeds", [] { return geared(7); }},
                      Machine{"gearedPoints", [] { return geared(4, true); }},
                      Machine{"gearedInSeries", [] { return gearedInSeries(); }},
                      Machine{"floating", [] { return floatingMachine(); }},
                      Machine{"floatingInMillimetres", [] { return floatingMachine(1e-3); }},
                      Machine{"oneBall", [] { return ballChain(1, false); }},
                      Machine{"chainOfBalls", [] { return ballChain(4, false); }},
                      Machine{"chainOfBallsWithSlenderRods", [] { return ballChain(3, true); }},
                      Machine{"spatialArm", [] { return testing::spatialArm(); }}),
    [](const auto& machine) { return machine.param.name; });

/// Each chain alone is solved for itself.
TEST(SparseEquations, OfMachinesSideBySideFallApart) {
  Mechanism m;
  for (int i = 0; i < 30; ++i) {
    const std::string number = std::to_string(i);
    m.add(Revolute{"joint" + number, Mechanism::inertialFrame, "K" + number, axisX});
    m.add(Mass{"body" + number, "K" + number, 1.0, {0.0, 0.5, 0.0}});
  }
  for (const Formulation formulation : {Formulation::sparse, Formulation::articulated})
    EXPECT_TRUE(recordMotion(m, {}, formulation).matrices().empty());
}

TEST(SparseEquations, StayShortAlongAChain) {
  const auto size = [](int links) {
    const Program f = recordMotion(chain(std::vector<Axis>(static_cast<std::size_t>(links), axisY), true));
    return f.matrices().empty() ? 0 : f.matrices().front().size;
  };
  EXPECT_LE(size(20), 5 * 20);
  EXPECT_LE(size(20) - size(10), 5 * 10 + 2);
}

}  // namespace
}  // namespace gamut
