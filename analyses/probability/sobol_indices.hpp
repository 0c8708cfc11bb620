// How much of an output's variance comes from which quantity: proved bounds of Sobol' indices, from the output's
// polynomials in the uncertain quantities (I. M. Sobol', Mathematics and Computers in Simulation 55, 2001).
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "analyses/probability/quantity_masses.hpp"
#include "analyses/surrogate/surrogate.hpp"
#include "scalars/interval.hpp"

namespace gamut {

struct SobolIndices {
  Interval mean = Interval::entire(), deviation = Interval::entire();  ///< of the output
  /// One a quantity: the share of the variance that would vanish on average if the quantity were known, and that which
  /// would stay if all others were. All of [0, 1] where the variance may be nothing.
  std::vector<Interval> first, total;
};

/// Of one output, at the time that the parts are of. Where it would cost more than `work` (work.hpp), the least terms
/// of polynomials count as their error.
SobolIndices sobolIndices(const Surrogate& surrogate, const std::vector<SurrogatePart>& parts, std::size_t output,
                          const QuantityMasses& masses, double work = std::numeric_limits<double>::infinity());

}  // namespace gamut
