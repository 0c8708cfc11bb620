// Loops in closed form: closed to all digits wherever the dependent coordinates say that they are, on the side on which
// the machine is assembled, and only where that is known.
#include "mechanics/triangle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "tests/mechanics/machines.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut::triangles {
namespace {

using Number = testing::HighPrecision;

const Axis downwards(0, 0, -1);

/// A crank of 0.3 m that turns a frame "pin" and a frame "far" at 0.9 m, both of which stand on `base`.
struct Crank {
  Mechanism m;

  explicit Crank(bool isTilted, const Axis& axis = axisZ) {
    std::string base = Mechanism::inertialFrame;
    if (isTilted) {  // a base that turns about another axis, and stands askew on that
      m.add(Revolute{"tilt", base, "tilted", axisX, 0.4, 0.3});
      m.add(Link{"askew", "tilted", "base", {0.1, 0.2, 0.3}, {{axisY, 0, 0.5}}});
      m.add(Mass{"platform", "base", 4.0, {0.1, 0.0, 0.2}, {1.0, 1.1, 1.2, 0.0, 0.0, 0.0}});
      base = "base";
    }
    m.add(Revolute{"crank", base, "crank_frame", axis, 0.7, 2.0});
    m.add(Mass{"crank_body", "crank_frame", 1.0, {0.15, 0.05, 0.0}, {0.1, 0.1, 0.2, 0.0, 0.0, 0.0}});
    m.add(Link{"arm", "crank_frame", "pin", {0.25, 0.125, 0.1}});
    m.add(Link{"ground", base, "far", {0.9, -0.1, 0.0}});
  }
  void hinge(const std::string& name, const std::string& from, double angle, const Axis& axis = axisZ) {
    m.add(Revolute{name, from, name + "_frame", axis, angle, 0.0});
    body(name);
  }
  void slide(const std::string& name, const std::string& from, double path, const Axis& axis) {
    m.add(Prismatic{name, from, name + "_frame", axis, path, 0.0});
    body(name);
  }
  void body(const std::string& name) {
    m.add(Mass{name + "_body", name + "_frame", 1.5, {0.2, 0.1, 0.0}, {0.1, 0.2, 0.3, 0.0, 0.0, 0.0}});
  }
  void close(const std::string& from, const std::string& to, const ExpressionVector& fromPoint,
             const ExpressionVector& toPoint, const std::vector<std::string>& dependent) {
    Closure closure;
    closure.name = "loop";
    closure.from = from;
    closure.to = to;
    closure.fromPoint = fromPoint;
    closure.toPoint = toPoint;
    closure.as = "pin";
    closure.dependent = dependent;
    m.add(closure);
  }
  void hold(const std::string& from, const std::string& to, const ExpressionVector& fromPoint,
            const ExpressionVector& toPoint, double length, const std::vector<std::string>& dependent) {
    RodClosure rod;
    rod.name = "loop";
    rod.from = from;
    rod.to = to;
    rod.fromPoint = fromPoint;
    rod.toPoint = toPoint;
    rod.length = length;
    rod.dependent = dependent;
    m.add(rod);
  }
};

struct Machine {
  const char* name;
  std::function<Mechanism(bool isTilted, const Axis& axis)> made;
};

const std::vector<Machine>& machines() {
  static const std::vector<Machine> all = {
      {"two hinges side by side",
       [](bool isTilted, const Axis& axis) {
         Crank c(isTilted, axis);
         c.hinge("coupler", "pin", -0.5, axis);
         c.hinge("rocker", "far", 1.6, downwards);
         c.close("rocker_frame", "coupler_frame", {0.6, 0.05, 0.2}, {0.8, -0.1, 0.0}, {"coupler", "rocker"});
         return c.m;
       }},
      {"two hinges in turn",
       [](bool isTilted, const Axis& axis) {
         Crank c(isTilted, axis);
         c.hinge("coupler", "pin", -0.5);
         c.m.add(Link{"bend", "coupler_frame", "knee", {0.8, 0.1, 0.0}, {{axisZ, 0, 0.25}}});
         c.hinge("rocker", "knee", -1.0, axis);
         c.close("far", "rocker_frame", {0.0, 0.0, 0.0}, {0.6, 0.05, 0.0}, {"coupler", "rocker"});
         return c.m;
       }},
      {"a hinge and a slide side by side",
       [](bool isTilted, const Axis& axis) {
         Crank c(isTilted, axis);
         c.hinge("rod", "pin", -0.2, axis);
         c.m.add(Link{"turned", "far", "guide", {0.0, 0.05, 0.0}, {{axisZ, 0, 0.3}}});
         c.slide("slider", "guide", 0.3, Axis(1, 0, 0));
         c.close("slider_frame", "rod_frame", {0.05, 0.1, 0.3}, {0.9, 0.1, 0.0}, {"rod", "slider"});
         return c.m;
       }},
      {"a slide that a hinge stands on",
       [](bool isTilted, const Axis& axis) {
         Crank c(isTilted, axis);
         c.slide("slider", "far", 0.3, Axis(-1, 0, 0));
         c.hinge("rod", "slider_frame", 2.6, axis);
         c.close("pin", "rod_frame", {0.01, 0.0, 0.0}, {0.7, 0.0, 0.0}, {"slider", "rod"});
         return c.m;
       }},
      {"a slide on a hinge",
       [](bool isTilted, const Axis& axis) {
         Crank c(isTilted, axis);
         c.hinge("cylinder", "far", 2.5, axis);
         c.slide("piston", "cylinder_frame", 0.3, Axis(0, 1, 0));
         c.close("pin", "piston_frame", {0.0, 0.0, 0.0}, {0.1, 0.2, 0.0}, {"cylinder", "piston"});
         return c.m;
       }},
      {"a hinge and a rod",
       [](bool isTilted, const Axis& axis) {
         Crank c(isTilted, axis);
         c.hinge("rocker", "far", 1.2, axis);
         c.hold("pin", "rocker_frame", {0.0, 0.0, 0.0}, {0.6, 0.0, 0.2}, 0.8, {"rocker"});
         return c.m;
       }},
      {"a slide and a rod",
       [](bool isTilted, const Axis& axis) {
         Crank c(isTilted, axis);
         c.slide("slider", "far", 0.3, Axis(1, 0, 0));
         c.hold("slider_frame", "pin", {0.0, 0.1, 0.2}, {0.0, 0.0, 0.0}, 0.9, {"slider"});
         return c.m;
       }},
  };
  return all;
}

std::vector<std::string> places(const std::string& frame) {
  std::vector<std::string> names;
  for (const char* component : {"x", "y", "z"}) names.push_back(frame + ".position." + component);
  return names;
}

/// The rows of the loop, by frames that are moved by whatever the states of dependent coordinates say.
Program rowsOf(const Mechanism& m, bool isPlaced) {
  const int states = static_cast<int>(m.stateNames().size()), rows = static_cast<int>(m.dependents().size());
  return record(states, 0, rows, [&](auto t, const auto& x, const auto&, auto& y) {
    Assembly<Recorded> assembly(m);
    if (isPlaced)
      assembly.setMotion(x, t);
    else
      assembly.setState(x, t);
    const std::vector<Recorded> found = assembly.system().residuals();
    for (std::size_t i = 0; i < found.size(); ++i) y[i] = found[i];
  });
}

class Triangles : public ::testing::TestWithParam<std::tuple<std::size_t, bool, bool>> {
 protected:
  Mechanism mechanism() const {
    const auto [number, isTilted, isDownwards] = GetParam();
    return machines()[number].made(isTilted, isDownwards ? downwards : axisZ);
  }
};

TEST_P(Triangles, AreClosedWhateverTheirCoordinatesSay) {
  const Mechanism m = mechanism();
  Evaluator<Number> placed(rowsOf(m, true)), open(rowsOf(m, false));
  const std::vector<double> start = Assembly<double>(m).initialState();
  testing::RandomStates random;
  for (int i = 0; i < 5; ++i) {
    std::vector<Number> x(start.begin(), start.end());
    const std::vector<double> by = random(static_cast<int>(x.size()), 0.1);
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += by[k];
    for (const Number& row : placed(Number(0), x)) EXPECT_LE(abs(row), Number("1e-45"));
    Number largest = 0;
    for (const Number& row : open(Number(0), x))
      if (abs(row) > largest) largest = abs(row);
    EXPECT_GT(largest, Number("1e-4"));
  }
}

TEST_P(Triangles, AreOnTheSideOnWhichTheMachineIsAssembled) {
  const Mechanism m = mechanism();
  const Assembly<double> assembly(m);
  std::vector<std::string> outputs;
  for (const Mechanism::Moved& moved : m.moved())
    for (const std::string& name : places(moved.frame)) outputs.push_back(name);
  const Program g = recordOutputs(m, {}, outputs);
  std::vector<double> x = assembly.initialState();
  const std::vector<std::string> names = m.stateNames();
  for (std::size_t i = 0; i < x.size(); ++i)  // differences
    if (m.coordinates().find(names[i]) != nullptr && m.coordinates().find(names[i])->isDependent) x[i] = 0;
  const std::vector<double> y = Evaluator<double>(g)(0.0, x);
  for (std::size_t i = 0; i < outputs.size(); ++i) EXPECT_NEAR(y[i], assembly.output(outputs[i]), 1e-12) << outputs[i];
}

/// What a machine does is the same by whichever way its loop is closed.
TEST_P(Triangles, MoveAsStatesThatCloseTheLoopDo) {
  const Mechanism m = mechanism();
  Evaluator<double> sparse(recordMotion(m, {}, Formulation::sparse)),
      articulated(recordMotion(m, {}, Formulation::articulated));
  Assembly<double> assembly(m);
  std::vector<double> x = assembly.initialState();
  assembly.setState(x);
  const std::vector<double> truth = assembly.rates();
  const std::vector<std::string> names = m.stateNames();
  for (std::size_t i = 0; i < x.size(); ++i)
    if (m.coordinates().find(names[i]) != nullptr && m.coordinates().find(names[i])->isDependent) x[i] = 0;
  for (Evaluator<double>* each : {&sparse, &articulated}) {
    const std::vector<double> rates = (*each)(0.0, x);
    for (std::size_t i = 0; i < rates.size(); ++i)
      EXPECT_NEAR(rates[i], truth[i], 1e-11 * (1 + std::abs(truth[i]))) << names[i];
  }
}

INSTANTIATE_TEST_SUITE_P(Machines, Triangles,
                         ::testing::Combine(::testing::Range<std::size_t>(0, 7), ::testing::Bool(), ::testing::Bool()));

/// A loop in space has no such form: it stands where its states say.
TEST(Triangle, IsNotWhatIsNotKnownToBeInAPlane) {
  Crank c(false);
  c.m.add(Link{"askew", "pin", "askew_pin", {0.0, 0.0, 0.0}, {{axisX, 0, 0.1}}});
  c.hinge("coupler", "askew_pin", -0.5);
  c.hinge("rocker", "far", 1.6);
  c.close("rocker_frame", "coupler_frame", {0.6, 0.0, 0.0}, {0.8, 0.0, 0.0}, {"coupler", "rocker"});
  EXPECT_FALSE(isIdentical(rowsOf(c.m, true), rowsOf(machines()[0].made(false, axisZ), true)));
  std::vector<double> x = Assembly<double>(c.m).initialState();
  x[1] = 0.1;  // a difference
  x[2] = 0.1;
  EXPECT_GT(std::abs(Evaluator<double>(rowsOf(c.m, true))(0.0, x)[0]), 1e-3);
}

}  // namespace
}  // namespace gamut::triangles
