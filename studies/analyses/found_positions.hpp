// What results of several positions have in common: bounds of each coordinate of each.
#pragma once

#include <algorithm>
#include <string>

#include "studies/results/grid.hpp"
#include "studies/words.hpp"

namespace gamut {

/// " angle in [..], path in [..]" of position k; `coordinates`: names, with ", " between them.
inline std::string boundsText(const std::string& coordinates, const Grid& lower, const Grid& upper, std::size_t k) {
  std::string text;
  std::size_t from = 0;
  for (std::size_t i = 0; from < coordinates.size(); ++i) {
    const std::size_t to = std::min(coordinates.find(", ", from), coordinates.size());
    text +=
        (i > 0 ? ", " : " ") + coordinates.substr(from, to - from) + " in " + rangeText(lower(k, i), upper(k, i), 8);
    from = to + 2;
  }
  return text;
}

inline bool areOrdered(const Grid& lower, const Grid& upper) {
  return std::ranges::equal(lower.data, upper.data, [](double a, double b) { return a <= b; });
}

}  // namespace gamut
