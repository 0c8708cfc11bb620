// What results of several positions have in common: bounds of each coordinate of each.
#pragma once

#include <algorithm>
#include <string>

#include "studies/results/grid.hpp"
#include "studies/told.hpp"
#include "studies/words.hpp"

namespace gamut {

/// " angle in [..] deg, path in [..] m" of position k; `coordinates`: names, `units`: in which people are told of each
/// (empty: rad, m), with ", " between them.
inline std::string boundsText(const std::string& coordinates, const std::string& units, const Grid& lower,
                              const Grid& upper, std::size_t k) {
  std::string text;
  const auto next = [](const std::string& list, std::size_t& from) {
    const std::size_t to = std::min(list.find(", ", from), list.size());
    std::string word = from < to ? list.substr(from, to - from) : std::string();
    from = to + 2;
    return word;
  };
  std::size_t name = 0, unit = 0;
  for (std::size_t i = 0; name < coordinates.size(); ++i) {
    text += (i > 0 ? ", " : " ") + next(coordinates, name) + " in ";
    const std::string stated = unit < units.size() ? next(units, unit) : std::string();
    const bool turns = Told("rad", stated).unit() == stated;
    const Told told(turns ? "rad" : "m", stated);
    const auto [least, greatest] = told.of(lower(k, i), upper(k, i));
    text += stated.empty() ? rangeText(least, greatest, 8) : inUnit(rangeText(least, greatest, 8), stated);
  }
  return text;
}

inline bool areOrdered(const Grid& lower, const Grid& upper) {
  return std::ranges::equal(lower.data, upper.data, [](double a, double b) { return a <= b; });
}

}  // namespace gamut
