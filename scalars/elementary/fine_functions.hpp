// Elementary functions of double-double arguments, by MPFR: for few evaluations that need more digits than a double
// has.
#pragma once

#include "scalars/elementary/double_double.hpp"

namespace gamut::detail {

/// |f(x) - value| ≤ error. value.hi is NaN, or infinite, where f is not defined, or too large.
struct FineValue {
  DoubleDouble value;
  double error;
};

struct FineSinCos {
  FineValue sin, cos;
};

FineValue fineExp(const DoubleDouble& x);
FineValue fineLog(const DoubleDouble& x);
FineValue fineAtan(const DoubleDouble& x);
FineSinCos fineSinCos(const DoubleDouble& x);

}  // namespace gamut::detail
