// A motion in a word's space: what is known best of it, a middle, and limits, without axes.
#pragma once

#include <string>

#include "reports/drawing/plot.hpp"

namespace gamut {

/// 96 x 22 units, for eyes alone: what it shows stands in words beside it. Empty where nothing is known.
std::string drawSpark(const Plot& plot);

}  // namespace gamut
