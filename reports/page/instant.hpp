// What is known of an output at some instants, beside its motion.
#pragma once

#include <cstddef>
#include <vector>

#include "reports/drawing/beside.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// At the times of the distributions, or at about a dozen, and at the instant at which the output is looked at.
std::vector<BesideMoment> besideOf(const Results& results, std::size_t output);

}  // namespace gamut
