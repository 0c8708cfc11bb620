// The numbers that a page's interactive plots draw, as JSON inside the page.
#pragma once

#include <cstddef>
#include <string>

#include "studies/results/results.hpp"

namespace gamut {

/// More times than this are thinned, see `thinned`.
inline constexpr std::size_t plottedTimes = 2000;

/// {"time": [..], "outputs": [{"name", "unit", "tube": [[..],[..]], "guaranteed", "sampled", "probable", "median",
/// "alpha", "possible": [band, ..], "overestimation", "share": [0.05, 0.95]}, ..]}. Every band is [lower, upper], its
/// decimals rounded outward; null where there is no number. Safe inside a <script> element.
std::string pageData(const Results& results);

}  // namespace gamut
