// What is proved of a requirement, as a map of two quantities, whatever all others are within their intervals.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "studies/results/requirements.hpp"

namespace gamut {

/// Rectangles of whole places of a square of `size` by `size`: left, bottom, width, height. At a place that is met all
/// cells over it are, and so it is with those that are violated.
struct DecidedMap {
  using Rectangle = std::array<int, 4>;
  std::vector<Rectangle> met, violated;
};

DecidedMap decidedMap(const std::vector<const RequirementCell*>& cells, std::size_t across, std::size_t upward,
                      int size);

}  // namespace gamut
