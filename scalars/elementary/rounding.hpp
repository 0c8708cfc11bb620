// Directed rounding without a rounding mode: for each operation the greatest double below and the least double above
// the exact result.
//
//   addDown(a, b) <= a + b <= addUp(a, b)      and no doubles lie closer.
//
// The processor rounds an operation to one of the two doubles around the exact result ('faithfully'), whichever of the
// four rounding modes the caller left; the sign of what was lost then decides whether to step to the neighbour. That
// sign is computed so that it is right in every mode (each function says why), so no mode is read or written, and the
// bounds are the same doubles in every thread, beside any library, under any optimisation that keeps IEEE 754, with or
// without fused multiply-add. Only modes that flush subnormals to zero (FTZ, DAZ) are beyond it; keep them off, and
// floating-point exceptions untrapped (comparisons with NaN raise 'invalid').
//
// Infinite operands are taken as exact; an overflow of finite operands is +inf above and the largest double below.
// An undefined result (inf - inf, 0 * inf, 0 / 0, x / 0, sqrt(-1), NaN) gets the bounds that are always true: -inf,
// +inf. A zero result is +0.
#pragma once

#include <bit>
#include <cfenv>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "Gamut's bounds need IEEE 754 arithmetic: build without -ffast-math and the flags that it consists of."
#endif
// clang tells the preprocessor of two of these flags only; against the others this keeps the file as it is written.
#ifdef __clang__
#pragma float_control(push)
#pragma float_control(precise, on)
#endif

namespace gamut {

static_assert(FLT_EVAL_METHOD == 0, "Gamut's bounds need doubles that are evaluated as doubles (no x87 registers).");
static_assert(std::numeric_limits<double>::is_iec559);

namespace detail {

/// Whether the processor rounds to nearest and keeps subnormal numbers (neither FTZ nor DAZ), which bounds that are
/// known beforehand ask for. Reads the mode of this thread, and never writes it.
inline bool isArithmeticNearest() noexcept {
#ifdef __SSE2__
  constexpr unsigned roundingControl = 0x6000, flushToZero = 0x8000, denormalsAreZero = 0x0040;
  return (__builtin_ia32_stmxcsr() & (roundingControl | flushToZero | denormalsAreZero)) == 0;
#else
  return std::fegetround() == FE_TONEAREST;
#endif
}

/// The neighbour above / below of x != 0: doubles are ordered as their magnitudes' bit patterns are. (The step from an
/// infinity towards zero is the largest double.)
inline double stepUp(double x) noexcept {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(bits + ((bits >> 63) | 1));
}
inline double stepDown(double x) noexcept {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return std::bit_cast<double>(bits - ((bits >> 63) | 1));
}

/// x, or its neighbour where the exact result lies beyond; -0, which some modes give for 1 - 1, becomes +0.
inline double stepUpIf(bool beyond, double x) noexcept { return beyond ? stepUp(x) : x == 0 ? 0.0 : x; }
inline double stepDownIf(bool beyond, double x) noexcept { return beyond ? stepDown(x) : x == 0 ? 0.0 : x; }

/// True when 2^-900 <= |x| < 2^990: far enough from underflow for exact errors (2^-900 * 2^-106 > 2^-1074) and from
/// overflow for their parts. False for NaN and infinities.
inline bool isModerate(double x) noexcept {
  constexpr std::uint64_t low = std::uint64_t{1023 - 900} << 52, high = std::uint64_t{1023 + 990} << 52;
  return (std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63)) - low < high - low;
}

#ifdef __FMA__
constexpr bool hasFusedMultiplyAdd = true;
#else
/// Whether this processor has the instruction, though the build does not rely on it. False until the program's
/// initialisation has asked the processor; the results do not depend on it.
extern const bool hasFusedMultiplyAdd;
#endif

// a * b - c, of which only the sign matters to what follows: exact where c is within an ulp of a * b, and of the right
// sign for every c while a, b, c and the product's last bit are far from overflow and underflow. Two ways, for doubles
// and for vectors of them:

/// By the fused instruction: one rounding of the exact value, which keeps its sign in every mode. (Written as an
/// instruction, so that a build for older processors can use it where hasFusedMultiplyAdd says so.)
struct Fused {
  static double productMinus(double a, double b, double c) noexcept {
#if defined(__x86_64__)
    asm("vfmsub213sd {%2, %1, %0|%0, %1, %2}" : "+x"(a) : "x"(b), "x"(c));
    return a;
#else
    return std::fma(a, b, -c);
#endif
  }
};

/// By halves: a = a1 + a0 with 26 bits in a1 and |a0| at most half of a1's last bit, cut by integer arithmetic (so in
/// every mode alike; Veltkamp's splitting is right to nearest only). In units of the product of the operands' last bits
/// (|a|, |b| <= 2^53): all four products of halves have at most 52 bits, so they are exact;
/// c - a1 b1 is a multiple of 2^51 below 2^81; minus a1 b0 it is a multiple of 2^27 below 2^80, minus a0 b1 below 2^55:
/// all exact while |c - a b| <= 2^54, and the last subtraction rounds the exact value once, which keeps its sign.
/// With a subnormal operand |a| c's last bit can be smaller: for |a| < 2^26 a1 = 0 and nothing is lost, beyond it is
/// 2^26 at least, and |c - a1 b1| < 2^79. With a zero operand the result is -c.
/// For c farther away, D = |c - a b| > 2^54: while D < 2^78 the same multiples still fit in 53 bits; beyond, the three
/// roundings lose at most 2^-52 of magnitudes below D + 2^81 each, far less than D.
struct Split {
  template <class T, class Bits>
  static T productMinus(T a, T b, T c) noexcept {
    constexpr std::int64_t half = std::int64_t{1} << 26;
    const T a1 = std::bit_cast<T>((std::bit_cast<Bits>(a) + half) & -2 * half), a0 = a - a1;
    const T b1 = std::bit_cast<T>((std::bit_cast<Bits>(b) + half) & -2 * half), b0 = b - b1;
    return a0 * b0 - (((c - a1 * b1) - a1 * b0) - a0 * b1);
  }
  static double productMinus(double a, double b, double c) noexcept {
    return productMinus<double, std::int64_t>(a, b, c);
  }
};

inline double productMinus(double a, double b, double c) noexcept {
  return hasFusedMultiplyAdd ? Fused::productMinus(a, b, c) : Split::productMinus(a, b, c);
}

// The same results where the fast path's premises fail: zeros, infinities, overflow, underflow (rounding.cpp).
double mulSlow(double a, double b, bool up) noexcept;
double divSlow(double a, double b, bool up) noexcept;
double sqrtSlow(double x, bool up) noexcept;

}  // namespace detail

