// Rigid stops: unfolded motions against the machine's own equations, and Newton's law of impact at the end.
#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <optional>

#include "machines.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using Row = std::vector<double>;

constexpr double restitution = 0.6;

/// The spatial arm, whose hip starts at -0.7 rad with this rate and strikes an end of its travel.
struct StoppedArm {
  StoppedArm(bool isUpper, double rate) : free(testing::spatialArm(0.3, rate)), at(isUpper ? 0.25 : -1.0) {
    mechanism = free;
    mechanism.add(RigidStop{"wall", "hip", at, restitution, isUpper ? "upper" : "lower"});
    states.emplace(recordOutputs(mechanism, {}, mechanism.stateNames()));
    f.emplace(recordMotion(mechanism));
  }
  /// The machine's states of unfolded ones.
  Row statesOf(const Row& x) { return (*states)(0.0, x); }

  static constexpr std::size_t position = 1, speed = 5, positions = 4, all = 8;
  Mechanism free, mechanism;
  double at;
  std::optional<Evaluator<double>> states, f;
};

/// All four ways in which a motion goes to an end or away from it, on either side of it.
template <class Test>
void inAllRegions(Test test) {
  testing::RandomStates random;
  for (const bool isUpper : {false, true})
    for (const double rate : {-1.1, 1.1}) {
      StoppedArm arm(isUpper, rate);
      for (const double side : {-1.0, 1.0})
        for (const double way : {-1.0, 1.0}) {
          Row x = random(StoppedArm::all, 0.8);
          x[StoppedArm::position] = arm.at + side * (0.2 + std::abs(x[StoppedArm::position]));
          x[StoppedArm::speed] = way * (0.2 + std::abs(x[StoppedArm::speed]));
          test(arm, x);
        }
    }
}

TEST(RigidStop, LetsTheMachineMoveAsItDoesWithoutIt) {
  inAllRegions([](StoppedArm& arm, const Row& x) {
    const Row machine = arm.statesOf(x);
    EXPECT_EQ(machine[StoppedArm::position] > arm.at, arm.at < 0) << "it stays inside";
    const Row rates = (*arm.f)(0.0, x);
    Row ahead = x, behind = x;
    constexpr double h = 1e-4;
    for (std::size_t i = 0; i < x.size(); ++i) ahead[i] += h * rates[i], behind[i] -= h * rates[i];
    const Row after = arm.statesOf(ahead), before = arm.statesOf(behind);
    Assembly<double> free(arm.free);
    free.setState(machine);
    const Row expected = free.rates();
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_NEAR((after[i] - before[i]) / (2 * h), expected[i], 2e-6 * (1 + std::abs(expected[i]))) << i;
  });
}

TEST(RigidStop, StartsAsTheMachineDoes) {
  for (const bool isUpper : {false, true})
    for (const double rate : {-1.1, 0.0, 1.1}) {
      StoppedArm arm(isUpper, rate);
      const Row start = Assembly<double>(arm.free).initialState(), found = arm.statesOf(start);
      for (std::size_t i = 0; i < start.size(); ++i) EXPECT_NEAR(found[i], start[i], 1e-15) << i;
    }
}

/// u⁺ = −e u⁻, and an impulse M (u⁺ − u⁻) at the joint alone.
TEST(RigidStop, IsStruckByNewtonsLaw) {
  inAllRegions([](StoppedArm& arm, Row x) {
    x[StoppedArm::position] = arm.at;
    const double towards = x[StoppedArm::speed] > 0 ? 1e-12 : -1e-12;
    Row behind = x;
    x[StoppedArm::position] -= towards;
    behind[StoppedArm::position] += towards;
    const Row first = arm.statesOf(x), then = arm.statesOf(behind);
    EXPECT_NEAR(then[StoppedArm::speed], -restitution * first[StoppedArm::speed], 1e-12);
    for (std::size_t i = 0; i < StoppedArm::positions; ++i) EXPECT_NEAR(first[i], then[i], 1e-11);
    Assembly<double> free(arm.free);
    free.setState(first);
    const auto m = free.system().inertiaMatrix();
    Eigen::VectorXd change(4);
    for (Eigen::Index i = 0; i < 4; ++i)
      change[i] = then[4 + static_cast<std::size_t>(i)] - first[4 + static_cast<std::size_t>(i)];
    const Eigen::VectorXd impulse = m * change;
    for (Eigen::Index i = 0; i < 4; ++i)
      if (i == 1)
        EXPECT_GT(impulse[i] * (arm.at < 0 ? 1 : -1), 1e-3);
      else
        EXPECT_NEAR(impulse[i], 0, 1e-10);
  });
}

TEST(RigidStop, DoesNothingWhereTheJointTurnsRound) {
  inAllRegions([](StoppedArm& arm, Row x) {
    x[StoppedArm::speed] = 1e-13;
    Row back = x;
    back[StoppedArm::speed] = -1e-13;
    const Row one = arm.statesOf(x), other = arm.statesOf(back);
    for (std::size_t i = 0; i < StoppedArm::all; ++i) EXPECT_NEAR(one[i], other[i], 1e-12);
  });
}

