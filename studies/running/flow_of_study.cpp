#include "studies/running/flow_of_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "analyses/flow/run.hpp"
#include "analyses/zero_free.hpp"
#include "scalars/program/recorder.hpp"
#include "studies/words.hpp"

namespace gamut {

namespace {

/// Where the motion is given there is nothing to step by, but loads change as fast as what drives them.
double longestStepOf(const Study& study) {
  constexpr double parts = 64;  // of the horizon, at least
  double longest = 0;
  for (std::size_t i = 1; i < study.times.size(); ++i) longest = std::max(longest, study.times[i] - study.times[i - 1]);
  return std::min(longest, study.horizon / parts);
}

/// These outputs alone; `numbers` becomes their new numbers, 0, 1, ...
Program programOf(const Program& g, const std::vector<int>& outputs, std::vector<int>& numbers) {
  numbers.clear();
  std::vector<int> nodes;
  for (const int output : outputs) {
    numbers.push_back(static_cast<int>(nodes.size()));
    nodes.push_back(g.outputNodes()[output]);
  }
  return Recorder(g).finish(nodes);
}

/// Why nothing is said of what comes behind: because of what happens there, is not known not to, or was not looked at.
FlowCause causeOf(const ZeroFree& known, const Regular& regular, const Box& box) {
  if (known.end == ZeroFree::End::cancelled) return {FlowCause::Kind::interrupted};
  const std::string& what = regular.otherwise[static_cast<std::size_t>(known.first)];
  if (known.end == ZeroFree::End::open) return {FlowCause::Kind::edge, "it could not be excluded that " + what};
  const bool isOne = std::ranges::all_of(box, [](const Interval& range) { return isThin(range); });
  return {FlowCause::Kind::edge, fmt::format("{}{}, at {} s at the latest", what, isOne ? "" : " for some values",
                                             outwardText(known.zeroBy, known.zeroBy, 6).second)};
}

}  // namespace

FlowOptions flowOptions(const Machine& machine, int jobs, const std::atomic<bool>* cancelled) {
  const Study& study = machine.study;
  FlowOptions flow = study.flow;
  flow.jobs = jobs;
  flow.cancelled = cancelled;
  flow.stateNames = study.mechanism.stateNames();
  if (machine.isMotionGiven()) {
    flow.stateNames = {"rest"};
    flow.longestStep = longestStepOf(study);
  }
  flow.varying = machine.varying;
  flow.rests = machine.equations().rests;
  flow.remainders = machine.remainders;
  flow.dropsUnneeded = true;
  return flow;
}

Tube encloseMotion(const Motion& motion, const Regular& regular, Program outputs, FlowOptions options, const Box& box,
                   double horizon, const std::vector<double>& times, const std::vector<Box>& levels) {
  const Box states(box.begin(), box.begin() + motion.f.states());
  if (options.cancelled != nullptr && *options.cancelled) {  // equations of many outputs take long to be prepared
    Tube tube = FlowRun::startAlone(states, outputs.outputs(), levels.size());
    FlowRun::endEarly(tube, {FlowCause::Kind::interrupted}, horizon, times, options);
    return tube;
  }
  const ZeroFree known = zeroFree(regular.values, box, horizon, options.cancelled);
  if (known.first < 0)
    return Flow(motion.f, std::move(outputs), std::move(options)).enclose(box, horizon, times, levels);
  std::vector<double> early;
  std::ranges::copy_if(times, std::back_inserter(early), [&](double time) { return time <= known.until; });
  Tube tube = FlowRun::startAlone(states, outputs.outputs(), levels.size());
  if (known.until > 0) tube = Flow(motion.f, std::move(outputs), options).enclose(box, known.until, early, levels);
  FlowRun::endEarly(tube, causeOf(known, regular, box), horizon, times, options);
  return tube;
}

std::vector<int> marginOutputs(const Study& study) {
  std::vector<int> outputs;
  for (const Requirement& requirement : study.requirements)
    for (const std::size_t output : requirement.marginOutputs()) outputs.push_back(static_cast<int>(output));
  return outputs;
}

std::vector<int> plainOutputs(const Study& study) {
  const std::vector<int> margins = marginOutputs(study);
  std::vector<int> outputs;
  for (int output = 0; output < static_cast<int>(study.outputs.size()); ++output)
    if (std::ranges::find(margins, output) == margins.end()) outputs.push_back(output);
  return outputs;
}

std::string adviceOf(const Watch& watch) {
  const std::string key = watch.key();
  return key.empty() ? key : "a greater " + key;
}

std::size_t rowOf(const std::vector<double>& times, double time) {
  return static_cast<std::size_t>(std::ranges::lower_bound(times, time) - times.begin());
}

CellQuestion questionOf(const Study& study, const Requirement& requirement, std::size_t rows) {
  CellQuestion question;
  question.when = requirement.demand.isAlways ? CellQuestion::When::always : CellQuestion::When::eventually;
  const std::size_t first = study.requirements.front().firstMargin;  // models are of margins alone
  for (std::size_t k = 0; k < requirement.margins(); ++k) {
    question.margins.push_back(static_cast<int>(requirement.firstMargin + k - first));
    question.isStrict.push_back(requirement.demand.terms[k].isStrict ? 1 : 0);
  }
  question.from = rowOf(study.times, requirement.demand.from);
  question.until = std::min(rowOf(study.times, requirement.demand.until), rows - 1);
  return question;
}

Tube modelMargins(const Machine& machine, FlowOptions options, const Box& box) {
  return modelMarginsOf(machine.study, machine.equations(), machine.regular, std::move(options), box,
                        machine.study.times);
}

Tube modelMarginsOf(const Study& study, const Motion& motion, const Regular& regular, FlowOptions options,
                    const Box& box, const std::vector<double>& times) {
  Program g = programOf(motion.g, marginOutputs(study), options.modelled);
  return encloseMotion(motion, regular, std::move(g), std::move(options), box, study.horizon, times);
}

Tube modelAll(const Machine& machine, FlowOptions options, const Box& box) {
  const Study& study = machine.study;
  std::vector<int> all = marginOutputs(study);
  const std::size_t margins = all.size();
  std::ranges::copy(plainOutputs(study), std::back_inserter(all));
  Program g = programOf(machine.equations().g, all, options.modelled);
  options.modelledAt.assign(options.modelled.begin() + static_cast<std::ptrdiff_t>(margins), options.modelled.end());
  options.modelled.resize(margins);
  return encloseMotion(machine.equations(), machine.regular, std::move(g), std::move(options), box, study.horizon,
                       study.times);
}

}  // namespace gamut
