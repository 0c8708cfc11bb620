// Angles of two coordinates, as atan2 of Recorded writes them: twice atan(y √(1/d)²), d = x + √(x² + y²). Where y = 0
// and x < 0 the half is π/2, though the formula has no value there since d = 0.
#pragma once

#include <optional>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// The nodes atan(y √(1/d)²) of a program.
std::vector<int> halfAnglesOf(const Program& program);
/// The node d of such a node, which is never negative.
int denominatorOf(const Program& program, int halfAngle);

/// Whether d and y may be zero: y √(1/d)², which `tangent` encloses, has the sign of y.
inline bool mayBeStraight(const Interval& tangent, const Interval& d) {
  return contains(d, 0.0) && (contains(tangent, 0.0) || isEmpty(tangent));
}
/// What such a node is in.
inline Interval halfAngle(const Interval& tangent, const Interval& d) {
  if (d.upper() == 0) return halfPi();
  return mayBeStraight(tangent, d) ? hull(atan(tangent), halfPi()) : atan(tangent);
}

/// x of such a node, if it is one and d is known to be what it should.
struct Abscissa {
  int node = -1;
  bool isNegated = false;
};
std::optional<Abscissa> abscissaOf(const Program& program, int node);

/// A program of y and x of each of these nodes, one after the other; 0 and 0 of those that `isKnown` tells not to be
/// known: d is not known to be what it should, or y or x are of other angles.
Program coordinatesOf(const Program& program, const std::vector<int>& halfAngles, std::vector<char>& isKnown);

/// For numbers: where x is below zero, d loses the digits of a small y, and has none left of a y of zero, so that such
/// a node has no value in `program`. With a = atan(y √(1/(√(x² + y²) + |x|))²) it is ±π/2 - a here, as if a zero were
/// above zero.
Program withHalfTurns(const Program& program);

}  // namespace gamut
