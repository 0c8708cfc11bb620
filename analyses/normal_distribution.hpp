// The standard normal distribution.
#pragma once

#include "scalars/interval.hpp"

namespace gamut {

/// Φ(z) = ½ erfc(-z/√2), enclosed.
Interval normalBelow(const Interval& z);
// In doubles Φ, 1 - Φ and their inverses: they prove nothing.
double aboutNormalBelow(double z);
double aboutNormalAbove(double z);
double aboutNormalQuantile(double probability);
double aboutNormalUpperQuantile(double probability);

}  // namespace gamut
