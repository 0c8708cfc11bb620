// What the scalar tests are judged by: random doubles of every kind, and MPFR's correctly rounded results.
#pragma once

#include <gmock/gmock.h>
#include <mpfr.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "scalars/interval.hpp"

namespace gamut::testing {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();
constexpr int cases = 10000;

/// A number of MPFR, for the length of a scope.
class Mpfr {
 public:
  explicit Mpfr(double value = 0, mpfr_prec_t precision = 53) {
    mpfr_init2(value_, precision);
    mpfr_set_d(value_, value, MPFR_RNDN);
  }
  ~Mpfr() { mpfr_clear(value_); }
  Mpfr(const Mpfr&) = delete;
  Mpfr& operator=(const Mpfr&) = delete;
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

using OfOne = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using OfTwo = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

/// The nearest double on one side of f(x) or f(x, y), by MPFR.
inline double rounded(OfOne f, double x, mpfr_rnd_t direction) {
  Mpfr argument(x), result;
  f(result, argument, direction);
  return mpfr_get_d(result, direction);
}
inline double rounded(OfTwo f, double x, double y, mpfr_rnd_t direction) {
  Mpfr first(x), second(y), result;
  f(result, first, second, direction);
  return mpfr_get_d(result, direction);
}

class RandomDoubles {
 public:
  explicit RandomDoubles(std::uint64_t seed = 20240607) : engine_(seed) {}

  double uniform(double lower, double upper) { return std::uniform_real_distribution<>(lower, upper)(engine_); }
  int integer(int lower, int upper) { return std::uniform_int_distribution<>(lower, upper)(engine_); }

  /// Any finite bit pattern: all magnitudes alike, one in four subnormal, near overflow, a small integer or zero.
  double any() {
    const std::uint64_t sign = engine_() << 63, mantissa = engine_() >> 12;
    switch (integer(0, 15)) {
      case 0:
        return std::bit_cast<double>(sign | mantissa);
      case 1:
        return std::bit_cast<double>(sign | (std::uint64_t(integer(2040, 2046)) << 52) | mantissa);
      case 2:
        return integer(-4, 4);
      case 3:
        return std::bit_cast<double>(sign | (std::uint64_t(integer(1, 60)) << 52) | mantissa);
      case 4:
      case 5:
      case 6:
        return std::bit_cast<double>(sign | (std::uint64_t(integer(1000, 1046)) << 52) | mantissa);
      default:
        return std::bit_cast<double>(sign | (std::uint64_t(integer(0, 2046)) << 52) | mantissa);
    }
  }

  /// An interval with endpoints from any(); one in eight is thin.
  Interval anyInterval() {
    const double a = any(), b = integer(0, 7) == 0 ? a : any();
    return {std::min(a, b), std::max(a, b)};
  }

  /// An interval inside [lower, upper], of any width; one in four is thin.
  Interval intervalIn(double lower, double upper) {
    const double a = uniform(lower, upper);
    if (integer(0, 3) == 0) return a;
    const double b = integer(0, 1) == 0 ? uniform(lower, upper) : a + (upper - a) * std::ldexp(1.0, -integer(1, 50));
    return {std::min(a, b), std::max(a, b)};
  }

  /// A bounded interval's endpoint or a random element.
  double elementOf(const Interval& x) {
    const int choice = integer(0, 5);
    if (choice == 0) return x.lower();
    if (choice == 1) return x.upper();
    const double t = uniform(0, 1);
    return std::clamp(x.lower() * (1 - t) + x.upper() * t, x.lower(), x.upper());
  }

 private:
  std::mt19937_64 engine_;
};

/// Exact: the interval equals [lower, upper].
MATCHER_P2(IsInterval, lower, upper,
           "is [" + ::testing::PrintToString(lower) + ", " + ::testing::PrintToString(upper) + "]") {
  return isEqual(arg, Interval(lower, upper));
}
MATCHER_P(IsSubsetOf, outer, "is a subset of " + ::testing::PrintToString(outer)) { return isSubset(arg, outer); }
MATCHER(IsEmptyInterval, "is empty") { return isEmpty(arg); }

}  // namespace gamut::testing
