// Eight numbers at once, for the inner loops.
#pragma once

#include "analyses/flow/series/vector_clones.hpp"

namespace gamut::kernels {

typedef double Vector __attribute__((vector_size(64), aligned(8), may_alias));

GAMUT_INLINE const Vector& load(const double* p) { return *reinterpret_cast<const Vector*>(p); }

GAMUT_INLINE double sum(const Vector& v) { return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])); }

/// to[i] += |v[i]|.
GAMUT_INLINE void addSize(double* to, const Vector& v) { *reinterpret_cast<Vector*>(to) += v < 0 ? -v : v; }

}  // namespace gamut::kernels
