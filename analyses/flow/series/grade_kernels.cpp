// A factor's orders stay in registers while all monomials of the other factor pass by: each is loaded, shifted by an
// order at a time, and added to the orders of its product.
#include "analyses/flow/series/grade_kernels.hpp"

#include <algorithm>

#include "analyses/flow/series/vector_clones.hpp"
#include "analyses/work.hpp"

namespace gamut::kernels {
namespace {

typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));

GAMUT_INLINE const Four& four(const double* p) { return *reinterpret_cast<const Four*>(p); }
GAMUT_INLINE Four& four(double* p) { return *reinterpret_cast<Four*>(p); }

/// Eight orders of out (four, unless `both`) += a's first J with b's, of which b[0] meets a[0] in out[0]. Unless
/// `isWhole`, b is zero before that, so that the first four meet no more than four of a.
template <int J, bool both, bool isWhole>
GAMUT_INLINE void addProducts(const double* a, const double* b, int count, const std::uint16_t* products, int stride,
                              double* out) {
  double factor[J];
#pragma GCC unroll 8
  for (int j = 0; j < J; ++j) factor[j] = a[j];
  for (int n = 0; n < count; ++n, b += paddedStride(stride)) {
    double* to = out + products[n] * stride;
    Four low = four(to);
#pragma GCC unroll 8
    for (int j = 0; j < (isWhole || J < 4 ? J : 4); ++j) low += factor[j] * four(b - j);
    four(to) = low;
    if (!both) continue;
    Four high = four(to + 4);
#pragma GCC unroll 8
    for (int j = 0; j < J; ++j) high += factor[j] * four(b + 4 - j);
    four(to + 4) = high;
  }
}

GAMUT_INLINE void addFirst(int terms, const double* a, const double* b, int count, const std::uint16_t* products,
                           int stride, double* out) {
  switch (terms) {
    case 1:
      return addProducts<1, false, false>(a, b, count, products, stride, out);
    case 2:
      return addProducts<2, false, false>(a, b, count, products, stride, out);
    case 3:
      return addProducts<3, false, false>(a, b, count, products, stride, out);
    case 4:
      return addProducts<4, false, false>(a, b, count, products, stride, out);
    case 5:
      return addProducts<5, true, false>(a, b, count, products, stride, out);
    case 6:
      return addProducts<6, true, false>(a, b, count, products, stride, out);
    case 7:
      return addProducts<7, true, false>(a, b, count, products, stride, out);
    default:
      return addProducts<8, true, false>(a, b, count, products, stride, out);
  }
}

/// The same of one order alone.
GAMUT_INLINE void addProducts(double factor, const double* b, int count, const std::uint16_t* products, double* out) {
  for (int n = 0; n < count; ++n) out[products[n]] += factor * b[n];
}

bool isZero(const double* a, int orders) {
  for (int i = 0; i < orders; ++i)
    if (a[i] != 0) return false;
  return true;
}

}  // namespace

GAMUT_CLONES void multiplySeries(const Monomials& monomials, int q, int least, const double* a, int ordersOfA,
                                 const double* bPadded, int stride, int orders, double* out) {
  const int ofA = std::min(orders, ordersOfA);
  double rows = 0;
  for (int p = least; p <= q - least; ++p) {
    const int firstB = monomials.firstOf(q - p), count = monomials.countUpTo(q - p) - firstB;
    const double* b = bPadded + firstB * paddedStride(stride) + padding(stride);
    for (int g = monomials.firstOf(p); g < monomials.countUpTo(p); ++g) {
      const double* factor = a + g * stride;
      if (isZero(factor, ofA)) continue;
      const std::uint16_t* products = monomials.products(g) + firstB;
      rows += count;
      if (stride == 1) {
        addProducts(*factor, b, count, products, out);
        continue;
      }
      for (int c = 0; c < orders; c += 8) {
        if (ofA == 1) {
          addProducts<1, true, false>(factor, b + c, count, products, stride, out + c);
          continue;
        }
        addFirst(std::min(8, orders - c), factor + c, b, count, products, stride, out + c);
        for (int k = 0; k < c; k += 8)
          addProducts<8, true, true>(factor + k, b + c - k, count, products, stride, out + c);
      }
    }
  }
  if (stride == 1) return Work::count(Work::multipliedPair, rows);
  const int whole = (orders + 7) / 8;
  const double blocks = whole;
  Work::count(Work::seriesProduct, rows * (ofA == 1 ? blocks : 0.5 * blocks * (blocks + 1)));
}

void multiplyGraded(const Monomials& monomials, int q, const double* a, const double* bPadded, int stride,
                    double* out) {
  double pairs = 0;
  for (int p = 1; p < q; ++p) {
    const int firstB = monomials.firstOf(q - p), count = monomials.countUpTo(q - p) - firstB;
    const double* b = bPadded + firstB * paddedStride(stride) + padding(stride);
    for (int g = monomials.firstOf(p); g < monomials.countUpTo(p); ++g) {
      const double factor = p * a[g * stride];
      if (factor == 0) continue;
      const std::uint16_t* products = monomials.products(g) + firstB;
      pairs += count;
      for (int n = 0; n < count; ++n) out[products[n] * stride] += factor * b[n * paddedStride(stride)];
    }
  }
  Work::count(Work::multipliedPair, pairs);
}

GAMUT_CLONES void convolveLanes(const double* s, int from, int to, const double* w, int i, double* out) {
  Four sum[4];
  for (int c = 0; c < 4; ++c) sum[c] = four(out + 4 * c);
  for (int j = from; j <= to; ++j) {
    const double* row = w + (i - j) * lanes;
    for (int c = 0; c < 4; ++c) sum[c] += s[j] * four(row + 4 * c);
  }
  for (int c = 0; c < 4; ++c) four(out + 4 * c) = sum[c];
}

GAMUT_CLONES void loadLanes(const double* rows, int stride, int count, int from, int to, double* out) {
  for (int l = 0; l < count; ++l, rows += stride)
    for (int i = from; i < to; ++i) out[i * lanes + l] = rows[i];
  if (count < lanes)
    for (int i = from; i < to; ++i) std::fill(out + i * lanes + count, out + (i + 1) * lanes, 0.0);
}

GAMUT_CLONES void storeLanes(double* w, int orders, int count, double* rows, int stride) {
  if (stride == 1) {
    std::copy_n(w, count, rows);
    return;
  }
  const int end = (orders + 7) / 8 * 8;
  std::fill(w + orders * lanes, w + end * lanes, 0.0);
  for (int l = 0; l < count; ++l, rows += stride) {
    const double* at = w + l;
    for (int i = 0; i < end; i += 4, at += 4 * lanes)
      four(rows + i) = Four{at[0], at[lanes], at[2 * lanes], at[3 * lanes]};
  }
}

GAMUT_CLONES void sumLanes(const double* w, int orders, const double* weights, double* sums, double* weighted) {
  for (int i = 0; i < orders; ++i, w += lanes) {
    Four sum = {}, product = {};
    for (int c = 0; c < lanes; c += 4) {
      Four value = four(w + c);
      value = value < 0 ? -value : value;
      sum += value;
      product += value * four(weights + c);
    }
    sums[i] += (sum[0] + sum[2]) + (sum[1] + sum[3]);
    weighted[i] += (product[0] + product[2]) + (product[1] + product[3]);
  }
}

}  // namespace gamut::kernels
