// The elementary functions of intervals that have no kernel of their own: MPFR at the endpoints.
#include <algorithm>

#include "scalars/interval.hpp"
#include "scalars/mpfr_bounds.hpp"

namespace gamut {
namespace {

using detail::Bounds, detail::evaluate, detail::evaluatePower, detail::increasing;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// x^n for n < 0: 1 / x^|n|, undefined at zero.
Interval negativePower(const Interval& x, int n) {
  if (x.lower() == 0 && x.upper() == 0) return Interval::empty();
  if (n % 2 == 0) {
    const Interval size = abs(x);
    return {evaluatePower(size.upper(), n).down, size.lower() == 0 ? infinity : evaluatePower(size.lower(), n).up};
  }
  if (x.lower() < 0 && x.upper() > 0) return Interval::entire();
  return {x.upper() == 0 ? -infinity : evaluatePower(x.upper(), n).down,
          x.lower() == 0 ? infinity : evaluatePower(x.lower(), n).up};
}

}  // namespace

Interval sinh(const Interval& x) { return increasing(mpfr_sinh, x); }
Interval cosh(const Interval& x) { return increasing(mpfr_cosh, abs(x)); }
Interval tanh(const Interval& x) { return increasing(mpfr_tanh, x); }

Interval pow(const Interval& x, int n) {
  if (isEmpty(x)) return x;
  if (n == 0) return 1;
  if (n == 1) return x;
  if (n == 2) return sqr(x);
  if (n < 0) return negativePower(x, n);
  const Interval base = n % 2 == 0 ? abs(x) : x;
  return {evaluatePower(base.lower(), n).down, evaluatePower(base.upper(), n).up};
}

/// Monotone in x for fixed y and in y for fixed x, so the extremes over a rectangle are at its corners.
Interval pow(const Interval& x, const Interval& y) {
  if (isEmpty(x) || isEmpty(y) || !(x.upper() >= 0)) return Interval::empty();
  if (x.upper() == 0) return y.upper() > 0 ? Interval(0) : Interval::empty();
  const double base[] = {std::max(x.lower(), 0.0) + 0.0, x.upper()};  // + 0.0: (-0)^y must not be negative
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
