// What may not differ between two runs of a sweep.
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "studies/sweeps/sweep_results.hpp"

namespace gamut {

/// All numbers but costs.
inline std::vector<std::uint64_t> bitsOf(const SweepResults& sweep) {
  std::vector<std::uint64_t> bits;
  for (const std::vector<Grid>* grids : {&sweep.ofRequirements, &sweep.ofOutputs})
    for (const Grid& grid : *grids)
      for (const double x : grid.data) bits.push_back(std::bit_cast<std::uint64_t>(x));
  for (const SweepPoint& point : sweep.points) {
    bits.push_back(static_cast<std::uint64_t>(point.state));
    bits.push_back(std::bit_cast<std::uint64_t>(point.reached));
  }
  return bits;
}

/// All that is said of its points.
inline std::vector<std::string> wordsOf(const SweepResults& sweep) {
  std::vector<std::string> all;
  for (const SweepPoint& point : sweep.points) all.push_back(point.verdict + ": " + point.why);
  return all;
}

}  // namespace gamut
