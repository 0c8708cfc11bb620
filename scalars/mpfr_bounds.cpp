// MPFR's evaluation of elementary functions, with numbers that each thread keeps.
#include "scalars/mpfr_bounds.hpp"

namespace gamut::detail {
namespace {

/// Frees MPFR's per-thread caches (of pi, log 2) when the thread ends; constructed before, so destroyed after Numbers.
struct CacheOwner {
  ~CacheOwner() { mpfr_free_cache(); }
};

struct Scratch {
  CacheOwner caches;
  Number argument{53}, second{53}, result{53}, secondResult{53};
};

Scratch& scratch() {
  thread_local Scratch numbers;
  return numbers;
}

/// From a 53-bit result rounded down and its ternary value: zero says exact, else the next number is an upper bound.
/// The conversions round once more, in the same direction, only where doubles are subnormal or overflow.
Bounds boundsOf(mpfr_ptr result, int ternary) {
  Bounds bounds;
  bounds.down = mpfr_get_d(result, MPFR_RNDD);
  if (ternary != 0) mpfr_nextabove(result);
  bounds.up = mpfr_get_d(result, MPFR_RNDU);
  return bounds;
}

}  // namespace

Bounds evaluate(MpfrFunction f, double x) {
  Scratch& s = scratch();
  mpfr_set_d(s.argument, x, MPFR_RNDN);  // exact
  return boundsOf(s.result, f(s.result, s.argument, MPFR_RNDD));
}

Bounds evaluate(MpfrFunction2 f, double x, double y) {
  Scratch& s = scratch();
  mpfr_set_d(s.argument, x, MPFR_RNDN);
  mpfr_set_d(s.second, y, MPFR_RNDN);
  return boundsOf(s.result, f(s.result, s.argument, s.second, MPFR_RNDD));
}

Bounds evaluatePower(double x, long n) {
  Scratch& s = scratch();
  mpfr_set_d(s.argument, x, MPFR_RNDN);
  return boundsOf(s.result, mpfr_pow_si(s.result, s.argument, n, MPFR_RNDD));
}

SinCosBounds evaluateSinCos(double x) {
  Scratch& s = scratch();
  mpfr_set_d(s.argument, x, MPFR_RNDN);
  const int ternary = mpfr_sin_cos(s.result, s.secondResult, s.argument, MPFR_RNDD);
  return {boundsOf(s.result, ternary & 3), boundsOf(s.secondResult, ternary >> 2)};
}

Interval increasing(MpfrFunction f, const Interval& x) {
  if (isEmpty(x)) return x;
  const Bounds low = evaluate(f, x.lower());
  const Bounds high = isThin(x) ? low : evaluate(f, x.upper());
  return {low.down, high.up};
}

Interval decreasing(MpfrFunction f, const Interval& x) {
  if (isEmpty(x)) return x;
  const Bounds high = evaluate(f, x.lower());
  const Bounds low = isThin(x) ? high : evaluate(f, x.upper());
  return {low.down, high.up};
}

}  // namespace gamut::detail
