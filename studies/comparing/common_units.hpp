// Outputs that two studies look at in two units of one kind, mm and m, are compared in that of the first.
#pragma once

#include <optional>

#include "studies/results/results.hpp"

namespace gamut {

/// The second results with outputs in the units that they have in the first, where these are of one kind: bounds
/// outward, all else to nearest but for a rounding. Of such an output no values of distribution functions are known
/// any more: bounds hold at these to the last bit. Nothing where there is no such output.
std::optional<Results> inUnitsOf(const Results& first, const Results& second);

}  // namespace gamut
