// The standard normal distribution.
#pragma once

#include "scalars/interval.hpp"

namespace gamut {

/// Φ(z) = ½ erfc(-z/√2), enclosed.
Interval normalBelow(const Interval& z);
/// In doubles, and its inverse: they prove nothing.
double aboutNormalBelow(double z);
double aboutNormalQuantile(double probability);

}  // namespace gamut
