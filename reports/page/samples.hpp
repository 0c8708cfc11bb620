// What the samples say of an output, and how far off that may be.
#pragma once

#include <cstddef>
#include <string>

#include "reports/drawing/style.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// Mean and quantiles over time with the intervals of 95 % confidence in which those of all motions lie, as deviations
/// from the mean of the samples: a figure; empty where there is nothing, or no time. Its layers go to the style sheet.
std::string statisticsFigure(const Results& results, std::size_t output, StyleSheet& style);

/// From which intervals these figures are, in a sentence; empty without samples.
std::string statisticsHint(const Results& results);

}  // namespace gamut
