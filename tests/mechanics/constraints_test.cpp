// Machines whose loops are closed by rows, against the same machines in coordinates that need none, and against laws.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "machines.hpp"
#include "mechanics/any_scalar.hpp"
#include "mechanics/bodies.hpp"
#include "mechanics/equations/system.hpp"
#include "mechanics/joints.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/recorded.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut {
namespace {

/// A rod without mass between the origins of two frames: g = ½ (|x|² − l²).
template <class S>
class HeldRod final : public Constraint<S> {
 public:
  HeldRod(Frame<S>& from, Frame<S>& to, S length, S stabilisation = S(0.0))
      : Constraint<S>(std::move(stabilisation)), from_(from), to_(to), length_(std::move(length)) {}

  std::vector<S> allResiduals() const override {
    const Vector3<S> x = chord();
    return {S(0.5) * (x.dot(x) - square(length_))};
  }
  std::vector<S> allRates() const override { return {chord().dot(velocity())}; }
  std::vector<S> allAccelerations(MotionLevel level) const override {
    const S linear = chord().dot(to_.R * to_.a - from_.R * from_.a);
    if (level == MotionLevel::acceleration) return {linear};
    const Vector3<S> v = velocity();
    return {linear + v.dot(v)};
  }
  std::vector<std::string> rowNames() const override { return {"length"}; }

 private:
  Vector3<S> chord() const { return to_.positionInInertial() - from_.positionInInertial(); }
  Vector3<S> velocity() const { return to_.velocityInInertial() - from_.velocityInInertial(); }
  void applyForce() override {
    const Vector3<S> force = chord() * this->multipliers().front();
    to_.f += to_.R.transpose() * force;
    from_.f -= from_.R.transpose() * force;
  }

  Frame<S>& from_;
  Frame<S>& to_;
  S length_;
};

/// A point on two slides, held by a rod: a pendulum without an angle.
template <class S>
struct SlidingPendulum {
  explicit SlidingPendulum(S sigma = S(0.0)) : rod(base, tip, S(2.0), std::move(sigma)) {
    chain << across << down << bob << rod;
  }

  Frame<S> base, carried, tip;
  Variable<S> y, z;
  PrismaticJoint<S> across{base, carried, y, axisY}, down{carried, tip, z, axisZ};
  MassElement<S> bob{tip, S(1.5)};
  HeldRod<S> rod;
  Chain<S> chain;
  std::array<Variable<S>*, 2> variables{&y, &z};
  System<S> system{{y, z}, chain, base, {S(0.0), S(0.0), S(-10.0)}};
};

/// Two arms that hang from the base, their tips coupled by a rod: a linkage of four bars.
template <class S>
struct FourBar {
  explicit FourBar(S sigma = S(0.0)) : rod(end1, end2, S(1.25), std::move(sigma)) {
    chain << hinge1 << arm1 << body1 << seat << hinge2 << arm2 << body2 << rod;
  }

