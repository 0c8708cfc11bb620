// Programs with inputs as states.
#include "analyses/flow/formulation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

using detail::at;

namespace {

Program differentiatedFor(const Program& f, const std::vector<VaryingParameter>& inputs) {
  if (inputs.empty()) return f.differentiated();
  const Program all = f.differentiated(true);
  const int n = f.states(), k = f.parameters();
  std::vector<int> outputs(all.outputNodes().begin(), all.outputNodes().begin() + n + n * n);
  for (int i = 0; i < n; ++i)
    for (const VaryingParameter& input : inputs)
      outputs.push_back(all.outputNodes()[at(n + n * n + i * k + input.parameter)]);
  return Recorder(all).finish(outputs);
}

}  // namespace

FlowFormulation::FlowFormulation(Program f, Program g, std::vector<VaryingParameter> varying)
    : motion(std::move(f)),
      differentiated(differentiatedFor(motion, varying)),
      outputs(std::move(g)),
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
        parameters[at(input.parameter)] = recorder.state(next++);
        rates.push_back(recorder.parameter(input.parameter));
      }
    const std::vector<int> here = recorder.append(program, parameters);
    std::vector<int> results;
    for (const int output : program.outputNodes()) results.push_back(here[at(output)]);
    if (withRates) results.insert(results.end(), rates.begin(), rates.end());
    return recorder.finish(results);
  };
  FlowFormulation result(written(motion, true), written(outputs, false), inputs);
  result.states = states;
  return result;
}

Box FlowFormulation::boxOf(const Box& box) const {
  if (motion.states() == states) return box;
  Box result = box;
  auto place = result.begin() + states;
  for (const VaryingParameter& input : inputs)
    if (std::isfinite(input.rate)) place = result.insert(place, box[at(states + input.parameter)]) + 1;
  for (const VaryingParameter& input : inputs)
    if (std::isfinite(input.rate)) result[at(motion.states() + input.parameter)] = Interval(-input.rate, input.rate);
  return result;
}

double FlowFormulation::horizonOf(const Box& box, double horizon) const {
  constexpr double widest = 4;  // of w as a state, in widths of its interval
  for (const VaryingParameter& input : inputs)
    if (std::isfinite(input.rate))
      horizon = std::min(horizon, 0.5 * widest * width(box[at(states + input.parameter)]) / input.rate);
  return horizon;
}

}  // namespace gamut
