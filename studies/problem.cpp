// Slots: state i is number i, free parameter k is number states + k. In kinematics nothing moves by itself: the states
// are given, so they are parameters of a program without states. A motion that is given as a whole has one state that
// rests, for flow and samples to follow.
#include "studies/problem.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <new>
#include <numbers>
#include <span>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>

#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/recorded.hpp"
#include "studies/watch.hpp"

namespace gamut {
namespace {

/// Those of the uncertain quantities that no state starts with.
std::vector<std::string> freeParameters(const Study& study) {
  const std::vector<std::string> states = study.mechanism.stateNames();
  const std::unordered_set<std::string> isState(states.begin(), states.end());
  std::vector<std::string> names;
  for (const UncertainQuantity& uncertain : study.uncertain)
    if (!isState.contains(uncertain.quantity)) names.push_back(uncertain.quantity);
  return names;
}

/// What varies in time follows a course: swinging once in the study's time at least, and twice as fast as the motion
/// itself, or sixteen times in all, at most.
void takeCourses(const Study& study, Problem& problem) {
  SwitchingCourses& switching = problem.motion.switching;
  for (std::size_t i = 0; i < study.uncertain.size(); ++i) {
    const UncertainQuantity& of = study.uncertain[i];
    if (!of.varies) continue;
    const int parameter = problem.motion.slot[i] - static_cast<int>(problem.states);
    problem.varying.push_back({parameter, of.rate});
    problem.courses.push_back({parameter, of.uncertain.range, of.uncertain.nominal, of.rate});
    switching.quantities.push_back(i);
    switching.rates.push_back(of.rate);
  }
  if (problem.courses.empty()) return;
  problem.slowest = 2 * std::numbers::pi / study.horizon;
  problem.fastest = std::max(16 * problem.slowest, 2 * fastestTurn(study.motion.f, problem.motion.nominal));
  Motion& motion = problem.motion.motion;
  switching.motion = motion;
  for (Program* program : {&motion.f, &motion.g, &motion.sampled})
    if (program->outputs() > 0) *program = alongCourses(problem, *program);
}

/// y = g(p): outputs of the assembly at the configuration p (states, then free parameters).
Program recordConfiguration(const Study& study, std::size_t states, int numbers) {
  const std::vector<Expression> outputs = outputExpressions(study);
  return record(0, numbers, static_cast<int>(outputs.size()), [&](auto, const auto&, const auto& p, auto& y) {
    const std::span<const Recorded> values(p);
    Assembly<Recorded> assembly(study.mechanism, freeParameters(study), values.subspan(states));
    assembly.setMotion(values.first(states));
    const std::vector<Recorded> found = recordOutputs(assembly, outputs);
    for (std::size_t i = 0; i < found.size(); ++i) y[i] = found[i];
  });
}

/// y = g(t, p) where everything is driven.
Program recordGivenMotion(const Study& study, const std::vector<std::string>& parameters) {
  const std::vector<Expression> outputs = outputExpressions(study);
  return record(1, static_cast<int>(parameters.size()), static_cast<int>(outputs.size()),
                [&](auto t, const auto&, const auto& p, auto& y) {
                  Assembly<Recorded> assembly(study.mechanism, parameters, p);
                  assembly.setState({}, t);
                  const std::vector<Recorded> found = recordOutputs(assembly, outputs);
                  for (std::size_t i = 0; i < found.size(); ++i) y[i] = found[i];
                });
}

/// While it lives, requests fail that would take the process beyond so many bytes, before the machine has none left.
class MemoryBound {
 public:
  explicit MemoryBound(double bytes) {
    ::getrlimit(RLIMIT_DATA, &before_);
    rlimit bound = before_;
    if (bytes < static_cast<double>(before_.rlim_cur)) bound.rlim_cur = static_cast<rlim_t>(bytes);
    ::setrlimit(RLIMIT_DATA, &bound);
  }
  ~MemoryBound() { ::setrlimit(RLIMIT_DATA, &before_); }
  MemoryBound(const MemoryBound&) = delete;
  MemoryBound& operator=(const MemoryBound&) = delete;

