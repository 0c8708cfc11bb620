// What recursions without symbols are made of (kernels.hpp).
#pragma once

#include "analyses/flow/series/vectors.hpp"

namespace gamut::kernels {

/// Σ_{j≤i} a_j b_{i-j} over stored orders; entries of the order being computed are still zero.
GAMUT_INLINE double thinDot(const double* a, const double* bReversed, int i) {
  const double* b = bReversed - i;
  Vector s = load(a) * load(b);
  for (int c = 8; c <= i; c += 8) s += load(a + c) * load(b + c);
  return sum(s);
}

}  // namespace gamut::kernels
