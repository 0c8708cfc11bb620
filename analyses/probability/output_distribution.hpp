// How probable it is that an output is not above a value: proved bounds of its distribution function, from its
// polynomials in the uncertain quantities and from theirs, all at once for many values.
#pragma once

#include <atomic>
#include <cstddef>
#include <limits>
#include <vector>

#include "analyses/probability/joint_masses.hpp"
#include "analyses/surrogate/surrogate.hpp"

namespace gamut {

struct DistributionOptions {
  double gap = 0.005;           ///< between the bounds, aimed at
  int points = 512;             ///< values, at most
  double negligible = 0;        ///< of an output that is known to no more than that, its ends are told and a gap of 0
  std::size_t mostCells = 256;  ///< into which the box is bisected
  double mostWork = std::numeric_limits<double>::infinity();  ///< about (work.hpp): what is found with less is told
  const std::atomic<bool>* cancelled = nullptr;
};

/// lower[i] <= P(y <= value[i]) <= upper[i], values rising, of all distributions that the quantities may have together.
/// Between them P is between lower[i] and upper[i+1]; before the first it is 0, from the last on 1.
struct DistributionBounds {
  std::vector<double> value, lower, upper;
  double gap = 1;          ///< the greatest upper[i+1] - lower[i]: nowhere are the bounds farther apart
  bool isLimited = false;  ///< more work would bring them closer
};

/// Of one output, at the time that the parts are of. Empty where no bounds of the output are known, or if it was
/// cancelled.
DistributionBounds boundDistribution(const std::vector<SurrogatePart>& parts, std::size_t output,
                                     const JointMasses& masses, const DistributionOptions& options = {});

}  // namespace gamut
