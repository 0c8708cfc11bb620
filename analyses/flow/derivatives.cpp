// The box of the variational equations: ∂x/∂q starts as a unit vector for an initial value, as zero for a parameter.
#include "analyses/flow/derivatives.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "analyses/flow/embedding.hpp"
#include "scalars/index.hpp"
#include "scalars/program/differentiation.hpp"

namespace gamut {

using detail::at;

namespace {

/// Names of states or outputs and of their derivatives, where there are names.
std::vector<std::string> extendedNames(std::vector<std::string> names, std::size_t count, std::size_t by) {
  if (names.empty()) return names;
  names.resize(count);
  for (std::size_t i = 0, all = count * by; i < all; ++i)
    names.push_back("derivative " + std::to_string(i / count) + " of " + names[i % count]);
  return names;
}

/// Of the flow along derivatives by these components.
FlowOptions checked(FlowOptions options, int states, int outputs, const std::vector<int>& which) {
  for (const VaryingParameter& input : options.varying)
    requireThat(std::ranges::find(which, states + input.parameter) == which.end(),
                "there is no derivative by what varies in time");
  const std::size_t by = which.size();
  for (PreciseValue& value : options.precise)  // parameters stand behind the derivatives
    if (value.component >= states) value.component += states * static_cast<int>(by);
  options.stateNames = extendedNames(std::move(options.stateNames), at(states), by);
  options.outputNames = extendedNames(std::move(options.outputNames), at(outputs), by);
  return options;
}

/// At a jump of f solutions have derivatives that jump too, which the variational equations do not know.
const Program& checkedForJumps(const Program& f, const std::vector<int>& by) {
  std::vector<char> varies(f.nodes().size(), 0);
  for (std::size_t i = 0; i < varies.size(); ++i) {
    const Node& v = f.nodes()[i];
    varies[i] = v.op == Op::state || (v.op == Op::parameter && std::ranges::find(by, f.states() + v.a) != by.end());
    detail::forEachOperand(f.table(), static_cast<int>(i), [&](int operand) { varies[i] |= varies[operand]; });
    requireThat(v.op != Op::sign || !varies[i],
                "there are no derivatives across a jump (sign, where) of what they are by");
  }
  return f;
}

Program noOutputs(const Program& f) {
  return record(f.states(), f.parameters(), 0, [](const auto&, const auto&, const auto&, auto&) {});
}

}  // namespace

DerivativeFlow::DerivativeFlow(const Program& f, std::vector<int> by, FlowOptions options)
    : DerivativeFlow(f, noOutputs(f), std::move(by), std::move(options)) {}

DerivativeFlow::DerivativeFlow(const Program& f, const Program& g, std::vector<int> by, FlowOptions options)
    : states_(f.states()),
      parameters_(f.parameters()),
      outputs_(g.outputs()),
      by_(std::move(by)),
      flow_(alongDerivatives(checkedForJumps(f, by_), by_), alongDerivatives(checkedForJumps(g, by_), by_),
            checked(std::move(options), states_, outputs_, by_)) {}

Box DerivativeFlow::extended(const Box& box) const {
  requireThat(box.size() == at(states_ + parameters_),
              "the box needs " + std::to_string(states_) + " initial values and " + std::to_string(parameters_) +
                  " parameters, not " + std::to_string(box.size()) + " numbers");
  const auto parameters = box.begin() + states_;
  Box result(box.begin(), parameters);
  for (const int q : by_)
    for (int i = 0; i < states_; ++i) result.emplace_back(i == q ? 1.0 : 0.0);
  result.insert(result.end(), parameters, box.end());
  return result;
}

Tube DerivativeFlow::enclose(const Box& box, double horizon, const std::vector<double>& outputTimes,
                             const std::vector<Box>& levels) const {
  std::vector<Box> inner;
  for (const Box& level : levels) inner.push_back(extended(level));
  return flow_.enclose(extended(box), horizon, outputTimes, inner);
}

std::size_t DerivativeFlow::derivative(int of, int which) const { return at(states_ * (1 + which) + of); }

std::size_t DerivativeFlow::outputDerivative(int of, int which) const { return at(outputs_ * (1 + which) + of); }

}  // namespace gamut
