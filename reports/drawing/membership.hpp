// Membership functions on paper: the proved alpha-cuts level by level, and what samples reached of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/results/results.hpp"

namespace gamut {

struct Cut {
  double alpha, lower, upper;
};
/// Those of an output at an output time that are known, level by level.
std::vector<Cut> cutsOf(const std::vector<double>& alpha, const std::vector<Envelope>& bounds, std::size_t time,
                        std::size_t output);

/// Of one output at an output time; empty where nothing is known.
std::string drawMembership(const Results& results, std::size_t time, std::size_t output, const std::string& label);

}  // namespace gamut
