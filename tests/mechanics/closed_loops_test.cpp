// Machines that close on themselves, against the same by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/equations/loop_rows.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "tests/mechanics/four_bar.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut {
namespace {

using Number = testing::HighPrecision;

using testing::pinned;

testing::FourBarMotion<Number> truth(const Number& angle, const Number& rate) {
  return testing::fourBarByHand<Number>(angle, rate, {Number("0.3"), Number("0.8"), Number("0.6"), Number("0.9")},
                                        [](const char* number) { return Number(number); });
}

/// Positions are found, rates follow, and accelerations are the same in both formulations, which have little in common.
TEST(ClosedLoops, MoveAsAFourBarByHandDoes) {
  const Mechanism m = testing::fourBar(pinned());
  EXPECT_EQ(m.stateNames(), (std::vector<std::string>{"A.angle", "B.angle", "D.angle", "A.rate"}));
  EXPECT_EQ(m.dependents(), (std::vector<std::string>{"B.angle", "D.angle"}));
  Assembly<double> assembly(m);
  std::vector<double> x = assembly.initialState();
  for (const double angle : {1.0, 1.5, 2.5, 4.0, 6.0, 0.0}) {
    for (const double rate : {4.0, 0.0, -9.0}) {
      const auto by = truth(angle, rate);
      const Number cx = by.closing[0] - Number("0.3") * cos(Number(angle)),
                   cy = by.closing[1] - Number("0.3") * sin(Number(angle));
      x = {angle, static_cast<double>(Number(atan2(cy, cx) - angle)),
           static_cast<double>(Number(atan2(by.closing[1], Number(by.closing[0] - Number("0.9"))))), rate};
      for (const Formulation formulation : {Formulation::sparse, Formulation::articulated}) {
        assembly.setState(x);
        const std::vector<double> rates = assembly.rates(formulation);
        EXPECT_NEAR(rates[0], rate, 0);
        EXPECT_NEAR(rates[1], static_cast<double>(by.coupler) - rate, 1e-13 * (1 + std::abs(rate)));
        EXPECT_NEAR(rates[2], static_cast<double>(by.rocker), 1e-13 * (1 + std::abs(rate)));
        EXPECT_NEAR(rates[3], static_cast<double>(by.acceleration), 3e-13 * (1 + std::abs(rates[3])));
      }
    }
  }
}

TEST(ClosedLoops, StartWhereTheyAreClosed) {
  const Assembly<double> assembly(testing::fourBar(pinned()));
  const auto by = truth(1, 4);
  EXPECT_NEAR(assembly.output("C1.position.x"), static_cast<double>(by.closing[0]), 1e-15);
  EXPECT_NEAR(assembly.output("C2.position.y"), static_cast<double>(by.closing[1]), 1e-15);
  EXPECT_NEAR(assembly.output("B.rate"), static_cast<double>(by.coupler) - 4, 1e-13);
}

/// From wherever they are looked for: on one branch or the other, and not turns away.
TEST(ClosedLoops, StartNearWhereTheyAreLookedFor) {
  int closed = 0;
  for (int i = -4; i < 4; ++i)
    for (int j = -4; j < 4; ++j) {
      const std::array<double, 2> guess{0.75 * i, 0.75 * j};
      try {
        const std::vector<double> x = Assembly<double>(testing::fourBar(pinned(), 4, 1, guess)).initialState();
        ++closed;
        EXPECT_LT(std::abs(x[1] - guess[0]), 6.3) << guess[0] << " " << guess[1];
        EXPECT_LT(std::abs(x[2] - guess[1]), 6.3) << guess[0] << " " << guess[1];
      } catch (const UnfitPart&) {
      }
    }
  EXPECT_GE(closed, 56);
}

/// Dry friction in coupler and rocker, of a motion that began where the rocker turned the other way.
TEST(ClosedLoops, RubAlikeHoweverTheyAreHeld) {
  const auto rubbing = [](double angle) {
    Mechanism m = testing::fourBar(pinned(), -3, angle);
    m.add(JointFriction{"onB", "B", 0.5});
    m.add(JointFriction{"onD", "D", 0.7});
    return m;
  };
  Mechanism held = rubbing(1);
  held.holdLoops();
  Assembly<double> byMultipliers(held);
  const double before = byMultipliers.output("D.rate");
  std::vector<double> x;
  Assembly<double> byCrank(rubbing(0));
  for (const std::string& name : held.stateNames()) x.push_back(byCrank.output(name));
  ASSERT_LT(before * byCrank.output("D.rate"), 0);
  byMultipliers.setState(x);
  const std::vector<double> expected = byCrank.accelerations(), found = byMultipliers.accelerations();
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-9 * std::abs(expected[i])) << i;
}

