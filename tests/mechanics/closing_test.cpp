// Laws that hold for every way to close a loop: rates are derivatives, what force does is the transposed of what motion
// does, both ends balance.
#include "mechanics/closing.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "machines.hpp"
#include "mechanics/any_scalar.hpp"
#include "mechanics/equations/system.hpp"
#include "mechanics/joints.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut {
namespace {

using Number = testing::HighPrecision;

/// Two frames that each move and turn in three ways, and one constraint between them.
struct TwoFrames {
  using Made = std::function<std::unique_ptr<Constraint<Number>>(CarriedPoint<Number>, CarriedPoint<Number>)>;

  explicit TwoFrames(const Made& make) {
    for (Frame<Number>** end : {&one, &other}) {
      Frame<Number>* at = &base;
      for (const Axis& axis : {axisX, axisY, axisZ}) {
        at = &join<PrismaticJoint<Number>>(*at, axis);
        at = &join<RevoluteJoint<Number>>(*at, axis);
      }
      *end = at;
    }
    constraint =
        make({one, {Number("0.3"), Number("-0.2"), Number("0.7")}}, {other, {Number("-0.4"), Number("0.1"), 1}});
    for (auto& joint : joints) chain << *joint;
    chain << *constraint;
    for (Variable<Number>& variable : variables) speeds.emplace_back(variable);
    system = std::make_unique<System<Number>>(speeds, chain, base, Vector3<Number>(0, 0, 0));
  }

  template <class Joint>
  Frame<Number>& join(Frame<Number>& from, const Axis& axis) {
    Frame<Number>& to = frames.emplace_back();
    joints.push_back(std::make_unique<Joint>(from, to, variables.emplace_back("q"), axis));
    return to;
  }
  /// q, u and u̇ of all joints, after the time `t`: q + u t + u̇ t²/2.
  void move(const std::vector<double>& numbers, const Number& t = 0) {
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const Number q(numbers[3 * i]), u(numbers[3 * i + 1]), a(numbers[3 * i + 2]);
      variables[i].position = q + u * t + a * t * t / 2;
      variables[i].rate = u + a * t;
      variables[i].acceleration = a;
    }
    system->doMotion();
  }

  Frame<Number> base;
  std::deque<Frame<Number>> frames;
  std::deque<Variable<Number>> variables;
  std::vector<std::unique_ptr<Element<Number>>> joints;
  Frame<Number>*one = nullptr, *other = nullptr;
  std::unique_ptr<Constraint<Number>> constraint;
  Chain<Number> chain;
  System<Number>::Speeds speeds;
  std::unique_ptr<System<Number>> system;
};

std::vector<TwoFrames::Made> everyClosing() {
  const Vector3<Number> x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), slanted(Number("0.6"), 0, Number("0.8"));
  using Directions = std::vector<Vector3<Number>>;
  using Angles = std::vector<Closing<Number>::RightAngle>;
  std::vector<TwoFrames::Made> all;
  const auto closing = [&](const Directions& directions, const Angles& angles) {
    all.emplace_back([=](CarriedPoint<Number> from, CarriedPoint<Number> to) {
      return std::make_unique<Closing<Number>>(from, to, directions, angles, axisZ);
    });
  };
  closing({x, y, z}, {});
  closing({x, y, z}, {{x, slanted}, {y, slanted}});
  closing({x, y}, {});
  closing({x, y}, {{x, z}, {y, z}});
  closing({slanted}, {});
  closing({}, {{x, slanted}});
  all.emplace_back([](CarriedPoint<Number> from, CarriedPoint<Number> to) {
    return std::make_unique<Rod<Number>>(from, to, Number("1.7"));
  });
  return all;
}

TEST(Closing, RatesAndAccelerationsAreDerivativesOfTheRows) {
  testing::RandomStates states;
  for (const TwoFrames::Made& made : everyClosing()) {
    TwoFrames frames(made);
    for (int i = 0; i < 5; ++i) {
      const std::vector<double> numbers = states(36, 1.2);
      const Number h("1e-12");
      frames.move(numbers, h);
      const auto after = frames.constraint->residuals(), ratesAfter = frames.constraint->rates();
      frames.move(numbers, -h);
      const auto before = frames.constraint->residuals(), ratesBefore = frames.constraint->rates();
      frames.move(numbers);
      const auto rates = frames.constraint->rates(), second = frames.constraint->accelerations(MotionLevel::all);
      ASSERT_EQ(rates.size(), second.size());
      for (std::size_t row = 0; row < rates.size(); ++row) {
        EXPECT_LE(abs(Number((after[row] - before[row]) / (2 * h) - rates[row])), Number("1e-20"));
        EXPECT_LE(abs(Number((ratesAfter[row] - ratesBefore[row]) / (2 * h) - second[row])), Number("1e-20"));
      }
    }
  }
}

/// Of each multiplier, the generalised force is its row of G, which accelerations are measured by, and rates are of.
TEST(Closing, ForcesAreTheRowsTransposed) {
  testing::RandomStates states;
  for (const TwoFrames::Made& made : everyClosing()) {
    TwoFrames frames(made);
    const std::vector<double> numbers = states(36, 1.2);
    frames.move(numbers);
    const std::size_t rows = frames.constraint->residuals().size();
    for (std::size_t row = 0; row < rows; ++row) {
      std::vector<Number> multipliers(rows, Number(0));
      multipliers[row] = 1;
      frames.move(numbers);
      frames.constraint->setMultipliers(multipliers);
      frames.system->doForce();
      const std::vector<Number> forces = frames.system->generalisedForces();
      for (std::size_t j = 0; j < forces.size(); ++j) {
        for (std::size_t k = 0; k < forces.size(); ++k) frames.variables[k].acceleration = k == j ? 1 : 0;
        frames.system->doMotion(MotionLevel::acceleration);
        const Number entry = frames.constraint->accelerations(MotionLevel::acceleration)[row];
        EXPECT_LE(abs(Number(forces[j] - entry)), Number("1e-40"));
        for (std::size_t k = 0; k < forces.size(); ++k) frames.variables[k].rate = k == j ? 1 : 0;
        frames.system->doMotion();
        EXPECT_LE(abs(Number(frames.constraint->rates()[row] - entry)), Number("1e-40"));
      }
    }
  }
}

}  // namespace
}  // namespace gamut
