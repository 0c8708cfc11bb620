// Slots: state i is number i, free parameter k is number states + k. In kinematics nothing moves by itself: the states
// are given, so they are parameters of a program without states. A motion that is given as a whole has one state that
// rests, for flow and samples to follow.
#include "studies/machine.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <numbers>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "analyses/flow/needed_states.hpp"
#include "analyses/roots/eigenvalue_bounds.hpp"
#include "analyses/roots/root_family.hpp"
#include "analyses/zero_free.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "mechanics/rest.hpp"
#include "mechanics/whole_turns.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/recorded.hpp"
#include "studies/assumed_rows.hpp"
#include "studies/machine_faults.hpp"
#include "studies/results/fuzzy.hpp"
#include "studies/watch.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

std::vector<std::string> freeParametersOf(const Study& study) {
  std::vector<std::string> names;
  for (const UncertainQuantity& uncertain : study.uncertain)
    if (study.mechanism.isFreeParameter(uncertain.quantity)) names.push_back(uncertain.quantity);
  return names;
}

Box boxOf(const Study& study, const std::vector<std::string>& parameters) {
  Box box;
  for (const UncertainQuantity& uncertain : study.uncertain)
    if (std::ranges::find(parameters, uncertain.quantity) != parameters.end()) box.push_back(uncertain.uncertain.range);
  return box;
}

/// Those that outputs ask for.
std::set<int> modesIn(const Study& study) {
  std::set<int> modes;
  for (const WantedOutput& output : study.outputs)
    for (const std::string& name : output.expression.names())
      for (int mode = 1; mode <= study.mechanism.degreesOfFreedom(); ++mode)
        for (const char* what : {"frequency.", "damping."})
          if (name == what + std::to_string(mode)) modes.insert(mode);
  return modes;
}

