// Angles of two coordinates, as atan2 of Recorded writes them: twice atan(y √(1/d)²), d = x + √(x² + y²).
#pragma once

#include <vector>

#include "scalars/program/program.hpp"

namespace gamut {

/// The nodes atan(y √(1/d)²) of a program.
std::vector<int> halfAnglesOf(const Program& program);

/// For numbers: where y is exactly zero and x below zero, such a node has no value in `program`, and is π/2 here, as if
/// y were above zero. All else is computed as there.
Program withHalfTurns(const Program& program);

}  // namespace gamut
