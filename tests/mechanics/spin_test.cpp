// Bodies that spin about their own axis of symmetry: the equations do not hold the angle, and nothing else changes.
#include <gmock/gmock.h>

#include <algorithm>
#include <functional>
#include <span>

#include "machines.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

using testing::placeOf;
using testing::RandomStates;
using testing::statesOf;

Expression decimal(const std::string& text) { return Expression::parse(text); }

/// A platform that turns any way, with an eccentric body, that carries what is to spin at its frame "seat".
Mechanism platform() {
  Mechanism m;
  m.add(Spherical{"ball", "inertial", "platform"});
  m.add(Mass{"bus", "platform", 2.0, {0.1, -0.2, 0.3}, {0.4, 0.5, 0.3, 0.02, -0.03, 0.05}});
  m.add(Link{"mount", "platform", "seat", {0.2, -0.3, 0.1}, {{axisX, 0, 0.4}, {axisZ, 0, -0.7}}});
  m.setGravity({0.5, -1.0, -9.0});
  return m;
}

/// The same with a wheel about this axis.
Mechanism wheel(const Axis& axis, const std::array<Expression, 6>& inertia, const ExpressionVector& centre) {
  Mechanism m = platform();
  m.add(Revolute{"wheel", "seat", "rotor", axis});
  m.add(Mass{"disc", "rotor", decimal("0.7"), centre, inertia});
  return m;
}

std::array<Expression, 6> aboutZ(const Expression& across, const Expression& along) {
  return {across, across, along, 0.0, 0.0, 0.0};
}

/// On a link along the axis, which is turned so that it is that of y, behind it; the body's numbers are turned, too.
Mechanism wheelBehindLinks() {
  Mechanism m = platform();
  m.add(Revolute{"wheel", "seat", "hub", axisX});
  m.add(Link{"shaft", "hub", "end", {decimal("0.3"), 0.0, 0.0}, {{axisZ, 1, 0.0}}});
  Mass disc{"disc", "end", 0.5, {0.0, 0.1, 0.0}, aboutZ(decimal("0.02"), decimal("0.03"))};
  disc.rotation = {{axisX, 1, 0.0}};
  m.add(disc);
  m.add(Mass{"ring", "hub", 0.25, {-0.1, 0.0, 0.0}, {0.5, 0.25, 0.25, 0.0, 0.0, 0.0}});
  return m;
}

/// A wheel on a shaft that spins about the same axis, the other way round.
Mechanism wheelOnShaft() {
  Mechanism m = platform();
  m.add(Revolute{"wheel", "seat", "shaft", axisZ});
  m.add(Mass{"shaftBody", "shaft", 0.5, {0.0, 0.0, 0.1}, aboutZ(0.25, 0.125)});
  m.add(Link{"along", "shaft", "top", {0.0, 0.0, 0.4}, {{axisZ, 0, 0.3}}});
  m.add(Revolute{"second", "top", "rotor", Axis(0, 0, -1)});
  m.add(Mass{"disc", "rotor", 0.7, {0.0, 0.0, 0.2}, aboutZ(0.3, 0.5)});
  m.add(JointForce{"brake", "second", Expression::parse("-0.1 N m s/rad * second.rate")});
  return m;
}

/// Planets that a carrier takes round, each of another mass, about a sun.
Mechanism gear(int planets, bool isHeavy) {
  Mechanism m;
  m.add(Revolute{"carrier", "inertial", "C", axisZ});
  m.add(Mass{"plate", "C", 1.0, {0.0, 0.0, 0.0}, aboutZ(decimal("0.005"), decimal("0.005"))});
  m.add(Revolute{"wheel", "inertial", "S", axisZ});
  m.add(Mass{"sun", "S", 0.2, {0.0, 0.0, 0.0}, aboutZ(1e-4, 1e-4)});
  m.add(Coupling{"toSun", "wheel", "carrier", 4.0});
  for (int i = 0; i < planets; ++i) {
    const std::string n = std::to_string(i);
    m.add(Link{"arm" + n, "C", "A" + n, {0.08 - 0.01 * i, 0.03 * i, 0.0}});
    m.add(Revolute{"planet" + n, "A" + n, "P" + n, axisZ});
    m.add(Mass{"disc" + n, "P" + n, 0.3 + 0.1 * i, {0.0, 0.0, 0.0}, aboutZ(decimal("2e-4"), decimal("4e-4"))});
    m.add(Coupling{"to" + n, "planet" + n, "carrier", -3.0});
  }
  m.add(JointForce{"drive", "wheel", Expression(0.05)});
  if (isHeavy) m.setGravity({0.0, 0.0, decimal("-9.81")});
  return m;
}

