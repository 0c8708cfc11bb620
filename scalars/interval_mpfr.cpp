// The elementary functions of intervals that have no kernel of their own: MPFR at the points of the interval where the
// function takes its extremes. MPFR rounds correctly, so each result is the tightest.
#include <algorithm>
#include <stdexcept>

#include "scalars/elementary/mpfr_bounds.hpp"
#include "scalars/interval.hpp"

namespace gamut {
namespace {

using detail::Bounds, detail::evaluate, detail::evaluatePower, detail::evaluateRoot, detail::MpfrFunction;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// MPFR tells the zeros apart, (-0)^-1 = -inf and atan2(-0, -1) = -pi; an endpoint 0 of an interval has no sign.
double withoutSignedZero(double x) { return x == 0 ? 0.0 : x; }

/// A function that increases on all of x, which may be empty.
Interval increasing(MpfrFunction f, const Interval& x) {
  if (isEmpty(x)) return x;
  const Bounds low = evaluate(f, x.lower()), high = isThin(x) ? low : evaluate(f, x.upper());
  return {low.down, high.up};
}

/// An increasing f with the open domain (infimum, supremum): f at a domain's end is an infinity that MPFR returns.
Interval increasingInside(MpfrFunction f, const Interval& x, double infimum, double supremum) {
  if (!(x.upper() > infimum && x.lower() < supremum)) return Interval::empty();
  return increasing(f, {std::max(x.lower(), infimum), std::min(x.upper(), supremum)});
}

/// x^n for n < 0: 1 / x^|n|, undefined at zero.
Interval negativePower(const Interval& x, long n) {
  if (x.lower() == 0 && x.upper() == 0) return Interval::empty();
  if (n % 2 == 0) {
    const Interval size = abs(x);
    return {evaluatePower(size.upper(), n).down, size.lower() == 0 ? infinity : evaluatePower(size.lower(), n).up};
  }
  if (x.lower() < 0 && x.upper() > 0) return Interval::entire();
  return {x.upper() == 0 ? -infinity : evaluatePower(x.upper(), n).down,
          x.lower() == 0 ? infinity : evaluatePower(x.lower(), n).up};
}

/// The angles over a box above the x-axis, of which it may hold a part but not be one. For y > 0 the angle falls with
/// x; it rises with y where x > 0 and falls where x < 0. So it is least on the right edge, below if x > 0 and else
/// above, and greatest on the left edge, below if x < 0 and else above. (At y = 0 too: 0 for x > 0, pi for x < 0.)
Interval upperAngles(const Interval& y, const Interval& x) {
  const double left = withoutSignedZero(x.lower()), right = withoutSignedZero(x.upper());
  const double bottom = withoutSignedZero(y.lower()), top = withoutSignedZero(y.upper());
  return {evaluate(mpfr_atan2, right > 0 ? bottom : top, right).down,
          evaluate(mpfr_atan2, left < 0 ? bottom : top, left).up};
}

}  // namespace

Interval cbrt(const Interval& x) { return increasing(mpfr_cbrt, x); }

Interval rootn(const Interval& x, int n) {
  if (n < 1) throw std::invalid_argument("rootn takes roots of degree 1 and above, not " + std::to_string(n));
  const Interval inside = n % 2 == 0 ? intersection(x, {0, infinity}) : x;
  if (isEmpty(inside)) return inside;
  return {evaluateRoot(withoutSignedZero(inside.lower()), static_cast<unsigned>(n)).down,
          evaluateRoot(withoutSignedZero(inside.upper()), static_cast<unsigned>(n)).up};
}

Interval hypot(const Interval& x, const Interval& y) {
  if (isEmpty(x) || isEmpty(y)) return Interval::empty();
  return {evaluate(mpfr_hypot, mignitude(x), mignitude(y)).down, evaluate(mpfr_hypot, magnitude(x), magnitude(y)).up};
}

Interval exp2(const Interval& x) { return increasing(mpfr_exp2, x); }
Interval exp10(const Interval& x) { return increasing(mpfr_exp10, x); }
Interval expm1(const Interval& x) { return increasing(mpfr_expm1, x); }
Interval log2(const Interval& x) { return increasingInside(mpfr_log2, x, 0, infinity); }
Interval log10(const Interval& x) { return increasingInside(mpfr_log10, x, 0, infinity); }
Interval log1p(const Interval& x) { return increasingInside(mpfr_log1p, x, -1, infinity); }

Interval sinh(const Interval& x) { return increasing(mpfr_sinh, x); }
Interval cosh(const Interval& x) { return increasing(mpfr_cosh, abs(x)); }
Interval tanh(const Interval& x) { return increasing(mpfr_tanh, x); }
Interval asinh(const Interval& x) { return increasing(mpfr_asinh, x); }
Interval acosh(const Interval& x) { return increasing(mpfr_acosh, intersection(x, {1, infinity})); }
Interval atanh(const Interval& x) { return increasingInside(mpfr_atanh, x, -1, 1); }

Interval atan2(const Interval& y, const Interval& x) {
  if (isEmpty(y) || isEmpty(x) || (magnitude(y) == 0 && magnitude(x) == 0)) return Interval::empty();
  if (magnitude(y) == 0) return {x.upper() > 0 ? 0 : pi().lower(), x.lower() < 0 ? pi().upper() : 0};
  if (y.lower() >= 0) return upperAngles(y, x);
  if (y.upper() < 0 || (y.upper() == 0 && x.lower() >= 0)) return -upperAngles(-y, x);
  if (x.lower() < 0) return {-pi().upper(), pi().upper()};  // both sides of the cut
  const double left = withoutSignedZero(x.lower());         // right of the y-axis the angle rises with y
  return {evaluate(mpfr_atan2, y.lower(), left).down, evaluate(mpfr_atan2, y.upper(), left).up};
}

Interval pow(const Interval& x, long n) {
  if (isEmpty(x)) return x;
  if (n == 0) return 1;
  if (n == 1) return x;
  if (n == 2) return sqr(x);
  if (n < 0) return negativePower(x, n);
  const Interval base = n % 2 == 0 ? abs(x) : x;
  return {evaluatePower(base.lower(), n).down, evaluatePower(base.upper(), n).up};
}

Interval pow(const Interval& x, double y) {
  if (std::trunc(y) != y) return pow(x, Interval(y));
  if (std::abs(y) < 0x1p63) return pow(x, static_cast<long>(y));
  return pow(abs(x), Interval(y));  // an even number, as every double of that size
}

/// Monotone in x for fixed y and in y for fixed x, so the extremes over a rectangle are at its corners.
Interval pow(const Interval& x, const Interval& y) {
  if (isEmpty(x) || isEmpty(y) || !(x.upper() >= 0)) return Interval::empty();
  if (x.upper() == 0) return y.upper() > 0 ? Interval(0) : Interval::empty();
  const double base[] = {withoutSignedZero(std::max(x.lower(), 0.0)), x.upper()};
  double lower = infinity, upper = 0;
  for (const double b : base) {
    for (const double exponent : {y.lower(), y.upper()}) {
      const Bounds corner = evaluate(mpfr_pow, b, exponent);
      lower = std::min(lower, corner.down);
      upper = std::max(upper, corner.up);
    }
  }
  return {lower, upper};
}

}  // namespace gamut
