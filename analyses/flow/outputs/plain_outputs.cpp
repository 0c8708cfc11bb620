// One program an output where some may have no value, so that what another one lacks does not matter.
#include "analyses/flow/outputs/plain_outputs.hpp"

#include <algorithm>
#include <utility>

#include "scalars/program/angles.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

bool dependsOnTime(const Program& program) {
  const std::vector<Node>& nodes = program.nodes();
  const auto isTime = [&](int node) { return nodes[node].op == Op::time; };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    bool does = false;
    detail::forEachOperand(program.table(), static_cast<int>(i), [&](int operand) { does = does || isTime(operand); });
    if (does) return true;
  }
  return std::ranges::any_of(program.outputNodes(), isTime);
}

std::vector<int> argumentsOfRoots(const Program& g, std::vector<int> open) {
  std::vector<char> isUsed(g.nodes().size(), 0);
  std::vector<int> found;
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    if (isUsed[i] != 0) continue;
    isUsed[i] = 1;
    const Node& node = g.nodes()[i];
    if (isOneSided(domainOf(node.op))) found.push_back(node.a);
    detail::forEachOperand(g.table(), i, [&](int operand) { open.push_back(operand); });
  }
  return found;
}

namespace {

/// The values of these nodes, then what they take roots and logarithms of.
Program withArguments(const Program& g, std::vector<int> nodes) {
  const std::vector<int> besides = argumentsOfRoots(g, nodes);
  nodes.insert(nodes.end(), besides.begin(), besides.end());
  return Recorder(g).finish(nodes);
}

/// These nodes with those of `given` as further parameters; what only others need is not written down again.
Program withNodesGiven(const Program& g, const std::vector<int>& given, const std::vector<int>& nodes) {
  Recorder recorder(g.states(), g.parameters() + static_cast<int>(given.size()));
  std::vector<int> instead(g.nodes().size(), recorder.time()), outputs, open;
  const auto need = [&](int node) {
    if (instead[node] >= 0) open.push_back(node);
    instead[node] = -1;
  };
  std::ranges::for_each(nodes, need);
  std::vector<char> isGiven(g.nodes().size(), 0);
  for (const int node : given) isGiven[node] = 1;
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    if (isGiven[node] != 0) continue;
    detail::forEachTwin(g.table(), node, need);
    detail::forEachOperand(g.table(), node, need);
  }
  for (std::size_t j = 0; j < given.size(); ++j)
    instead[given[j]] = recorder.parameter(g.parameters() + static_cast<int>(j));
  const std::vector<int> here = recorder.append(g, {}, instead);
  for (const int node : nodes) outputs.push_back(here[node]);
  return recorder.finish(outputs);
}

/// Whether none of the others, which roots and logarithms are taken of, may be negative.
bool areDefined(const std::vector<Interval>& found, std::size_t values) {
  for (std::size_t i = values; i < found.size(); ++i)
    if (!(found[i].lower() >= 0)) return false;
  return true;
}

/// The first of `found`, if it has a value.
Interval valueOf(const std::vector<Interval>& found) { return areDefined(found, 1) ? found[0] : Interval::empty(); }

/// Twice the extreme: the greater is as large as either at least, and no larger than both may be; the lesser likewise.
Interval rangeOf(const Extreme& extreme, const Interval& a, const Interval& b) {
  const Interval u = Interval(extreme.byA) * a, v = Interval(extreme.byB) * b;
  if (isEmpty(u) || isEmpty(v)) return Interval::empty();
  const Interval one = extreme.isMax ? Interval(std::max(u.lower(), v.lower()), std::max(u.upper(), v.upper()))
                                     : Interval(std::min(u.lower(), v.lower()), std::min(u.upper(), v.upper()));
  return Interval(2.0) * one;
}

}  // namespace

PlainOutputs::PlainOutputs(const Program& g)
    : g_(g), hasAngles_(!halfAnglesOf(g).empty()), outputs_(g.outputNodes().size()) {
  if (!hasAngles_ && extremesOf(g).empty() && argumentsOfRoots(g, g.outputNodes()).empty()) together_.emplace(g);
}

PlainOutputs::Output& PlainOutputs::apart(int output) {
  if (outputs_[output]) return *outputs_[output];
  const Program own = Recorder(g_).finish({g_.outputNodes()[output]});
  std::vector<int> given;
  std::vector<Given> extremes;
  const bool hasAngles = !halfAnglesOf(own).empty();  // these need what they are made of as a whole
  for (const Extreme& extreme : hasAngles ? std::vector<Extreme>{} : extremesOf(own)) {
    const Program both = withNodesGiven(own, given, {extreme.a, extreme.b});
    extremes.push_back({Evaluator<Interval>(withArguments(both, both.outputNodes())), extreme});
    given.push_back(extreme.node);
  }
  const Program rest = withNodesGiven(own, given, own.outputNodes());
  Output& of = outputs_[output].emplace(withArguments(rest, rest.outputNodes()));
  of.extremes = std::move(extremes);
  const std::vector<int> angles = halfAnglesOf(rest);
  if (angles.empty()) return of;
  const Program atWorst = withNodesGiven(rest, angles, rest.outputNodes());
  of.atWorst.emplace_back(withArguments(atWorst, atWorst.outputNodes()));
  of.angles = angles.size();
  return of;
}

Interval PlainOutputs::over(int output, const Interval& t, const std::vector<Interval>& states,
                            const std::vector<Interval>& parameters) {
  Output& of = apart(output);
  std::vector<Interval> all = parameters;
  for (Given& given : of.extremes) {
    given.ofBoth.setParameters(all);
    const std::vector<Interval> found = given.ofBoth(t, states);
    const Interval range = areDefined(found, 2) ? rangeOf(given.extreme, found[0], found[1]) : Interval::empty();
    if (isEmpty(range)) return Interval::entire();
    all.push_back(range);
  }
  of.value.setParameters(all);
  Interval value = valueOf(of.value(t, states));
  if (isEmpty(value) && of.angles > 0) {
    all.resize(all.size() + of.angles, hull(-halfPi(), halfPi()));
    of.atWorst[0].setParameters(all);
    value = valueOf(of.atWorst[0](t, states));
  }
  return isEmpty(value) ? Interval::entire() : value;
}

std::vector<Interval> PlainOutputs::over(double t, const Box& box) {
  const auto states = box.begin() + g_.states();
  const std::vector<Interval> x(box.begin(), states), p(states, box.end());
  std::vector<Interval> found;
  if (together_) {
    together_->setParameters(p);
    found = (*together_)(Interval(t), x);
    for (Interval& value : found) value = isEmpty(value) ? Interval::entire() : value;
  } else {
    for (int o = 0; o < static_cast<int>(outputs_.size()); ++o) found.push_back(over(o, Interval(t), x, p));
  }
  return found;
}

}  // namespace gamut