Mechanism wheels(int count) {
  Mechanism m = platform();
  for (int i = 0; i < count; ++i) {
    const std::string n = i == 0 ? "" : std::to_string(i);
    const int k = i % 3;
    m.add(Revolute{"wheel" + n, "seat", "rotor" + n, k == 0 ? axisX : k == 1 ? axisY : axisZ});
    Mass disc{"disc" + n, "rotor" + n, decimal("0.5"), {0.0, 0.0, 0.0}};
    for (int j = 0; j < 3; ++j) disc.inertia[static_cast<std::size_t>(j)] = decimal(j == k ? "5e-4" : "2.5e-4");
    m.add(disc);
    m.add(Motor{"motor" + n, "wheel" + n, Expression::parse("0.1 N m s/rad * ball.rate.x")});
  }
  return m;
}

/// A ball that rolls on a plate which turns, with a body of these moments of inertia.
Mechanism rollingBall(const std::array<Expression, 6>& inertia) {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "plate", Axis(1, 2, 3)});
  m.add(Mass{"plateBody", "plate", 2.0, {0.1, -0.2, 0.3}, {0.4, 0.5, 0.3, 0.02, -0.03, 0.05}});
  m.add(RollingBall{"roll", "plate", "globe", 0.25});
  m.add(Mass{"body", "globe", 0.5, {0.0, 0.0, 0.0}, inertia});
  m.add(Mass{"core", "globe", 0.25});
  m.setGravity({0.5, -1.0, -9.0});
  return m;
}

Mechanism rollingBallWithLoads() {
  Mechanism m = rollingBall({0.125, 0.125, 0.125, 0.0, 0.0, 0.0});
  m.add(Force{"push", "globe", {1.0, 2.0, -7.0}, {0.5, 0.25, -0.5}});
  m.add(Spring{"spring", "inertial", "globe", 20.0, 0.5, 0.25, {3.0, 2.0, 1.0}, {0.25, 0.5, 0.0}});
  return m;
}

/// Loads on what spins: at its rim, and by how it moves.
Mechanism wheelWithLoads() {
  Mechanism m = wheel(axisZ, aboutZ(0.25, 0.5), {0.0, 0.0, 0.125});
  m.add(Spring{"spring", "inertial", "rotor", 20.0, 0.5, 0.25, {3.0, 2.0, 1.0}, {0.25, 0.5, 0.0}});
  m.add(JointSpring{"torsion", "wheel", 4.0, 0.2, 0.1});
  return m;
}

/// Which states the rates of speeds are computed from.
std::vector<char> usedByAccelerations(const Mechanism& m, const Program& f) {
  std::vector<char> used(f.nodes().size(), 0);
  for (std::size_t i = m.positions(); i < m.stateNames().size(); ++i)
    used[static_cast<std::size_t>(f.outputNodes()[i])] = 1;
  for (int i = static_cast<int>(used.size()) - 1; i >= 0; --i)
    if (used[static_cast<std::size_t>(i)] != 0)
      detail::forEachOperand(f.table(), i, [&](int operand) { used[static_cast<std::size_t>(operand)] = 1; });
  used.resize(static_cast<std::size_t>(f.states()));
  return used;
}

bool holdsAngle(const Mechanism& m, Formulation formulation, const std::vector<std::string>& parameters = {},
                const std::string& angle = "wheel.angle") {
  const Program f = recordMotion(m, parameters, formulation);
  return usedByAccelerations(m, f)[placeOf(m, angle)] != 0;
}

struct SpinningMachine {
  std::string name;
  std::function<Mechanism()> make;
  bool isFree = true;  // of the angle
  std::string angle = "wheel.angle";
};

class Spin : public ::testing::TestWithParam<SpinningMachine> {};

TEST_P(Spin, IsInNoEquationWhereItChangesNothing) {
  const Mechanism m = GetParam().make();
  for (const Formulation formulation : {Formulation::sparse, Formulation::articulated})
    EXPECT_EQ(holdsAngle(m, formulation, {}, GetParam().angle), !GetParam().isFree);
}