std::string refusalOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(RigidStop, SaysWhatItCannotBe) {
  const auto with = [](const RigidStop& stop) {
    Mechanism m = testing::spatialArm();
    m.add(stop);
    return refusalOf([&] { m.check(); });
  };
  EXPECT_EQ(with({"wall", "hip", -1.0, 1.0}), "none");
  EXPECT_THAT(with({"wall", "hip", -1.0, 0.0}), HasSubstr("the restitution of 'wall' is not above 0 and at most 1"));
  EXPECT_THAT(with({"wall", "hip", -1.0, 1.01}), HasSubstr("the restitution"));
  EXPECT_THAT(refusalOf([&] { with({"wall", "hip", -1.0, 0.5, "middle"}); }), HasSubstr("is 'middle', not"));
  EXPECT_THAT(with({"wall", "hip", -0.7, 0.5}), HasSubstr("starts at 'wall', or beyond it"));
  EXPECT_THAT(with({"wall", "hip", -1.0, 0.5, "upper"}), HasSubstr("starts at 'wall', or beyond it"));
  Mechanism m = testing::spatialArm();
  m.add(RigidStop{"wall", "hip", -1.0, 0.5});
  EXPECT_THAT(refusalOf([&] { m.add(RigidStop{"other", "hip", 1.0, 0.5, "upper"}); }), HasSubstr("two rigid ends"));
  m.add(RigidStop{"other", "slide", 1.0, 0.5, "upper"});
  EXPECT_THAT(refusalOf([&] { recordMotion(m); }), HasSubstr("which has a rigid end too"));
}

TEST(RigidStop, CannotBeStruckByWhatIsDriven) {
  Mechanism m;
  m.add(Prismatic{"slide", "inertial", "A", axisX});
  m.add(Mass{"body", "A", 1.0});
  m.add(RigidStop{"wall", "slide", -1.0, 0.5});
  EXPECT_THAT(refusalOf([&] {
                m.add(Drive{"cam", "slide", Expression::parse("1 m * sin(t/(1 s))")});
              }),
              HasSubstr("cannot strike 'wall'"));
  Mechanism driven;
  driven.add(Prismatic{"slide", "inertial", "A", axisX});
  driven.add(Drive{"cam", "slide", Expression::parse("1 m * sin(t/(1 s))")});
  EXPECT_THAT(refusalOf([&] { driven.add(RigidStop{"wall", "slide", -1.0, 0.5}); }), HasSubstr("cannot strike 'wall'"));
}

/// Of what holds the joint there, unfolded rates tell otherwise than the machine's.
TEST(RigidStop, IsNotStruckByWhatDryFrictionHolds) {
  const auto with = [](const Described& load) {
    Mechanism m = testing::spatialArm();
    m.add(RigidStop{"wall", "hip", -1.0, 0.5});
    m.add(load);
    return refusalOf([&] { recordMotion(m); });
  };
  EXPECT_THAT(with(JointFriction{"dry", "hip", 0.3}), HasSubstr("something jumps with the sign of 'hip.rate'"));
  EXPECT_THAT(with(JointForce{"relay", "slide", Expression::parse("-2 N*sign(0.3*hip.rate)")}),
              HasSubstr("something jumps with the sign of 'hip.rate'"));
  EXPECT_THAT(with(JointForce{"relay", "slide", Expression::parse("-2 N*sign(hip.rate^3)")}), HasSubstr("hip.rate"));
  EXPECT_EQ(with(JointForce{"slip", "slide", Expression::parse("-2 N*sign(hip.rate - 2*base.rate)")}), "none");
  EXPECT_EQ(with(JointFriction{"dry", "slide", 0.3}), "none");
  EXPECT_EQ(with(SmoothedJointFriction{"dry", "hip", 0.3, 0.0, 0.1}), "none");
  EXPECT_EQ(with(JointForce{"drag", "hip", Expression::parse("-2 N m s^2*hip.rate*abs(hip.rate)")}), "none");
}

/// Two balls side by side have nothing to do with each other.
TEST(RigidStop, MayBeOnJointsThatDoNotMoveEachOther) {
  Mechanism m;
  for (const std::string name : {"a", "b"}) {
    m.add(Prismatic{name, "inertial", name + "Ball", axisZ, 1.0});
    m.add(Mass{name + "Body", name + "Ball", 0.5});
    m.add(RigidStop{name + "Floor", name, 0.0, 0.8});
  }
  m.setGravity({0.0, 0.0, -9.81});
  const Row rates = Evaluator<double>(recordMotion(m))(0.0, Row{-0.5, 0.25, -2.0, 1.0});
  EXPECT_NEAR(rates[0], -1.6, 1e-15);        // -e v: up at 1.6 m/s, mirrored
  EXPECT_NEAR(rates[1], 0.8, 1e-15);         // e v
  EXPECT_NEAR(rates[2], 9.81 / 0.8, 1e-13);  // slower, and mirrored
  EXPECT_NEAR(rates[3], -9.81 / 0.8, 1e-13);
}

}  // namespace
}  // namespace gamut
