// Two results beside each other on one page: designs, or versions of one. "A" is the first of them, "B" the second.
#pragma once

#include <string>

#include "studies/comparing/difference.hpp"

namespace gamut {

/// The page as HTML (UTF-8): what of B is better and what worse, requirements, outputs, what was asked otherwise, and
/// the motions of both in one figure an output. `difference`: what compareResults() found of them; `files`: their
/// names.
std::string renderComparison(const Difference& difference, const Results& first, const Results& second,
                             const Both<std::string>& files);

}  // namespace gamut
