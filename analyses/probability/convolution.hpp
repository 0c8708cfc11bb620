// Distributions of sums of independent variables on a grid, by Fourier transforms whose errors are bounded.
#pragma once

#include <vector>

namespace gamut {

/// Probabilities of multiples of a step: mass[i] of (first + i).
struct GridMasses {
  long first = 0;
  std::vector<double> mass;
};

/// Two of the same variable: one that is nowhere above it, one that is nowhere below it.
struct GridBounds {
  GridMasses below, above;
};

/// Of the sum, both sides. The probability that it is above (below) a number is off by `error` at most on each side, of
/// which `shift` is not rounding.
struct GridSum {
  GridBounds sum;
  double error = 0, shift = 0;
};
/// Masses of every part are at most 1 in all; those of `exact` are of both sides. By Σ|error| <= `error` on each side.
GridSum sumOf(const std::vector<GridBounds>& parts, const std::vector<GridMasses>& exact = {});

}  // namespace gamut
