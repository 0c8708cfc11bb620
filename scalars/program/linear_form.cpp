// Forms of nodes, from those of their operands.
#include "scalars/program/linear_form.hpp"

#include <algorithm>
#include <cmath>

#include "scalars/index.hpp"

namespace gamut {

using detail::at;

std::optional<LinearForm> linearFormOf(const Program& f, int node) {
  std::vector<std::optional<LinearForm>> forms;
  LinearForm zero;
  zero.states.assign(at(f.states()), 0.0);
  zero.parameters.assign(at(f.parameters()), 0.0);
  const auto combined = [](const LinearForm& a, const Interval& by, const LinearForm& b) -> std::optional<LinearForm> {
    LinearForm sum = a;
    bool isExact = true;
    const auto add = [&](double& to, double more) {
      const Interval exact = Interval(to) + by * Interval(more);
      isExact = isExact && isThin(exact);
      to = exact.lower();
    };
    for (std::size_t i = 0; i < sum.states.size(); ++i) add(sum.states[i], b.states[i]);
    for (std::size_t i = 0; i < sum.parameters.size(); ++i) add(sum.parameters[i], b.parameters[i]);
    sum.constant = a.constant + by * b.constant;
    return isExact ? std::optional(sum) : std::nullopt;
  };
  for (int i = 0; i <= node; ++i) {
    const Node& n = f.nodes()[at(i)];
    std::optional<LinearForm> form;
    const auto operand = [&](int which) -> const std::optional<LinearForm>& { return forms[at(which)]; };
    const auto constant = [&](int which) {
      const Node& of = f.nodes()[at(which)];
      return of.op == Op::constant ? f.constants()[at(of.a)] : Interval::entire();
    };
    switch (n.op) {
      case Op::state:
        form = zero;
        form->states[at(n.a)] = 1;
        break;
      case Op::parameter:
        form = zero;
        form->parameters[at(n.a)] = 1;
        break;
      case Op::constant:
        form = zero;
        form->constant = f.constants()[at(n.a)];
        break;
      case Op::add:
      case Op::sub:
        if (operand(n.a) && operand(n.b))
          form = combined(*operand(n.a), Interval(n.op == Op::add ? 1.0 : -1.0), *operand(n.b));
        break;
      case Op::neg:
        if (operand(n.a)) form = combined(zero, Interval(-1.0), *operand(n.a));
        break;
      case Op::mul:
        if (isThin(constant(n.a)) && operand(n.b))
          form = combined(zero, constant(n.a), *operand(n.b));
        else if (isThin(constant(n.b)) && operand(n.a))
          form = combined(zero, constant(n.b), *operand(n.a));
        break;
      default:
        break;
    }
    forms.push_back(std::move(form));
  }
  std::optional<LinearForm> result = std::move(forms.back());
  if (!result) return result;
  const auto size = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  result->pivot = static_cast<int>(std::ranges::max_element(result->states, size) - result->states.begin());
  if (result->states.empty() || result->states[at(result->pivot)] == 0) result.reset();
  return result;
}

double sameForm(const LinearForm& a, const LinearForm& b, const std::vector<char>& zeros) {
  for (const double factor : {1.0, -1.0}) {
    bool isSame = true;
    for (std::size_t i = 0; i < zeros.size(); ++i)
      isSame = isSame && (zeros[i] != 0 || a.states[i] == factor * b.states[i]);
    for (std::size_t k = 0; k < a.parameters.size(); ++k)
      isSame = isSame && a.parameters[k] == factor * b.parameters[k];
    if (isSame) return factor;
  }
  return 0;
}

bool isOfOneState(const LinearForm& form) {
  return std::ranges::count_if(form.states, [](double by) { return by != 0; }) == 1;
}

int zeroOf(const LinearForm& form) {
  const bool isAlone = isOfOneState(form) && std::ranges::all_of(form.parameters, [](double by) { return by == 0; }) &&
                       isEqual(form.constant, Interval(0.0));
  return isAlone ? form.pivot : -1;
}

}  // namespace gamut
