// The standard normal distribution on a grid: probabilities that add up exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gamut {

struct NormalGrid {
  static constexpr std::uint16_t count = 1 << 14;  ///< of cells between nodes
  static constexpr double reach = 8;               ///< what is beyond counts as in the first or the last cell

  static double at(std::size_t node) { return -reach + 2 * reach * (static_cast<double>(node) / count); }
  /// Φ at the nodes, about: the first is 0, the last 1. Between nodes differences are probabilities, exactly adding up.
  static const std::vector<double>& below();
  /// Σ|error| of all cells' probabilities is at most that.
  static double error();
};

}  // namespace gamut
