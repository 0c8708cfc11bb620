#include "studies/running/flow_of_study.hpp"

#include <algorithm>
#include <utility>

#include "scalars/program/recorder.hpp"

namespace gamut {

namespace {

/// Where the motion is given there is nothing to step by, but loads change as fast as what drives them.
double longestStepOf(const Study& study) {
  constexpr double parts = 64;  // of the horizon, at least
  double longest = 0;
  for (std::size_t i = 1; i < study.motion.times.size(); ++i)
    longest = std::max(longest, study.motion.times[i] - study.motion.times[i - 1]);
  return std::min(longest, study.horizon / parts);
}

}  // namespace

FlowOptions flowOptions(const Study& study, const Problem& problem, int jobs, const std::atomic<bool>* cancelled) {
  FlowOptions flow = study.flow;
  flow.jobs = jobs;
  flow.cancelled = cancelled;
  flow.stateNames = study.mechanism.stateNames();
  if (study.isMotionGiven()) {
    flow.stateNames = {"rest"};
    flow.longestStep = longestStepOf(study);
  }
  flow.varying = problem.varying;
  return flow;
}

std::vector<int> marginOutputs(const Study& study) {
  std::vector<int> outputs;
  for (const Requirement& requirement : study.requirements)
    for (const std::size_t output : requirement.margins) outputs.push_back(static_cast<int>(output));
  return outputs;
}

std::size_t rowOf(const std::vector<double>& times, double time) {
  return static_cast<std::size_t>(std::ranges::lower_bound(times, time) - times.begin());
}

CellQuestion questionOf(const Study& study, const Requirement& requirement, std::size_t rows) {
  CellQuestion question;
  question.when = requirement.isAlways ? CellQuestion::When::always : CellQuestion::When::eventually;
  const std::size_t first = study.requirements.front().margins.front();  // models are of margins alone
  for (const std::size_t output : requirement.margins) question.margins.push_back(static_cast<int>(output - first));
  question.isMetAtZero = requirement.isMetAtZero;
  question.from = rowOf(study.motion.times, requirement.from);
  question.until = std::min(rowOf(study.motion.times, requirement.until), rows - 1);
  return question;
}

Tube modelMargins(const Study& study, FlowOptions options, const Box& box) {
  const Motion& motion = study.motion;
  std::vector<int> nodes;
  for (const int output : marginOutputs(study)) {
    options.modelled.push_back(static_cast<int>(nodes.size()));
    nodes.push_back(motion.g.outputNodes()[static_cast<std::size_t>(output)]);
  }
  return Flow(motion.f, Recorder(motion.g).finish(nodes), std::move(options)).enclose(box, study.horizon, motion.times);
}

}  // namespace gamut
