// What was found, in words for those who know neither method nor study: what holds in every case, what does not.
#pragma once

#include <string>
#include <vector>

#include "reports/verdict.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// One or two sentences that lead the page. Without requirements: where this output stays.
std::string plainSummary(const Results& results, const Verdict& verdict, std::size_t output);

/// One sentence a requirement: "“height” stays above 0.2 m in every case."
std::vector<std::string> plainRequirements(const Results& results);

}  // namespace gamut
