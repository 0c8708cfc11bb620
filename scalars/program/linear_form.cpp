// Forms of nodes, from those of their operands.
#include "scalars/program/linear_form.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace gamut {

Interval rangeOf(const LinearForm& form, std::span<const Interval> states, std::span<const Interval> parameters) {
  Interval sum = form.constant;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (form.states[i] != 0) sum += Interval(form.states[i]) * states[i];
  for (std::size_t k = 0; k < std::min(parameters.size(), form.parameters.size()); ++k)
    if (form.parameters[k] != 0) sum += Interval(form.parameters[k]) * parameters[k];
  return sum;
}

Interval rangeWithout(std::size_t but, const LinearForm& form, std::span<const Interval> states,
                      std::span<const Interval> parameters) {
  Interval sum = rangeOf(form, {}, parameters);
  for (std::size_t i = 0; i < states.size(); ++i)
    if (form.states[i] != 0 && i != but) sum += Interval(form.states[i]) * states[i];
  return sum;
}

namespace {

/// a + by b, if its coefficients are exact.
std::optional<LinearForm> combined(const LinearForm& a, const Interval& by, const LinearForm& b) {
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
}

}  // namespace

std::optional<LinearForm> linearFormOf(const Program& f, int node) {
  std::vector<std::optional<LinearForm>> forms;
  LinearForm zero;
  zero.states.assign(f.states(), 0.0);
  zero.parameters.assign(f.parameters(), 0.0);
  for (int i = 0; i <= node; ++i) {
    const Node& n = f.nodes()[i];
    std::optional<LinearForm> form;
    const auto operand = [&](int which) -> const std::optional<LinearForm>& { return forms[which]; };
    const auto constant = [&](int which) {
      const Node& of = f.nodes()[which];
      return of.op == Op::constant ? f.constants()[of.a] : Interval::entire();
    };
    switch (n.op) {
      case Op::state:
        form = zero;
        form->states[n.a] = 1;
        break;
      case Op::parameter:
        form = zero;
        form->parameters[n.a] = 1;
        break;
      case Op::constant:
        form = zero;
        form->constant = f.constants()[n.a];
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
  if (result->states.empty() || result->states[result->pivot] == 0) result.reset();
  return result;
}

std::vector<std::pair<std::size_t, int>> statesThatFollow(const std::vector<const LinearForm*>& forms) {
  std::vector<std::pair<std::size_t, int>> result;
  std::vector<char> taken;
  const auto count = [](const LinearForm& form) {
    return std::ranges::count_if(form.states, [](double by) { return by != 0; });
  };
  std::multimap<std::ptrdiff_t, std::size_t> order;  // by how many states
  for (std::size_t k = 0; k < forms.size(); ++k) order.emplace(count(*forms[k]), k);
  for (const auto& [states, k] : order) {
    const LinearForm& form = *forms[k];
    taken.resize(form.states.size(), 0);
    for (std::size_t i = 0; i < form.states.size(); ++i) {
      bool isExact = form.states[i] != 0 && taken[i] == 0;
      for (const double other : form.states) isExact = isExact && isThin(Interval(other) / Interval(form.states[i]));
      if (!isExact) continue;
      result.emplace_back(k, static_cast<int>(i));
      taken[i] = 1;
      break;
    }
  }
  return result;
}

bool isSameForm(const LinearForm& a, const LinearForm& b) {
  const std::size_t common = std::min(a.parameters.size(), b.parameters.size());
  const auto isZero = [](double coefficient) { return coefficient == 0; };
  return a.states == b.states && isEqual(a.constant, b.constant) &&
         std::equal(a.parameters.begin(), a.parameters.begin() + static_cast<std::ptrdiff_t>(common),
                    b.parameters.begin()) &&
         std::all_of(a.parameters.begin() + static_cast<std::ptrdiff_t>(common), a.parameters.end(), isZero) &&
         std::all_of(b.parameters.begin() + static_cast<std::ptrdiff_t>(common), b.parameters.end(), isZero);
}

double signOfRatio(const LinearForm& a, const LinearForm& b) {
  const double ofA = a.states[b.pivot], ofB = b.states[b.pivot];
  const auto isSame = [&](const Interval& x, const Interval& y) {  // x/ofA = y/ofB
    const Interval left = x * Interval(ofB), right = y * Interval(ofA);
    const bool isZero = isEqual(x, Interval(0.0)) && isEqual(y, Interval(0.0));
    return isZero || (isThin(left) && isEqual(left, right) && left.lower() != 0);
  };
  bool isMultiple = ofA != 0 && isSame(a.constant, b.constant);
  for (std::size_t i = 0; i < a.states.size(); ++i) isMultiple = isMultiple && isSame(a.states[i], b.states[i]);
  for (std::size_t k = 0; k < a.parameters.size(); ++k)
    isMultiple = isMultiple && isSame(a.parameters[k], b.parameters[k]);
  return !isMultiple ? 0 : (ofA > 0) == (ofB > 0) ? 1 : -1;
}

}  // namespace gamut
