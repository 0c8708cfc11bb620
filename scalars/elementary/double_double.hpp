// Double-double arithmetic: a real kept as the unevaluated sum of two doubles, about 106 bits.
// The building blocks of the kernels in kernels.hpp. Round-to-nearest only, no overflow or underflow: the
// callers keep their operands between 2^-200 and 2^200 or at zero. u = 2^-53 is the relative error of one rounding.
//
// Functions of <bool fused> use the fused multiply-add where the caller is compiled for hardware that has it, and
// otherwise Dekker's products. Exact results are exact either way; the bounds of inexact ones hold for both.
#pragma once

#include <cmath>

namespace gamut::detail {

/// The real number hi + lo. Normalised when |lo| <= u |hi|.
struct DoubleDouble {
  double hi, lo;
};

[[gnu::always_inline]] inline DoubleDouble operator-(const DoubleDouble& x) { return {-x.hi, -x.lo}; }

/// a * b + c with one rounding, or with two where there is no fused hardware.
template <bool fused>
[[gnu::always_inline]] inline double multiplyAdd(double a, double b, double c) {
  if constexpr (fused) return __builtin_fma(a, b, c);
  return a * b + c;
}

/// hi + lo = a + b exactly, normalised (Knuth's TwoSum).
[[gnu::always_inline]] inline DoubleDouble exactSum(double a, double b) {
  const double s = a + b, bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

/// hi + lo = a + b exactly, normalised, where |a| >= |b| or a = 0 (Dekker's FastTwoSum).
[[gnu::always_inline]] inline DoubleDouble exactSumOrdered(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// hi + lo = a * b exactly, normalised (Dekker's TwoProduct with Veltkamp's halves of 26 bits; one fma where fused).
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble exactProduct(double a, double b) {
  const double p = a * b;
  if constexpr (fused) return {p, __builtin_fma(a, b, -p)};
  constexpr double splitter = 0x1p27 + 1;
  const double ca = splitter * a, cb = splitter * b;
  const double aHigh = ca - (ca - a), bHigh = cb - (cb - b);
  const double aLow = a - aHigh, bLow = b - bHigh;
  return {p, aLow * bLow - (((p - aHigh * bHigh) - aLow * bHigh) - aHigh * bLow)};
}

/// n / d, normalised, with a relative error below 2^-98; |n.lo| <= 4 u |n.hi|, |d.lo| <= 4 u |d.hi|.
/// q = n.hi / d.hi to 3 u (two roundings). The remainder n - q d is below (3 + 4 + 4) u |n|: its leading part
/// n.hi - p is exact by Sterbenz' lemma, the other three operations err by u of at most 11 u |n| each. Divided by d.hi
/// for d (4 u) with two more roundings, the correction of 11 u errs by 11 u * 6 u + 3 * 11 u^2, below 2^-98.
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble quotient(const DoubleDouble& n, const DoubleDouble& d) {
  const double reciprocal = 1 / d.hi, q = n.hi * reciprocal;
  const DoubleDouble p = exactProduct<fused>(q, d.hi);
  const double remainder = ((n.hi - p.hi) - p.lo) + multiplyAdd<fused>(-q, d.lo, n.lo);
  return exactSumOrdered(q, remainder * reciprocal);
}

/// sqrt(x) for x > 0, normalised, with a relative error below 2^-100; |x.lo| <= 4 u x.hi.
/// s = sqrt(x.hi) to u; the remainder x - s^2 is below (2 + 4) u x, its leading part exact as above, two operations
/// err by u of it. Divided by 2 s instead of s + sqrt(x) (3 u) with a rounding, 3 u errs by 3 u * 4 u + 6 u^2.
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble squareRoot(const DoubleDouble& x) {
  const double s = std::sqrt(x.hi);
  const DoubleDouble p = exactProduct<fused>(s, s);
  const double remainder = ((x.hi - p.hi) - p.lo) + x.lo;
  return exactSumOrdered(s, remainder / (2 * s));
}

}  // namespace gamut::detail