 private:
  rlimit before_{};
};

void recordAnalysis(Study& study, const std::vector<std::string>& parameters) {
  Motion& motion = study.motion;
  if (study.isMotionGiven()) {
    motion.f =
        record(1, static_cast<int>(parameters.size()), [](auto, const auto&, const auto&, auto& dx) { dx[0] = 0.0; });
    motion.g = recordGivenMotion(study, parameters);
  } else if (study.analysis != Study::Analysis::kinematics) {
    motion.f = recordMotion(study.mechanism, parameters, Formulation::sparse);
    motion.sampled = recordMotion(study.mechanism, parameters, Formulation::articulated);
    motion.g = recordOutputs(study.mechanism, parameters, outputExpressions(study));
    motion.rests = restsOf(study.mechanism);
  } else {
    const std::size_t states = study.mechanism.stateNames().size();
    const int numbers = static_cast<int>(states + parameters.size());
    motion.f = record(0, numbers, [](auto, const auto&, const auto&, auto&) {});
    motion.g = recordConfiguration(study, states, numbers);
  }
}

}  // namespace

std::vector<Expression> outputExpressions(const Study& study) {
  std::vector<Expression> expressions;
  for (const WantedOutput& output : study.outputs) expressions.push_back(output.inUnit());
  return expressions;
}

Expression WantedOutput::inUnit() const {
  const Amount one = oneOfUnit(unit);
  return one.value == 1 && one.piPower == 0 ? expression : expression / Expression(one);
}

Program alongCourses(const Problem& problem, const Program& program) {
  return problem.courses.empty() ? program : withCourses(program, problem.courses, problem.slowest, problem.fastest);
}

void recordPrograms(Study& study) {
  const double start = processCpuSeconds();
  const std::vector<std::string> parameters = freeParameters(study);
  const double most =
      StatedLimits{}.resolved().memory;  // what a study states is of its runs: it may be read for others
  try {
    const MemoryBound bound(most);
    recordAnalysis(study, parameters);
  } catch (const std::bad_alloc&) {
    study.motion = {};
    throw std::length_error(fmt::format(
        "the equations of {} {} do not fit into the {:.3g} GB that a run may have", study.mechanism.stateNames().size(),
        study.analysis == Study::Analysis::dynamics ? "states" : "coordinates", most / 1e9));
  }
  Motion& motion = study.motion;
  motion.outputNames.clear();
  for (const OutputInfo& output : study.outputs) motion.outputNames.push_back(output.name);
  study.recordingCpu = processCpuSeconds() - start;
}

Problem makeProblem(const Study& study) {
  Problem problem;
  const Mechanism& mechanism = study.mechanism;
  const std::vector<std::string> names = mechanism.stateNames();
  problem.states = names.size();
  problem.freeParameters = freeParameters(study);
  problem.motion.motion = study.motion;
  const std::vector<bool> isDifference = mechanism.startsWith(problem.freeParameters);
  for (const Expression& initial : mechanism.initialState())
    problem.box.push_back(isDifference[problem.box.size()] ? Interval(0.0) : mechanism.rangeOf(initial));
  if (study.isMotionGiven()) {
    problem.states = 1;
    problem.box.emplace_back(0.0);
  }
  std::unordered_map<std::string, int> slotOf;
  for (std::size_t i = 0; i < names.size(); ++i) slotOf[names[i]] = static_cast<int>(i);
  for (const UncertainQuantity& uncertain : study.uncertain) {
    const auto state = slotOf.find(uncertain.quantity);
    problem.motion.uncertain.push_back(uncertain.uncertain);
    if (state != slotOf.end()) {
      problem.motion.slot.push_back(state->second);
    } else {
      problem.motion.slot.push_back(static_cast<int>(problem.box.size()));
      problem.box.push_back(mechanism.nominal(uncertain.quantity));
    }
  }
  problem.motion.dependence = study.dependence;
  for (const Interval& value : problem.box) problem.motion.nominal.push_back(midpoint(value));
  for (std::size_t i = 0; i < study.uncertain.size(); ++i) {
    const auto slot = static_cast<std::size_t>(problem.motion.slot[i]);
    problem.box[slot] = study.uncertain[i].uncertain.range;
    problem.motion.nominal[slot] = study.uncertain[i].uncertain.nominal;
  }
  takeCourses(study, problem);
  for (int j = 0; study.asksFor<FuzzyResult>() && j < study.levels; ++j) {
    problem.alpha.push_back(levelOf(j, study.levels));
    Box level = problem.box;
    for (std::size_t i = 0; i < study.uncertain.size(); ++i)
      level[static_cast<std::size_t>(problem.motion.slot[i])] =
          study.uncertain[i].uncertain.membership.cut(problem.alpha.back());
    problem.levels.push_back(std::move(level));
  }
  return problem;
}

}  // namespace gamut
