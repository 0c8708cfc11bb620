// The kernels of dense_kernels.hpp, for the vector unit that the build may use.
#include "scalars/algebra/dense_kernels.hpp"

#include <cmath>

#include "scalars/elementary/vector_unit.hpp"

namespace gamut::detail {
namespace {

/// Rows of a column.
#ifdef __AVX__
using Rows = Vector4;
#else
using Rows = Vector2;
#endif
constexpr Count width = lanes<Rows>;

Rows loaded(const double* x) {
  Rows rows;
  load(rows, x);
  return rows;
}

/// 4 rows of so many columns of a b, where b is given by the first of those columns. The sums stay in registers.
template <int Columns>
void multiplyBlock(const double* a, Count aStride, Count depth, const double* b, Count bStride, double* product,
                   Count productStride) {
  constexpr int parts = 4 / width;
  Rows sums[Columns][parts] = {};
  for (Count k = 0; k < depth; ++k, a += aStride) {
    const Rows top = loaded(a), bottom = loaded(a + 4 - width);
    for (int j = 0; j < Columns; ++j) {
      const double factor = b[k + j * bStride];
      sums[j][0] += top * factor;
      if constexpr (parts > 1) sums[j][1] += bottom * factor;
    }
  }
  for (int j = 0; j < Columns; ++j) {
    for (int part = 0; part < parts; ++part) store(product + j * productStride + part * width, sums[j][part]);
  }
}

template <int Columns>
void multiplyColumns(const Dense a, const double* b, Count bStride, double* product, Count productStride) {
  for (Count i = 0; i < a.stride; i += 4) {
    multiplyBlock<Columns>(a.data + i, a.stride, a.columns, b, bStride, product + i, productStride);
  }
}

/// The row of the element of greatest magnitude in a column, from the diagonal down.
Count pivotRow(const Dense& a, Count k) {
  Count pivot = k;
  for (Count i = k + 1; i < a.rows; ++i) {
    if (std::abs(a(i, k)) > std::abs(a(pivot, k))) pivot = i;
  }
  return pivot;
}

void swapRows(const Dense& a, Count one, Count other) {
  if (one == other) return;
  for (Count j = 0; j < a.columns; ++j) std::swap(a(one, j), a(other, j));
}

/// column -= multipliers * factor, four rows at a time.
void eliminate(double* column, const double* multipliers, double factor, Count stride) {
  for (Count i = 0; i < stride; i += 4) {
    for (Count k = i; k < i + 4; k += width) store(column + k, loaded(column + k) - loaded(multipliers + k) * factor);
  }
}

}  // namespace

double* Arena::keptMemory() {
  thread_local const auto memory = std::make_unique_for_overwrite<double[]>(kept);
  return memory.get();
}

void multiply(const Dense& a, const Dense& b, const Dense& product) {
  Count j = 0;
  for (; j + 3 < b.columns; j += 4) {
    multiplyColumns<4>(a, b.column(j), b.stride, product.column(j), product.stride);
  }
  for (; j + 1 < b.columns; j += 2) {
    multiplyColumns<2>(a, b.column(j), b.stride, product.column(j), product.stride);
  }
  if (j < b.columns) multiplyColumns<1>(a, b.column(j), b.stride, product.column(j), product.stride);
}

void multiply(const Dense& a, const double* x, double* product) {
  multiplyColumns<1>(a, x, a.stride, product, a.stride);
}

double greatest(const double* x, Count rows) {
  double best[4] = {};  // four chains of comparisons instead of one
  for (Count i = 0; i < Dense::padded(rows); i += 4) {
    for (Count k = 0; k < 4; ++k) best[k] = x[i + k] > best[k] ? x[i + k] : best[k];
  }
  return std::max(std::max(best[0], best[1]), std::max(best[2], best[3]));
}

void invertInPlace(const Dense& a, Count* pivots, double* multipliers) {
  const Count n = a.rows, stride = a.stride;
  for (Count k = 0; k < n; ++k) {
    pivots[k] = pivotRow(a, k);
    swapRows(a, k, pivots[k]);
    double* const eliminated = a.column(k);
    const double reciprocal = 1 / eliminated[k];
    for (Count i = 0; i < stride; ++i) multipliers[i] = std::exchange(eliminated[i], 0.0);
    multipliers[k] = 0;
    eliminated[k] = 1;
    double* column = a.data;
    for (Count j = 0; j < n; ++j, column += stride) {
      const double factor = column[k] * reciprocal;
      eliminate(column, multipliers, factor, stride);
      column[k] = factor;
    }
  }
  for (Count k = a.rows - 1; k >= 0; --k) {
    if (pivots[k] != k) std::swap_ranges(a.column(k), a.column(k) + a.stride, a.column(pivots[k]));
  }
}

int factorInPlace(const Dense& a, const Dense& permuted, const Dense& permutedToo) {
  int sign = 1;
  for (Count k = 0; k < a.rows; ++k) {
    const Count pivot = pivotRow(a, k);
    if (pivot != k) sign = -sign;
    swapRows(a, k, pivot);
    swapRows(permuted, k, pivot);
    swapRows(permutedToo, k, pivot);
    double* const __restrict multipliers = a.column(k);
    for (Count i = k + 1; i < a.rows; ++i) multipliers[i] /= multipliers[k];
    for (Count j = k + 1; j < a.columns; ++j) {
      double* const __restrict column = a.column(j);
      const double factor = column[k];
      for (Count i = k + 1; i < a.rows; ++i) column[i] -= multipliers[i] * factor;
    }
  }
  return sign;
}

void invertFactors(const Dense& factors, const Dense& lower, const Dense& upper) {
  std::fill_n(lower.data, lower.size(), 0.0);
  std::fill_n(upper.data, upper.size(), 0.0);
  for (Count j = 0; j < factors.columns; ++j) {
    double* const __restrict x = lower.column(j);
    double* const __restrict y = upper.column(j);
    x[j] = y[j] = 1;
    for (Count k = j; k < factors.rows; ++k) {
      const double* const __restrict factor = factors.column(k);
      const double element = x[k];
      for (Count i = k + 1; i < factors.rows; ++i) x[i] -= factor[i] * element;
    }
    for (Count k = j; k >= 0; --k) {
      const double* const __restrict factor = factors.column(k);
      const double element = y[k] /= factor[k];
      for (Count i = 0; i < k; ++i) y[i] -= factor[i] * element;
    }
  }
}

}  // namespace gamut::detail
