// All positions in which a mechanism rests, as roots of equations in a region.
#pragma once

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
  Program roots;                    ///< these, of q and, where there are loops, μ0 and μ, and of the free parameters
  Program nearRest;                 ///< of the same and of q̇, which are zero at rest: what NearRest::of reads
  Program resisting;                ///< likewise: what Resistances::of reads
  int resistances = 0, masses = 0;  ///< of these
  Box multipliers;                  ///< which holds all (μ0, μ)
  int coordinates = 0;
};

/// Throws UnfitPart as RestRows does, and where elements have states alone.
RestEquations restEquations(const Mechanism& mechanism, const std::vector<std::string>& freeParameters);

}  // namespace gamut
