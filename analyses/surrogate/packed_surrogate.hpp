// A surrogate as plain numbers, for files: output = Σ coefficient Π η_q^exponent ± radius on each part of the box, with
// η_q = ((value - centre) / half - part_centre) / part_half.
#pragma once

#include <vector>

namespace gamut {

/// A quantity on which no polynomial depends has half 0, exponents 0, and part_half 1.
struct PackedSurrogate {
  std::vector<double> centre, half;          ///< [quantity]
  std::vector<double> row, firstTerm;        ///< [part], rows rising: number of the output time; first of its terms
  std::vector<double> partCentre, partHalf;  ///< [part][quantity]
  std::vector<double> exponent;              ///< [term][quantity]
  std::vector<double> first, count;          ///< [part][output]: its coefficients, of the part's first terms
  std::vector<double> radius;                ///< [part][output]; NaN: there is no polynomial
  std::vector<double> coefficient;
};

}  // namespace gamut
