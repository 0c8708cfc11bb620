// The comparison of two results as programs read it: docs/json.md.
#pragma once

#include <string>

#include "studies/comparing/difference.hpp"

namespace gamut {

/// The word of what contradicts: "enclosure", "sample", "total_index".
std::string wordOf(Contradiction::Of of);
/// The word of what is beyond the tolerances, as the file of tolerances has it: "wider", "gap".
std::string wordOf(Excess::Of of);

/// One JSON object on one line.
std::string comparisonJson(const Difference& difference, const Results& first, const Results& second,
                           const Both<std::string>& files);

}  // namespace gamut
