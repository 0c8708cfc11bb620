// docs/flow.md, section 7.
#include "analyses/flow/start_outputs.hpp"

#include <stdexcept>

#include "analyses/flow/journey.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

StartOutputs::StartOutputs(const FlowTask& task, const Program& g)
    : task_(task), g_(g), outputs_(task.jumps.outputsGiven(g, {})) {
  if (!jumpsOf(task.jumps.f).empty()) signsWithin_.emplace(task.jumps);
}

std::vector<Interval> StartOutputs::over(const Box& box) {
  if (!signsWithin_) return outputs_.over(0.0, box);
  const auto middle = box.begin() + task_.motion.states();
  const Box states(box.begin(), middle), parameters(middle, box.end());
  const auto overBoxes = [&](PlainOutputs& outputs) {
    std::vector<Interval> result;
    const std::vector<SignCases> any(jumpsOf(task_.jumps.f).size());
    for (const SignBox& part : signsWithin_->boxes(0.0, Interval(0.0), states, parameters, any)) {
      Box all = part.states;
      all.insert(all.end(), parameters.begin(), parameters.end());
      all.insert(all.end(), part.signs.begin(), part.signs.end());
      joinHulls(result, outputs.over(0.0, all));
    }
    return result;
  };
  std::vector<Interval> result = overBoxes(outputs_);
  const std::vector<char> holds = held(states, parameters);
  if (holds.empty()) return result;
  try {
    PlainOutputs whileHeld(task_.jumps.outputsGiven(g_, holds));
    const std::vector<Interval> there = overBoxes(whileHeld);
    for (std::size_t o = 0; o < result.size(); ++o) result[o] = intersection(result[o], there[o]);
  } catch (const std::logic_error&) {  // these jumps do not decide about themselves
  }
  return result;
}

std::vector<char> StartOutputs::held(const Box& states, const Box& parameters) {
  std::vector<SignCases> signs(jumpsOf(task_.jumps.f).size());
  signsWithin_->narrow(Interval(0.0), states, parameters, signs);
  const std::vector<Interval>& start = signsWithin_->arguments();
  std::vector<JumpBound> bounds(task_.jumps.count());
  if (!task_.jumps.isAffine) return {};
  JumpBounder bounder(task_.jumps);
  bounder.setParameters(parameters);
  bounder.bound(Interval(0.0), states, start, 0.0, bounds);
  std::vector<char> result;
  bool any = false;
  for (std::size_t k = 0; k < signs.size(); ++k) {
    result.push_back(static_cast<char>(bounds[k].holds && isEqual(start[k], Interval(0.0))));
    any = any || result.back() != 0;
  }
  return any ? result : std::vector<char>{};
}

}  // namespace gamut
