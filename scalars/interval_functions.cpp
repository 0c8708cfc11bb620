// sin, cos, tan, exp, log and the inverse functions of intervals. Monotone functions are taken at the endpoints; sin,
// cos and tan count the multiples of pi / 2 between the endpoints rigorously.
#include <algorithm>
#include <cmath>

#include "scalars/interval.hpp"
#include "scalars/mpfr_bounds.hpp"

namespace gamut {
namespace {

using detail::Bounds, detail::decreasing, detail::evaluate, detail::increasing, detail::Number;

// ---- Where the extrema are ------------------------------------------------------------------------------------------

/// floor(2 x / pi) modulo 8 in 1280 bits: the integer part has at most 1024, and since no double but 0 comes closer to
/// a multiple of pi / 2 than 2^-62 relative to it, the rest decides the floor. -1 where it did not (it never does not).
int quadrantByMpfr(double x) {
  constexpr mpfr_prec_t precision = 1280;
  thread_local Number pi(precision + 64), low(precision), high(precision);
  thread_local bool piKnown = false;
  if (!piKnown) {
    mpfr_const_pi(pi, MPFR_RNDN);  // error below 2^-1340, less than a last bit of the quotient
    piKnown = true;
  }
  mpfr_set_d(low, x, MPFR_RNDN);
  mpfr_mul_2ui(low, low, 1, MPFR_RNDN);
  mpfr_div(low, low, pi, MPFR_RNDD);
  mpfr_nextbelow(low);  // covers pi's error
  mpfr_set(high, low, MPFR_RNDN);
  for (int step = 0; step < 3; ++step) mpfr_nextabove(high);
  mpfr_floor(low, low);
  mpfr_floor(high, high);
  if (!mpfr_equal_p(low, high)) return -1;
  thread_local Number eight(8);
  mpfr_set_ui(eight, 8, MPFR_RNDN);
  mpfr_fmod(low, low, eight, MPFR_RNDN);  // exact; carries the sign of x
  return static_cast<int>(mpfr_get_si(low, MPFR_RNDN)) & 7;
}

/// floor(2 x / pi) modulo 8, or -1 if undecided. x * fl(2 / pi) in doubles has a relative error below 2^-51
/// (two roundings of 2^-53 each), so its floor is right unless an integer lies so close.
int quadrant(double x) {
  const double quotient = x * 0x1.45f306dc9c883p-1;
  const double error = std::abs(quotient) * 0x1p-51;
  if (std::abs(x) < 0x1p40 && std::abs(x) > 0x1p-900) {
    const double floor = std::floor(quotient);
    if (quotient - floor > error && (floor + 1) - quotient > error)
      return static_cast<int>(static_cast<long long>(floor) & 7);
  }
  if (x == 0) return 0;
  return quadrantByMpfr(x);
}

/// Which residues m modulo 4 occur among the multiples m pi / 2 in (lower, upper].
struct Multiples {
  bool any[4] = {false, false, false, false};
};

Multiples multiplesOfHalfPi(const Interval& x) {
  constexpr Multiples all{{true, true, true, true}};
  if (!isBounded(x) || !(width(x) < 6.28)) return all;  // 6.28 < 2 pi: below it the floors differ by at most 4
  if (isThin(x)) return {};                             // no double but 0 is a multiple, and 0's value is exact anyway
  const int first = quadrant(x.lower()), last = quadrant(x.upper());
  if (first < 0 || last < 0) return all;
  Multiples found;
  for (int m = first; m != last; m = (m + 1) & 7) found.any[(m + 1) & 3] = true;
  return found;
}

/// The range of sin or cos, from its values at the endpoints and whether a maximum or minimum lies between.
Interval range(const Bounds& a, const Bounds& b, bool maximum, bool minimum) {
  return {minimum ? -1.0 : std::min(a.down, b.down), maximum ? 1.0 : std::max(a.up, b.up)};
}

}  // namespace

Interval exp(const Interval& x) { return increasing(mpfr_exp, x); }
Interval atan(const Interval& x) { return increasing(mpfr_atan, x); }

Interval log(const Interval& x) {
  if (!(x.upper() > 0)) return Interval::empty();
  return increasing(mpfr_log, {std::max(x.lower(), 0.0), x.upper()});
}

Interval asin(const Interval& x) { return increasing(mpfr_asin, intersection(x, {-1, 1})); }
Interval acos(const Interval& x) { return decreasing(mpfr_acos, intersection(x, {-1, 1})); }

Interval sin(const Interval& x) {
  if (isEmpty(x)) return x;
  const Multiples found = multiplesOfHalfPi(x);
  const bool maximum = found.any[1], minimum = found.any[3];
  if (maximum && minimum) return {-1, 1};
  const Bounds a = evaluate(mpfr_sin, x.lower()), b = isThin(x) ? a : evaluate(mpfr_sin, x.upper());
  return range(a, b, maximum, minimum);
}

Interval cos(const Interval& x) {
  if (isEmpty(x)) return x;
  const Multiples found = multiplesOfHalfPi(x);
  const bool maximum = found.any[0], minimum = found.any[2];
  if (maximum && minimum) return {-1, 1};
  const Bounds a = evaluate(mpfr_cos, x.lower()), b = isThin(x) ? a : evaluate(mpfr_cos, x.upper());
  return range(a, b, maximum, minimum);
}

SinCos sinCos(const Interval& x) {
  if (!isThin(x)) return {sin(x), cos(x)};
  const auto [sine, cosine] = detail::evaluateSinCos(x.lower());
  return {{sine.down, sine.up}, {cosine.down, cosine.up}};
}

Interval tan(const Interval& x) {
  if (isEmpty(x)) return x;
  const Multiples found = multiplesOfHalfPi(x);
  if (found.any[1] || found.any[3]) return Interval::entire();
  return increasing(mpfr_tan, x);
}

}  // namespace gamut
