// MPFR's functions with 160 bits.
#include "scalars/elementary/fine_functions.hpp"

#include <cmath>

#include "scalars/elementary/mpfr_bounds.hpp"

namespace gamut::detail {
namespace {

struct Scratch {
  Number<160> argument, result, second;
};

Scratch& scratch() {
  thread_local Scratch numbers;
  return numbers;
}

mpfr_srcptr load(Scratch& s, const DoubleDouble& x) {
  mpfr_set_d(s.argument, x.hi, MPFR_RNDN);
  mpfr_add_d(s.argument, s.argument, x.lo, MPFR_RNDN);
  return s.argument;
}

/// x loses 2^-160 of itself, which moves these functions by less than 2^-160 (1 + |x|)(1 + |f|); the result another
/// 2^-160 |f|; and what two doubles hold of it is within 2^-106 |f|.
FineValue fineValue(mpfr_ptr result, double x) {
  const double hi = mpfr_get_d(result, MPFR_RNDN);
  if (!std::isfinite(hi)) return {{hi, 0.0}, 0.0};
  mpfr_sub_d(result, result, hi, MPFR_RNDN);  // exact
  const double lo = mpfr_get_d(result, MPFR_RNDN);
  return {{hi, lo}, 0x1p-105 * std::fabs(hi) + 0x1p-157 * (1 + std::fabs(x)) * (1 + std::fabs(hi))};
}

FineValue evaluate(int (*f)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t), const DoubleDouble& x) {
  const WideExponents wide;
  Scratch& s = scratch();
  f(s.result, load(s, x), MPFR_RNDN);
  return fineValue(s.result, x.hi);
}

}  // namespace

FineValue fineExp(const DoubleDouble& x) { return evaluate(mpfr_exp, x); }
FineValue fineLog(const DoubleDouble& x) { return evaluate(mpfr_log, x); }
FineValue fineAtan(const DoubleDouble& x) { return evaluate(mpfr_atan, x); }

FineSinCos fineSinCos(const DoubleDouble& x) {
  const WideExponents wide;
  Scratch& s = scratch();
  mpfr_sin_cos(s.result, s.second, load(s, x), MPFR_RNDN);
  return {fineValue(s.result, x.hi), fineValue(s.second, x.hi)};
}

}  // namespace gamut::detail
