// Arguments, rates and pushes by intervals.
#include "analyses/flow/step/kinks.hpp"

#include <algorithm>
#include <utility>

#include "analyses/flow/series/embedded.hpp"
#include "scalars/index.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/expression.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

using detail::at;

namespace {

/// The nodes that the first outputs, one a state, need.
std::vector<char> neededByRates(const Program& differentiated) {
  std::vector<char> isNeeded(differentiated.nodes().size(), 0);
  for (int i = 0; i < differentiated.states(); ++i) isNeeded[differentiated.outputNodes()[i]] = 1;
  for (std::size_t i = isNeeded.size(); i-- > 0;)
    if (isNeeded[i] != 0)
      detail::forEachOperand(differentiated.table(), static_cast<int>(i), [&](int operand) { isNeeded[operand] = 1; });
  return isNeeded;
}

/// Of each node, whether it depends on a state, and on nothing that bends, jumps or varies.
std::vector<char> curvesOf(const Program& f, const std::vector<int>& varying) {
  std::vector<char> moves, isRough, result;
  for (std::size_t i = 0; i < f.nodes().size(); ++i) {
    const Node& node = f.nodes()[i];
    bool does = node.op == Op::state, rough = !isSmooth(node.op);
    rough = rough || (node.op == Op::parameter && std::ranges::find(varying, node.a) != varying.end());
    detail::forEachOperand(f.table(), static_cast<int>(i), [&](int operand) {
      does = does || moves[operand] != 0;
      rough = rough || isRough[operand] != 0;
    });
    moves.push_back(static_cast<char>(does));
    isRough.push_back(static_cast<char>(rough));
    result.push_back(static_cast<char>(does && !rough));
  }
  return result;
}

/// Whether a sign or an absolute value has another argument that is the same operations: constants that are no doubles
/// then count as one number by their enclosures (expression.hpp), but are two, for one number is one node.
bool isAmbiguous(const Program& f, int argument) {
  for (const Node& node : f.nodes())
    if ((node.op == Op::abs || node.op == Op::sign) && node.a != argument && isSameExpression(f, node.a, f, argument))
      return true;
  return false;
}

/// The nodes |u| that f needs, of linear u without inputs and, if they are few, of such that are not linear.
std::vector<int> kinksOf(const Program& differentiated, const std::vector<int>& varying, bool withCurved,
                         std::vector<KinkArgument>& arguments) {
  constexpr std::size_t most = 4;  // each asks for a step of its own where it is passed
  const std::vector<char> isNeeded = neededByRates(differentiated), isCurve = curvesOf(differentiated, varying);
  std::vector<std::pair<int, std::optional<LinearForm>>> found;
  for (std::size_t i = 0; i < isNeeded.size(); ++i) {
    const Node& node = differentiated.nodes()[i];
    if (isNeeded[i] == 0 || node.op != Op::abs) continue;
    auto form = linearFormOf(differentiated, node.a);
    bool isKnown = form || (withCurved && isCurve[node.a] != 0 && !isAmbiguous(differentiated, node.a));
    for (const int input : varying) isKnown = isKnown && (!form || form->parameters[input] == 0);
    if (isKnown) found.emplace_back(static_cast<int>(i), std::move(form));
  }
  const auto isCurved = [](const auto& kink) { return !kink.second; };
  if (at(std::ranges::count_if(found, isCurved)) > std::max(most, at(differentiated.states())))
    std::erase_if(found, isCurved);
  std::vector<int> nodes;
  for (const auto& [node, form] : found) {
    nodes.push_back(node);
    arguments.push_back(kinkArgumentOf(differentiated, differentiated.nodes()[node].a));
  }
  return nodes;
}

std::vector<std::size_t> curvedOf(const std::vector<KinkArgument>& arguments) {
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < arguments.size(); ++k)
    if (!arguments[k].form) result.push_back(k);
  return result;
}

/// f, with the nodes |u| as parameters behind its own, then the rates of those u that are curved.
Program withKinksGiven(const Program& differentiated, const std::vector<int>& nodes,
                       const std::vector<std::size_t>& curved) {
  const int n = differentiated.states(), k = differentiated.parameters();
  Recorder recorder(n, k + static_cast<int>(nodes.size()));
  std::vector<int> instead(differentiated.nodes().size(), -1), outputs, arguments;
  for (std::size_t j = 0; j < nodes.size(); ++j) instead[nodes[j]] = recorder.parameter(k + static_cast<int>(j));
  const std::vector<int> here = recorder.append(differentiated, {}, instead);
  std::vector<std::pair<int, int>> seeds{{recorder.time(), recorder.constant(1.0)}};
  for (int i = 0; i < n; ++i) {
    outputs.push_back(here[differentiated.outputNodes()[i]]);
    seeds.emplace_back(recorder.state(i), outputs.back());
  }
  for (const std::size_t j : curved) arguments.push_back(here[differentiated.nodes()[nodes[j]].a]);
  const std::vector<int> rates = tangents(recorder, arguments, seeds);
  outputs.insert(outputs.end(), rates.begin(), rates.end());
  return recorder.finish(outputs);
}

