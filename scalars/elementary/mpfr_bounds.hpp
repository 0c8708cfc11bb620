// Bounds of elementary functions by MPFR, whose rounding mode is an argument and whose results are correctly rounded:
// one evaluation rounded down, with its ternary value, gives both bounds of f at a point. No rounding mode of the
// processor is read or written.
#pragma once

#include <mpfr.h>

#include <type_traits>

namespace gamut::detail {

/// An MPFR number of fixed precision. Its digits lie inside it, so it needs no destructor: what a thread keeps of this
/// kind can still be used while the thread's or the program's other objects are destroyed.
template <int bits>
class Number {
 public:
  Number() {
    mpfr_custom_init(limbs_, bits);
    mpfr_custom_init_set(value_, MPFR_ZERO_KIND, 0, bits, limbs_);
  }
  Number(const Number&) = delete;
  Number& operator=(const Number&) = delete;
  operator mpfr_ptr() { return value_; }  // NOLINT(google-explicit-*): handed to C functions

 private:
  mp_limb_t limbs_[(bits + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS];
  mpfr_t value_;
};
static_assert(std::is_trivially_destructible_v<Number<53>>);

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

}  // namespace gamut::detail
