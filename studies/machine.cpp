// Slots: state i is number i, free parameter k is number states + k. In kinematics nothing moves by itself: the states
// are given, so they are parameters of a program without states. A motion that is given as a whole has one state that
// rests, for flow and samples to follow.
#include "studies/machine.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <numbers>
#include <span>
#include <unordered_map>
#include <utility>

#include "analyses/roots/root_family.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/recorded.hpp"
#include "studies/machine_faults.hpp"
#include "studies/results/fuzzy.hpp"
#include "studies/watch.hpp"

namespace gamut {
namespace {

std::vector<std::string> freeParametersOf(const Study& study) {
  std::vector<std::string> names;
  for (const UncertainQuantity& uncertain : study.uncertain)
    if (study.mechanism.isFreeParameter(uncertain.quantity)) names.push_back(uncertain.quantity);
  return names;
}

/// What varies in time follows a course: swinging once in the study's time at least, and twice as fast as the motion
/// itself, or sixteen times in all, at most.
void takeCourses(Machine& machine) {
  SwitchingCourses& switching = machine.motion.switching;
  for (std::size_t i = 0; i < machine.study.uncertain.size(); ++i) {
    const UncertainQuantity& of = machine.study.uncertain[i];
    const int slot = machine.motion.slot[i];
    if (!of.varies) {
      machine.constants.push_back({i, slot});
      continue;
    }
    const int parameter = slot - static_cast<int>(machine.states);
    machine.varying.push_back({parameter, of.rate});
    machine.courses.push_back({parameter, of.uncertain.range, of.uncertain.nominal, of.rate});
    switching.quantities.push_back(i);
    switching.rates.push_back(of.rate);
  }
  if (machine.courses.empty()) return;
  machine.slowest = 2 * std::numbers::pi / machine.study.horizon;
  machine.fastest = std::max(16 * machine.slowest, 2 * fastestTurn(machine.motion.motion.f, machine.motion.nominal));
  Motion& motion = machine.motion.motion;
  switching.motion = motion;
  for (Program* program : {&motion.f, &motion.g, &motion.sampled})
    if (program->outputs() > 0) *program = machine.alongCourses(*program);
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

void recordAnalysis(const Study& study, const std::vector<std::string>& parameters, Motion& motion) {
  const std::vector<Expression> outputs = outputExpressions(study);
  const auto outputsOf = [&](const Assembly<Recorded>& assembly) { return recordOutputs(assembly, outputs); };
  if (study.isMotionGiven()) {
    motion.f =
        record(1, static_cast<int>(parameters.size()), [](auto, const auto&, const auto&, auto& dx) { dx[0] = 0.0; });
    motion.g = recordedOf(study, outputs.size(), outputsOf);
  } else if (study.analysis != Study::Analysis::kinematics) {
    motion.f = recordMotion(study.mechanism, parameters, Formulation::sparse);
    motion.sampled = recordMotion(study.mechanism, parameters, Formulation::articulated);
    motion.g = recordOutputs(study.mechanism, parameters, outputs);
    motion.rests = restsOf(study.mechanism);
  } else {
    motion.g = recordedOf(study, outputs.size(), outputsOf);
    motion.f = record(0, motion.g.parameters(), [](auto, const auto&, const auto&, auto&) {});
  }
}

/// Initial values, then free parameters, and in which of them the uncertain quantities are.
void takeNumbers(Machine& machine) {
  const Mechanism& mechanism = machine.study.mechanism;
  UncertainMotion& motion = machine.motion;
  const std::vector<std::string> names = mechanism.stateNames();
  const std::vector<bool> isDifference = mechanism.startsWith(machine.freeParameters);
  for (const Expression& initial : mechanism.initialState())
    machine.box.push_back(isDifference[machine.box.size()] ? Interval(0.0) : mechanism.rangeOf(initial));
  if (machine.study.isMotionGiven()) machine.box.emplace_back(0.0);
  machine.states = machine.box.size();
  std::unordered_map<std::string, int> slotOf;
  for (std::size_t i = 0; i < names.size(); ++i) slotOf[names[i]] = static_cast<int>(i);
  for (const UncertainQuantity& uncertain : machine.study.uncertain) {
    const auto state = mechanism.isFreeParameter(uncertain.quantity) ? slotOf.end() : slotOf.find(uncertain.quantity);
    motion.uncertain.push_back(uncertain.uncertain);
    motion.slot.push_back(state != slotOf.end() ? state->second : static_cast<int>(machine.box.size()));
    if (state == slotOf.end()) machine.box.push_back(mechanism.nominal(uncertain.quantity));
  }
  motion.dependence = machine.study.dependence;
  for (const Interval& value : machine.box) motion.nominal.push_back(midpoint(value));
  for (std::size_t i = 0; i < motion.uncertain.size(); ++i) {
    const auto slot = static_cast<std::size_t>(motion.slot[i]);
    machine.box[slot] = motion.uncertain[i].range;
    motion.nominal[slot] = motion.uncertain[i].nominal;
  }
}

/// Dependent coordinates start at what is left between Newton's steps and the closed loops, for all values of the box.
void closeLoops(Machine& machine) {
  const Mechanism& mechanism = machine.study.mechanism;
  if (!mechanism.isClosed()) return;
  machine.closing = recordClosing(mechanism, machine.freeParameters);
  refuseVaryingLoops(machine.study, machine.freeParameters);
  const std::vector<std::string> names = mechanism.stateNames();
  for (const std::string& dependent : mechanism.dependents())
    machine.remainders.push_back(static_cast<int>(std::ranges::find(names, dependent) - names.begin()));
  machine.box = machine.closed(std::move(machine.box));
  for (const int slot : machine.remainders) machine.motion.nominal[slot] = midpoint(machine.box[slot]);
}

void takeLevels(Machine& machine) {
  const int levels = machine.study.levels;
  for (int j = 0; machine.study.asksFor<FuzzyResult>() && j < levels; ++j) {
    machine.alpha.push_back(levelOf(j, levels));
    Box& level = machine.levels.emplace_back(machine.box);
    for (std::size_t i = 0; i < machine.motion.uncertain.size(); ++i)
      level[machine.motion.slot[i]] = machine.motion.uncertain[i].membership.cut(machine.alpha.back());
  }
}

}  // namespace

Program recordedOf(const Study& study, std::size_t values,
                   const std::function<std::vector<Recorded>(const Assembly<Recorded>&)>& what) {
  const std::vector<std::string> parameters = freeParametersOf(study);
  const std::size_t given = study.mechanism.stateNames().size();
  const bool moves = study.analysis != Study::Analysis::kinematics;
  const std::size_t states = study.isMotionGiven() ? 1 : moves ? given : 0;
  const auto motion = [&](auto t, const auto& x, const auto& p, auto& y) {
    const std::span<const Recorded> numbers(p);
    Assembly<Recorded> assembly(study.mechanism, parameters, moves ? numbers : numbers.subspan(given));
    if (study.isMotionGiven())
      assembly.setState({}, t);
    else
      moves ? assembly.setMotion(x, t) : assembly.setMotion(numbers.first(given));
    std::ranges::copy(what(assembly), y.begin());
  };
  return record(static_cast<int>(states), static_cast<int>(parameters.size() + (moves ? 0 : given)),
                static_cast<int>(values), motion);
}

std::vector<Expression> outputExpressions(const Study& study) {
  std::vector<Expression> expressions;
  for (const WantedOutput& output : study.outputs) expressions.push_back(output.inUnit());
  return expressions;
}

Motion recordedMotion(const Study& study) {
  Motion motion;
  motion.times = study.times;
  for (const OutputInfo& output : study.outputs) motion.outputNames.push_back(output.name);
  try {
    checkStart(study.mechanism);
    const MemoryBound bound(StatedLimits{}.resolved().memory);  // what a study states is of its runs
    recordAnalysis(study, freeParametersOf(study), motion);
  } catch (...) {
    refuseMechanism(study);
  }
  return motion;
}

Machine::Machine(Study of) : study(std::move(of)), freeParameters(freeParametersOf(study)) {
  const double start = processCpuSeconds();
  motion.motion = recordedMotion(study);
  cpu = processCpuSeconds() - start;
  takeNumbers(*this);
  closeLoops(*this);
  takeCourses(*this);
  takeLevels(*this);
}

Box Machine::closed(Box other) const {
  if (remainders.empty()) return other;
  const RootFamily family = proveRoots(closing, Box(other.begin() + static_cast<std::ptrdiff_t>(states), other.end()));
  if (family.remainder.empty()) refuseOpenLoops(study, freeParameters, *family.open);
  for (std::size_t i = 0; i < remainders.size(); ++i) other[remainders[i]] = family.remainder[i];
  return other;
}

Program Machine::alongCourses(const Program& program) const {
  return courses.empty() ? program : withCourses(program, courses, slowest, fastest);
}

}  // namespace gamut
