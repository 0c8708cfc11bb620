// Directed rounding where the fast paths of rounding.hpp do not apply: zeros, infinities, overflow and underflow.
// Finite operands are brought to [0.5, 1) by exact scaling, treated as usual, and the result is scaled back, where the
// one inexact step (into the subnormal range, or beyond the largest double) is decided by comparing exactly.
#include "scalars/rounding.hpp"

#include <algorithm>

namespace gamut::detail {
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

/// Bounds (value + error) * 2^exponent, where value is normal and |error| < ulp(value) / 2 is known by its sign.
/// `scaled` is the nearest double; scaled back it differs from value by a multiple of value's last bit, or not at all.
double scaleDirected(double value, double error, int exponent, bool up) {
  const double scaled = std::ldexp(value, exponent);
  if (std::isinf(scaled)) return overflowed(value, up);
  const double back = std::ldexp(scaled, -exponent);  // exact: a subnormal has fewer bits than value
  const bool exactIsAbove = back < value || (back == value && error > 0);
  const bool exactIsBelow = back > value || (back == value && error < 0);
  if (up) return exactIsAbove ? nextUp(scaled) : scaled;
  return exactIsBelow ? nextDown(scaled) : scaled;
}

}  // namespace

double addSlow(double a, double b, bool up) noexcept {
  const double s = a + b;
  if (std::isnan(s)) return undefined(up);
  if (std::isinf(a) || std::isinf(b)) return s;
  if (std::isinf(s)) return overflowed(s, up);
  if (std::abs(a) < std::abs(b)) std::swap(a, b);
  const double e = b - (s - a);  // Fast2Sum: exact for |a| >= |b|, and without overflow when s has none
  if (up) return e > 0 ? nextUp(s) : s;
  return e < 0 ? nextDown(s) : s;
}

double mulSlow(double a, double b, bool up) noexcept {
  const double p = a * b;
  if (std::isnan(p)) return undefined(up);
  if (a == 0 || b == 0 || std::isinf(a) || std::isinf(b)) return p;
  int aExponent, bExponent;
  const double aMantissa = std::frexp(a, &aExponent), bMantissa = std::frexp(b, &bExponent);
  const double product = aMantissa * bMantissa;  // in [0.25, 1): its error is exact
  return scaleDirected(product, productError(aMantissa, bMantissa, product), aExponent + bExponent, up);
}

double divSlow(double a, double b, bool up) noexcept {
  const double q = a / b;
  if (std::isnan(q) || b == 0) return undefined(up);
  if (a == 0 || std::isinf(a) || std::isinf(b)) return q;
  int aExponent, bExponent;
  const double aMantissa = std::frexp(a, &aExponent), bMantissa = std::frexp(b, &bExponent);
  const double quotient = aMantissa / bMantissa;  // in (0.5, 2): its residual is exact
  const double r = residual(aMantissa, quotient, bMantissa);
  return scaleDirected(quotient, b > 0 ? r : -r, aExponent - bExponent, up);
}

double sqrtSlow(double x, bool up) noexcept {
  if (!(x >= 0)) return undefined(up);
  if (x == 0 || std::isinf(x)) return x;
  int exponent;
  double mantissa = std::frexp(x, &exponent);
  if (exponent % 2 != 0) {
    mantissa *= 2;
    --exponent;
  }
  const double root = std::sqrt(mantissa);  // in [0.5, 1.5); scaling back by 2^(exponent / 2) stays normal, so exact
  const double r = residual(mantissa, root, root);
  return scaleDirected(root, r, exponent / 2, up);
}

}  // namespace gamut::detail
