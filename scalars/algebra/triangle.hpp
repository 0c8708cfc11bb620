// Symmetric matrices as their lower triangles, row by row, of intervals and while recording.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

/// Where entry (i, j) stands.
inline int triangleEntry(int i, int j) { return std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j); }

namespace detail {
inline bool isNothing(const Interval& x) { return x.lower() == 0 && x.upper() == 0; }
inline bool isNothing(const Recorded& x) { return isKnownZero(x); }
}  // namespace detail

/// TᵀAT of an A of so many rows and a T of so many columns, row by row.
template <class S>
std::vector<S> congruent(std::span<const S> a, std::span<const double> t, int rows, int columns) {
  std::vector<S> at(static_cast<std::size_t>(rows) * columns, S(0.0));
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < rows; ++k) {
      const S& entry = a[triangleEntry(i, k)];
      if (detail::isNothing(entry)) continue;
      for (int j = 0; j < columns; ++j)
        if (t[k * columns + j] != 0) at[i * columns + j] = at[i * columns + j] + S(t[k * columns + j]) * entry;
    }
  std::vector<S> product;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j <= i; ++j) {
      S sum(0.0);
      for (int k = 0; k < rows; ++k)
        if (t[k * columns + i] != 0 && !detail::isNothing(at[k * columns + j]))
          sum = sum + S(t[k * columns + i]) * at[k * columns + j];
      product.push_back(sum);
    }
  return product;
}

/// A x
template <class S>
std::vector<S> times(std::span<const S> a, std::span<const S> x) {
  const int n = static_cast<int>(x.size());
  std::vector<S> product;
  for (int i = 0; i < n; ++i) {
    S sum(0.0);
    for (int j = 0; j < n; ++j) sum = sum + a[triangleEntry(i, j)] * x[j];
    product.push_back(sum);
  }
  return product;
}

}  // namespace gamut
