// One program an output, differentiated by all that it is of in one reverse sweep.
#include "analyses/flow/outputs/mean_value_outputs.hpp"

#include <algorithm>

#include "analyses/flow/outputs/plain_outputs.hpp"
#include "scalars/program/angles.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

MeanValueOutputs::MeanValueOutputs(const Program& g) {
  for (const int output : g.outputNodes()) {
    const Program own = Recorder(g).finish({output});
    if (!jumpsOf(own).empty() || !halfAnglesOf(own).empty()) {
      outputs_.emplace_back();
      continue;
    }
    Recorder recorder(own);
    std::vector<int> inputs{recorder.time()};
    for (int i = 0; i < own.states(); ++i) inputs.push_back(recorder.state(i));
    for (int k = 0; k < own.parameters(); ++k) inputs.push_back(recorder.parameter(k));
    std::vector<int> nodes = adjoints(recorder, own.outputNodes(), {recorder.constant(1.0)}, inputs);
    const std::vector<int> besides = argumentsOfRoots(own, own.outputNodes());
    nodes.insert(nodes.end(), besides.begin(), besides.end());
    outputs_.emplace_back(Output{Evaluator<Interval>(own), Evaluator<Interval>(recorder.finish(nodes))});
  }
}

Interval MeanValueOutputs::over(int output, const Interval& t, const std::vector<Interval>& states,
                                const std::vector<Interval>& parameters) {
  std::optional<Output>& of = outputs_[output];
  if (!of) return Interval::entire();
  std::vector<Interval> inputs{t};
  inputs.insert(inputs.end(), states.begin(), states.end());
  inputs.insert(inputs.end(), parameters.begin(), parameters.end());
  std::size_t worst = 0;
  const Interval result = over(*of, inputs, states.size(), &worst);
  if (!isCommon(result) || worst == inputs.size()) return result;
  // What is too wide of this interval's square falls to a 64th, of its products with others to an eighth.
  constexpr int parts = 8;
  const Interval all = inputs[worst];
  Interval together = Interval::empty();
  double from = all.lower();
  for (int part = 1; part <= parts; ++part) {
    const double to = part == parts ? all.upper() : std::clamp(from + width(all) / parts, from, all.upper());
    inputs[worst] = Interval(from, to);
    together = hull(together, over(*of, inputs, states.size()));
    from = to;
  }
  return intersection(result, together);
}

/// Along the straight way from the middle y has a derivative almost everywhere, the sum of those by t, x and p times
/// how far each goes: |u| has sign u, in the interval of the signs of u, where u is not 0, and where u stays 0 none is
/// needed. So y(q) - y(c) is in Σ ∂y/∂q_i (q_i - c_i), ∂y/∂q_i over the whole box.
Interval MeanValueOutputs::over(Output& of, const std::vector<Interval>& inputs, std::size_t states,
                                std::size_t* worst) {
  const auto firstParameter = 1 + static_cast<std::ptrdiff_t>(states);
  std::vector<Interval> middles;
  if (worst != nullptr) *worst = inputs.size();
  for (const Interval& input : inputs) {
    if (!isCommon(input)) return Interval::entire();
    middles.emplace_back(midpoint(input));
  }
  const auto part = [&](const std::vector<Interval>& from, std::ptrdiff_t begin, std::ptrdiff_t end) {
    return std::vector<Interval>(from.begin() + begin, from.begin() + end);
  };
  of.all.setParameters(part(inputs, firstParameter, std::ssize(inputs)));
  const std::vector<Interval> found = of.all(inputs[0], part(inputs, 1, firstParameter));
  for (std::size_t i = inputs.size(); i < found.size(); ++i)
    if (!(found[i].lower() >= 0)) return Interval::entire();
  of.value.setParameters(part(middles, firstParameter, std::ssize(middles)));
  Interval result = of.value(middles[0], part(middles, 1, firstParameter))[0];
  double most = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (isThin(inputs[i]) || isEqual(found[i], Interval(0.0))) continue;
    if (!isCommon(found[i])) return Interval::entire();
    const Interval by = found[i] * (inputs[i] - middles[i]);
    result += by;
    if (width(by) > most) {
      most = width(by);
      if (worst != nullptr) *worst = i;
    }
  }
  return isCommon(result) ? result : Interval::entire();
}

}  // namespace gamut
