// Polynomials of many symbols that are nearly sums of functions of one symbol each, or nearly a curve of such a sum: as
// sines, roots, products and quotients of what varies by little are.
#pragma once

#include <vector>

#include "analyses/flow/series/monomials.hpp"

namespace gamut {

/// φ(s) + constant + [-down, up], with s = Σ f_l(η_l) and φ(s) = s + Σ curve[n] s^n, n > 1, which rises for |s| <=
/// reach, where s always is.
struct CurvedSum {
  std::vector<std::vector<double>> f;  ///< [symbol][power], powers above 0
  std::vector<double> curve;           ///< [n]; empty: φ(s) = s
  double constant = 0, down = 0, up = 0, reach = 0;
  std::vector<double> mixedOf;  ///< [symbol]: of the terms with several symbols that are left, those that hold it

  /// About; off by no more than `rounding()`.
  double at(double s) const;
  double rounding() const;
  /// φ(s) > value for all s above that, and φ(s) < value for all s below: bounds of the number with φ(s) = value, or
  /// one beyond the reach.
  double above(double value) const;
  double below(double value) const;
};

/// Of Σ c_g η^g on [-1,1]^k. Symbols with isOwn = 0 are in no f.
CurvedSum curvedSumOf(const std::vector<double>& c, const Monomials& monomials, const std::vector<char>& isOwn);

}  // namespace gamut
