#include "analyses/flow/step/chord.hpp"

#include <algorithm>

namespace gamut {

namespace {

/// The least of (1 - s) a + s b - 4 s (1 - s) bend on [0, 1]: it falls and rises again where 4 bend > |b - a|, to
/// (a + b) / 2 - bend - (b - a)² / (16 bend) at s = 1/2 - (b - a) / (8 bend).
double leastBetween(double a, double b, double bend) {
  const double least = std::min(a, b);
  const Interval rise = Interval(b) - Interval(a);
  if (!(mignitude(rise) < 4 * bend)) return least;
  const Interval middle = Interval(0.5) * (Interval(a) + Interval(b));
  const Interval bottom = middle - Interval(bend) - sqr(rise) / (Interval(16.0) * Interval(bend));
  return std::max(bottom.lower(), (Interval(least) - Interval(bend)).lower());
}

}  // namespace

/// A solution is above its chord less 4 s (1 - s) of what that bends downwards and the rest, and its chord is above the
/// one between the lower ends; likewise from above.
Interval overChord(const Interval& before, const Interval& after, const FlowSag& sag) {
  if (!isCommon(before) || !isCommon(after) || !isBounded(sag.bend)) return hull(before, after) + sag.whole();
  const double least = leastBetween(before.lower(), after.lower(), -sag.bend.lower());
  const double greatest = -leastBetween(-before.upper(), -after.upper(), sag.bend.upper());
  return inflated(Interval(least, greatest), sag.rest);
}

}  // namespace gamut