/// The arguments that are curved.
Program curvesOf(const Program& differentiated, const std::vector<int>& nodes, const std::vector<std::size_t>& curved) {
  std::vector<int> outputs;
  for (const std::size_t k : curved) outputs.push_back(differentiated.nodes()[nodes[k]].a);
  return Recorder(differentiated).finish(outputs);
}

/// Derivatives of the first outputs, one a state, by the last `count` parameters.
Program byKinks(const Program& given, std::size_t count) {
  if (count == 0) return given;
  const std::size_t n = at(given.states()), k = at(given.parameters()), m = at(given.outputs());
  const Program all = given.differentiated(true);
  std::vector<int> columns;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = k - count; j < k; ++j) columns.push_back(all.outputNodes()[m + m * n + i * k + j]);
  return Recorder(all).finish(columns);
}

}  // namespace

FlowKinks::FlowKinks(const Program& differentiated, const std::vector<int>& varying, bool withCurved)
    : nodes_(kinksOf(differentiated, varying, withCurved, arguments_)),
      curved_(curvedOf(arguments_)),
      motion_(withKinksGiven(differentiated, {}, {})),
      given_(withKinksGiven(differentiated, nodes_, curved_)),
      pushes_(byKinks(given_, nodes_.size())),
      ofCurved_(curvesOf(differentiated, nodes_, curved_)),
      f_(given_),
      columns_(pushes_),
      u_(ofCurved_) {}

Program FlowKinks::curvesAlong(const Program& f) const {
  Recorder recorder(f.states(), f.parameters());
  const std::vector<int> here = recorder.append(f);
  std::vector<std::pair<int, int>> seeds{{recorder.time(), recorder.constant(1.0)}};
  for (int i = 0; i < f.states(); ++i) seeds.emplace_back(recorder.state(i), here[f.outputNodes()[i]]);
  const std::vector<int> all = recorder.append(ofCurved_);
  std::vector<int> outputs;
  for (const int output : ofCurved_.outputNodes()) outputs.push_back(all[output]);
  const std::vector<int> rates = tangents(recorder, outputs, seeds);
  outputs.insert(outputs.end(), rates.begin(), rates.end());
  return recorder.finish(outputs);
}

std::vector<Interval> FlowKinks::arguments(const Interval& time, const Box& box,
                                           const std::vector<Embedded>& parameters) {
  const Box ranges = rangesOf(parameters);
  std::vector<Interval> u(count()), ofCurved(curved_.size());
  for (std::size_t k = 0; k < count(); ++k)
    if (isStraight(k)) u[k] = rangeOf(form(k), box, ranges);
  if (!curved_.empty()) {
    u_.setParameters(ranges);
    u_(time, box, ofCurved);
  }
  for (std::size_t j = 0; j < curved_.size(); ++j) u[curved_[j]] = ofCurved[j];
  return u;
}

void FlowKinks::bound(const Interval& time, const Box& box, const std::vector<Embedded>& parameters,
                      std::vector<Interval>& u, std::vector<Interval>& rates) {
  time_ = time;
  box_ = box;
  u = arguments(time, box, parameters);
  all_ = rangesOf(parameters);
  for (const Interval& argument : u) all_.push_back(abs(argument));
  f_.setParameters(all_);
  std::vector<Interval> f(box.size() + curved_.size());
  f_(time, box, f);
  rates.assign(count(), Interval(0.0));
  for (std::size_t k = 0; k < count(); ++k)
    for (std::size_t i = 0; i < box.size() && isStraight(k); ++i)
      if (form(k).states[i] != 0) rates[k] += Interval(form(k).states[i]) * f[i];
  for (std::size_t j = 0; j < curved_.size(); ++j) rates[curved_[j]] = f[box.size() + j];
  for (std::size_t k = 0; k < u.size(); ++k) {
    const double most = magnitude(u[k]);
    all_[parameters.size() + k] = Interval(-most, most);
  }
}

std::vector<Interval> FlowKinks::pushOf(std::size_t kink) {
  std::vector<Interval> columns(box_.size() * count()), result;
  columns_.setParameters(all_);
  columns_(time_, box_, columns);
  for (std::size_t i = 0; i < box_.size(); ++i) result.push_back(columns[i * count() + kink]);
  return result;
}

}  // namespace gamut
