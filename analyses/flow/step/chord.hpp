// What lies between two moments of a solution: near its chord.
#pragma once

#include "analyses/flow/series/embedded.hpp"

namespace gamut {

/// How far solutions leave their chords between two moments, a share s of the way from the first: by 4 s (1 - s) times
/// something in `bend`, which holds zero, and by up to `rest` besides.
struct FlowSag {
  Interval bend{0.0};
  double rest = 0;

  /// However far it is from the moments.
  Interval whole() const { return inflated(bend, rest); }
};

/// Where solutions are between two moments at which they are `before` and `after`.
Interval overChord(const Interval& before, const Interval& after, const FlowSag& sag);

}  // namespace gamut
