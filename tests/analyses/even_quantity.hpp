// A quantity that is as likely anywhere in its interval, and most possible in the middle of it.
#pragma once

#include "analyses/uncertainty.hpp"

namespace gamut::testing {

inline Uncertain evenQuantity(const Interval& range) {
  Uncertain u;
  u.name = "q";
  u.range = range;
  u.nominal = midpoint(range);
  u.distribution = Distribution::uniform(range);
  u.membership = Membership::triangular(range.lower(), u.nominal, range.upper());
  return u;
}

}  // namespace gamut::testing
