// The scale is the unit's amount, which is known exactly.
#include "studies/told.hpp"

#include <cmath>

#include "mechanics/description/units.hpp"

namespace gamut {

Told::Told(const std::string& own, const std::string& stated) : unit_(own), one_(1.0), isOwn_(true) {
  if (stated.empty() || stated == own) return;
  try {
    const Amount one = oneOfUnit(stated);
    if (!one.hasUnit || one.isRelative || !isCompatible(one.dimension, dimensionOf(own))) return;
    unit_ = stated;
    one_ = enclose(one) / enclose(oneOfUnit(own));
    isOwn_ = false;
  } catch (const UnitError&) {  // of a file that another build wrote
  }
}

Told::Bounds Told::of(double lower, double upper) const {
  if (isOwn_ || !(lower <= upper) || !std::isfinite(upper - lower)) return {lower, upper};
  const Interval told = Interval(lower, upper) / one_;
  return {told.lower(), told.upper()};
}

Told::Bounds Told::perOne(double lower, double upper) const {
  if (isOwn_ || !(lower <= upper) || !std::isfinite(upper - lower)) return {lower, upper};
  const Interval told = Interval(lower, upper) * one_;
  return {told.lower(), told.upper()};
}

std::string Told::rateUnit() const {
  return isOwn_ ? rateUnitOf(unit_) : unit_ + (unit_.ends_with("/s") ? "^2" : "/s");
}

}  // namespace gamut
