// Gauss's principle of least constraint: of all accelerations q̈ the true one minimises  ½ Σ w (γ + J q̈)² − Q·q̈  over
// the rows γ + J q̈ of the bodies' accelerations, with w their inertia. Variables are eliminated one after the other,
// from the last to the first, on the rows themselves: every pivot Σ w J² is a sum of squares, and what moves a single
// row alone costs next to nothing. For a few variables: bounds that are carried on through an elimination grow with
// each.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "mechanics/element.hpp"

namespace gamut {

/// q̈ from the columns of J, the rows γ, the applied generalised forces Q and the weights. Every variable must move a
/// weighted row. Eliminating q̈_j (with D = Σ w J_j²) leaves
///   q̈_j = (Q_j − Σ w J_j γ)/D − Σ_{i<j} L_i q̈_i,   L_i = Σ w J_j J_i / D,
/// and the same problem in the rest, with J_i − J_j L_i for J_i, γ − J_j Σ w J_j γ / D for γ, Q_i − L_i Q_j for Q_i.
template <class S>
std::vector<S> leastConstraint(std::vector<std::vector<S>> columns, std::vector<S> gamma, std::vector<S> loads,
                               const std::vector<InertiaWeight<S>>& weights) {
  const std::size_t f = columns.size(), rows = gamma.size();
  std::vector<std::vector<S>> l(f);
  std::vector<S> result(f, S(0.0));
  for (std::size_t j = f; j-- > 0;) {
    const std::vector<S>& pivot = columns[j];
    std::vector<S> weighted(rows, S(0.0));
    S d(0.0);
    for (const InertiaWeight<S>& weight : weights) {
      const auto row = static_cast<std::size_t>(weight.k), other = static_cast<std::size_t>(weight.l);
      weighted[row] = weighted[row] + weight.w * pivot[other];
      if (row != other) weighted[other] = weighted[other] + weight.w * pivot[row];
      d = d + (row == other ? weight.w * square(pivot[row]) : S(2.0) * (weight.w * (pivot[row] * pivot[other])));
    }
    std::vector<std::size_t> involved;
    for (std::size_t row = 0; row < rows; ++row)
      if (!isKnownZero(weighted[row])) involved.push_back(row);

    // A single row is solved for q̈_j and is zero ever after: no weight is needed, and nothing is left to cancel. If its
    // entry vanishes, so does D.
    const bool single = involved.size() == 1 && !isKnownZero(pivot[involved[0]]);
    const S inverse = single ? S(1.0) / pivot[involved[0]] : S(1.0) / d;
    const auto project = [&](const std::vector<S>& column) {
      if (single) return S(column[involved[0]] * inverse);
      S sum(0.0);
      for (std::size_t row : involved) sum = sum + weighted[row] * column[row];
      return S(sum * inverse);
    };
    const auto reduce = [&](std::vector<S>& column, const S& factor) {
      for (std::size_t row = 0; row < rows; ++row) column[row] = column[row] - pivot[row] * factor;
      if (single) column[involved[0]] = S(0.0);
    };
    const S free = project(gamma);
    reduce(gamma, free);
    result[j] = isKnownZero(loads[j]) ? S(-free) : S(loads[j] / d - free);
    for (std::size_t i = 0; i < j; ++i) {
      l[j].push_back(project(columns[i]));
      reduce(columns[i], l[j][i]);
      loads[i] = loads[i] - l[j][i] * loads[j];
    }
  }
  for (std::size_t j = 0; j < f; ++j)
    for (std::size_t i = 0; i < j; ++i) result[j] = result[j] - l[j][i] * result[i];
  return result;
}

}  // namespace gamut