  Frame<S> base, turned1, end1, aside, turned2, end2;
  Variable<S> one, other;
  RevoluteJoint<S> hinge1{base, turned1, one, axisX};
  RigidLink<S> arm1{turned1, end1, {S(0.0), S(0.0), S(-0.5)}};
  MassElement<S> body1{end1, S(2.0)};
  RigidLink<S> seat{base, aside, {S(0.0), S(1.0), S(0.25)}};
  RevoluteJoint<S> hinge2{aside, turned2, other, axisX};
  RigidLink<S> arm2{turned2, end2, {S(0.0), S(0.0), S(-0.75)}};
  MassElement<S> body2{end2, S(0.75), {S(0.0), S(0.1), S(0.3)}};
  HeldRod<S> rod;
  Chain<S> chain;
  std::array<Variable<S>*, 2> variables{&one, &other};
  System<S> system{{one, other}, chain, base, {S(0.0), S(0.0), S(-10.0)}};
};

/// u̇ at x = [q; q̇].
template <template <class> class Machine, class S>
std::vector<S> accelerationsOf(Machine<S>& machine, const std::vector<S>& x) {
  for (std::size_t i = 0; i < 2; ++i) {
    machine.variables[i]->position = x[i];
    machine.variables[i]->rate = x[2 + i];
  }
  return machine.system.accelerations();
}

/// θ̈ = −g/l sin θ, and the rod pulls by m (g cos θ + l θ̇²).
TEST(Constraints, MakeAPendulumOfAPointOnTwoSlides) {
  for (const double angle : {0.0, 0.5, 1.57, 3.0, -2.0})
    for (const double rate : {0.0, 1.5, -4.0}) {
      const double s = std::sin(angle), c = std::cos(angle), turning = -10.0 / 2 * s;
      SlidingPendulum<double> pendulum;
      const std::vector<double> found = accelerationsOf(pendulum, {2 * s, -2 * c, 2 * c * rate, 2 * s * rate});
      EXPECT_NEAR(found[0], 2 * (c * turning - s * rate * rate), 1e-12);
      EXPECT_NEAR(found[1], 2 * (s * turning + c * rate * rate), 1e-12);
      EXPECT_NEAR(-2 * pendulum.rod.multipliers().front(), 1.5 * (10 * c + 2 * rate * rate), 1e-12);
    }
}

/// No force remains, the rows stay as they are asked to, whether the start is closed or not.
TEST(Constraints, HoldALinkageByForcesThatBalance) {
  testing::RandomStates states;
  for (const double sigma : {0.0, 3.0})
    for (int i = 0; i < 50; ++i) {
      FourBar<double> bars(sigma);
      accelerationsOf(bars, states(4, 1.5));
      const double g = bars.rod.residuals()[0], rate = bars.rod.rates()[0];
      EXPECT_NEAR(bars.rod.accelerations(MotionLevel::all)[0], -2 * sigma * rate - sigma * sigma * g, 1e-10);
      bars.system.doForce();
      for (const double force : bars.system.generalisedForces()) EXPECT_NEAR(force, 0, 1e-9);
    }
}

/// The rod does no work: with ġ = 0, dE/dt = 0, by central differences along the motion.
TEST(Constraints, DoNoWork) {
  testing::RandomStates states;
  for (int i = 0; i < 50; ++i) {
    FourBar<testing::HighPrecision> bars;
    using Number = testing::HighPrecision;
    std::vector<Number> x;
    for (const double number : states(4, 1.5)) x.emplace_back(number);
    // The rates along the rows: ġ is linear in them.
    std::array<Number, 2> opening;
    for (std::size_t j = 0; j < 2; ++j) {
      x[2] = j == 0 ? 1 : 0;
      x[3] = j == 0 ? 0 : 1;
      accelerationsOf(bars, x);
      opening[j] = bars.rod.rates()[0];
    }
    x[2] = -opening[1];
    x[3] = opening[0];
    const std::vector<Number> u = accelerationsOf(bars, x);
    const Number h("1e-12");
    const auto energyAfter = [&](const Number& step) {
      accelerationsOf(bars, std::vector<Number>{x[0] + step * x[2] + step * step * u[0] / 2,
                                                x[1] + step * x[3] + step * step * u[1] / 2, x[2] + step * u[0],
                                                x[3] + step * u[1]});
      return bars.system.energy();
    };
    EXPECT_LE(abs(Number((energyAfter(h) - energyAfter(-h)) / (2 * h))), Number("1e-18"));
  }
}

TEST(Constraints, AreTheSameInEveryScalar) {
  const Program program = record(4, 0, [](auto, const auto& x, const auto&, auto& dx) {
    FourBar<Recorded> bars(Recorded(2.0));
    const std::vector<Recorded> u = accelerationsOf(bars, std::vector<Recorded>(x.begin(), x.end()));
    for (std::size_t i = 0; i < 2; ++i) {
      dx[i] = x[2 + i];
      dx[2 + i] = u[i];
    }
  });
  Evaluator<double> recorded(program);
  Evaluator<Interval> enclosed(program);
  testing::RandomStates states;
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> x = states(4, 1.2);
    FourBar<testing::HighPrecision> exact(2);
    FourBar<Interval> boxed(Interval(2.0));
    const auto truth = accelerationsOf(exact, std::vector<testing::HighPrecision>(x.begin(), x.end()));
    const auto box = accelerationsOf(boxed, std::vector<Interval>(x.begin(), x.end()));
    const std::vector<double> rates = recorded(0.0, x);
    const std::vector<Interval> proved = enclosed(0.0, std::vector<Interval>(x.begin(), x.end()));
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_NEAR(rates[2 + j], static_cast<double>(truth[j]), 1e-10 * (1 + std::abs(rates[2 + j])));
      EXPECT_TRUE(testing::HighPrecision(box[j].lower()) <= truth[j] &&
                  truth[j] <= testing::HighPrecision(box[j].upper()));
      EXPECT_TRUE(testing::HighPrecision(proved[2 + j].lower()) <= truth[j] &&
                  truth[j] <= testing::HighPrecision(proved[2 + j].upper()));
    }
  }
}

}  // namespace
}  // namespace gamut
