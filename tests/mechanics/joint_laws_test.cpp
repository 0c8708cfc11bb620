// Laws of everything that moves a frame by another, of whatever type, alone and in its surroundings: rates are rates of
// what they are said to be of, what power goes in comes out, inertia is handed on as motion and force say, all
// formulations are the same equations, and energy is kept. Numbers of 50 digits evaluate what was recorded, so that
// no mistake hides in rounding. A new type of joint is tested without a line here; its operations are counted by one.
#include <gmock/gmock.h>

#include <map>

#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/program/differentiation.hpp"
#include "tests/mechanics/every_joint.hpp"
#include "tests/mechanics/machines.hpp"
#include "tests/mechanics/toy/parallel_cranks.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut {
namespace {

using testing::Around;
using testing::HighPrecision;

/// Midpoints of enclosed constants, unit axes and lengths among them, are right to the digits of doubles.
const HighPrecision roundingOfConstants("1e-13");

class JointLaws : public ::testing::TestWithParam<std::tuple<Described, Around>> {
 protected:
  const Mechanism machine_ = testing::machineWith(std::get<0>(GetParam()), std::get<1>(GetParam()));
  testing::RandomStates random_;

  std::vector<HighPrecision> state() {
    const std::vector<double> x = testing::statesOf(machine_, random_, 1.2);
    return {x.begin(), x.end()};
  }
  std::vector<HighPrecision> numbers(std::size_t count) {
    const std::vector<double> values = random_(count, 1);
    return {values.begin(), values.end()};
  }
};

/// Σ ∂y/∂x ẋ of each output of a program that does not depend on time.
std::vector<HighPrecision> ratesAlong(const Program& y, const std::vector<HighPrecision>& x,
                                      const std::vector<HighPrecision>& dx) {
  const Program derivatives = forwardDifferentiated(y);
  const std::vector<HighPrecision> all = Evaluator<HighPrecision>(derivatives)(0, x);
  const auto outputs = static_cast<std::size_t>(y.outputs());
  std::vector<HighPrecision> rates(outputs, HighPrecision(0));
  for (std::size_t i = 0; i < outputs; ++i)
    for (std::size_t j = 0; j < x.size(); ++j) rates[i] += all[outputs + i * x.size() + j] * dx[j];
  return rates;
}

/// Velocities are the rates of places, which inFrom carries inwards; accelerations, which doMotion carries outwards,
/// are those of velocities; of points off the joint too, where angular motion is felt.
TEST_P(JointLaws, RatesAreRates) {
  Mechanism m = machine_;
  m.add(Link{"probe", "moved", "probed", {0.3, -0.5, 0.7}});
  const Program motion = recordMotion(m);
  std::vector<std::string> positions, rates;
  for (const std::string frame : {"moved", "probed"})
    for (const std::string component : components)
      for (const auto& [position, rate] :
           {std::pair(".position.", ".velocity."), std::pair(".velocity.", ".acceleration."),
            std::pair(".angular_velocity.", ".angular_acceleration.")}) {
        positions.push_back(frame + position + component);
        rates.push_back(frame + rate + component);
      }
  const Program y = recordOutputs(m, {}, positions), dy = recordOutputs(m, {}, rates);
  for (int round = 0; round < 3; ++round) {
    const std::vector<HighPrecision> x = state(), dx = Evaluator<HighPrecision>(motion)(0, x);
    const std::vector<HighPrecision> found = Evaluator<HighPrecision>(dy)(0, x), expected = ratesAlong(y, x, dx);
    for (std::size_t i = 0; i < rates.size(); ++i)
      EXPECT_LE(abs(found[i] - expected[i]), (1 + abs(expected[i])) * roundingOfConstants) << rates[i];
  }
}

/// What the frames are told by doMotion is what inFrom tells of them, and of axes.
TEST_P(JointLaws, BothWaysTellTheSameMotion) {
  Assembly<double> assembly(machine_);
  const std::vector<double> x = testing::statesOf(machine_, random_, 1.2);
  assembly.setState(x);
  for (const std::string& name : machine_.frames()) {
    const Frame<double>& frame = assembly.frame(name);
    const MovingPoint<double> origin = frame.inInertial({});
    TurningAxes<double> axes;
    for (const Frame<double>* k = &frame; k->origin != nullptr; k = &k->origin->from())
      axes = k->origin->axesInFrom(axes);
    EXPECT_LE((origin.position - frame.R * frame.r).norm(), 1e-13) << name;
    EXPECT_LE((origin.velocity - frame.R * frame.v).norm(), 1e-13) << name;
    EXPECT_LE((axes.axes - frame.R).norm(), 1e-13) << name;
    EXPECT_LE((axes.omega - frame.R * frame.omega).norm(), 1e-13) << name;
  }
}

/// Forces and moments on all frames, Σ f·v + τ·ω, against the generalised forces that they become, Σ Q u.
TEST_P(JointLaws, PassPowerOn) {
  const auto states = static_cast<int>(machine_.stateNames().size());
  constexpr int forces = 6 * 24;
  const Program powers = record(states, forces, 2, [&](auto t, const auto& x, const auto& p, auto& y) {
    Assembly<Recorded> assembly(machine_);
    assembly.setState(x, t);
    const std::vector<Element<Recorded>*>& elements = assembly.system().chain().elements();
    for (Element<Recorded>* element : elements) element->clearForces();
    for (Speed<Recorded>& speed : assembly.system().speeds()) speed.force = Recorded(0.0);
    std::size_t next = 0;
    for (Element<Recorded>* element : elements)
      if (auto* transmission = dynamic_cast<Transmission<Recorded>*>(element)) {
        Frame<Recorded>& k = transmission->to();
        for (Vector3<Recorded>* load : {&k.f, &k.tau})
          for (int i = 0; i < 3; ++i) (*load)[i] = p[next++];
        y[0] = y[0] + k.f.dot(k.v) + k.tau.dot(k.omega);
      }
    ASSERT_LE(next, static_cast<std::size_t>(forces));
    for (auto element = elements.rbegin(); element != elements.rend(); ++element)
      if (dynamic_cast<Inertia<Recorded>*>(*element) == nullptr) (*element)->doForce();
    for (const Speed<Recorded>& speed : assembly.system().speeds()) y[1] = y[1] + speed.force * speed.rate;
  });
  Evaluator<HighPrecision> evaluate(powers);
  for (int round = 0; round < 3; ++round) {
    evaluate.setParameters(numbers(forces));
    const std::vector<HighPrecision> power = evaluate(0, state());
    EXPECT_NE(power[0], 0);
    EXPECT_LE(abs(power[0] - power[1]), (1 + abs(power[0])) * roundingOfConstants);
  }
}

/// inFrom of an inertia is Xᵀ M X of what doMotion does at unit accelerations.
TEST_P(JointLaws, HandInertiaOn) {
  const auto states = static_cast<int>(machine_.stateNames().size());
  const std::vector<double> entries = random_(21, 1);
  std::vector<std::string> names;
  std::size_t count = 0;
  const Program differences = record(states, 0, 24 * 27, [&](auto t, const auto& x, const auto&, auto& y) {
    Assembly<Recorded> assembly(machine_);
    assembly.setState(x, t);
    SpatialInertia<Recorded> m;
    auto entry = entries.begin();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        m.coupling(i, j) = Recorded(*entry++);
        if (j > i) continue;
        m.angular(i, j) = m.angular(j, i) = Recorded(*entry++);
        m.linear(i, j) = m.linear(j, i) = Recorded(*entry++);
      }
    for (Element<Recorded>* element : assembly.system().chain().elements())
      if (auto* joint = dynamic_cast<Transmission<Recorded>*>(element)) {
        const SpatialInertia<Recorded> own = joint->inFrom(m), general = joint->Transmission<Recorded>::inFrom(m);
        for (const auto part : {&SpatialInertia<Recorded>::angular, &SpatialInertia<Recorded>::coupling,
                                &SpatialInertia<Recorded>::linear})
          for (int i = 0; i < 9; ++i) y[count++] = (own.*part)(i / 3, i % 3) - (general.*part)(i / 3, i % 3);
      }
  });
  ASSERT_GE(count, 27U);
  for (const HighPrecision& difference : Evaluator<HighPrecision>(differences)(0, state()))
    EXPECT_LE(abs(difference), roundingOfConstants);
}

