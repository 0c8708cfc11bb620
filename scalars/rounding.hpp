// Directed rounding in round-to-nearest: for each operation the greatest double below and the least double above the
// exact result. An error-free transformation gives the sign of the rounding error, which decides whether the nearest
// double must be left for its neighbour. No rounding mode is touched, so the bounds hold in every thread, beside any
// library and under any optimisation that keeps IEEE 754 (sources: Knuth; Dekker; Ogita, Rump & Oishi 2005).
//
//   addDown(a, b) <= a + b <= addUp(a, b)      and no doubles lie closer.
//
// Infinite operands are taken as exact; an overflow of finite operands is +inf above and the largest double below.
// An undefined result (inf - inf, 0 * inf, 0 / 0, x / 0, sqrt(-1), NaN) gets the bounds that are always true: -inf,
// +inf.
#pragma once

#include <bit>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "Gamut's bounds need IEEE 754 arithmetic: build without -ffast-math and -ffinite-math-only."
#endif

namespace gamut {

static_assert(FLT_EVAL_METHOD == 0, "Gamut's bounds need doubles that are evaluated as doubles (no x87 registers).");
static_assert(std::numeric_limits<double>::is_iec559);

namespace detail {

/// The neighbour above / below of a finite x != 0: doubles are ordered as their magnitudes' bit patterns are.
inline double stepUp(double x) noexcept {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(bits + ((bits >> 63) | 1));
}
inline double stepDown(double x) noexcept {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(bits - ((bits >> 63) | 1));
}

/// True when 2^-900 <= |x| < 2^990: far enough from underflow for exact errors (2^-900 * 2^-106 > 2^-1074) and from
/// overflow for Dekker's splitting (|x| < 2^996). False for NaN and infinities.
inline bool isModerate(double x) noexcept {
  constexpr std::uint64_t low = std::uint64_t{1023 - 900} << 52, high = std::uint64_t{1023 + 990} << 52;
  return (std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63)) - low < high - low;
}

/// The exact a * b - p for p = fl(a * b), where p is moderate and |a|, |b| < 2^990.
/// With fused hardware one instruction; without it Dekker's TwoProduct (17 operations, faster than a software fma).
inline double productError(double a, double b, double p) noexcept {
#ifdef __FMA__
  return std::fma(a, b, -p);
#else
  constexpr double splitter = 134217729.0;  // 2^27 + 1: Veltkamp's halves of 26 bits each
  const double ca = splitter * a, cb = splitter * b;
  const double aHigh = ca - (ca - a), bHigh = cb - (cb - b);
  const double aLow = a - aHigh, bLow = b - bHigh;
  return aLow * bLow - (((p - aHigh * bHigh) - aLow * bHigh) - aHigh * bLow);
#endif
}

/// The exact a - q * b for q = fl(a / b) (or a = x, q = b = fl(sqrt(x))), all three moderate.
/// a - p is exact by Sterbenz' lemma (p is within a factor 2 of a), and the residual itself is a double.
inline double residual(double a, double q, double b) noexcept {
#ifdef __FMA__
  return std::fma(-q, b, a);
#else
  const double p = q * b;
  return (a - p) - productError(q, b, p);
#endif
}

// The same results where the fast path's premises fail: zeros, infinities, overflow, underflow (rounding.cpp).
double addSlow(double a, double b, bool up) noexcept;
double mulSlow(double a, double b, bool up) noexcept;
double divSlow(double a, double b, bool up) noexcept;
double sqrtSlow(double x, bool up) noexcept;

}  // namespace detail

/// The least double above x; +inf for the largest double and for +inf. NaN stays NaN.
inline double nextUp(double x) noexcept {
  if (x == 0) return std::numeric_limits<double>::denorm_min();
  if (!(x < std::numeric_limits<double>::infinity())) return x;
  return detail::stepUp(x);
}

/// The greatest double below x; -inf for the lowest double and for -inf. NaN stays NaN.
inline double nextDown(double x) noexcept { return -nextUp(-x); }

/// TwoSum: s + e = a + b exactly while |s| < 2^1022 (Boldo, Graillat & Muller 2017: no spurious overflow then).
/// The exact sum lies below s just when e < 0.
inline double addDown(double a, double b) noexcept {
  const double s = a + b;
  if (!(std::abs(s) < 0x1p1022)) return detail::addSlow(a, b, false);
  const double bb = s - a;
  const double e = (a - (s - bb)) + (b - bb);
  return e < 0 ? detail::stepDown(s) : s;  // e != 0 implies s != 0: sums that underflow are exact
}

/// As addDown; the exact sum lies above s just when e > 0.
inline double addUp(double a, double b) noexcept {
  const double s = a + b;
  if (!(std::abs(s) < 0x1p1022)) return detail::addSlow(a, b, true);
  const double bb = s - a;
  const double e = (a - (s - bb)) + (b - bb);
  return e > 0 ? detail::stepUp(s) : s;
}

/// a - b = a + (-b), and negation is exact.
inline double subDown(double a, double b) noexcept { return addDown(a, -b); }
inline double subUp(double a, double b) noexcept { return addUp(a, -b); }

/// TwoProduct: p + e = a * b exactly for a moderate p; the exact product lies below p just when e < 0.
inline double mulDown(double a, double b) noexcept {
  const double p = a * b;
  if (!(detail::isModerate(p) && std::abs(a) < 0x1p990 && std::abs(b) < 0x1p990)) return detail::mulSlow(a, b, false);
  return detail::productError(a, b, p) < 0 ? detail::stepDown(p) : p;
}

/// As mulDown; the exact product lies above p just when e > 0.
inline double mulUp(double a, double b) noexcept {
  const double p = a * b;
  if (!(detail::isModerate(p) && std::abs(a) < 0x1p990 && std::abs(b) < 0x1p990)) return detail::mulSlow(a, b, true);
  return detail::productError(a, b, p) > 0 ? detail::stepUp(p) : p;
}

/// a / b = q + r / b with the exact residual r = a - q b: the quotient lies below q just when r / b < 0.
inline double divDown(double a, double b) noexcept {
  const double q = a / b;
  if (!(detail::isModerate(a) && detail::isModerate(b) && detail::isModerate(q))) return detail::divSlow(a, b, false);
  const double r = detail::residual(a, q, b);
  return (b > 0 ? r : -r) < 0 ? detail::stepDown(q) : q;
}

/// As divDown; the quotient lies above q just when r / b > 0.
inline double divUp(double a, double b) noexcept {
  const double q = a / b;
  if (!(detail::isModerate(a) && detail::isModerate(b) && detail::isModerate(q))) return detail::divSlow(a, b, true);
  const double r = detail::residual(a, q, b);
  return (b > 0 ? r : -r) > 0 ? detail::stepUp(q) : q;
}

/// x = s^2 + r with the exact residual r = x - s^2: sqrt(x) lies below s just when r < 0.
inline double sqrtDown(double x) noexcept {
  if (!(x > 0 && detail::isModerate(x))) return detail::sqrtSlow(x, false);
  const double s = std::sqrt(x);
  return detail::residual(x, s, s) < 0 ? detail::stepDown(s) : s;
}

/// As sqrtDown; sqrt(x) lies above s just when r > 0.
inline double sqrtUp(double x) noexcept {
  if (!(x > 0 && detail::isModerate(x))) return detail::sqrtSlow(x, true);
  const double s = std::sqrt(x);
  return detail::residual(x, s, s) > 0 ? detail::stepUp(s) : s;
}

}  // namespace gamut
