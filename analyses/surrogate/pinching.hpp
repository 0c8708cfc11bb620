// By how much less an output would be uncertain if one quantity were known (S. Ferson, W. T. Tucker, Reliability
// Engineering and System Safety 91, 2006: pinching).
#pragma once

#include <cstddef>
#include <vector>

#include "analyses/surrogate/surrogate.hpp"

namespace gamut {

/// Of one output, at the time that the parts are of: the share by which the width of its enclosure shrinks where a
/// quantity has its nominal value alone, one a quantity; 0 of what is no part of the polynomials, NaN where the
/// enclosure has no width or no bound.
std::vector<double> pinchedShares(const Surrogate& surrogate, const std::vector<SurrogatePart>& parts,
                                  std::size_t output, const std::vector<double>& nominal);

}  // namespace gamut