/// Cut at the joints, joint by joint, and by the inertia matrix.
TEST_P(JointLaws, HaveOneAcceleration) {
  const Program sparse = recordMotion(machine_, {}, Formulation::sparse),
                articulated = recordMotion(machine_, {}, Formulation::articulated);
  const auto speeds = static_cast<std::size_t>(machine_.degreesOfFreedom()), positions = machine_.positions();
  for (int round = 0; round < 3; ++round) {
    const std::vector<HighPrecision> x = state(), a = Evaluator<HighPrecision>(sparse)(0, x),
                                     b = Evaluator<HighPrecision>(articulated)(0, x);
    HighPrecision largest(0);
    for (std::size_t i = 0; i < speeds; ++i) largest = std::max(largest, HighPrecision(abs(a[positions + i])));
    for (std::size_t i = 0; i < speeds; ++i)
      EXPECT_LE(abs(a[positions + i] - b[positions + i]), largest * HighPrecision("1e-38")) << i;

    Assembly<double> assembly(machine_);
    std::vector<double> state;
    for (const HighPrecision& value : x) state.push_back(value.convert_to<double>());
    assembly.setState(state);
    const std::vector<double> residual = assembly.system().residual();
    const auto matrix = assembly.system().inertiaMatrix();
    for (std::size_t i = 0; i < speeds; ++i) {
      double left = 0, size = 1e-3;
      for (std::size_t j = 0; j < speeds; ++j) {
        const double term =
            matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * a[positions + j].convert_to<double>();
        left += term;
        size += std::abs(term);
      }
      EXPECT_NEAR(left, residual[i], 1e-12 * size) << i;
    }
  }
}

