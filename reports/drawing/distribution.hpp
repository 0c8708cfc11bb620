// Distribution functions on paper: proved bounds, the samples' share between them and its band.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/results/results.hpp"

namespace gamut {

/// Values with bounds of the probability of no more, and the samples' share.
struct Stairs {
  std::vector<double> value, lower, upper, sampled;
};

/// What is drawn of one output at the time numbered `at` among those of results.distribution.
Stairs stairsOf(const Results& results, std::size_t at, std::size_t output);

/// The same as a drawing; empty where nothing is known.
std::string drawDistribution(const Results& results, std::size_t at, std::size_t output, const std::string& label);

}  // namespace gamut
