// Programs with inputs as states.
#include "analyses/flow/formulation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analyses/flow/outputs/plain_outputs.hpp"
#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

using detail::at;

namespace {

/// The outputs of `all` = f.differentiated(): f's first n rows, their Jacobian, columns of inputs and of the parameters
/// from `signs` on; then what else f has for outputs, without derivatives.
Program selected(const Program& all, int functions, const Program& f, const std::vector<VaryingParameter>& inputs,
                 int signs) {
  const int n = f.states(), k = f.parameters();
  const std::vector<int>& from = all.outputNodes();
  std::vector<int> outputs(from.begin(), from.begin() + n);
  outputs.insert(outputs.end(), from.begin() + functions, from.begin() + functions + n * n);
  for (int i = 0; i < n; ++i)
    for (const VaryingParameter& input : inputs)
      outputs.push_back(from[functions + functions * n + i * k + input.parameter]);
  for (int i = 0; i < n; ++i)
    for (int parameter = signs; parameter < k; ++parameter)
      outputs.push_back(from[functions + functions * n + i * k + parameter]);
  outputs.insert(outputs.end(), from.begin() + n, from.begin() + functions);
  return Recorder(all).finish(outputs);
}

/// Of each node, whether it depends on a parameter from number `first` on.
std::vector<char> dependents(const Program& program, int first) {
  std::vector<char> result;
  for (std::size_t i = 0; i < program.nodes().size(); ++i) {
    const Node& node = program.nodes()[i];
    bool does = node.op == Op::parameter && node.a >= first;
    detail::forEachOperand(program.table(), static_cast<int>(i),
                           [&](int operand) { does = does || result[operand] != 0; });
    result.push_back(static_cast<char>(does));
  }
  return result;
}

}  // namespace

std::vector<char> bentStates(const Program& f) {
  std::vector<char> bent(f.states(), 0);
  std::vector<std::vector<char>> on;  // of each node, which states it depends on
  const auto bend = [&](int node) {
    for (std::size_t i = 0; i < bent.size(); ++i) bent[i] = static_cast<char>(bent[i] != 0 || on[node][i] != 0);
  };
  const auto depends = [&](int node) { return std::ranges::count(on[node], 0) < f.states(); };
  for (std::size_t i = 0; i < f.nodes().size(); ++i) {
    const Node& node = f.nodes()[i];
    std::vector<char> own(bent.size(), 0);
    if (node.op == Op::state) own[node.a] = 1;
    bool isLinear = node.op == Op::add || node.op == Op::sub || node.op == Op::neg || node.op == Op::abs;
    if (node.op == Op::mul) isLinear = !depends(node.a) || !depends(node.b);
    if (node.op == Op::sign) isLinear = true;
    detail::forEachOperand(f.table(), static_cast<int>(i), [&](int operand) {
      if (!isLinear) bend(operand);
      for (std::size_t k = 0; k < own.size() && node.op != Op::sign; ++k)
        own[k] = static_cast<char>(own[k] != 0 || on[operand][k] != 0);
    });
    on.push_back(std::move(own));
  }
  return bent;
}

/// Signs in f are inputs to it: nodes of their own, which the derivative of |u| has no part in.
Program differentiatedFor(const Program& motion, const std::vector<VaryingParameter>& inputs) {
  const Program f = affineInSign(withOneSignASurface(withJumpingKinks(withBareSigns(withBareKinks(motion)))));
  const int n = f.states(), k = f.parameters(), jumps = static_cast<int>(jumpsOf(f).size());
  if (jumps == 0 || !isAffineInSigns(f))
    return inputs.empty() ? f.differentiated() : selected(f.differentiated(true), n, f, inputs, k);
  const Program given = withSignsGiven(f);
  const Program functions =
      Recorder(given).finish({given.outputNodes().begin(), given.outputNodes().begin() + n + jumps});
  const Program signless = selected(functions.differentiated(true), n + jumps, functions, inputs, k);
  Recorder recorder(n, k, RuleSet::none());
  std::vector<int> parameters;
  for (int i = 0; i < k; ++i) parameters.push_back(recorder.parameter(i));
  parameters.resize(k + jumps, recorder.constant(0.0));
  const std::vector<int> without = recorder.append(signless, parameters);
  const std::vector<int>& all = signless.outputNodes();
  for (int j = 0; j < jumps; ++j) parameters[k + j] = recorder.sign(without[all[all.size() - at(jumps) + at(j)]]);
  std::vector<int> instead = without, outputs;
  const std::vector<char> depend = dependents(signless, k);
  for (std::size_t i = 0; i < instead.size(); ++i)
    if (depend[i] != 0) instead[i] = -1;
  const std::vector<int> here = recorder.append(signless, parameters, instead);
  for (std::size_t o = 0; o + at(jumps) < all.size(); ++o) outputs.push_back(here[all[o]]);
  return recorder.finish(outputs);
}

