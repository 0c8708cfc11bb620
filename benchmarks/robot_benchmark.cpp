// Forward dynamics of robots, as samples are integrated: one sample at a time, and in packs with each vector unit.
// Times are for one sample; the label says how many operations and instructions it takes. Robots are those whose URDF
// files the command line names, fixed to the ground, and a floating humanoid of 29 joints with numbers of own making.
// Torques of the joints are parameters.
//
//     robot_benchmark arm.urdf --benchmark_repetitions=9
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/revolute_chain.hpp"
#include "mechanics/elements/all.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/evaluation/sample_pack.hpp"
#include "studies/robots/robot.hpp"
#include "studies/robots/robot_elements.hpp"

namespace gamut::benchmarks {
namespace {

/// URDF: a trunk with two legs of six joints, a waist of three and two arms of seven, with a head and hands that are
/// welded on; no number is that of another's robot.
std::string humanoidText() {
  std::string text = "<robot name=\"humanoid\">";
  int bodies = 0;
  const auto addLink = [&](const std::string& name, double mass) {
    const double k = 0.01 * (1 + bodies++ % 5), r = mass * 0.004;
    text += fmt::format(
        "<link name=\"{}\"><inertial><mass value=\"{}\"/><origin xyz=\"{} {} {}\"/>"
        "<inertia ixx=\"{}\" iyy=\"{}\" izz=\"{}\" ixy=\"{}\" iyz=\"{}\" ixz=\"{}\"/></inertial></link>",
        name, mass, 0.3 * k, -0.2 * k, -1.1 * k, r, 0.9 * r, 0.6 * r, 0.02 * r, -0.05 * r, 0.03 * r);
  };
  const auto add = [&](const std::string& name, const std::string& parent, const char* axis, double mass,
                       const std::string& xyz, const std::string& rpy = "0 0 0") {
    addLink(name, mass);
    text += fmt::format(
        "<joint name=\"{0}_joint\" type=\"{1}\"><parent link=\"{2}\"/><child link=\"{0}\"/>"
        "<origin xyz=\"{3}\" rpy=\"{4}\"/><axis xyz=\"{5}\"/></joint>",
        name, *axis == '\0' ? "fixed" : "continuous", parent, xyz, rpy, *axis == '\0' ? "1 0 0" : axis);
  };
  const char *const x = "1 0 0", *const y = "0 1 0", *const z = "0 0 1", *const fixed = "";
  addLink("pelvis", 4.1);
  for (const std::string side : {"left_", "right_"}) {
    const double s = side == "left_" ? 1 : -1;
    add(side + "hip_pitch", "pelvis", y, 1.3, fmt::format("0.01 {} -0.1", 0.07 * s));
    add(side + "hip_roll", side + "hip_pitch", x, 1.6, fmt::format("0.0 {} -0.03", 0.05 * s), "0 -0.15 0");
    add(side + "hip_yaw", side + "hip_roll", z, 1.8, fmt::format("0.02 {} -0.12", 0.001 * s));
    add(side + "knee", side + "hip_yaw", y, 2.1, fmt::format("-0.08 {} -0.18", 0.002 * s), "0 0.15 0");
    add(side + "ankle_pitch", side + "knee", y, 0.1, fmt::format("0.001 {} -0.31", 0.001 * s));
    add(side + "ankle_roll", side + "ankle_pitch", x, 0.6, "0.001 0.0 -0.02");
  }
  add("waist_yaw", "pelvis", z, 0.3, "-0.004 0.0 0.05");
  add("waist_roll", "waist_yaw", x, 0.1, "-0.003 0.001 0.04");
  add("torso", "waist_roll", y, 7.2, "0.001 0.002 0.02");
  add("head", "torso", fixed, 1.1, "0.004 0.0 0.4");
  for (const std::string side : {"left_", "right_"}) {
    const double s = side == "left_" ? 1 : -1;
    add(side + "shoulder_pitch", "torso", y, 0.7, fmt::format("0.004 {} 0.25", 0.1 * s),
        fmt::format("{} 0.0002 -0.0001", 0.25 * s));
    add(side + "shoulder_roll", side + "shoulder_pitch", x, 0.6, fmt::format("0.001 {} -0.01", 0.04 * s),
        fmt::format("{} 0 0", -0.25 * s));
    add(side + "shoulder_yaw", side + "shoulder_roll", z, 0.7, fmt::format("0.001 {} -0.1", 0.006 * s));
    add(side + "elbow", side + "shoulder_yaw", y, 0.6, "0.016 0.002 -0.08");
    add(side + "wrist_roll", side + "elbow", x, 0.1, fmt::format("0.1 {} -0.01", 0.002 * s));
    add(side + "wrist_pitch", side + "wrist_roll", y, 0.5, "0.04 0.001 0.002");
    add(side + "wrist_yaw", side + "wrist_pitch", z, 0.1, "0.05 0.0 0.001");
    add(side + "hand", side + "wrist_yaw", fixed, 0.2, "0.04 0.003 0.0");
  }
  return text + "</robot>";
}

/// A motion, and how many of its parameters are torques; there are no others.
Program forwardDynamics(const Robot& robot, bool isFree) {
  Mechanism mechanism;
  RobotChoices choices;
  choices.isFree = isFree;
  choices.damping = choices.friction = choices.mimic = false;
  for (RobotElement& element : robotElements(robot, choices, mechanism)) mechanism.add(std::move(element.element));
  mechanism.setGravity({0.0, 0.0, -9.81});
  std::vector<std::string> torques;
  for (const Robot::Joint& joint : robot.joints) {
    if (joint.type == Robot::Type::fixed) continue;
    torques.push_back(joint.name + ".torque");
    mechanism.addParameter(torques.back(), 0.0, "N m");
    mechanism.add(JointForce{joint.name + ".motor", joint.name, Expression::named(torques.back())});
  }
  return recordMotion(mechanism, torques, Formulation::articulated);
}

std::vector<double> randomNumbers(std::size_t n) {
  std::mt19937_64 engine(7);
  std::vector<double> x(n);
  for (double& value : x) value = std::uniform_real_distribution<>(-1.5, 1.5)(engine);
  return x;
}

void one(benchmark::State& state, const Program& program) {
  Evaluator<double> evaluate(program);
  evaluate.setParameters(randomNumbers(static_cast<std::size_t>(program.parameters())));
  const std::size_t n = static_cast<std::size_t>(program.states());
  const std::vector<double> x = randomNumbers(n * 256);
  std::vector<double> y(n);
  std::size_t i = 0;
  for (auto _ : state) {
    evaluate(0.0, std::span<const double>(x).subspan(n * (i++ % 256), n), std::span<double>(y));
    benchmark::DoNotOptimize(y.data());
  }
  const Tape& tape = evaluate.tape();
  state.SetLabel(fmt::format("{} operations, {} instructions, {} slots", tape.operations(), tape.instructions().size(),
                             tape.slots()));
}

/// The baseline: the articulated-body algorithm written for one arm of seven joints with quarter turns, in doubles.
void writtenByHand(benchmark::State& state) {
  const Arm<double> arm = armOf<double>(usualMasses);
  const std::vector<double> numbers = randomNumbers(3 * joints * 256);
  std::size_t i = 0;
  for (auto _ : state) {
    std::array<JointValues<double>, 3> given;  // angles, velocities, torques
    for (JointValues<double>& values : given)
      for (double& value : values) value = numbers[i++ % numbers.size()];
    benchmark::DoNotOptimize(ForwardDynamics<double>::of(arm, given[0], given[1], given[2]));
  }
}

void packs(benchmark::State& state, const Program& program, VectorUnit unit) {
  PackEvaluator evaluate(program, unit);
  evaluate.setParameters(randomNumbers(static_cast<std::size_t>(program.parameters() * packWidth)));
  const std::vector<double> x = randomNumbers(static_cast<std::size_t>(program.states() * packWidth));
  const std::vector<double> t(packWidth, 0.0);
  std::vector<double> y(x.size());
  for (auto _ : state) {
    evaluate(t, x, y);
    benchmark::DoNotOptimize(y.data());
  }
  state.counters["sample"] = benchmark::Counter(static_cast<double>(state.iterations()) * packWidth,
                                                benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void add(const Robot& robot, bool isFree) {
  const Program program = forwardDynamics(robot, isFree);
  benchmark::RegisterBenchmark((robot.name + "/one").c_str(),
                               [program](benchmark::State& state) { one(state, program); });
  for (const VectorUnit unit : usableUnits())
    benchmark::RegisterBenchmark((robot.name + "/packs/" + nameOf(unit)).c_str(),
                                 [program, unit](benchmark::State& state) { packs(state, program, unit); });
}

}  // namespace
}  // namespace gamut::benchmarks

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::RegisterBenchmark("written by hand/one", gamut::benchmarks::writtenByHand);
  try {
    for (int i = 1; i < argc; ++i) {
      std::ifstream file(argv[i]);
      if (!file) throw std::runtime_error(std::string("cannot read ") + argv[i]);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      gamut::benchmarks::add(gamut::readRobotText(text, argv[i]), false);
    }
    gamut::benchmarks::add(gamut::readRobotText(gamut::benchmarks::humanoidText(), "humanoid"), true);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
}
