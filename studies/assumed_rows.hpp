// Rows of closed loops that a study assumes to follow from all others: whether they do, in doubles. That they do cannot
// be proved by intervals; what is proved holds if they do.
#pragma once

#include <string>
#include <vector>

#include "studies/machine.hpp"

namespace gamut {

/// What is assumed of a closure, as "that places along x of 'D' follow from the other rows of all loops".
struct Assumption {
  std::string element, sentence;
};
/// Throws UnfitPart where the loops do not close.
std::vector<Assumption> assumptionsOn(const Mechanism& mechanism);

/// Throws StudyError where they do not hold at the start of some values of the quantities, or along some motions.
void refuseRowsThatDoNotFollow(const Machine& machine);

}  // namespace gamut
