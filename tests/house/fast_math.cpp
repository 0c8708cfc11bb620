// Returns 0 if bounds computed in headers are bounds: a compiler that re-associates takes every rounding error for
// zero.
#include <cmath>
#include <limits>

#include "scalars/elementary/rounding.hpp"

int main() {
  using namespace gamut;
  volatile double one = 1, tiny = 0x1p-60, three = 3;
  const double above = std::nextafter(1.0, 2.0), below = std::nextafter(1.0, 0.0);
  const bool sums = addUp(one, tiny) == above && addDown(one, -tiny) == below && subDown(one, tiny) == below;
  const bool products = mulDown(above, above) < mulUp(above, above);
  const bool quotients = divDown(one, three) < divUp(one, three) && divUp(one, three) == nextUp(divDown(one, three));
  const bool roots = sqrtDown(three) < sqrtUp(three);
  return sums && products && quotients && roots ? 0 : 1;
}
