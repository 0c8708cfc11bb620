// Node by node, so that what may have no value is known of each, and matters to none that does not need it.
#include "analyses/flow/outputs/plain_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include "scalars/evaluation/node.hpp"
#include "scalars/operations/all.hpp"
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

/// The first of `found`, if it has a value: none of the others, which roots and logarithms are taken of, may be
/// negative; and of no angle, the tangents of whose halves come last, may a half come to -π/2, beside which it is π/2.
Interval valueOf(const std::vector<Interval>& found, std::size_t angles) {
  const std::size_t tangents = found.size() - angles;
  for (std::size_t i = 1; i < tangents; ++i)
    if (!(found[i].lower() >= 0)) return Interval::empty();
  for (std::size_t i = tangents; i < found.size(); ++i)
    if (std::isinf(found[i].lower())) return Interval::empty();
  return found[0];
}

/// Twice the extreme: the greater is as large as either at least, and no larger than both may be; the lesser likewise.
Interval rangeOf(const Extreme& extreme, const Interval& a, const Interval& b) {
  const Interval u = Interval(extreme.byA) * a, v = Interval(extreme.byB) * b;
  if (isEmpty(u) || isEmpty(v)) return Interval::empty();
  const Interval one = extreme.isMax ? Interval(std::max(u.lower(), v.lower()), std::max(u.upper(), v.upper()))
                                     : Interval(std::min(u.lower(), v.lower()), std::min(u.upper(), v.upper()));
  return Interval(2.0) * one;
}

}  // namespace

NodeValues::NodeValues(std::shared_ptr<const Program> g)
    : g_(std::move(g)), extremeOf_(g_->nodes().size(), -1), extremes_(extremesOf(*g_)) {
  for (std::size_t k = 0; k < extremes_.size(); ++k) extremeOf_[extremes_[k].node] = static_cast<int>(k);
  for (const Node& node : g_->nodes()) isOneSided_.push_back(static_cast<char>(isOneSided(domainOf(node.op))));
  value_.resize(extremeOf_.size());
  hasNone_.assign(extremeOf_.size(), 0);
}

/// By rising number, twins and all components of solutions among them.
std::vector<int> NodeValues::neededBy(const std::vector<int>& nodes) const {
  std::vector<char> isNeeded(g_->nodes().size(), 0);
  std::vector<int> open, needed;
  const auto need = [&](int node) {
    if (std::exchange(isNeeded[node], char{1}) == 0) open.push_back(node);
  };
  std::ranges::for_each(nodes, need);
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    needed.push_back(node);
    detail::forEachTwin(g_->table(), node, need);
    detail::forEachOperand(g_->table(), node, need);
  }
  std::ranges::sort(needed);
  return needed;
}

void NodeValues::evaluate(const std::vector<int>& nodes, const Interval& t, const std::vector<Interval>& states,
                          const std::vector<Interval>& parameters) {
  for (const int node : nodes) {
    bool lacks = isOneSided_[node] != 0 && !(value_[g_->nodes()[node].a].lower() >= 0);
    detail::forEachOperand(g_->table(), node, [&](int operand) { lacks = lacks || hasNone_[operand] != 0; });
    if (const int k = extremeOf_[node]; k >= 0) {
      const Extreme& extreme = extremes_[k];
      value_[node] = rangeOf(extreme, value_[extreme.a], value_[extreme.b]);
      lacks = lacks || isEmpty(value_[node]);
    } else {
      setValue(node, t, states, parameters);
    }
    hasNone_[node] = static_cast<char>(lacks);
  }
}

/// Of a node that is no extreme; the first of twins, and of components, sets all.
void NodeValues::setValue(int node, const Interval& t, const std::vector<Interval>& states,
                          const std::vector<Interval>& parameters) {
  const Node& n = g_->nodes()[node];
  Interval& value = value_[node];
  if (n.op == Op::state) {
    value = states[n.a];
  } else if (n.op == Op::parameter) {
    value = parameters[n.a];
  } else if (n.op == Op::time) {
    value = t;
  } else if (n.op == Op::constant) {
    value = g_->constants()[n.a];
  } else if (n.op == Op::solution) {
    if (n.b != 0) return;
    LinearSystem<Interval> system;
    assign(system, g_->matrices()[g_->solutions()[n.a].matrix], value_);
    setSolution(*g_, node, system, value_);
  } else if (isFunction(n.op)) {
    if (isTwin(n.op)) return;
    const Interval argument = value_[n.a];
    Interval none, &second = hasTwin(n.op) ? value_[node + 1] : none;
    withFunction(n.op, [&](auto f) { gamut::evaluate(f, argument, value, second); });
  } else {
    setByArithmetic(n, value_, value);
  }
}

