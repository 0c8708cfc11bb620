// Volumes that half-spaces cut from a cube.
#pragma once

#include <vector>

#include "scalars/interval.hpp"

namespace gamut {

/// Encloses the part of [-1,1]^k in which Σ slope_i w_i <= limit.
Interval partOfCube(const std::vector<double>& slope, double limit);

}  // namespace gamut
