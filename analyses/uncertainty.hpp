// One uncertain quantity, three views: an interval (what is guaranteed), a distribution (what is probable) and a
// membership function (what is possible). Both supports lie inside the interval, so a sample or an alpha-cut that
// leaves an enclosure of the interval is an error of the program, never bad luck.
#pragma once

#include <string>
#include <vector>

#include "analyses/distribution.hpp"
#include "scalars/interval.hpp"
#include "scalars/membership.hpp"

namespace gamut {

/// What distributions and membership functions may be of; own ones may be added.
struct ShapeTypes {
  std::vector<DistributionType> distributions = distributionTypes();
  std::vector<MembershipType> memberships = membershipTypes();
};

/// An uncertain quantity.
struct Uncertain {
  std::string name;
  Interval range;
  double nominal = 0;
  Distribution distribution;
  Membership membership;

  double blur = 0;  ///< how wide the nominal value itself is known, as of a formula
  /// Values that certainly are what is meant, where the ends of `range` were rounded outward from decimals and the
  /// nominal value: away from these by 32 roundings of the greatest number in it and four times `blur`. Empty of a
  /// range no wider.
  Interval inside() const;

  /// Throws std::invalid_argument, naming the quantity, unless the nominal value and both supports lie in the range.
  void check() const;
};

}  // namespace gamut
