// Forms of nodes, from those of their operands.
#include "scalars/program/linear_form.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <unordered_set>

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

/// The other operand of a product with a number that is one double; -1: it is none.
int factorOf(const Program& f, const Node& product) {
  const auto isNumber = [&](int which) {
    const Node& of = f.nodes()[which];
    return of.op == Op::constant && isThin(f.constants()[of.a]);
  };
  return isNumber(product.a) ? product.b : isNumber(product.b) ? product.a : -1;
}

/// The nodes that its form is made of, by rising number, it itself last; none where one of them has no form.
std::vector<int> partsOfForm(const Program& f, int node) {
  std::vector<int> parts, open{node};
  std::unordered_set<int> seen;
  const auto need = [&](int operand) {
    if (seen.insert(operand).second) open.push_back(operand);
  };
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    parts.push_back(i);
    const Node& n = f.nodes()[i];
    switch (n.op) {
      case Op::state:
      case Op::parameter:
      case Op::constant:
        break;
      case Op::add:
      case Op::sub:
        need(n.a);
        need(n.b);
        break;
      case Op::neg:
        need(n.a);
        break;
      case Op::mul:
        if (const int other = factorOf(f, n); other >= 0) {
          need(other);
          break;
        }
        return {};
      default:
        return {};
    }
  }
  std::ranges::sort(parts);
  return parts;
}

}  // namespace

std::optional<LinearForm> linearFormOf(const Program& f, int node) {
  std::unordered_map<int, LinearForm> forms;
  LinearForm zero;
  zero.states.assign(f.states(), 0.0);
  zero.parameters.assign(f.parameters(), 0.0);
  const std::vector<int> parts = partsOfForm(f, node);
  for (const int i : parts) {
    const Node& n = f.nodes()[i];
    std::optional<LinearForm> form = zero;
    switch (n.op) {
      case Op::state:
        form->states[n.a] = 1;
        break;
      case Op::parameter:
        form->parameters[n.a] = 1;
        break;
      case Op::constant:
        form->constant = f.constants()[n.a];
        break;
      case Op::neg:
        form = combined(zero, Interval(-1.0), forms.at(n.a));
        break;
      case Op::mul: {
        const int other = factorOf(f, n);
        form = combined(zero, f.constants()[f.nodes()[other == n.b ? n.a : n.b].a], forms.at(other));
        break;
      }
      default:
        form = combined(forms.at(n.a), Interval(n.op == Op::add ? 1.0 : -1.0), forms.at(n.b));
        break;
    }
    if (!form) return std::nullopt;
    forms.emplace(i, *std::move(form));
  }
  if (parts.empty()) return std::nullopt;
  LinearForm& result = forms.at(node);
  const auto size = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  result.pivot = static_cast<int>(std::ranges::max_element(result.states, size) - result.states.begin());
  if (result.states.empty() || result.states[result.pivot] == 0) return std::nullopt;
  return std::move(result);
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
