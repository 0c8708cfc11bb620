#include "scalars/elementary/special_functions.hpp"

namespace gamut::detail {

Bounds boundErfc(double x) { return evaluate(mpfr_erfc, x); }

Bounds boundLogGamma(double x) { return evaluate(mpfr_lngamma, x); }

}  // namespace gamut::detail
