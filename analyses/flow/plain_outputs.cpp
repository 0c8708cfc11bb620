// One program an output, so that what another one lacks does not matter.
#include "analyses/flow/plain_outputs.hpp"

#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

using detail::at;

namespace {

/// What output node `output` takes roots and logarithms of.
std::vector<int> arguments(const Program& g, int output) {
  std::vector<char> isUsed(g.nodes().size(), 0);
  std::vector<int> open{output}, found;
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    if (isUsed[at(i)] != 0) continue;
    isUsed[at(i)] = 1;
    const Node& node = g.nodes()[at(i)];
    if (node.op == Op::sqrt || node.op == Op::log) found.push_back(node.a);
    detail::forEachOperand(g.table(), i, [&](int operand) { open.push_back(operand); });
  }
  return found;
}

}  // namespace

PlainOutputs::PlainOutputs(const Program& g) : states_(g.states()) {
  for (const int output : g.outputNodes()) {
    std::vector<int> nodes = arguments(g, output);
    nodes.insert(nodes.begin(), output);
    outputs_.emplace_back(Recorder(g).finish(nodes));
  }
}

Interval PlainOutputs::over(int output, const Interval& t, const std::vector<Interval>& states,
                            const std::vector<Interval>& parameters) {
  Evaluator<Interval>& evaluate = outputs_[at(output)];
  evaluate.setParameters(parameters);
  const std::vector<Interval> found = evaluate(t, states);
  for (std::size_t i = 1; i < found.size(); ++i)
    if (!(found[i].lower() >= 0)) return Interval::entire();
  return isEmpty(found[0]) ? Interval::entire() : found[0];
}

std::vector<Interval> PlainOutputs::over(double t, const Box& box) {
  const auto states = box.begin() + states_;
  const std::vector<Interval> x(box.begin(), states), p(states, box.end());
  std::vector<Interval> found;
  for (int o = 0; o < static_cast<int>(outputs_.size()); ++o) found.push_back(over(o, Interval(t), x, p));
  return found;
}

}  // namespace gamut
