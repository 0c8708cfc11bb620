// Nodes that are linear in states and parameters.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// u = Σ states_j x_j + Σ parameters_k p_k + constant, exactly; `pivot`: the state of the greatest coefficient.
struct LinearForm {
  std::vector<double> states, parameters;
  Interval constant{0.0};
  int pivot = 0;
};

/// u wherever states and parameters are in these.
Interval rangeOf(const LinearForm& form, std::span<const Interval> states, std::span<const Interval> parameters);
/// Likewise without what state `but` has in it.
Interval rangeWithout(std::size_t but, const LinearForm& form, std::span<const Interval> states,
                      std::span<const Interval> parameters);

/// The form of a node, if it is one with exact coefficients, one of a state at least.
std::optional<LinearForm> linearFormOf(const Program& f, int node);

/// For forms that are zero together: which state x_i = -(Σ_{j≠i} c_j x_j + Σ d_k p_k + constant)/c_i follows from which
/// of them, {form, i} one after the other, those of few states first; ratios c_j/c_i are exact. Some may have none.
std::vector<std::pair<std::size_t, int>> statesThatFollow(const std::vector<const LinearForm*>& forms);

/// Parameters that only one of them knows must have no part in it.
bool isSameForm(const LinearForm& a, const LinearForm& b);

/// Whether a = c·b with c ≠ 0, seen without rounding: its sign, 1 or -1; 0 if not.
double signOfRatio(const LinearForm& a, const LinearForm& b);

}  // namespace gamut
