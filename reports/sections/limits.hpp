// Limits that requirements set to outputs.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "studies/results/instants.hpp"
#include "studies/results/results.hpp"

namespace gamut {

struct Limit {
  std::size_t requirement = 0, margin = 0;  ///< numbers of the requirement, and of the output that is its margin
  std::size_t output = 0;                   ///< that the limit is of: the margin itself, above zero, if no other fits
  double value = 0;
};

/// One for each margin of each requirement.
std::vector<Limit> limitsOf(const Results& results);

/// Where a requirement comes nearest to its limit.
struct NearLimit {
  Limit limit;
  double share = 0;  ///< how near, in shares of how far its margin varies; below zero beyond the limit
};
/// Nothing where nothing is known of it.
std::optional<NearLimit> nearestOf(const Results& results, std::size_t requirement);

/// The requirements that are shown, the worst first: as shownRequirements, but of equals that which comes nearest to
/// its limit.
std::vector<std::size_t> worstFirst(const Results& results);

/// The limit of the first of these of which anything is known: what somebody has to look at first.
std::optional<Limit> nearestLimit(const Results& results);

/// The instant at which an output is looked at first: of the requirement that sets it a limit (of several the nearest),
/// or where it varies most, s. NaN where nothing is known.
double instantOf(const Results& results, std::size_t output);

}  // namespace gamut
