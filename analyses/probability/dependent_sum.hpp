// Bounds of the distribution of a sum of which nothing is known but the distributions of the terms.
#pragma once

#include <vector>

#include "analyses/probability/convolution.hpp"

namespace gamut {

/// However the parts, each of probability 1, depend on each other (R. C. Williamson, T. Downs, International Journal of
/// Approximate Reasoning 4, 1990). Best possible for two, but for 2048 levels.
GridSum dependentSumOf(const std::vector<GridBounds>& parts);

}  // namespace gamut
