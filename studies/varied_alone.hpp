// What an output is where one quantity alone goes from the least to the greatest of its values and all others have
// their nominal ones: by the polynomials that results hold, with their proved errors.
#pragma once

#include <cstddef>
#include <vector>

#include "studies/results/results.hpp"

namespace gamut {

/// In the output's unit, proved.
struct ProvedValue {
  double lower = 0, upper = 0;
};

struct VariedAlone {
  std::size_t quantity = 0;
  ProvedValue atLeast, atGreatest;  ///< of the quantity's values

  double low() const;   ///< the least that is known of both
  double high() const;  ///< the greatest
};

struct AllVariedAlone {
  std::size_t row = 0;  ///< the output time that it is of
  ProvedValue nominal;
  std::vector<VariedAlone> quantities;  ///< in the order of the results; none: nothing is known
};

/// At the output time next to this one of which the results hold polynomials of the output.
AllVariedAlone variedAlone(const Results& results, std::size_t output, std::size_t row);

}  // namespace gamut
