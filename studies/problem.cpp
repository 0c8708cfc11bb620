// Slots: state i is number i, free parameter k is number states + k. In kinematics nothing moves by itself: the states
// are given, so they are parameters of a program without states.
#include "studies/problem.hpp"

#include <algorithm>
#include <span>

#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

/// y = g(p): outputs of the assembly at the configuration p (states, then free parameters).
Program recordConfiguration(const Study& study, const Problem& problem) {
  const int numbers = static_cast<int>(problem.box.size()), outputs = static_cast<int>(problem.outputs.size());
  return record(0, numbers, outputs, [&](auto, const auto&, const auto& p, auto& y) {
    const std::span<const Recorded> values(p);
    Assembly<Recorded> assembly(study.mechanism, problem.freeParameters, values.subspan(problem.states));
    assembly.setState(values.first(problem.states));
    for (std::size_t i = 0; i < problem.outputs.size(); ++i) y[i] = assembly.output(problem.outputs[i]);
  });
}

void recordPrograms(const Study& study, Problem& problem) {
  Motion& motion = problem.motion.motion;
  motion.times = study.time;
  if (study.analysis == Study::Analysis::dynamics) {
    motion.f = recordMotion(study.mechanism, problem.freeParameters, Formulation::sparse);
    motion.sampled = recordMotion(study.mechanism, problem.freeParameters, Formulation::articulated);
    motion.g = recordOutputs(study.mechanism, problem.freeParameters, problem.outputs);
  } else {
    motion.f = record(0, static_cast<int>(problem.box.size()), [](auto, const auto&, const auto&, auto&) {});
    motion.g = recordConfiguration(study, problem);
  }
}

}  // namespace

Problem makeProblem(const Study& study) {
  Problem problem;
  const Mechanism& mechanism = study.mechanism;
  const std::vector<std::string> names = mechanism.stateNames();
  problem.states = names.size();
  for (const Expression& initial : mechanism.initialState()) problem.box.push_back(mechanism.rangeOf(initial));
  for (const UncertainQuantity& uncertain : study.uncertain) {
    const auto state = std::find(names.begin(), names.end(), uncertain.quantity);
    problem.motion.uncertain.push_back(uncertain.uncertain);
    if (state != names.end()) {
      problem.motion.slot.push_back(static_cast<int>(state - names.begin()));
    } else {
      problem.motion.slot.push_back(static_cast<int>(problem.box.size()));
      problem.freeParameters.push_back(uncertain.quantity);
      problem.box.push_back(mechanism.nominal(uncertain.quantity));
    }
  }
  for (const Interval& value : problem.box) problem.motion.nominal.push_back(midpoint(value));
  for (std::size_t i = 0; i < study.uncertain.size(); ++i) {
    const auto slot = static_cast<std::size_t>(problem.motion.slot[i]);
    problem.box[slot] = study.uncertain[i].uncertain.range;
    problem.motion.nominal[slot] = study.uncertain[i].uncertain.nominal;
  }
  for (int j = 0; study.fuzzy && j < study.levels; ++j) {
    problem.alpha.push_back(static_cast<double>(j) / (study.levels - 1));
    Box level = problem.box;
    for (std::size_t i = 0; i < study.uncertain.size(); ++i)
      level[static_cast<std::size_t>(problem.motion.slot[i])] =
          study.uncertain[i].uncertain.membership.cut(problem.alpha.back());
    problem.levels.push_back(std::move(level));
  }
  for (const OutputInfo& output : study.outputs) problem.outputs.push_back(output.quantity);
  recordPrograms(study, problem);
  return problem;
}

}  // namespace gamut
