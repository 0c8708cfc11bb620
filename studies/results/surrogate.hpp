// The outputs' polynomials in the uncertain quantities, by which other programs know the outputs without integrating.
#pragma once

#include <vector>

#include "analyses/surrogate/packed_surrogate.hpp"
#include "studies/results/part.hpp"

namespace gamut {

/// Of all quantities; of what varies in time nothing depends. Of all outputs but the requirements' margins.
struct SurrogateResult final : Part, PackedSurrogate {
  std::vector<double> part, term, number;  ///< 0, 1, ...: of parts, of terms, of coefficients

  std::string title() const override { return "polynomials"; }
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
