// Inner loops of the recursion by grades: series in time of many monomials at once. They run in the widest vector unit
// that the machine has. Sums may be reassociated and fused: the certificate counts terms, not their order.
#pragma once

#include "analyses/flow/series/monomials.hpp"

namespace gamut::kernels {

/// Layout of a series' padded copy: eight zeros before each monomial's `stride` orders; none where there is one order.
constexpr int padding(int stride) { return stride == 1 ? 0 : 8; }
constexpr int paddedStride(int stride) { return stride + padding(stride); }

/// out[γ][i] += Σ_{αβ = γ} Σ_{j ≤ i} a[α][j] b[β][i-j] for all γ of grade q and i < orders, over α and β of grade
/// `least` and more. `a` holds no more than `ordersOfA` orders. Orders of `out` up to the next multiple of eight
/// are no longer what they were, unless stride is 1.
void multiplySeries(const Monomials& monomials, int q, int least, const double* a, int ordersOfA, const double* bPadded,
                    int stride, int orders, double* out);

/// out[γ][0] += Σ grade(α) a[α][0] b[β][0] over αβ = γ of grade q, neither of them 1.
void multiplyGraded(const Monomials& monomials, int q, const double* a, const double* bPadded, int stride, double* out);

/// So many monomials are carried on together: order i of one is at [i·lanes + its number].
constexpr int lanes = 16;

/// out[l] += Σ_{from ≤ j ≤ to} s[j] w[i-j][l].
void convolveLanes(const double* s, int from, int to, const double* w, int i, double* out);

/// out[i·lanes + l] = rows[l·stride + i] for l < count, from ≤ i < to; zeros for the other l.
void loadLanes(const double* rows, int stride, int count, int from, int to, double* out);

/// rows[l·stride + i] = w[i·lanes + l] for l < count, i < orders, and, unless stride is 1, zeros up to the next
/// multiple of eight orders; in w too.
void storeLanes(double* w, int orders, int count, double* rows, int stride);

/// sums[i] += Σ_l |w[i·lanes + l]|, weighted[i] += Σ_l weights[l] |w[i·lanes + l]| for i < orders.
void sumLanes(const double* w, int orders, const double* weights, double* sums, double* weighted);

}  // namespace gamut::kernels
