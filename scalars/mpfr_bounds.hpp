// Bounds of elementary functions by MPFR, whose rounding mode is an argument and whose results are correctly rounded:
// one evaluation rounded down, with its ternary value, gives both bounds of f at a point. No rounding mode of the
// processor is read or written.
#pragma once

#include <mpfr.h>

#include "scalars/interval.hpp"

namespace gamut::detail {

/// An MPFR number of fixed precision (bits).
class Number {
 public:
  explicit Number(mpfr_prec_t precision) { mpfr_init2(value_, precision); }
  ~Number() { mpfr_clear(value_); }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

/// MPFR's exponent range belongs to the thread, and a caller may have narrowed it below what doubles need. While an
/// object of this kind lives it is wide; afterwards it is the caller's again.
class WideExponents {
 public:
  WideExponents();
  ~WideExponents();
  WideExponents(const WideExponents&) = delete;
  WideExponents& operator=(const WideExponents&) = delete;

 private:
  bool isNarrow() const { return least_ > -2000 || greatest_ < 2000; }
  const mpfr_exp_t least_, greatest_;
};

/// The greatest double that is not above one real value and the least that is not below it.
struct Bounds {
  double down, up;
};

using MpfrFunction = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using MpfrFunction2 = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

/// Bounds of f(x), f(x, y), x^n and the n-th root of x. Infinite arguments are limits; an undefined value gives NaN.
Bounds evaluate(MpfrFunction f, double x);
Bounds evaluate(MpfrFunction2 f, double x, double y);
Bounds evaluatePower(double x, long n);
Bounds evaluateRoot(double x, unsigned long n);

struct SinCosBounds {
  Bounds sin, cos;
};
SinCosBounds evaluateSinCos(double x);

/// The range over x of a function that increases or decreases on all of x; x may be empty.
Interval increasing(MpfrFunction f, const Interval& x);
Interval decreasing(MpfrFunction f, const Interval& x);

}  // namespace gamut::detail
