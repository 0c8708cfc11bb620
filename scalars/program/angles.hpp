// Angles of two coordinates, as atan2 of Recorded writes them: twice atan(y √(1/d)²), d = x + √(x² + y²).
#pragma once

#include <vector>

#include "scalars/program/program.hpp"

namespace gamut {

/// The nodes atan(y √(1/d)²) of a program.
std::vector<int> halfAnglesOf(const Program& program);
/// The node d of such a node, which is never negative.
int denominatorOf(const Program& program, int halfAngle);

/// For numbers: where x is below zero, d loses the digits of a small y, and has none left of a y of zero, so that such
/// a node has no value in `program`. With a = atan(y √(1/(√(x² + y²) + |x|))²) it is ±π/2 - a here, as if a zero were
/// above zero.
Program withHalfTurns(const Program& program);

}  // namespace gamut
