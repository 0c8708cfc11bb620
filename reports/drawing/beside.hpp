// What is known of an output at an instant, to be set beside its motion on the same axis: to the right how probable it
// is that the output is not above a value, to the left how possible the value is, and between which ends it is
// guaranteed to lie.
#pragma once

#include <string>
#include <vector>

#include "reports/drawing/axes.hpp"

namespace gamut {

/// Shapes in units of their own: upwards from -besideHeight, at `high`, to 0, at `low`; from -besideWidth, membership
/// 1, by 0 to besideWidth, probability 1.
struct BesideMoment {
  double time = 0;           ///< s
  double low = 0, high = 0;  ///< values of the output
  double middle = 0;         ///< around which spreads are drawn; NaN where there is none
  bool isProbable = false;   ///< something is known of the probability,
  bool isPossible = false;   ///< of the membership
  std::string shapes = {};   ///< paths
};
inline constexpr double besideWidth = 1000, besideHeight = 10000;

/// The moment that is nearest to a time; there is one at least.
const BesideMoment& nearestTo(const std::vector<BesideMoment>& moments, double time);

/// In the right part of a drawing whose motion has this frame: `from` and `until` are its left and right end. Values
/// are drawn less `around`.
void drawBeside(const BesideMoment& moment, const Frame& frame, double from, double until, double around,
                std::string& svg);

/// All of them as an element that is not shown; a script takes them from there. Empty without any.
std::string besideTemplate(const std::vector<BesideMoment>& moments, const std::string& label);

}  // namespace gamut