/// Scalars that do not record know nothing of symmetry, and turn every body.
TEST_P(Spin, ChangesNothingThatCanBeLookedAt) {
  const Mechanism m = GetParam().make();
  const std::vector<std::string> outputs = m.outputQuantities();
  const Program sparse = recordMotion(m, {}, Formulation::sparse),
                articulated = recordMotion(m, {}, Formulation::articulated), y = recordOutputs(m, {}, outputs);
  Evaluator<double> first(sparse), second(articulated), seen(y);
  Assembly<double> machine(m);
  RandomStates states;
  for (int round = 0; round < 4; ++round) {
    const std::vector<double> x = statesOf(m, states);
    machine.setState(x);
    const std::vector<double> rates = machine.rates(), a = first(0.0, x), b = second(0.0, x), values = seen(0.0, x);
    double largest = 1;
    for (const double rate : rates) largest = std::max(largest, std::abs(rate));
    for (std::size_t i = 0; i < rates.size(); ++i) {
      EXPECT_NEAR(a[i], rates[i], 1e-12 * largest) << m.stateNames()[i];
      EXPECT_NEAR(b[i], rates[i], 1e-12 * largest) << m.stateNames()[i];
    }
    for (std::size_t i = 0; i < outputs.size(); ++i)
      EXPECT_NEAR(values[i], machine.output(outputs[i]), 1e-12 * (largest + std::abs(values[i]))) << outputs[i];
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, Spin,
    ::testing::Values(
        SpinningMachine{"aBallThatRolls",
                        [] {
                          return rollingBall({decimal("0.2"), decimal("0.2"), decimal("0.2"), 0.0, 0.0, 0.0});
                        },
                        true, "roll.quaternion.x"},
        SpinningMachine{"aBallWithLoads", rollingBallWithLoads, false, "roll.quaternion.x"},
        SpinningMachine{"aLopsidedBall",
                        [] {
                          return rollingBall({0.25, 0.125, 0.25, 0.0, 0.0, 0.0});
                        },
                        false, "roll.quaternion.x"},
        SpinningMachine{"aWheel",
                        [] {
                          return wheel(axisZ, aboutZ(decimal("0.2"), decimal("0.3")), {0.0, 0.0, 0.1});
                        }},
        SpinningMachine{"aWheelAboutTheNegativeAxis",
                        [] {
                          return wheel(Axis(0, -1, 0), {0.25, 0.5, 0.25, 0.0, 0.0, 0.0}, {0.0, 0.125, 0.0});
                        }},
        SpinningMachine{"aWheelInSmallUnits",
                        [] {
                          return wheel(axisZ, aboutZ(decimal("200 g mm^2"), decimal("2e-7 kg m^2")), {0.0, 0.0, 0.0});
                        }},
        SpinningMachine{
            "aWheelByAFormula",
            [] {
              Mechanism m = platform();
              m.addParameter("inertia", parseAmount("0.01 kg m^2"), "kg m^2");
              m.add(Revolute{"wheel", "seat", "rotor", axisZ});
              m.add(Mass{"disc", "rotor", 0.5, {0.0, 0.0, 0.0}, aboutZ(decimal("0.6*inertia"), decimal("inertia"))});
              return m;
            }},
        SpinningMachine{"aPointOnTheAxisOfARotor",
                        [] {
                          Mechanism m = wheel(axisX, {0.5, 0.25, 0.25, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
                          m.add(Mass{"tip", "rotor", 0.5, {0.5, 0.0, 0.0}});
                          return m;
                        }},
        SpinningMachine{"aBallAboutAnyAxis",
                        [] {
                          return wheel(Axis(1, 2, -2), {0.25, 0.25, 0.25, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
                        }},
        SpinningMachine{"aWheelBehindLinks", wheelBehindLinks}, SpinningMachine{"aWheelOnAShaft", wheelOnShaft},
        SpinningMachine{"threeWheels", [] { return wheels(3); }},
        SpinningMachine{"tenWheels", [] { return wheels(10); }},
        SpinningMachine{"aPuck",
                        [] {
                          Mechanism m = platform();
                          m.add(Planar{"wheel", "seat", "puck", axisY});
                          m.add(Mass{"disc", "puck", 0.5, {0.0, 0.0, 0.0}, {0.25, 0.5, 0.25, 0.0, 0.0, 0.0}});
                          return m;
                        }},
        SpinningMachine{"aLoadedWheel", wheelWithLoads, false},
        SpinningMachine{"anEllipticWheel",
                        [] {
                          return wheel(axisZ, {0.2, 0.25, 0.3, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
                        },
                        false},
        SpinningMachine{"aWheelWithADeviationMoment",
                        [] {
                          return wheel(axisZ, {0.25, 0.25, 0.3, 0.0, 0.01, 0.0}, {0.0, 0.0, 0.0});
                        },
                        false},
        SpinningMachine{"anEccentricWheel",
                        [] {
                          return wheel(axisZ, aboutZ(0.25, 0.5), {0.0, 0.001, 0.0});
                        },
                        false},
        SpinningMachine{"aBallOffTheAxis",
                        [] {
                          return wheel(Axis(1, 2, -2), {0.25, 0.25, 0.25, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.125});
                        },
                        false},
        SpinningMachine{"aWheelOnAnotherAcross",
                        [] {
                          Mechanism m = wheel(axisZ, aboutZ(0.25, 0.5), {0.0, 0.0, 0.0});
                          m.add(Revolute{"second", "rotor", "upper", axisX});
                          m.add(Mass{"top", "upper", 0.5, {0.0, 0.0, 0.0}, {0.5, 0.25, 0.25, 0.0, 0.0, 0.0}});
                          return m;
                        },
                        false},
        SpinningMachine{"aWheelWithABodyOnItsRim",
                        [] {
                          Mechanism m = wheel(axisZ, aboutZ(0.25, 0.5), {0.0, 0.0, 0.0});
                          m.add(Link{"spoke", "rotor", "rim", {0.25, 0.0, 0.0}});
                          m.add(Mass{"weight", "rim", 0.125});
                          return m;
                        },
                        false}),
    [](const auto& machine) { return machine.param.name; });

/// The one state is the carrier's angle; no sine is left.
TEST(PlanetaryGear, HasConstantInertia) {
  for (const bool isHeavy : {false, true})
    for (const int planets : {1, 3, 4, 10}) {
      const Mechanism m = gear(planets, isHeavy);
      std::vector<std::string> masses;
      for (int i = 0; i < planets; ++i) masses.push_back("disc" + std::to_string(i) + ".mass");
      const Program f = recordMotion(m, masses);
      EXPECT_TRUE(std::ranges::none_of(f.nodes(), [](const Node& node) { return node.op == Op::sin; }));
      std::vector<double> values;
      for (int i = 0; i < planets; ++i) values.push_back(0.3 + 0.1 * i);
      Evaluator<double> evaluator(f);
      evaluator.setParameters(values);
      RandomStates states;
      Assembly<double> machine(m);
      for (int round = 0; round < 3; ++round) {
        const std::vector<double> x = states(2);
        machine.setState(x);
        EXPECT_NEAR(evaluator(0.0, x)[1], machine.accelerations()[0], 1e-12);
      }
    }
}

/// Equal numbers are no symmetry where each may be another: what is known must be known of all values.
TEST(Symmetry, IsThatOfFormulas) {
  const Mechanism numbers = wheel(axisZ, aboutZ(decimal("0.2"), decimal("0.3")), {0.0, 0.0, 0.0});
  EXPECT_FALSE(holdsAngle(numbers, Formulation::sparse, {"disc.inertia.zz", "disc.mass"}));
  EXPECT_TRUE(holdsAngle(numbers, Formulation::sparse, {"disc.inertia.xx"}));
  EXPECT_TRUE(holdsAngle(numbers, Formulation::sparse, {"disc.inertia.xx", "disc.inertia.yy"}));
  EXPECT_TRUE(holdsAngle(numbers, Formulation::sparse, {"disc.centre.x"}));
  EXPECT_FALSE(holdsAngle(numbers, Formulation::sparse, {"disc.centre.z"}));

  Mechanism formulas = platform();
  formulas.addParameter("inertia", parseAmount("0.01 kg m^2"), "kg m^2");
  formulas.add(Revolute{"wheel", "seat", "rotor", axisZ});
  formulas.add(Mass{"disc", "rotor", 0.5, {0.0, 0.0, 0.0}, aboutZ(decimal("0.6*inertia"), decimal("inertia"))});
  EXPECT_FALSE(holdsAngle(formulas, Formulation::sparse, {"inertia"}));
}

/// Two decimals that no double tells apart are not one number.
TEST(Symmetry, IsNotSeenInEnclosures) {
  const auto of = [](const char* across) {
    return wheel(axisZ, {decimal("0.1"), decimal(across), 0.15, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  };
  EXPECT_FALSE(holdsAngle(of("1/10"), Formulation::sparse));
  EXPECT_TRUE(holdsAngle(of("0.1000000000000000000001"), Formulation::sparse));
}

}  // namespace
}  // namespace gamut
