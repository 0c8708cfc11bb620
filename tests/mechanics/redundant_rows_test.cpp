// Linkages that move though they hold more than leaves them free: rows that are said to follow from others are left
// out, and what moves is what is known in closed form.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/elements/all.hpp"

namespace gamut {
namespace redundant_rows {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string refusalOf(const std::function<void()>& what) {
  try {
    what();
  } catch (const Refusal& refusal) {
    return refusal.what();
  }
  return "";
}

constexpr double alpha = 0.6, beta = 1.1;
const double fitting = 0.3 * std::sin(beta) / std::sin(alpha);
const double k = std::sin((alpha + beta) / 2) / std::sin((beta - alpha) / 2);

/// Bennett's linkage, lengths a and b: tan(A/2) tan(B/2) = k, C = −A. Looked for so far `off`.
Mechanism bennett(std::size_t redundant, const Expression& b, double off = 0.1, double rate = 3) {
  Mechanism m;
  const auto arm = [&](const char* name, const char* from, const char* to, const Expression& length, double twist) {
    m.add(Link{name, from, to, {length, 0.0, 0.0}, {{axisX, 0, twist}}});
  };
  m.add(Revolute{"A", "inertial", "K1", axisZ, 1.3, rate});
  m.add(Mass{"crank", "K1", 1.0, {0.0, 0.0, 0.0}, {0.01, 0.01, 0.02, 0.0, 0.0, 0.0}});
  arm("ab", "K1", "P2", 0.3, alpha);
  m.add(Revolute{"B", "P2", "K2", axisZ, 2 * std::atan(k / std::tan(0.65)) - off, 0.0});
  arm("bc", "K2", "P3", b, beta);
  m.add(Revolute{"C", "P3", "K3", axisZ, -1.3 + off, 0.0});
  arm("cd", "K3", "P4", 0.3, alpha);
  m.add(Weld{"twist", "inertial", "G", {{axisX, 0, -beta}}});
  m.add(Link{"ground", "G", "P1", {-b, 0.0, 0.0}});
  Closure hinge;
  hinge.name = "D";
  hinge.from = "P1";
  hinge.to = "P4";
  hinge.as = "hinge";
  hinge.redundant = redundant;
  m.add(hinge);
  return m;
}

TEST(RedundantRows, LeaveBennettsLinkageOneFreedom) {
  const Mechanism m = bennett(3, fitting);
  EXPECT_THAT(m.dependents(), ElementsAre("B.angle", "C.angle"));
  Assembly<double> assembly(m);
  EXPECT_EQ(assembly.assumedRows().size(), 3U);
  EXPECT_EQ(assembly.assumedRows()[0].element, "D");
  EXPECT_NEAR(assembly.output("B.angle"), 2 * std::atan(k / std::tan(0.65)), 1e-13);
  EXPECT_NEAR(assembly.output("C.angle"), -1.3, 1e-13);
  for (const double angle : {0.9, 1.3, 1.8}) {
    const double other = 2 * std::atan(k / std::tan(angle / 2));
    assembly.setState(std::vector<double>{angle, other, -angle, 3.0});
    const double ratio = -2 * k / (1 + k * k + (k * k - 1) * std::cos(angle));
    EXPECT_NEAR(assembly.output("B.rate"), 3 * ratio, 1e-12) << angle;
    EXPECT_NEAR(assembly.output("C.rate"), -3, 1e-12) << angle;
    for (const double row : assembly.assumedResiduals()) EXPECT_NEAR(row, 0, 1e-15) << angle;
    // Only the crank has mass: it turns evenly.
    for (const Formulation formulation : {Formulation::sparse, Formulation::articulated}) {
      assembly.setState(std::vector<double>{angle, other, -angle, 3.0});
      EXPECT_NEAR(assembly.rates(formulation)[3], 0, 1e-12) << angle;
    }
  }
}

TEST(RedundantRows, MustHoldWithAllOthers) {
  EXPECT_THAT(refusalOf([] { Assembly<double>(bennett(3, 1.001 * fitting)); }),
              HasSubstr("the rows of the loop 'D' do not hold together, as `redundant` says"));
}

TEST(RedundantRows, AreAsManyAsFollowFromOthers) {
  EXPECT_THAT(refusalOf([] { Assembly<double>(bennett(4, fitting, 0)); }),
              HasSubstr("of the rows of the loop 'D' 4 do not follow from the others where it starts"));
  EXPECT_THAT(refusalOf([] { bennett(6, fitting); }), HasSubstr("the redundant of 'D' is 6"));
  EXPECT_THAT(refusalOf([] { bennett(0, fitting); }), HasSubstr("`redundant`, how many rows"));
}

/// Three cranks of one length on one coupler.
Mechanism cranks(std::size_t redundant) {
  Mechanism m;
  const auto pin = [&](const char* name, const char* from, const char* to, double along, std::size_t rows) {
    Closure closure;
    closure.name = name;
    closure.from = from;
    closure.to = to;
    closure.as = "pin";
    closure.toPoint = {along, 0.0, 0.0};
    closure.fromPoint = {1.0, 0.0, 0.0};
    closure.redundant = rows;
    return closure;
  };
  m.add(Revolute{"A", "inertial", "K1", axisZ, 1.37, 2.0});
  m.add(Mass{"crank", "K1", 1.0, {0.5, 0.0, 0.0}, {0.1, 0.1, 0.1, 0.0, 0.0, 0.0}});
  m.add(Link{"ab", "K1", "P", {1.0, 0.0, 0.0}});
  m.add(Revolute{"bar", "P", "K2", axisZ, -1.4, 0.0});
  m.add(Link{"other", "inertial", "P2", {1.5, 0.0, 0.0}});
  m.add(Revolute{"B", "P2", "K3", axisZ, 1.4, 0.0});
  m.add(pin("two", "K3", "K2", 1.5, 0));
  m.add(Link{"last", "inertial", "P3", {2.5, 0.0, 0.0}});
  m.add(Revolute{"C", "P3", "K4", axisZ, 1.5, 0.0});
  m.add(pin("three", "K4", "K2", 2.5, redundant));
  return m;
}

TEST(RedundantRows, LeaveAParallelogramItsThirdCrank) {
  const Mechanism m = cranks(1);
  EXPECT_THAT(m.dependents(), ElementsAre("bar.angle", "B.angle", "C.angle"));
  const Assembly<double> assembly(m);
  for (const char* crank : {"B", "C"}) {
    EXPECT_NEAR(assembly.output(std::string(crank) + ".angle"), assembly.output("A.angle"), 1e-13);
    EXPECT_NEAR(assembly.output(std::string(crank) + ".rate"), 2, 1e-12);
  }
  EXPECT_NEAR(assembly.output("bar.rate"), -2, 1e-12);
}

/// A rod that keeps what is kept already has no coordinate at all.
TEST(RedundantRows, MayBeAllOfARod) {
  Mechanism m = cranks(1);
  RodClosure rod;
  rod.name = "rod";
  rod.from = "K1";
  rod.to = "K4";
  rod.fromPoint = rod.toPoint = {0.5, 0.0, 0.0};
  rod.length = 2.5;
  rod.redundant = 1;
  m.add(rod);
  const Assembly<double> assembly(m);
  EXPECT_EQ(assembly.assumedRows().size(), 2U);
  EXPECT_NEAR(assembly.output("C.rate"), 2, 1e-12);
  EXPECT_EQ(assembly.output("rod.force"), 0);
  for (const double row : assembly.assumedResiduals()) EXPECT_NEAR(row, 0, 1e-14);
  const Assembly<Interval> enclosed(m);
  EXPECT_EQ(enclosed.assumedRows().size(), 2U);
}

/// Two pairs of legs at right angles, each of two bars: what they carry moves straight up, by 2 l cos of their lean.
TEST(RedundantRows, LeaveSarrussLinkageItsStraightLine) {
  Mechanism m;
  m.add(Link{"footA", "inertial", "F1", {0.0, -0.2, 0.0}});
  m.add(Revolute{"A", "F1", "K1", axisX, 0.5, 1.0});
  m.add(Link{"lowA", "K1", "E1", {0.0, 0.0, 0.4}});
  m.add(Revolute{"kneeA", "E1", "K2", axisX, -0.9, 0.0});
  m.add(Link{"upA", "K2", "E2", {0.0, 0.0, 0.4}});
  m.add(Revolute{"topA", "E2", "T", axisX, 0.4, 0.0});
  m.add(Mass{"table", "T", 2.0, {0.0, 0.2, 0.0}, {0.1, 0.1, 0.1, 0.0, 0.0, 0.0}});
  m.add(Link{"footB", "inertial", "F2", {0.3, 0.0, 0.0}});
  m.add(Revolute{"B", "F2", "K3", axisY, 0.4, 0.0});
  m.add(Link{"lowB", "K3", "E3", {0.0, 0.0, 0.4}});
  m.add(Revolute{"kneeB", "E3", "K4", axisY, -0.9, 0.0});
  Closure hinge;
  hinge.name = "top";
  hinge.from = "K4";
  hinge.to = "T";
  hinge.fromPoint = {0.0, 0.0, 0.4};
  hinge.toPoint = {0.3, 0.2, 0.0};
  hinge.as = "hinge";
  hinge.axis = hinge.toAxis = axisY;
  hinge.redundant = 1;
  m.add(hinge);
  EXPECT_EQ(m.dependents().size(), 4U);
  Assembly<double> assembly(m);
  EXPECT_NEAR(assembly.output("T.position.z"), 0.8 * std::cos(0.5), 1e-13);
  EXPECT_NEAR(assembly.output("T.velocity.z"), -0.8 * std::sin(0.5), 1e-12);
  EXPECT_NEAR(assembly.output("T.velocity.x"), 0, 1e-12);
  EXPECT_NEAR(assembly.output("T.velocity.y"), 0, 1e-12);
  EXPECT_NEAR(assembly.output("T.angular_velocity.x"), 0, 1e-12);
  EXPECT_NEAR(assembly.output("B.rate"), 1, 1e-12);
  // Weightless, the table goes on as its energy says: m ż²/2.
  EXPECT_NEAR(assembly.output("A.acceleration"), -std::cos(0.5) / std::sin(0.5), 1e-11);
}

}  // namespace
}  // namespace redundant_rows
}  // namespace gamut
