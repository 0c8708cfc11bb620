// Bounds of sin, cos, tan, exp, log, atan, asin and acos at a double: the greatest double that is not above the exact
// value and the least that is not below it, always, so a result never depends on how it was found. It is found
//
//   - at points where the value is a double (sin 0, exp 0, log 1, ...) by naming it; elsewhere the value is irrational
//     (Lindemann), hence strictly between its bounds;
//   - for tiny arguments from the first terms of the series, of alternating or equal signs;
//   - by a double-double kernel (kernels.hpp) with its proved error e: the value is hi + lo +- e. With
//     h + l = hi + lo, h the nearest double, no double lies between hi + lo - e and hi + lo + e if |l| > e, as the
//     doubles beside h are no nearer to hi + lo than h is. So the bounds are h and its neighbour on l's side;
//   - by MPFR in all other cases: |l| <= e (one ordinary argument in 2000 to 6000), huge arguments, results near
//     overflow or underflow, and everything when the processor does not round to nearest or flushes subnormal numbers,
//     for then the proofs of the kernels do not hold. That mode is read and never written.
#pragma once

#include "scalars/elementary/mpfr_bounds.hpp"

namespace gamut::detail {

/// Infinite arguments are limits. log needs x >= 0, asin and acos -1 <= x <= 1. No argument may be NaN.
Bounds expBounds(double x);
Bounds logBounds(double x);
Bounds atanBounds(double x);
Bounds asinBounds(double x);
Bounds acosBounds(double x);
SinCosBounds sinCosBounds(double x);
Bounds tanBounds(double x);

/// floor(2 x / pi) modulo 8 tells between which multiples of pi / 2 a finite x lies; -1 if that is unknown.
struct SinCosTurn {
  SinCosBounds value;
  int quadrant;
};
struct TanTurn {
  Bounds value;
  int quadrant;
};
SinCosTurn sinCosTurn(double x);
TanTurn tanTurn(double x);

}  // namespace gamut::detail
