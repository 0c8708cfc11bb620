// Distribution functions on paper: proved bounds, the samples' share between them and its band.
#pragma once

#include <cstddef>
#include <string>

#include "studies/results/results.hpp"

namespace gamut {

/// Of one output at the time numbered `at` among those of results.distribution; empty where nothing is known.
std::string drawDistribution(const Results& results, std::size_t at, std::size_t output, const std::string& label);

}  // namespace gamut
