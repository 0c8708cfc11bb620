// The comparison of two results as programs read it: docs/json.md.
#pragma once

#include <string>

#include "studies/comparing/difference.hpp"

namespace gamut {

/// One JSON object on one line.
std::string comparisonJson(const Difference& difference, const Results& first, const Results& second,
                           const Both<std::string>& files);

}  // namespace gamut