/// Moves it to rest, and tells it of modes.
void putToRest(Assembly<Recorded>& assembly, const Rest::Found& at) {
  assembly.setState(at.state);
  for (const auto& [name, value] : at.known) assembly.tell(name, [value] { return value; });
  for (const auto& [name, why] : at.unknown) assembly.tell(name, [why]() -> Recorded { throw std::domain_error(why); });
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

/// Where all frames are: what pictures are drawn of.
Program recordedFrames(const Study& study) {
  const std::vector<std::string>& names = study.mechanism.frames();
  return recordedOf(study, nullptr, 12 * names.size(), [&](const Assembly<Recorded>& assembly) {
    std::vector<Recorded> all;
    for (const std::string& name : names) {
      const Frame<Recorded>& frame = assembly.frame(name);
      for (const auto& each : frame.R.reshaped()) all.push_back(each);
      for (const auto& each : frame.positionInInertial()) all.push_back(each);
    }
    return all;
  });
}

/// Dependent coordinates of loops that are closed in closed form move nothing: those that no output asks for, nor a
/// frame, need not be followed, and rest.
void restUnread(const Study& study, Motion& motion) {
  const Mechanism& mechanism = study.mechanism;
  if (!mechanism.isClosed()) return;
  const std::vector<std::string> names = mechanism.stateNames();
  const Program others = record(motion.f.states(), motion.f.parameters(), motion.f.states(),
                                [&](auto, const auto& x, const auto&, auto& y) {
                                  for (std::size_t i = 0; i < names.size(); ++i) {
                                    const auto& dependents = mechanism.dependents();
                                    const bool depends = std::ranges::find(dependents, names[i]) != dependents.end();
                                    y[i] = depends ? Recorded(0.0) : x[i];
                                  }
                                });
  // Where a triangle's root is above zero, the quotients in these rates have values too.
  const std::array readers{others, recordedFrames(study), motion.g};
  motion.f = withOthersAtRest(motion.f, neededStates(motion.f, readers, true));
}

/// Of loops that are placed: one state, which rests, where those of the machine were, of which nothing is read.
Program placedOf(const Study& study, std::size_t values,
                 const std::function<std::vector<Recorded>(const Assembly<Recorded>&)>& what,
                 const AngleCourses& placed) {
  const std::vector<std::string> parameters = freeParametersOf(study);
  const std::size_t given = study.mechanism.stateNames().size();
  const int count = static_cast<int>(parameters.size()), outputs = static_cast<int>(values);
  const Program ofStates =
      record(static_cast<int>(given), count, outputs, [&](auto t, const auto& x, const auto& p, auto& y) {
        Assembly<Recorded> assembly(study.mechanism, parameters, p);
        assembly.placeAngles(placed);
        assembly.setMotion(x, t);
        std::ranges::copy(what(assembly), y.begin());
      });
  return record(1, count, outputs, [&](auto t, const auto&, const auto& p, auto& y) {
    const std::vector<Recorded> nothing(given, Recorded(0.0));
    std::ranges::copy(written(ofStates, nothing, {p.begin(), p.end()}, Recorded(t)), y.begin());
  });
}

/// What happens where this margin is zero.
std::string singularAt(const Mechanism& mechanism, const Assembly<Recorded>::PlacedMargin& margin) {
  const Mechanism::Closed& loop = mechanism.loops()[margin.loop];
  return margin.angle.empty()
             ? fmt::format("the loop '{}' comes to a dead point of {}", loop.element, fmt::join(loop.by, ", "))
             : fmt::format("{} of the loop '{}' comes to half a turn from where it is in the nominal machine",
                           margin.angle, loop.element);
}

/// Of loops that are placed.
Regular recordedRegular(const Study& study, const AngleCourses& placed) {
  using Placed = Assembly<Recorded>;
  Regular regular;
  placedOf(
      study, 0,
      [&](const Placed& assembly) {
        for (const Placed::PlacedMargin& margin : assembly.placedMargins())
          regular.otherwise.push_back(singularAt(study.mechanism, margin));
        return std::vector<Recorded>();
      },
      placed);
  regular.values = placedOf(
      study, regular.otherwise.size(),
      [](const Placed& assembly) {
        std::vector<Recorded> values;
        for (const Placed::PlacedMargin& margin : assembly.placedMargins()) values.push_back(margin.value);
        return values;
      },
      placed);
  return regular;
}

/// Rates of what rests that become infinite where a loop that is placed is no longer regular, so that samples neither
/// come there nor pass it by.
Program recordedEnding(const Program& regular) {
  // The state, which counts for nothing, makes them no functions of time alone, whose growth samples need not meet in
  // cells (TimeCells): what they grow with is one.
  constexpr double nothing = 0x1p-300;
  return record(1, regular.parameters(), 1, [&](auto t, const auto& x, const auto& p, auto& y) {
    Recorded rate(0.0);
    for (const Recorded& value : written(regular, {x.begin(), x.end()}, {p.begin(), p.end()}, Recorded(t)))
      rate = rate + Recorded(1.0) / (value * sqrt(value) * (Recorded(1.0) + Recorded(nothing) * x[0]));
    y[0] = rate;
  });
}

/// Where directions go far round, as those of plays, or something varies, of which nothing that is followed knows
/// enough; else coordinates are followed, which knows more between output times. None where a witness is asked for,
/// which follows them as states, nor where some value of the box starts where nothing goes on from: that is
/// `irregular`.
std::optional<AngleCourses> placedIn(const Study& study, const std::vector<std::string>& parameters,
                                     std::string& irregular) {
  constexpr double farRound = 1.5;  // rad, as in circles.cpp
  const bool isRound = std::ranges::any_of(study.uncertain, [](const UncertainQuantity& quantity) {
    return quantity.varies || (quantity.unit == "rad" && width(quantity.uncertain.range) > farRound);
  });
  const bool isFollowed = std::ranges::any_of(
      study.analyses, [](const auto& each) { return each->section() == "witness" && each->isAsked(); });
  if (study.analysis != Study::Analysis::inverseDynamics || !isRound || isFollowed) return std::nullopt;
  std::optional<AngleCourses> placed = placedLoops(study.mechanism, parameters, study.horizon);
  if (!placed) return std::nullopt;
  Box box = {Interval(0.0)};
  std::ranges::copy(boxOf(study, parameters), std::back_inserter(box));
  constexpr double soon = 0x1p-6;  // of the horizon
  const Regular regular = recordedRegular(study, *placed);
  const ZeroFree known = zeroFree(regular.values, box, soon * study.horizon);
  if (known.until > 0) return placed;
  const std::string& what = regular.otherwise[static_cast<std::size_t>(known.first)];
  irregular = known.end == ZeroFree::End::zero ? fmt::format("{} for some values, at {} s at the latest", what,
                                                             outwardText(known.zeroBy, known.zeroBy, 6).second)
                                               : fmt::format("it could not be excluded that {} where it starts", what);
  return std::nullopt;
}

Program recordedOutputs(const Study& study, const Rest* rest, bool withinEnds = false,
                        const std::optional<AngleCourses>& placed = {}) {
  const std::vector<Expression> outputs = outputExpressions(study);
  return recordedOf(
      study, rest, outputs.size(), [&](const Assembly<Recorded>& assembly) { return recordOutputs(assembly, outputs); },
      withinEnds, placed);
}

void recordAnalysis(const Study& study, const Rest* rest, const std::optional<AngleCourses>& placed,
                    const std::vector<std::string>& parameters, Motion& motion) {
  if (study.isMotionGiven() || placed) {
    motion.f =
        record(1, static_cast<int>(parameters.size()), [](auto, const auto&, const auto&, auto& dx) { dx[0] = 0.0; });
    motion.g = recordedOutputs(study, rest, false, placed);
    if (placed) motion.sampled = recordedEnding(recordedRegular(study, *placed).values);
  } else if (study.moves()) {
    refuseMasslessLoops(study);
    motion.f = recordMotion(study.mechanism, parameters, Formulation::sparse);
    motion.sampled = recordMotion(study.mechanism, parameters, Formulation::articulated);
    motion.g = recordOutputs(study.mechanism, parameters, outputExpressions(study));
    motion.rests = restsOf(study.mechanism);
    restUnread(study, motion);
  } else {
    motion.g = recordedOutputs(study, rest);
    motion.f = record(0, motion.g.parameters(), [](auto, const auto&, const auto&, auto&) {});
  }
}

/// Initial values, then free parameters, and in which of them the uncertain quantities are.
void takeNumbers(Machine& machine) {
  const Mechanism& mechanism = machine.study.mechanism;
  UncertainMotion& motion = machine.motion;
  const std::vector<std::string> names =
      machine.rest || machine.placed ? std::vector<std::string>() : mechanism.stateNames();
  const std::vector<bool> isDifference = mechanism.startsWith(machine.freeParameters);
  if (machine.rest) machine.box.assign(machine.rest->remainders(), Interval(0.0));
  for (std::size_t i = 0; i < names.size(); ++i)
    machine.box.push_back(isDifference[i] ? Interval(0.0) : mechanism.rangeOf(mechanism.initialState()[i]));
  if (machine.isMotionGiven()) machine.box.emplace_back(0.0);
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

/// Proofs that do not succeed within so much CPU time are given up: where a loop comes to a dead point they would go on
/// for hours.
std::function<bool(double)> withinAMinute(const Machine::Progress& progress, const std::string& task) {
  return [&progress, task, start = processCpuSeconds()](double done) {
    if (progress) progress(task, done);
    return processCpuSeconds() - start < 60;
  };
}

/// Before anything is recorded: polynomials of the free parameters that come near to where loops close, unless that
/// they do is proved only with Newton's steps from the nominal position. What is left open, where it is proved.
Box approachLoops(Machine& machine, const Machine::Progress& progress) {
  constexpr std::size_t few = 6;  // rows: Newton's steps lose little, and come nearer for wide tolerances
  if (machine.rest || machine.placed) return {};
  if (machine.study.mechanism.dependents().size() <= few || machine.freeParameters.empty()) return {};
  Mechanism& mechanism = machine.study.mechanism;
  const std::vector<std::string>& names = machine.freeParameters;
  const Box parameters(machine.box.begin() + static_cast<std::ptrdiff_t>(machine.states), machine.box.end());
  try {
    const Program step = recordApproach(mechanism, names);
    mechanism.closeNear(names, std::make_shared<const Program>(approached(step, parameters)));
    Box open = proveRoots(recordClosing(mechanism, names), parameters, static_cast<int>(names.size()), 1e-9,
                          withinAMinute(progress, "loops"))
                   .remainder;
    if (open.empty()) mechanism.closeNear({}, nullptr);
    return open;
  } catch (...) {
    refuseMechanism(machine.study);
  }
}

Box parametersIn(const Machine& machine, const Box& box) {
  return {box.begin() + static_cast<std::ptrdiff_t>(machine.states), box.end()};
}

std::vector<int> numbersOfModes(const Rest& rest) {
  std::vector<int> numbers;
  for (std::size_t k = 0; k < rest.vibration()->modes.size(); ++k) numbers.push_back(rest.vibration()->number(k));
  return numbers;
}

/// Of each undamped mode three numbers stand last of what is left open, of which these are the latter.
void putEnds(const std::vector<Interval>& squares, Box& box, std::size_t states) {
  for (std::size_t k = 0; k < squares.size(); ++k) {
    Interval* own = &box[states - 3 * (squares.size() - k)];
    own[1] = Interval(squares[k].lower());
    own[2] = Interval(squares[k].upper());
  }
}

struct ClosedBox {
  Box box;
  std::shared_ptr<const EigenvalueBounds> vibrations;
};

/// For all values of the box: loops are proved to close, or position and modes of rest to exist. `known`: what the
/// first family leaves open, where that is known already.
ClosedBox closedBox(const Machine& machine, Box other, const Box& known = {}, const Machine::Progress& progress = {}) {
  ClosedBox closed{std::move(other), nullptr};
  Box parameters = parametersIn(machine, closed.box), open;
  const Box own = parameters;
  auto slot = machine.remainders.begin();
  for (const Program& newton : machine.closing) {
    const bool isFirst = slot == machine.remainders.begin();
    const RootFamily family = isFirst && !known.empty()
                                  ? RootFamily{known, {}, {}}
                                  : proveRoots(newton, parameters, static_cast<int>(machine.freeParameters.size()),
                                               isFirst || !machine.rest ? 1e-9 : 1.0,
                                               withinAMinute(progress, machine.rest ? "rest" : "loops"));
    if (family.remainder.empty()) {
      if (machine.rest)
        refuseUnprovedRest(machine.study, machine.freeParameters, *family.open, isFirst, std::span(&newton, 1));
      refuseOpenLoops(machine.study, machine.freeParameters, *family.open, newton);
    }
    for (const Interval& each : family.remainder) closed.box[*slot++] = each;
    if (isFirst) open = family.remainder;
    if (isFirst) parameters.insert(parameters.end(), open.begin(), open.end());
  }
  if (!machine.rest || !machine.rest->vibration()) return closed;
  if (progress) progress("modes", 0);
  const RestVibration& vibration = *machine.rest->vibration();
  const auto openAt = [open, newton = machine.closing.front()](const Box& thin) {
    constexpr double enough = 1e-7;
    if (std::ranges::all_of(open, [](const Interval& each) { return magnitude(each) < enough; })) return open;
    RootFamily family = proveRoots(newton, thin);
    return family.remainder.empty() ? open : std::move(family.remainder);
  };
  closed.vibrations = std::make_shared<const EigenvalueBounds>(vibration.pencil, machine.rest->position(),
                                                               vibration.basis, own, open, openAt);
  const std::vector<int> numbers = numbersOfModes(*machine.rest);
  const std::vector<Interval> squares = closed.vibrations->ranges(numbers, own);
  if (!std::ranges::all_of(squares, [](const Interval& each) { return isBounded(each); }))
    refuseUnprovedRest(machine.study, machine.freeParameters, own, false,
                       std::array{vibration.pencil, machine.rest->position()});
  const EigenvalueBounds::Beside beside = closed.vibrations->beside(vibration.near, vibration.shapes, numbers, squares);
  putEnds(beside.ranges, closed.box, machine.states);
  for (const Interval& off : beside.off) {
    closed.box[*slot] = off;
    slot += 3;
  }
  return closed;
}

/// Dependent coordinates, and rates that depend on others, start at what is left between Newton's steps and the closed
/// loops, for all values of the box; at rest all numbers are of this kind. `open`: what that is, where it is known
/// already.
void closeFamilies(Machine& machine, const Box& open, const std::string& irregular, const Machine::Progress& progress) {
  const Mechanism& mechanism = machine.study.mechanism;
  if (machine.rest) {
    machine.closing = machine.rest->families();
    for (std::size_t i = 0; i < machine.states; ++i) machine.remainders.push_back(static_cast<int>(i));
  } else if (mechanism.isClosed() && !machine.placed) {
    machine.closing = {recordClosing(mechanism, machine.freeParameters)};
    refuseVaryingLoops(machine.study, machine.freeParameters, irregular);
    std::vector<std::string> dependents = mechanism.dependents();
    if (mechanism.areLoopsHeld()) {
      machine.closing.push_back(recordClosingRates(mechanism, machine.freeParameters));
      std::ranges::move(mechanism.dependentRates(), std::back_inserter(dependents));
    }
    const std::vector<std::string> names = mechanism.stateNames();
    for (const std::string& dependent : dependents)
      machine.remainders.push_back(static_cast<int>(std::ranges::find(names, dependent) - names.begin()));
  }
  ClosedBox closed = closedBox(machine, std::move(machine.box), open, progress);
  machine.box = std::move(closed.box);
  machine.vibrations = std::move(closed.vibrations);
  for (const int slot : machine.remainders) machine.motion.nominal[slot] = midpoint(machine.box[slot]);
}

void takeLevels(Machine& machine) {
  const int levels = machine.study.levels;
  for (int j = 0; machine.study.asksFor<FuzzyResult>() && j < levels; ++j) {
    machine.alpha.push_back(levelOf(j, levels));
    Box& level = machine.levels.emplace_back(machine.box);
    for (std::size_t i = 0; i < machine.motion.uncertain.size(); ++i)
      level[machine.motion.slot[i]] = machine.motion.uncertain[i].membership.cut(machine.alpha.back());
    level = machine.within(std::move(level));
  }
}

}  // namespace

Program recordedOf(const Study& study, const Rest* rest, std::size_t values,
                   const std::function<std::vector<Recorded>(const Assembly<Recorded>&)>& what, bool withinEnds,
                   const std::optional<AngleCourses>& placed) {
  if (placed) return placedOf(study, values, what, *placed);
  const std::vector<std::string> parameters = freeParametersOf(study);
  const bool moves = study.moves();
  const std::size_t given = rest != nullptr ? rest->remainders() : study.mechanism.stateNames().size();
  const std::size_t states = study.isMotionGiven() ? 1 : moves ? given : 0;
  const auto motion = [&](auto t, const auto& x, const auto& p, auto& y) {
    const std::span<const Recorded> numbers(p);
    Assembly<Recorded> assembly(study.mechanism, parameters, moves ? numbers : numbers.subspan(given));
    if (study.isMotionGiven())
      assembly.setState({}, t);
    else if (rest != nullptr)
      putToRest(assembly, rest->at(numbers.first(given), numbers.subspan(given), withinEnds));
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

std::shared_ptr<const Rest> restOf(const Study& study) {
  if (study.analysis != Study::Analysis::equilibria) return nullptr;
  const std::vector<std::string> parameters = freeParametersOf(study);
  const Box box = boxOf(study, parameters);
  try {
    return std::make_shared<const Rest>(
        study.mechanism, parameters, box, modesIn(study),
        [&](const Program& steps, double share) { return approximated(steps, box, share); });
  } catch (...) {
    refuseMechanism(study);
  }
}

Motion recordedMotion(const Study& study, const Rest* rest, const std::optional<AngleCourses>& placed) {
  Motion motion;
  motion.times = study.times;
  for (const OutputInfo& output : study.outputs) motion.outputNames.push_back(output.name);
  try {
    checkStart(study.mechanism);
    const MemoryBound bound(StatedLimits{}.resolved().memory);  // what a study states is of its runs
    recordAnalysis(study, rest, placed, freeParametersOf(study), motion);
  } catch (...) {
    refuseMechanism(study);
  }
  return motion;
}

Machine::Machine(Study of, const Progress& progress) : study(std::move(of)), freeParameters(freeParametersOf(study)) {
  const double start = processCpuSeconds();
  if (progress) progress("equations", 0);
  rest = restOf(study);
  std::string irregular;
  placed = placedIn(study, freeParameters, irregular);
  if (placed) regular = recordedRegular(study, *placed);
  takeNumbers(*this);
  const Box open = approachLoops(*this, progress);
  motion.motion = recordedMotion(study, rest.get(), placed);
  if (rest) plain = recordedOutputs(study, rest.get(), true);
  closeFamilies(*this, open, irregular, progress);
  cpu = processCpuSeconds() - start;
  takeCourses(*this);
  takeLevels(*this);
  refuseRowsThatDoNotFollow(*this);
}

Box Machine::closed(Box other) const { return closedBox(*this, std::move(other)).box; }

Box Machine::within(Box part) const {
  if (!vibrations) return part;
  std::vector<Interval> squares = vibrations->ranges(numbersOfModes(*rest), parametersIn(*this, part));
  for (std::size_t k = 0; k < squares.size(); ++k) {
    const Interval* ends = &box[states - 3 * (squares.size() - k)];
    squares[k] = intersection(squares[k], Interval(ends[1].lower(), ends[2].upper()));
  }
  putEnds(squares, part, states);
  return part;
}

Program Machine::alongCourses(const Program& program) const {
  return courses.empty() ? program : withCourses(program, courses, slowest, fastest);
}

}  // namespace gamut
