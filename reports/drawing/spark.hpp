// A motion in a word's space: what is known best of it, a middle, and limits, without axes.
#pragma once

#include <string>

#include "reports/drawing/plot.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// 96 x 22 units, for eyes alone: what it shows stands in words beside it. Empty where nothing is known.
std::string drawSpark(const Plot& plot);

/// As large: the density of a quantity's distribution, or its membership, over its interval, by the numbers that
/// results hold of it. Empty of what more than one distribution may be, and of shapes that have no simple form.
std::string drawShape(const Results& results, const UncertainInfo& quantity, ShapeKind kind);

}  // namespace gamut
