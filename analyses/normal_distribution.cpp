#include "analyses/normal_distribution.hpp"

#include <gsl/gsl_cdf.h>

#include "scalars/elementary/special_functions.hpp"

namespace gamut {

/// |erfc'| <= 2/√π < 1.13: where that loses no digit that counts, an end tells of the other.
Interval normalBelow(const Interval& z) {
  const Interval x = -z / sqrt(Interval(2.0));
  const auto half = [](const detail::Bounds& erfc) { return 0.5 * Interval(erfc.down, erfc.up); };
  const Interval first = half(detail::boundErfc(x.upper()));
  if (width(x) <= 0x1p-50 && magnitude(x) < 3) return first + Interval(0.0, width(x));
  return hull(first, half(detail::boundErfc(x.lower())));
}

double aboutNormalBelow(double z) { return gsl_cdf_ugaussian_P(z); }

double aboutNormalQuantile(double probability) { return gsl_cdf_ugaussian_Pinv(probability); }

}  // namespace gamut