/// The least double above x; +inf for the largest double and for +inf. NaN stays NaN.
inline double nextUp(double x) noexcept {
  if (x == 0) return std::numeric_limits<double>::denorm_min();
  if (!(x < std::numeric_limits<double>::infinity())) return x;
  const double next = detail::stepUp(x);
  return next == 0 ? 0.0 : next;  // +0 above the greatest negative double
}

/// The greatest double below x; -inf for the lowest double and for -inf. NaN stays NaN.
inline double nextDown(double x) noexcept { return -nextUp(-x); }

/// With s = fl(a + b) the exact sum lies above s just when fl(s - a) < b or fl(s - b) < a, in every rounding mode.
/// Let a + b = s + e. If e > 0 then s - a < b, hence fl(s - a) <= b as rounding is monotone; if e <= 0, fl(s - a) >= b;
/// likewise with a and b exchanged. So neither comparison is ever true wrongly, and one is right: for the larger
/// operand, |a| >= |b| say, s - a is a double. (If e != 0, then s is a multiple of ulp(s) > ulp(b), a one of ulp(s) /
/// 2, and |s - a| < |b| + ulp(s) < (2^53 + 1) ulp(s) / 2.) Sums that underflow are exact. An overflow to the largest
/// double or to an infinity is judged rightly too: s - a is exact, or infinite.
inline double addUp(double a, double b) noexcept {
  const double s = a + b;
  if (std::isnan(s)) return std::numeric_limits<double>::infinity();
  return detail::stepUpIf(bool(int(s - a < b) | int(s - b < a)), s);
}

/// As addUp, mirrored: no sign of zero or comparison depends on the side.
inline double addDown(double a, double b) noexcept {
  const double s = a + b;
  if (std::isnan(s)) return -std::numeric_limits<double>::infinity();
  return detail::stepDownIf(bool(int(s - a > b) | int(s - b > a)), s);
}

/// a - b = a + (-b), and negation is exact.
inline double subDown(double a, double b) noexcept { return addDown(a, -b); }
inline double subUp(double a, double b) noexcept { return addUp(a, -b); }

/// The double nearest to a + b, ties to even, in every rounding mode; infinite beyond the largest double.
/// NaN for inf - inf.
double addNearest(double a, double b) noexcept;

/// p = fl(a * b) is the bound unless the exact product lies beyond: the sign of a * b - p.
inline double mulUp(double a, double b) noexcept {
  const double p = a * b;
  if (!(detail::isModerate(p) && std::abs(a) < 0x1p990 && std::abs(b) < 0x1p990)) return detail::mulSlow(a, b, true);
  return detail::stepUpIf(detail::productMinus(a, b, p) > 0, p);
}
inline double mulDown(double a, double b) noexcept {
  const double p = a * b;
  if (!(detail::isModerate(p) && std::abs(a) < 0x1p990 && std::abs(b) < 0x1p990)) return detail::mulSlow(a, b, false);
  return detail::stepDownIf(detail::productMinus(a, b, p) < 0, p);
}

/// a / b = q + r / b with the residual r = a - q b, of which |r| < ulp(q) |b|: the quotient lies above q just when
/// r / b > 0.
inline double divUp(double a, double b) noexcept {
  const double q = a / b;
  if (!(detail::isModerate(a) && detail::isModerate(b) && detail::isModerate(q))) return detail::divSlow(a, b, true);
  const double excess = detail::productMinus(q, b, a);
  return detail::stepUpIf(b > 0 ? excess < 0 : excess > 0, q);
}
inline double divDown(double a, double b) noexcept {
  const double q = a / b;
  if (!(detail::isModerate(a) && detail::isModerate(b) && detail::isModerate(q))) return detail::divSlow(a, b, false);
  const double excess = detail::productMinus(q, b, a);
  return detail::stepDownIf(b > 0 ? excess > 0 : excess < 0, q);
}

/// x = s^2 + r with the residual r = x - s^2, of which |r| < 2 s ulp(s): sqrt(x) lies above s just when r > 0.
inline double sqrtUp(double x) noexcept {
  if (!(x > 0 && detail::isModerate(x))) return detail::sqrtSlow(x, true);
  const double s = std::sqrt(x);
  return detail::stepUpIf(detail::productMinus(s, s, x) < 0, s);
}
inline double sqrtDown(double x) noexcept {
  if (!(x > 0 && detail::isModerate(x))) return detail::sqrtSlow(x, false);
  const double s = std::sqrt(x);
  return detail::stepDownIf(detail::productMinus(s, s, x) > 0, s);
}

}  // namespace gamut

#ifdef __clang__
#pragma float_control(pop)
#endif
