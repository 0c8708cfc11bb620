// Which states of a motion are there for the sake of others alone that nobody asks for: where a machine is, how far
// what spins has turned.
#pragma once

#include <span>
#include <vector>

#include "scalars/program/program.hpp"

namespace gamut {

/// Of each state of ẋ = f, whether an output of one of these programs, of the same states, depends on it, or the rate
/// of another one that is needed. Where such an output depends on a root, so is a state with a root in its rate that no
/// other has which is needed: where a linkage is closed in closed form, at a dead point the motion ends, but not what
/// the form says of the times behind.
std::vector<char> neededStates(const Program& f, std::span<const Program> readers);

/// ẋ = f where all that are not needed stand still.
Program withOthersAtRest(const Program& f, const std::vector<char>& isNeeded);

}  // namespace gamut
