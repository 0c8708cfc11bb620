// docs/flow.md, section 7.
#include "analyses/flow/start_outputs.hpp"

#include <stdexcept>

#include "scalars/index.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

using detail::at;

StartOutputs::StartOutputs(const FlowTask& task) : task_(task), outputs_(withSignsGiven(task.jumps.f, task.outputs)) {
  if (!jumpsOf(task.jumps.f).empty()) arguments_.emplace(withSignsGiven(task.jumps.f));
}

std::vector<Interval> StartOutputs::over(const Box& box) {
  if (!arguments_) return outputs_.over(0.0, box);
  const auto middle = box.begin() + task_.motion.states();
  const Box states(box.begin(), middle), parameters(middle, box.end());
  const std::vector<char> holds = held(states, parameters);
  Box all = box;
  all.insert(all.end(), signs_.begin(), signs_.end());
  std::vector<Interval> result = outputs_.over(0.0, all);
  if (holds.empty()) return result;
  try {
    const std::vector<Interval> there = PlainOutputs(task_.jumps.heldOutputs(task_.outputs, holds)).over(0.0, box);
    for (std::size_t o = 0; o < result.size(); ++o) result[o] = intersection(result[o], there[o]);
  } catch (const std::logic_error&) {  // these jumps do not decide about themselves
  }
  return result;
}

std::vector<char> StartOutputs::held(const Box& states, const Box& parameters) {
  const std::size_t count = jumpsOf(task_.jumps.f).size();
  Box given = parameters;
  given.resize(given.size() + count, Interval(-1.0, 1.0));
  arguments_->setParameters(given);
  const std::vector<Interval> found = (*arguments_)(Interval(0.0), states);
  signs_.clear();
  std::vector<Interval> start;
  std::vector<JumpBound> bounds(task_.jumps.count());
  for (std::size_t k = 0; k < count; ++k) {
    const Interval& u = found[states.size() + k];
    signs_.push_back(u.lower() > 0 ? Interval(1.0) : u.upper() < 0 ? Interval(-1.0) : Interval(-1.0, 1.0));
    start.push_back(u);
  }
  if (bounds.empty()) return {};
  JumpBounder bounder(task_.jumps);
  bounder.setParameters(parameters);
  bounder.bound(Interval(0.0), states, start, 0.0, bounds);
  std::vector<char> result;
  bool any = false;
  for (std::size_t k = 0; k < count; ++k) {
    result.push_back(static_cast<char>(bounds[k].holds && isEqual(start[k], Interval(0.0))));
    any = any || result.back() != 0;
    // What holds one depends on the signs of others: one that leaves has not that of its argument at this moment.
    if (result.back() == 0 && !isThin(signs_[k])) return {};
  }
  return any ? result : std::vector<char>{};
}

}  // namespace gamut
