// Random containment of interval functions: random intervals, a random point of each, and MPFR's value there at 120
// bits compared exactly with the enclosure. Every function of Interval on every range that is special to it. The
// ordinary tests run some thousand cases of each, tests/campaigns/scalar_campaign.cpp a million.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace gamut::testing {

/// What the cases of one function on one range came to.
struct ContainmentOutcome {
  long cases = 0;
  long undefined = 0;  ///< of these, at points outside of the function's domain: nothing to contain
  long outside = 0;    ///< the value is not in the enclosure
  long loose = 0;     ///< the enclosure is not the tightest, where that is known: for thin intervals, and for functions
                      ///< that are monotone, even, sin, cos or tan, or have their extremes at corners
  std::string first;  ///< the first failure in words
};

struct ContainmentTrial {
  std::string function, range;
  std::function<ContainmentOutcome(long cases, std::uint64_t seed)> run;
};

/// All functions, one after the other, each with all its ranges.
const std::vector<ContainmentTrial>& containmentTrials();

}  // namespace gamut::testing