PlainOutputs::PlainOutputs(const Program& g)
    : g_(std::make_shared<const Program>(g)), outputs_(g.outputNodes().size()) {
  const std::vector<int> angles = halfAnglesOf(g);
  hasAngles_ = !angles.empty();
  if (!hasAngles_) return;
  const NodeValues values(g_);
  for (std::size_t o = 0; o < outputs_.size(); ++o) {
    const std::vector<int> needed = values.neededBy({g.outputNodes()[o]});
    outputs_[o].hasAngles =
        std::ranges::any_of(angles, [&](int angle) { return std::ranges::binary_search(needed, angle); });
  }
}

NodeValues& PlainOutputs::values() {
  if (!values_) values_.emplace(g_);
  return *values_;
}

/// Made where it is first asked for.
PlainOutputs::Angles& PlainOutputs::anglesOf(int output) {
  std::optional<Angles>& of = outputs_[output].angles;
  if (of) return *of;
  const Program own = Recorder(*g_).finish({g_->outputNodes()[output]});
  const std::vector<int> angles = halfAnglesOf(own);
  std::vector<int> nodes = own.outputNodes(), others = nodes;
  std::ranges::copy(argumentsOfRoots(own, nodes), std::back_inserter(nodes));
  const auto isOfAngle = [&](int node) {
    return std::ranges::any_of(angles, [&](int angle) { return denominatorOf(own, angle) == node; });
  };
  std::copy_if(nodes.begin() + 1, nodes.end(), std::back_inserter(others), std::not_fn(isOfAngle));
  for (const int angle : angles) nodes.push_back(own.nodes()[angle].a);
  of.emplace(Evaluator<Interval>(Recorder(own).finish(nodes)));
  of->atWorst.emplace_back(withNodesGiven(own, angles, others));
  of->coordinates.emplace_back(coordinatesOf(own, angles, of->isKnown));
  of->count = angles.size();
  return *of;
}

Interval PlainOutputs::overAngles(int output, const Interval& t, const std::vector<Interval>& states,
                                  const std::vector<Interval>& parameters) {
  Angles& of = anglesOf(output);
  of.value.setParameters(parameters);
  const Interval value = valueOf(of.value(t, states), of.count);
  of.coordinates[0].setParameters(parameters);
  const std::vector<Interval> found = of.coordinates[0](t, states);
  std::vector<Interval> all = parameters;
  for (std::size_t k = 0; k < of.count; ++k) {
    const Interval any = hull(-halfPi(), halfPi()), angle = atan2(found[2 * k], found[2 * k + 1]);
    all.push_back(of.isKnown[k] == 0 || isEmpty(angle) ? any : intersection(any, 0.5 * angle));
  }
  of.atWorst[0].setParameters(all);
  const Interval byHalves = valueOf(of.atWorst[0](t, states), 0);
  if (isEmpty(value) || isEmpty(byHalves))
    return isEmpty(hull(value, byHalves)) ? Interval::entire() : hull(value, byHalves);
  const Interval both = intersection(value, byHalves);
  return isEmpty(both) ? value : both;
}

Interval PlainOutputs::over(int output, const Interval& t, const std::vector<Interval>& states,
                            const std::vector<Interval>& parameters) {
  Output& of = outputs_[output];
  if (of.hasAngles) return overAngles(output, t, states, parameters);
  if (of.needed.empty()) of.needed = values().neededBy({g_->outputNodes()[output]});
  values().evaluate(of.needed, t, states, parameters);
  return values().known(g_->outputNodes()[output]);
}

std::vector<Interval> PlainOutputs::over(double t, const Box& box) {
  const auto states = box.begin() + g_->states();
  const std::vector<Interval> x(box.begin(), states), p(states, box.end());
  if (together_.empty()) {
    std::vector<int> plain;
    for (std::size_t o = 0; o < outputs_.size(); ++o)
      if (!outputs_[o].hasAngles) plain.push_back(g_->outputNodes()[o]);
    together_ = values().neededBy(plain);
  }
  values().evaluate(together_, Interval(t), x, p);
  std::vector<Interval> found;
  for (int o = 0; o < static_cast<int>(outputs_.size()); ++o)
    found.push_back(outputs_[o].hasAngles ? overAngles(o, Interval(t), x, p) : values().known(g_->outputNodes()[o]));
  return found;
}

}  // namespace gamut
