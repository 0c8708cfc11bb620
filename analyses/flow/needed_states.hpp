// Which states of a motion are there for the sake of others alone that nobody asks for: where a machine is, how far
// what spins has turned.
#pragma once

#include <span>
#include <vector>

#include "scalars/program/program.hpp"

namespace gamut {

/// Of each state of ẋ = f, whether an output of one of these programs, of the same states, depends on it, or the rate
/// of another one that is needed. So is a state whose rate may have no value, by a root, a quotient or a system of
/// equations that stands in no rate of those: a loop that cannot close ends the motion of all there is, though others
/// need nothing of it. `rootsAlone`: not for quotients and systems.
std::vector<char> neededStates(const Program& f, std::span<const Program> readers, bool rootsAlone = false);

/// ẋ = f where all that are not needed stand still.
Program withOthersAtRest(const Program& f, const std::vector<char>& isNeeded);

}  // namespace gamut
