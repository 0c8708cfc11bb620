// Membership functions on paper: the proved alpha-cuts level by level, and what samples reached of them.
#pragma once

#include <cstddef>
#include <string>

#include "studies/results/results.hpp"

namespace gamut {

/// Of one output at an output time; empty where nothing is known.
std::string drawMembership(const Results& results, std::size_t time, std::size_t output, const std::string& label);

}  // namespace gamut
