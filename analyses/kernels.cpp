#include "analyses/kernels.hpp"

#include <algorithm>

// One clone for AVX-512, one for FMA3, one for the baseline, chosen when the program starts.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define GAMUT_CLONES __attribute__((target_clones("avx512f", "fma", "default")))
#else
#define GAMUT_CLONES
#endif
#define GAMUT_INLINE inline __attribute__((always_inline))

namespace gamut::kernels {
namespace {

typedef double Vector __attribute__((vector_size(64), aligned(8), may_alias));

GAMUT_INLINE const Vector& load(const double* p) { return *reinterpret_cast<const Vector*>(p); }

GAMUT_INLINE double sum(const Vector& v) { return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])); }

template <int chunks>
GAMUT_INLINE void convolveChunks(const Monomials::Pair* pairs, const std::int32_t* first, int count, const double* a,
                                 const double* b, int stride, double* out) {
  const int strideR = reversedStride(stride);
  for (int g = 0; g < count; ++g) {
    Vector even = {}, odd = {};
    int q = first[g];
    const int end = first[g + 1];
    for (; q + 1 < end; q += 2) {
      const double* x0 = a + pairs[q].a * stride;
      const double* y0 = b + pairs[q].b * strideR;
      const double* x1 = a + pairs[q + 1].a * stride;
      const double* y1 = b + pairs[q + 1].b * strideR;
      for (int c = 0; c < chunks; ++c) {
        even += load(x0 + 8 * c) * load(y0 + 8 * c);
        odd += load(x1 + 8 * c) * load(y1 + 8 * c);
      }
    }
    if (q < end) {
      const double* x = a + pairs[q].a * stride;
      const double* y = b + pairs[q].b * strideR;
      for (int c = 0; c < chunks; ++c) even += load(x + 8 * c) * load(y + 8 * c);
    }
    even += odd;
    out[g] += sum(even);
  }
}

}  // namespace

GAMUT_CLONES void convolve(const Monomials::Pair* pairs, const std::int32_t* first, int count, const double* a,
                           const double* bReversed, int stride, int i, double* out) {
  const double* b = bReversed + stride - 1 - i;
  switch (i / 8) {
    case 0:
      convolveChunks<1>(pairs, first, count, a, b, stride, out);
      break;
    case 1:
      convolveChunks<2>(pairs, first, count, a, b, stride, out);
      break;
    case 2:
      convolveChunks<3>(pairs, first, count, a, b, stride, out);
      break;
    default:
      convolveChunks<4>(pairs, first, count, a, b, stride, out);
      break;
  }
}

GAMUT_CLONES void multiply(const Monomials::Pair* pairs, const std::int32_t* first, int count, const double* c,
                           const double* x, int stride, double* out) {
  for (int g = 0; g < count; ++g) {
    double s = 0;
    for (int q = first[g]; q < first[g + 1]; ++q) s += c[pairs[q].a * stride] * x[pairs[q].b * stride];
    out[g] += s;
  }
}

GAMUT_CLONES void tabulate(const Monomials& monomials, int count, const double* f, const double* power,
                           const double* weights, int stride, double* table, double& norm, double& weighted) {
  const int chunks = stride / 8;
  std::fill(table, table + (monomials.grade(count - 1) + 1) * stride, 0.0);
  Vector n = {}, w = {};
  for (int g = 0; g < count; ++g) {
    double* row = table + monomials.grade(g) * stride;
    const double multiplicity = monomials.multiplicity(g);
    Vector wg = {};
    for (int c = 0; c < chunks; ++c) {
      Vector v = load(f + g * stride + 8 * c);
      v = v < 0 ? -v : v;
      const Vector scaled = v * load(power + 8 * c);
      *reinterpret_cast<Vector*>(row + 8 * c) += scaled;
      n += scaled;
      wg += v * load(weights + 8 * c);
    }
    w += multiplicity * wg;
  }
  norm = sum(n);
  weighted = sum(w);
}

GAMUT_CLONES double dot(const double* a, const double* b, int stride) {
  Vector s = {};
  for (int c = 0; c < stride; c += 8) s += load(a + c) * load(b + c);
  return sum(s);
}

}  // namespace gamut::kernels
