// At which instants results are looked at first: where a requirement comes nearest to its limit, where an output varies
// most.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "studies/results/results.hpp"

namespace gamut {

/// What is known best of all outputs: guaranteed, or else sampled, or else possible at all; null if nothing is.
const Bounds* bestKnown(const Results& results);

/// The instant of the violation that is told; else the output time of the window at which a margin is least (of what is
/// to be once: at which the least margin is greatest), s. NaN where nothing is known.
double decisiveTime(const Results& results, const RequirementResult& requirement);

/// The time at which what is proved of all cases ends before the horizon, s: of the enclosure, or else of the
/// alpha-cuts. Nothing where neither was asked for, it comes to the horizon, or nothing moves.
std::optional<double> endOfProof(const Results& results);

/// What an output's number at an output time is called: "margin of grip" of what is the margin of a requirement; empty
/// at a time at which that demands nothing.
std::string toldName(const Results& results, std::size_t output, std::size_t time);

/// The output time at which an output's bounds are farthest apart, s; the first of several. NaN where nothing is known.
double widestTime(const Results& results, std::size_t output);

}  // namespace gamut