FlowFormulation::FlowFormulation(Program f, Program g, std::vector<VaryingParameter> varying, Program besides)
    : motion(std::move(f)),
      differentiated(differentiatedFor(motion, varying)),
      outputs(std::move(g)),
      asides(std::move(besides)),
      states(motion.states()),
      inputs(std::move(varying)) {}

FlowFormulation FlowFormulation::ofRates() const {
  const int limited = static_cast<int>(
      std::ranges::count_if(inputs, [](const VaryingParameter& input) { return std::isfinite(input.rate); }));
  const auto written = [&](const Program& program, bool withRates) {
    Recorder recorder(states + limited, motion.parameters());
    std::vector<int> parameters, rates;
    for (int i = 0; i < motion.parameters(); ++i) parameters.push_back(recorder.parameter(i));
    int next = states;
    for (const VaryingParameter& input : inputs)
      if (std::isfinite(input.rate)) {
        parameters[input.parameter] = recorder.state(next++);
        rates.push_back(recorder.parameter(input.parameter));
      }
    const std::vector<int> here = recorder.append(program, parameters);
    std::vector<int> results;
    for (const int output : program.outputNodes()) results.push_back(here[output]);
    if (withRates) results.insert(results.end(), rates.begin(), rates.end());
    return recorder.finish(results);
  };
  FlowFormulation result(written(motion, true), written(outputs, false), inputs, written(asides, false));
  result.states = states;
  return result;
}

FlowFormulation FlowFormulation::withClock() const {
  const auto written = [&](const Program& program, bool isMotion) {
    Recorder recorder(states + 1, motion.parameters());
    const int clock = recorder.state(states);
    std::vector<int> instead(program.nodes().size(), -1);
    for (std::size_t i = 0; i < instead.size(); ++i)
      if (program.nodes()[i].op == Op::time) instead[i] = clock;
    const std::vector<int> here = recorder.append(program, {}, instead);
    std::vector<int> results;
    for (const int output : program.outputNodes()) results.push_back(here[output]);
    if (isMotion) results.push_back(recorder.constant(1.0));
    return recorder.finish(results);
  };
  FlowFormulation result(written(motion, true), written(outputs, false), {}, written(asides, false));
  result.states = states;
  result.hasClock = true;
  return result;
}

void boundStarts(Box& box, const Program& starts) {
  const std::vector<Interval> ranges = PlainOutputs(starts).over(0.0, box);
  std::ranges::copy(ranges, box.begin() + (starts.states() - starts.outputs()));
}

Box FlowFormulation::boxOf(const Box& box) const {
  if (motion.states() == states) return box;
  Box result = box;
  if (hasClock) result.insert(result.begin() + states, Interval(0.0));
  if (starts.outputs() > 0) {
    const auto behind = result.begin() + motion.states() - starts.outputs();
    result.insert(behind, at(starts.outputs()), Interval(0.0));
    boundStarts(result, starts);
  }
  if (hasClock || starts.outputs() > 0) return result;
  auto place = result.begin() + states;
  for (const VaryingParameter& input : inputs)
    if (std::isfinite(input.rate)) place = result.insert(place, box[states + input.parameter]) + 1;
  for (const VaryingParameter& input : inputs)
    if (std::isfinite(input.rate)) result[motion.states() + input.parameter] = Interval(-input.rate, input.rate);
  return result;
}

double FlowFormulation::horizonOf(const Box& box, double horizon) const {
  constexpr double widest = 4;  // of w as a state, in widths of its interval
  for (const VaryingParameter& input : inputs)
    if (std::isfinite(input.rate))
      horizon = std::min(horizon, 0.5 * widest * width(box[states + input.parameter]) / input.rate);
  return horizon;
}

}  // namespace gamut
