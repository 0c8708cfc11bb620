// The equations of motion as they stand before anything is solved: forces in balance, loops by multipliers.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// r(t, y, ẏ, p) = 0 of y = [q; z; λ; u]: all coordinates, those that close loops too, own states, multipliers and
/// rates; differential-algebraic equations of index 1.
struct Balance {
  /// Throws UnfitPart as checkFit() does, and where something jumps.
  Balance(const Mechanism& mechanism, const std::vector<std::string>& freeParameters);
  /// Throws UnfitPart where coordinates do not say the position (balls, free frames, rolling), and where ends are
  /// rigid.
  static void checkFit(const Mechanism& mechanism);

  Program rows;  ///< of [y; ẏ]: the generalised force of each coordinate, M u̇ and Gᵀ λ among them; by how much own
                 ///< rates exceed ż; g̈ + 2σ ġ + σ² g of the loops (J. Baumgarte, Comput. Methods Appl. Mech. Eng. 1,
                 ///< 1972), which keeps what rounding opens from growing; u − q̇
  std::vector<bool> isAlgebraic;         ///< of each y: λ
  std::vector<std::string> coordinates;  ///< q
  std::vector<std::string> rates;        ///< u
  std::vector<std::string> ownStates;    ///< z

  /// σ [1/s].
  static constexpr double stabilisation = 20;

  std::size_t size() const { return isAlgebraic.size(); }
  /// What is asked of the machine, of y and the free parameters.
  Program outputs(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                  const std::vector<Expression>& asked) const;
};

}  // namespace gamut
