// Bounds of functions that distributions are made of, by MPFR.
#pragma once

#include "scalars/elementary/mpfr_bounds.hpp"

namespace gamut::detail {

/// erfc x = 2/√π ∫_x^∞ exp(-s²) ds.
Bounds boundErfc(double x);
/// log Γ(x), x > 0.
Bounds boundLogGamma(double x);

}  // namespace gamut::detail
