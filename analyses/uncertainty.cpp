#include "analyses/uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include "scalars/elementary/rounding.hpp"

namespace gamut {

Interval Uncertain::inside() const {
  const double rounding = 32 * 0x1p-53 * std::max(magnitude(range), std::fabs(nominal)) + 4 * blur;
  const double lower = addUp(range.lower(), rounding), upper = subDown(range.upper(), rounding);
  return lower <= upper ? Interval(lower, upper) : Interval::empty();
}

void Uncertain::check() const {
  const std::string of = "uncertain quantity '" + name + "': ";
  requireShape(!isEmpty(range) && isBounded(range), of + "its interval must be bounded, not " + toString(range));
  requireShape(contains(range, nominal),
               of + "the nominal value " + toString(nominal) + " lies outside its interval " + toString(range));
  requireShape(isSubset(distribution.support(), range),
               of + "the distribution reaches beyond its interval " + toString(range));
  requireShape(isSubset(membership.support(), range),
               of + "the membership function reaches beyond its interval " + toString(range));
}

}  // namespace gamut