TEST_P(JointLaws, KeepTheEnergy) {
  const Program motion = recordMotion(machine_), energy = recordOutputs(machine_, {}, {"energy"});
  for (int round = 0; round < 3; ++round) {
    const std::vector<HighPrecision> x = state(), dx = Evaluator<HighPrecision>(motion)(0, x);
    EXPECT_LE(abs(ratesAlong(energy, x, dx)[0]), 100 * roundingOfConstants);
  }
}

/// Those of the library, and one whose motion changes with its position.
std::vector<Described> allJoints() {
  std::vector<Described> types = elementTypes();
  types.emplace_back(testing::ParallelCranks{});
  return testing::jointTypes(types);
}

std::string nameOfLaw(const ::testing::TestParamInfo<std::tuple<Described, Around>>& law) {
  std::string name = std::get<0>(law.param).type() + testing::nameOf(std::get<1>(law.param));
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Of, JointLaws,
                         ::testing::Combine(::testing::ValuesIn(allJoints()),
                                            ::testing::ValuesIn(testing::everySurrounding)),
                         nameOfLaw);

/// Operations of the recorded motion of every joint: cut at the joints, and joint by joint. They may fall.
TEST(JointOperations, DoNotGrow) {
  const std::map<std::string, std::pair<int, int>> most = {
      {"revoluteFixed", {326, 326}},
      {"revoluteFree", {10751, 1864}},
      {"revoluteSymmetric", {2542, 502}},
      {"prismaticFixed", {50, 50}},
      {"prismaticFree", {10724, 1597}},
      {"prismaticSymmetric", {2731, 939}},
      {"screwFixed", {326, 326}},
      {"screwFree", {11133, 2072}},
      {"screwSymmetric", {3128, 1468}},
      {"cylindricalFixed", {2525, 671}},
      {"cylindricalFree", {15194, 2137}},
      {"cylindricalSymmetric", {2594, 978}},
      {"universalFixed", {2456, 751}},
      {"universalFree", {15212, 2368}},
      {"universalSymmetric", {2606, 1047}},
      {"planarFixed", {700, 247}},
      {"planarFree", {8968, 1559}},
      {"planarSymmetric", {1617, 764}},
      {"sphericalFixed", {1743, 504}},
      {"sphericalFree", {6830, 1560}},
      {"sphericalSymmetric", {1838, 858}},
      {"skateFixed", {299, 218}},
      {"skateFree", {8525, 1629}},
      {"skateSymmetric", {2021, 905}},
      {"rolling-wheelFixed", {4798, 843}},
      {"rolling-wheelFree", {14149, 3324}},
      {"rolling-wheelSymmetric", {4661, 1676}},
      {"rolling-ballFixed", {2425, 922}},
      {"rolling-ballFree", {8279, 2263}},
      {"rolling-ballSymmetric", {1721, 917}},
      {"freeFixed", {3524, 798}},
      {"freeFree", {4523, 1626}},
      {"freeSymmetric", {1252, 950}},
      {"weldFixed", {8, 8}},
      {"weldFree", {4011, 1663}},
      {"weldSymmetric", {922, 450}},
      {"playFixed", {8, 8}},
      {"playFree", {3942, 1456}},
      {"playSymmetric", {964, 490}},
      {"guide-playFixed", {8, 8}},
      {"guide-playFree", {3961, 1475}},
      {"guide-playSymmetric", {944, 472}},
      {"linkFixed", {8, 8}},
      {"linkFree", {4074, 1798}},
      {"linkSymmetric", {991, 519}},
  };
  for (const Described& type : testing::jointTypes())
    for (const Around around : testing::everySurrounding) {
      const std::string name = type.type() + testing::nameOf(around);
      ASSERT_TRUE(most.contains(name)) << name;
      const Mechanism machine = testing::machineWith(type, around);
      EXPECT_LE(recordMotion(machine, {}, Formulation::sparse).operations(), most.at(name).first) << name;
      EXPECT_LE(recordMotion(machine, {}, Formulation::articulated).operations(), most.at(name).second) << name;
    }
}

}  // namespace
}  // namespace gamut
