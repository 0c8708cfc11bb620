// The outputs' polynomials in the uncertain quantities, by which other programs know the outputs without integrating.
#pragma once

#include <vector>

#include "analyses/surrogate/packed_surrogate.hpp"
#include "studies/results/fields.hpp"

namespace gamut {

/// Of all quantities; of what varies in time nothing depends. Of all outputs but the requirements' margins.
struct SurrogateResult : PackedSurrogate {
  bool present = false;
  std::vector<double> part, term, number;  ///< 0, 1, ...: of parts, of terms, of coefficients
};

void describe(SurrogateResult& surrogate, std::vector<Group>& groups);

}  // namespace gamut