/// Where the crank is driven nothing is left that moves by itself, and positions follow as states.
TEST(ClosedLoops, FollowACrankThatIsDriven) {
  Mechanism m = testing::fourBar(pinned(), 0, 0);
  m.add(Drive{"motor", "A", Expression::parse("1 rad + 4 rad/s*t - 1 rad/s^2*t^2")});
  EXPECT_EQ(m.stateNames(), (std::vector<std::string>{"B.angle", "D.angle"}));
  Assembly<double> assembly(m);
  const auto by = truth(1, 4);
  EXPECT_NEAR(assembly.output("C1.position.x"), static_cast<double>(by.closing[0]), 1e-15);
  for (const Formulation formulation : {Formulation::sparse, Formulation::articulated}) {
    assembly.setState(assembly.initialState());
    const std::vector<double> rates = assembly.rates(formulation);
    ASSERT_EQ(rates.size(), 2U);
    EXPECT_NEAR(rates[0], static_cast<double>(by.coupler) - 4, 1e-13);
    EXPECT_NEAR(rates[1], static_cast<double>(by.rocker), 1e-13);
  }
  // Accelerations by differences along the motion.
  const double h = 1e-5;
  const auto rateAfter = [&](double t) {
    const auto x = truth(Number(1 + 4 * t - t * t), Number(4 - 2 * t));
    return static_cast<double>(x.rocker);
  };
  assembly.setState(assembly.initialState());
  EXPECT_NEAR(assembly.output("D.acceleration"), (rateAfter(h) - rateAfter(-h)) / (2 * h), 1e-7);
}

/// The rocker's moments about its pivot balance.
TEST(ClosedLoops, TellTheForceThatClosesThem) {
  const Assembly<double> assembly(testing::fourBar(pinned()));
  const double psi = assembly.output("D.angle");
  const double onRocker =
      -0.6 * (std::cos(psi) * assembly.output("C.force.y") - std::sin(psi) * assembly.output("C.force.x"));
  EXPECT_NEAR((0.05 + 1.5 * 0.09) * assembly.output("D.acceleration"), onRocker - 1.5 * 9.81 * 0.3 * std::cos(psi),
              1e-12);
  EXPECT_NEAR(assembly.output("C.moment.z"), 0, 0);
  for (const std::string& quantity : testing::fourBar(pinned()).outputQuantities())
    EXPECT_TRUE(std::isfinite(assembly.output(quantity))) << quantity;
}

/// A pendulum of 2 m without an angle, θ = 0.5: the rod pulls by m (g cos θ + l θ̇²).
TEST(ClosedLoops, HoldAPointByARod) {
  Mechanism m;
  m.add(Prismatic{"across", "inertial", "carriage", axisY, 2 * std::sin(0.5), 2 * std::cos(0.5) * 1.5});
  m.add(Prismatic{"down", "carriage", "tip", axisZ, -1.0, 0.0});
  m.add(Mass{"bob", "tip", 1.5});
  RodClosure rod;
  rod.name = "rod";
  rod.from = "inertial";
  rod.to = "tip";
  rod.length = 2.0;
  m.add(rod);
  m.setGravity({0.0, 0.0, -10.0});
  EXPECT_EQ(m.dependents(), (std::vector<std::string>{"down.displacement"}));
  const Assembly<double> assembly(m);
  EXPECT_NEAR(assembly.output("tip.position.z"), -2 * std::cos(0.5), 1e-15);
  EXPECT_NEAR(assembly.output("down.rate"), 2 * std::sin(0.5) * 1.5, 1e-14);
  EXPECT_NEAR(assembly.output("rod.force"), -1.5 * (10 * std::cos(0.5) + 2 * 1.5 * 1.5), 1e-13);
  EXPECT_NEAR(assembly.output("across.acceleration"), 2 * (-std::cos(0.5) * 5 * std::sin(0.5) - std::sin(0.5) * 2.25),
              1e-13);
}

TEST(ClosedLoops, FeelTheInertiaOfAllThatMoves) {
  Assembly<double> assembly(testing::fourBar(pinned()));
  const double energy = assembly.output("energy.kinetic");
  const Eigen::MatrixXd inertia = inertiaAlongLoops(assembly.system());
  ASSERT_EQ(inertia.size(), 1);
  EXPECT_NEAR(inertia(0, 0), 2 * energy / (4 * 4), 1e-13);
}

/// No dead point of coupler and rocker is near.
TEST(ClosedLoops, AreHeldFirmlyByCouplerAndRocker) {
  const Mechanism m = testing::fourBar(pinned());
  Assembly<double> assembly(m);
  const LoopGrip grip = gripOfLoops(m, assembly.system());
  EXPECT_GT(grip.share, 0.5);
  EXPECT_EQ(grip.best.size(), 2U);
}

/// Two pins between the same bars: the second one holds what the first does.
TEST(ClosedLoops, AreRefusedWhereRowsDependOnOthers) {
  Mechanism m = testing::fourBar(pinned(), 0);
  Closure second = pinned();
  second.name = "second";
  second.dependent = {"A"};
  second.as = "plane";
  second.axis = axisX;
  m.add(second);
  EXPECT_THROW(Assembly<double>{m}, UnfitPart);
}

}  // namespace
}  // namespace gamut
