// The functions of Recorded that need more than one line.
#include "scalars/recorded.hpp"

#include <cmath>

namespace gamut {

Recorded acos(const Recorded& a) { return Recorded(0.5 * pi()) - asin(a); }

Recorded pow(const Recorded& a, int exponent) {
  if (exponent < 0) return 1.0 / pow(a, -exponent);
  if (exponent == 0) return 1.0;
  if (exponent == 1) return a;
  const Recorded half = pow(a, exponent / 2);
  return exponent % 2 == 0 ? sqr(half) : sqr(half) * a;
}

Recorded pow(const Recorded& a, double exponent) {
  if (exponent == std::trunc(exponent) && std::fabs(exponent) < 1024) return pow(a, static_cast<int>(exponent));
  return pow(a, Recorded(exponent));
}

}  // namespace gamut
