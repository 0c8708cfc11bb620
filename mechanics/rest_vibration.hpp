// Undamped modes about rest: ω² are the eigenvalues of K φ = ω² M φ in the coordinates that loops leave free,
//
//   K = −Zᵀ (∂R/∂q) Z,  M = −Zᵀ (∂R/∂q̈) Z,  Z = [1; −J_d⁻¹ J_i],
//
// symmetric where forces have a potential. They are counted in their order, 0 the least, whether they meet or not.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "mechanics/rest_rows.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

struct RestVibration {
  /// Of v and parameters: R, then the lower triangles of K and M, row by row.
  Program pencil;
  int size = 0;               ///< of K
  std::vector<double> basis;  ///< Φ, row by row: ΦᵀMΦ is about 1 and ΦᵀKΦ about diagonal at the nominal values
  std::vector<double> squares;  ///< all ω² there, rad²/s²
  std::vector<int> modes;       ///< those that are wanted, 0 the slowest that oscillates
  int unstable = 0;             ///< eigenvalues below these: the number of mode k is unstable + k
  Program near;                 ///< of parameters: about ω² of each wanted mode, rad²/s²
  Program shapes;               ///< likewise, about x of φ = Φ x, all of each, of which that of its own number is 1

  int number(std::size_t wanted) const { return unstable + modes[wanted]; }
};

/// Whether all forces have one. At many values of the parameters, which no such force
/// passes unless it is zero at all of them.
bool hasPotential(const RestRows& rows, const std::vector<double>& v, const Box& parameters);

/// `v`: at rest; `position`: v of parameters, nearly; `wanted`: 1 the slowest. Throws UnfitPart where not all joints
/// move a mass.
RestVibration vibrationOf(const RestRows& rows, const std::vector<double>& v, const Box& parameters,
                          const std::function<std::vector<Recorded>(std::span<const Recorded>)>& position,
                          const std::vector<int>& wanted,
                          const std::function<Program(const Program&, double)>& approximated);

/// All ω² at once of a pencil's triangles; NaN where they are not finite.
std::vector<double> squaresOf(std::span<const double> triangles, int size);

}  // namespace gamut
