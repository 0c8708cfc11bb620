// The factorisation M = L D Lᵀ of positive definite matrices and solutions by it, written once for a number and for a
// group of numbers: the same operations in the same order, without a branch on values, so that a sample has the same
// bits alone and in a pack. Neither depends on the units of rows and columns (Higham 2002, section 10.1).
#pragma once

#include <limits>

#include "scalars/elementary/vector_unit.hpp"

namespace gamut::detail {

// The operations, for a number or a vector; a group has overloads of its own.
template <class V>
GAMUT_INLINE void subtractProduct(V& x, const V& a, const V& b) {
  x = x - a * b;
}
template <class V>
GAMUT_INLINE void multiplyBy(V& x, const V& a) {
  x = x * a;
}
/// x = 1 / x, or NaN where x is not positive.
template <class V>
GAMUT_INLINE void invertPivot(V& x) {
  x = 0.0 < x ? V(1.0 / x) : V(x * std::numeric_limits<double>::quiet_NaN());
}

/// entry(i, j), i >= j, is read before factor(i, j) is written: L below the diagonal and the inverses of D on it, NaN
/// where D is not positive. Both give references.
template <class V, class Entry, class Factor>
GAMUT_INLINE void factoriseLDLt(int n, Entry entry, Factor factor) {
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) {  // L D
      V sum = entry(i, j);
      for (int k = 0; k < j; ++k) subtractProduct(sum, factor(i, k), factor(j, k));
      factor(i, j) = sum;
    }
    V pivot = entry(i, i);
    for (int k = 0; k < i; ++k) {
      const V scaled = factor(i, k);
      V unscaled = scaled;
      multiplyBy(unscaled, factor(k, k));
      factor(i, k) = unscaled;
      subtractProduct(pivot, scaled, unscaled);
    }
    invertPivot(pivot);
    factor(i, i) = pivot;
  }
}

/// x(i) becomes the solution's component i for the right-hand side r(i), which is read before x(i) is written.
template <class V, class Factor, class RightSide, class Solution>
GAMUT_INLINE void solveLDLt(int n, Factor factor, RightSide r, Solution x) {
  for (int i = 0; i < n; ++i) {
    V sum = r(i);
    for (int k = 0; k < i; ++k) subtractProduct(sum, factor(i, k), x(k));
    x(i) = sum;
  }
  for (int i = n - 1; i >= 0; --i) {
    V sum = x(i);
    multiplyBy(sum, factor(i, i));
    for (int k = i + 1; k < n; ++k) subtractProduct(sum, factor(k, i), x(k));
    x(i) = sum;
  }
}

}  // namespace gamut::detail
