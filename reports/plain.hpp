// What was found, in words for those who know neither method nor study: what holds in every case, what does not.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/verdict.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// One or two sentences that lead the page. Without requirements: where this output stays.
std::string plainSummary(const Results& results, const Verdict& verdict, std::size_t output);

/// One sentence a requirement: "“height” stays above 0.2 m in every case."
std::vector<std::string> plainRequirements(const Results& results);

/// Of a requirement that some values violate what its sentence says, one by one; empty of what is not known.
struct ViolationFacts {
  std::string what;    ///< "“height” does not stay above 0.2 m"
  std::string likely;  ///< "6.9 to 7.8 % of all cases, proved; 66 of 1024 simulated cases"
  std::string missed;  ///< "the limit by 0.27 mm at 3.2 s, in an extreme combination of the tolerances (corner 3)"
};
/// One a requirement; nothing of one that is not proved to be violated.
std::vector<std::optional<ViolationFacts>> violationFacts(const Results& results);

}  // namespace gamut
