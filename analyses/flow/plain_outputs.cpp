// One program an output, so that what another one lacks does not matter.
#include "analyses/flow/plain_outputs.hpp"

#include "scalars/index.hpp"
#include "scalars/program/angles.hpp"
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

/// The value, then what it takes roots and logarithms of.
Program withArguments(const Program& g, int output) {
  std::vector<int> nodes = arguments(g, output);
  nodes.insert(nodes.begin(), output);
  return Recorder(g).finish(nodes);
}

/// Output 0 with these nodes as further parameters.
Program withNodesGiven(const Program& g, const std::vector<int>& nodes) {
  Recorder recorder(g.states(), g.parameters() + static_cast<int>(nodes.size()));
  std::vector<int> instead(g.nodes().size(), -1);
  for (std::size_t j = 0; j < nodes.size(); ++j)
    instead[at(nodes[j])] = recorder.parameter(g.parameters() + static_cast<int>(j));
  return recorder.finish({recorder.append(g, {}, instead)[at(g.outputNodes()[0])]});
}

/// The value among `found`; empty if one of the others, which roots and logarithms are taken of, may be negative.
Interval valueOf(const std::vector<Interval>& found) {
  for (std::size_t i = 1; i < found.size(); ++i)
    if (!(found[i].lower() >= 0)) return Interval::empty();
  return found[0];
}

}  // namespace

PlainOutputs::PlainOutputs(const Program& g) : states_(g.states()) {
  for (const int output : g.outputNodes()) {
    const Program own = Recorder(g).finish({output});
    Output& of = outputs_.emplace_back(withArguments(own, own.outputNodes()[0]));
    const std::vector<int> angles = halfAnglesOf(own);
    if (angles.empty()) continue;
    const Program given = withNodesGiven(own, angles);
    of.atWorst.emplace_back(withArguments(given, given.outputNodes()[0]));
    of.angles = angles.size();
    hasAngles_ = true;
  }
}

Interval PlainOutputs::over(int output, const Interval& t, const std::vector<Interval>& states,
                            const std::vector<Interval>& parameters) {
  Output& of = outputs_[at(output)];
  of.value.setParameters(parameters);
  Interval value = valueOf(of.value(t, states));
  if (isEmpty(value) && of.angles > 0) {
    std::vector<Interval> all = parameters;
    all.resize(all.size() + of.angles, hull(-halfPi(), halfPi()));
    of.atWorst[0].setParameters(all);
    value = valueOf(of.atWorst[0](t, states));
  }
  return isEmpty(value) ? Interval::entire() : value;
}

std::vector<Interval> PlainOutputs::over(double t, const Box& box) {
  const auto states = box.begin() + states_;
  const std::vector<Interval> x(box.begin(), states), p(states, box.end());
  std::vector<Interval> found;
  for (int o = 0; o < static_cast<int>(outputs_.size()); ++o) found.push_back(over(o, Interval(t), x, p));
  return found;
}

}  // namespace gamut
