// Numbers in symbols ξ ∈ [-1,1]^k: what they may be, and halves of these.
#pragma once

#include <cmath>
#include <vector>

#include "analyses/flow/series/error_bounds.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// One uncertain number: value = centre + low + half·ξ_symbol ± radius (symbol -1: no dependence).
struct Embedded {
  double centre = 0, half = 0, radius = 0;
  int symbol = -1;
  double low = 0;  // second double of the centre
  /// |value - centre - half·ξ| ≤ this, for whoever does not see `low`.
  double coarseRadius() const { return low == 0 ? radius : (std::fabs(low) + radius) * bounds::up; }
};

/// range + [-radius, radius]; the whole line for a radius that is infinite or no number.
Interval inflated(const Interval& range, double radius);

/// All that the number may be; that all of them may.
Interval rangeOf(const Embedded& value);
Box rangesOf(const std::vector<Embedded>& values);

/// From now on ξ_symbol = middle + ξ'/2, middle ±1/2, of numbers and of a piece, centre + half·ξ.
void halve(std::vector<Embedded>& values, int symbol, double middle);
void halve(std::vector<double>& centre, std::vector<double>& half, int symbol, double middle);

}  // namespace gamut
