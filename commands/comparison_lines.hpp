// The comparison of two results as people read it. "A" is the first of them, "B" the second.
#pragma once

#include <string>

#include "studies/comparing/difference.hpp"

namespace gamut {

/// Several lines, the last one ended.
std::string comparisonText(const Difference& difference, const Results& first, const Results& second,
                           const Both<std::string>& files);

}  // namespace gamut
