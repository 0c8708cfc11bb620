// The judge of the neighbour test: exact reals by MPFR, enclosures compared with them without any tolerance, and a
// digest of all enclosures. The optimiser sees nothing of the exact values: they live in MPFR's library.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string_view>

#include "scalars/interval.hpp"

namespace gamut::testing {

/// A real number got from doubles by + - *; throws std::range_error where the result is not exact.
/// a * b + c of any doubles fits: its bits weigh between 2^-2148 and 2^2049. Functions of their own, and not hundreds
/// of copies, which would be most of what there is to compile.
class Exact {
 public:
  // NOLINTNEXTLINE(google-explicit-*): so that Exact + double is exact
  [[gnu::noinline]] Exact(double value, mpfr_prec_t precision = 4200) {
    mpfr_init2(value_, precision);
    check(mpfr_set_d(value_, value, MPFR_RNDN));
  }
  [[gnu::noinline]] Exact(const Exact& other) : Exact(0.0) { mpfr_set(value_, other.value_, MPFR_RNDN); }
  Exact& operator=(const Exact& other) {
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  [[gnu::noinline]] ~Exact() { mpfr_clear(value_); }

  mpfr_srcptr get() const { return value_; }

  [[gnu::noinline]] friend Exact operator+(const Exact& x, const Exact& y) { return by(mpfr_add, x, y); }
  [[gnu::noinline]] friend Exact operator-(const Exact& x, const Exact& y) { return by(mpfr_sub, x, y); }
  [[gnu::noinline]] friend Exact operator*(const Exact& x, const Exact& y) { return by(mpfr_mul, x, y); }
  friend bool operator<=(const Exact& x, const Exact& y) { return mpfr_lessequal_p(x.value_, y.value_) != 0; }

 private:
  static void check(int ternary) {
    if (ternary != 0) throw std::range_error("the judge's value is not exact");
  }
  template <typename Function>
  static Exact by(Function f, const Exact& x, const Exact& y) {
    Exact result(0.0);
    check(f(result.value_, x.value_, y.value_, MPFR_RNDN));
    return result;
  }

  mpfr_t value_;
};

class Judge {
 public:
  long enclosures() const { return enclosures_; }
  long failures() const { return failures_; }
  std::uint64_t digest() const { return digest_; }

  /// The exact value and the ordinary (rounded) one lie in x; an ordinary NaN is none.
  /// (The nearest double to an element of x lies in x too, since x's endpoints are doubles.)
  [[gnu::noinline]] void encloses(std::string_view what, const Interval& x, const Exact& exact, double ordinary) {
    take(x);
    if (!(isBelow(x, exact) && isAbove(x, exact)) || !holds(x, ordinary)) fail(what, x, ordinary);
  }

  /// As encloses, for the exact numerator / denominator; a zero denominator leaves nothing to hold.
  [[gnu::noinline]] void enclosesRatio(std::string_view what, const Interval& x, const Exact& numerator,
                                       double denominator, double ordinary) {
    take(x);
    if (denominator == 0) return;
    const Exact n = denominator < 0 ? Exact(0.0) - numerator : numerator;
    const double d = std::abs(denominator);
    const bool below = std::isinf(x.lower()) ? x.lower() < 0 : Exact(x.lower()) * d <= n;
    const bool above = std::isinf(x.upper()) ? x.upper() > 0 : n <= Exact(x.upper()) * d;
    if (!below || !above || !holds(x, ordinary)) fail(what, x, ordinary);
  }

  /// As encloses, for the square root of square >= 0.
  [[gnu::noinline]] void enclosesRoot(std::string_view what, const Interval& x, double square, double ordinary) {
    take(x);
    const bool below = x.lower() <= 0 || Exact(x.lower()) * x.lower() <= square;
    const bool above = x.upper() >= 0 && (std::isinf(x.upper()) || square <= Exact(x.upper()) * x.upper());
    if (!below || !above || !holds(x, ordinary)) fail(what, x, ordinary);
  }

  /// f(arguments...) lies in x.
  template <typename Function, typename... Arguments>
  [[gnu::noinline]] void enclosesFunction(std::string_view what, const Interval& x, Function f,
                                          Arguments... arguments) {
    take(x);
    mpfr_t out;
    mpfr_init2(out, 200);
    // A double is no greater than f(arguments) just when it is no greater than that rounded down to 200 bits.
    f(out, Exact(arguments, 53).get()..., MPFR_RNDD);
    const bool undefined = mpfr_nan_p(out) != 0, below = mpfr_cmp_d(out, x.lower()) >= 0;
    f(out, Exact(arguments, 53).get()..., MPFR_RNDU);
    const bool above = mpfr_cmp_d(out, x.upper()) <= 0;
    if (!undefined && !(below && above)) fail(what, x, std::max({arguments...}));
    mpfr_clear(out);
  }

  /// Both are the same set.
  [[gnu::noinline]] void areEqual(std::string_view what, const Interval& x, const Interval& y) {
    take(x);
    if (!isEqual(x, y)) fail(what, x, y.lower());
  }

  /// An enclosure that is only part of the digest.
  void take(const Interval& x) {
    ++enclosures_;
    take(x.lower());
    take(x.upper());
  }
  void take(double x) {
    // One NaN and one zero: their signs are nothing that a set has.
    mix(std::isnan(x) ? 0x7ff8000000000000 : x == 0 ? 0 : std::bit_cast<std::uint64_t>(x));
  }
  void take(std::string_view text) {
    for (const char c : text) mix(static_cast<unsigned char>(c));
  }

 private:
  static bool isBelow(const Interval& x, const Exact& y) {
    return std::isinf(x.lower()) ? x.lower() < 0 : Exact(x.lower()) <= y;
  }
  static bool isAbove(const Interval& x, const Exact& y) {
    return std::isinf(x.upper()) ? x.upper() > 0 : y <= Exact(x.upper());
  }
  static bool holds(const Interval& x, double ordinary) {
    return std::isnan(ordinary) || (x.lower() <= ordinary && ordinary <= x.upper());
  }
  void mix(std::uint64_t bits) {  // FNV-1a, a word at a time, with the high bits folded down
    digest_ = (digest_ ^ bits) * 0x100000001b3;
    digest_ ^= digest_ >> 29;
  }
  void fail(std::string_view what, const Interval& x, double ordinary) {
    if (++failures_ <= 10)
      std::printf("%.*s: not in [%a, %a], ordinary value %a\n", static_cast<int>(what.size()), what.data(), x.lower(),
                  x.upper(), ordinary);
  }

  long enclosures_ = 0, failures_ = 0;
  std::uint64_t digest_ = 0xcbf29ce484222325;
};

}  // namespace gamut::testing
