// Directed rounding where the fast paths of rounding.hpp do not apply: zeros, infinities, overflow and underflow.
// Finite operands are brought to [0.5, 1) by exact scaling, treated as usual, and the result is scaled back, where the
// one inexact step (into the subnormal range, or beyond the largest double) is decided by comparing exactly. Every step
// is faithful or exact, so the results are the same in every rounding mode.
#include "scalars/elementary/rounding.hpp"

#include <algorithm>

namespace gamut {
namespace detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();

/// The bound that is always true.
double undefined(bool up) { return up ? infinity : -infinity; }

/// A result of finite operands that is infinite was rounded: the bound towards zero is the largest double.
double overflowed(double value, bool up) {
  if (value > 0) return up ? infinity : largest;
  return up ? -largest : -infinity;
}

/// Bounds (value + error) * 2^exponent, where value is normal and |error| < ulp(value) is known by its sign.
/// `scaled` is one of the two doubles around the scaled value, or an infinity; scaled back it differs from value by at
/// least value's last bit, hence by more than the error, or not at all.
double scaleDirected(double value, double error, int exponent, bool up) {
  const double scaled = std::ldexp(value, exponent);
  if (std::isinf(scaled)) return overflowed(value, up);
  const double back = std::ldexp(scaled, -exponent);  // exact: a subnormal has fewer bits than value
  const bool exactIsAbove = back < value || (back == value && error > 0);
  const bool exactIsBelow = back > value || (back == value && error < 0);
  const double bound = up ? (exactIsAbove ? nextUp(scaled) : scaled) : (exactIsBelow ? nextDown(scaled) : scaled);
  return bound == 0 ? 0.0 : bound;
}

}  // namespace

#ifndef __FMA__
#if defined(__x86_64__)
const bool hasFusedMultiplyAdd = __builtin_cpu_supports("fma");
#elif defined(FP_FAST_FMA)
const bool hasFusedMultiplyAdd = true;
#else
const bool hasFusedMultiplyAdd = false;
#endif
#endif

double mulSlow(double a, double b, bool up) noexcept {
  const double p = a * b;
  if (std::isnan(p)) return undefined(up);
  if (a == 0 || b == 0) return 0;
  if (std::isinf(a) || std::isinf(b)) return p;
  int aExponent, bExponent;
  const double aMantissa = std::frexp(a, &aExponent), bMantissa = std::frexp(b, &bExponent);
  const double product = aMantissa * bMantissa;  // in [0.25, 1]: its error is exact
  return scaleDirected(product, productMinus(aMantissa, bMantissa, product), aExponent + bExponent, up);
}

double divSlow(double a, double b, bool up) noexcept {
  const double q = a / b;
  if (std::isnan(q) || b == 0) return undefined(up);
  if (a == 0 || std::isinf(b)) return 0;
  if (std::isinf(a)) return q;
  int aExponent, bExponent;
  const double aMantissa = std::frexp(a, &aExponent), bMantissa = std::frexp(b, &bExponent);
  const double quotient = aMantissa / bMantissa;  // in [0.5, 2]: its residual is exact
  const double excess = productMinus(quotient, bMantissa, aMantissa);
  return scaleDirected(quotient, b > 0 ? -excess : excess, aExponent - bExponent, up);
}

double sqrtSlow(double x, bool up) noexcept {
  if (!(x >= 0)) return undefined(up);
  if (x == 0) return 0;
  if (std::isinf(x)) return x;
  int exponent;
  double mantissa = std::frexp(x, &exponent);
  if (exponent % 2 != 0) {
    mantissa *= 2;
    --exponent;
  }
  const double root = std::sqrt(mantissa);  // in [0.5, 1.5); scaling back by 2^(exponent / 2) stays normal, so exact
  return scaleDirected(root, -productMinus(root, root, mantissa), exponent / 2, up);
}

}  // namespace detail

/// The exact sum is below + e with 0 < e < gap; whether e exceeds half the gap, two comparisons say as in addUp: both
/// are monotone images of small - z > half, so neither is ever true wrongly, and one is exact. z = below - large is,
/// and is a multiple of gap / 4; where ulp(small) >= 2^-53 gap, e is a double, and elsewhere |small| < gap, so z + half
/// is.
double addNearest(double a, double b) noexcept {
  if (!(std::abs(a) < 0x1p1022 && std::abs(b) < 0x1p1022)) {
    if (!(std::isfinite(a) && std::isfinite(b))) return a + b;
    const double half = addNearest(0.5 * a, 0.5 * b);  // a bit lost from a subnormal lies far below half an ulp
    return std::abs(half) < 0x1p1023 ? 2 * half : std::copysign(detail::infinity, half);
  }
  const double below = addDown(a, b), above = addUp(a, b);
  if (below == above) return below;
  const auto [small, large] = std::minmax(a, b, [](double x, double y) { return std::abs(x) < std::abs(y); });
  const double half = 0.5 * (above - below), z = below - large;
  if (small - z > half || small > z + half) return above;
  if (small - z < half || small < z + half) return below;
  return (std::bit_cast<std::uint64_t>(below) & 1) == 0 ? below : above;
}

}  // namespace gamut
