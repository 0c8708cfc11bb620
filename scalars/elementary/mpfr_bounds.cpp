// MPFR's evaluation of elementary functions, with numbers that each thread keeps.
#include "scalars/elementary/mpfr_bounds.hpp"

namespace gamut::detail {
namespace {

/// Frees MPFR's per-thread caches (of pi, log 2) when the thread ends. Whoever comes later makes new ones.
struct CacheOwner {
  ~CacheOwner() { mpfr_free_cache(); }
};

struct Scratch {
  Number<53> argument, second, result, secondResult;
};

Scratch& scratch() {
  thread_local const CacheOwner caches;
  thread_local Scratch numbers;
  return numbers;
}

/// x, but +0 for -0.
double withoutSign(double x) { return x == 0 ? 0.0 : x; }

/// Both bounds of y from r, y rounded down to 53 bits, and its ternary value (zero: r = y).
/// Every double is a 53-bit number, so the doubles that are <= y are those that are <= r, and, if r < y, the doubles
/// that are >= y are those that are >= the number after r. Hence rounding once more, which does something only where
/// doubles are subnormal or overflow, still gives the greatest double below y and the least above it. The same with
/// MPFR's own limits far outside of the doubles': an underflow is r = 0 or the number before it, an overflow r = the
/// largest number or -inf, each with a ternary value.
Bounds boundsOf(mpfr_ptr result, int ternary) {
  Bounds bounds;
  bounds.down = withoutSign(mpfr_get_d(result, MPFR_RNDD));
  if (ternary != 0) mpfr_nextabove(result);
  bounds.up = withoutSign(mpfr_get_d(result, MPFR_RNDU));
  return bounds;
}

void setExponents(mpfr_exp_t least, mpfr_exp_t greatest) {
  mpfr_set_emin(least);
  mpfr_set_emax(greatest);
}

}  // namespace

WideExponents::WideExponents() : least_(mpfr_get_emin()), greatest_(mpfr_get_emax()) {
  if (isNarrow()) setExponents(-(1 << 20), 1 << 20);
}
WideExponents::~WideExponents() {
  if (isNarrow()) setExponents(least_, greatest_);
}

Bounds evaluate(MpfrFunction f, double x) {
  const WideExponents wide;
  Scratch& s = scratch();
  mpfr_set_d(s.argument, x, MPFR_RNDN);  // exact
  return boundsOf(s.result, f(s.result, s.argument, MPFR_RNDD));
}

Bounds evaluate(MpfrFunction2 f, double x, double y) {
  const WideExponents wide;
  Scratch& s = scratch();
  mpfr_set_d(s.argument, x, MPFR_RNDN);
  mpfr_set_d(s.second, y, MPFR_RNDN);
  return boundsOf(s.result, f(s.result, s.argument, s.second, MPFR_RNDD));
}

Bounds evaluatePower(double x, long n) {
  const WideExponents wide;
  Scratch& s = scratch();
  mpfr_set_d(s.argument, x, MPFR_RNDN);
  return boundsOf(s.result, mpfr_pow_si(s.result, s.argument, n, MPFR_RNDD));
}

Bounds evaluateRoot(double x, unsigned long n) {
  const WideExponents wide;
  Scratch& s = scratch();
  mpfr_set_d(s.argument, x, MPFR_RNDN);
  return boundsOf(s.result, mpfr_rootn_ui(s.result, s.argument, n, MPFR_RNDD));
}

SinCosBounds evaluateSinCos(double x) {
  const WideExponents wide;
  Scratch& s = scratch();
  mpfr_set_d(s.argument, x, MPFR_RNDN);
  // MPFR's manual: s + 4 c, where each of the two is 0 if exact, 1 if rounded up, 2 if rounded down.
  const int ternary = mpfr_sin_cos(s.result, s.secondResult, s.argument, MPFR_RNDD);
  return {boundsOf(s.result, ternary & 3), boundsOf(s.secondResult, ternary >> 2)};
}

}  // namespace gamut::detail
