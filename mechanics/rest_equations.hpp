// All positions in which a mechanism rests, as roots of equations in a region.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// Where a mechanism without own states rests, f(q) + G(q)ᵀ λ = 0 and g(q) = 0 of its coordinates and the multipliers
/// of its loops, that may be any: with λ = Λ μ/μ0, μ0 > 0,
///
///   μ0 f + Λ Gᵀ μ = 0,   g = 0,   μ0² + |μ|² = 1.
struct RestEquations {
  Program roots;      ///< these, of q and, where there are loops, μ0 and μ, and of the free parameters
  Program stiffness;  ///< of the same: K = −∂(f + Gᵀ λ)/∂q, bordered by G, symmetric and row by row
  Box multipliers;    ///< which holds all (μ0, μ)
};

/// Throws UnfitPart as RestRows does, and where elements have states alone.
RestEquations restEquations(const Mechanism& mechanism, const std::vector<std::string>& freeParameters);

/// How many eigenvalues of a symmetric matrix, n by n and row by row, are below zero: with T near to its eigenvectors
/// Tᵀ K T has as many (J. J. Sylvester), and those of its discs (S. Gershgorin) that lie below zero count them. Nothing
/// where a disc holds zero, or where the matrix is certainly not symmetric.
std::optional<int> negativeEigenvalues(const std::vector<Interval>& matrix, int n);

}  // namespace gamut
