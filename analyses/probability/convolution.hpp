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

/// Of the sum, both sides; masses of every part are at most 1 in all. By Σ|error| <= `error` on each side.
struct GridSum {
  GridBounds sum;
  double error = 0;
};
GridSum sumOf(const std::vector<GridBounds>& parts);

}  // namespace gamut
