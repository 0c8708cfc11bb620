// What a share of independent samples says of a probability.
#pragma once

#include <cstdint>

#include "scalars/interval.hpp"

namespace gamut {

/// Where the probability lies of which `hits` of `count` independent samples have been hit: with this confidence, at
/// least, whatever it is (C. J. Clopper and E. S. Pearson, Biometrika 26, 1934). [0, 1] of no samples.
Interval confidenceOfShare(std::int64_t hits, std::int64_t count, double confidence = 0.95);

}  // namespace gamut
