// The arithmetic of intervals on pairs (lower, upper) of doubles in one vector register, both bounds at once and
// without a branch that depends on signs: the tightest enclosures, in every rounding mode (elementary/rounding.hpp says
// how).
//
// A lower bound of a set is the negated upper bound of the negated set, so each kernel computes (-lower, upper), both
// rounded up. Sums need no special case at all: infinities, overflow, subnormals and the empty interval (NaN, NaN) come
// out right. Products, quotients and roots of operands that are zero or of moderate size (2^-480 to 2^510) are computed
// here; all others, and division by an interval that holds zero, go to Boost.Interval's case logic, out of line
// (interval_arithmetic.cpp). A zero endpoint is +0.
//
// Both bounds in one register, factors selected by sign: B. Lambov, Interval arithmetic using SSE-2 (Reliable
// Implementation of Real Number Algorithms, 2008), there with the rounding mode switched.
#pragma once

#include "scalars/elementary/rounding.hpp"

#ifdef __clang__  // as in elementary/rounding.hpp
#pragma float_control(push)
#pragma float_control(precise, on)
#endif

namespace gamut::detail {

/// Two doubles, or the mask of their comparison, in one register: an extension that g++ and clang++ share.
using Pair = double __attribute__((vector_size(16)));
using Mask = std::int64_t __attribute__((vector_size(16)));

constexpr std::int64_t signBit = std::numeric_limits<std::int64_t>::min();
inline Mask bits(Pair x) noexcept { return std::bit_cast<Mask>(x); }
inline Pair pair(Mask bits) noexcept { return std::bit_cast<Pair>(bits); }

/// Whether a lane's first bit is set, as it is where a comparison holds.
inline bool any(Mask mask) noexcept {
#if __has_builtin(__builtin_ia32_movmskpd)
  return __builtin_ia32_movmskpd(pair(mask)) != 0;
#else
  return (mask[0] | mask[1]) < 0;
#endif
}

inline Pair swapped(Pair x) noexcept { return Pair{x[1], x[0]}; }
inline Pair magnitudes(Pair x) noexcept { return pair(bits(x) & ~signBit); }
/// From (lower, upper) to (-lower, upper) and back.
inline Pair negateFirst(Pair x) noexcept { return pair(bits(x) ^ Mask{signBit, 0}); }
inline Pair negateSecond(Pair x) noexcept { return pair(bits(x) ^ Mask{0, signBit}); }
inline Pair greater(Pair x, Pair y) noexcept { return x > y ? x : y; }
inline Pair smaller(Pair x, Pair y) noexcept { return x < y ? x : y; }
inline Pair squareRoots(Pair x) noexcept {
#if __has_builtin(__builtin_ia32_sqrtpd)
  return __builtin_ia32_sqrtpd(x);
#else
  return Pair{std::sqrt(x[0]), std::sqrt(x[1])};
#endif
}
inline Pair withPositiveZeros(Pair x) noexcept { return pair(bits(x) & (x != 0.0)); }

/// From a faithful (-lower, upper) to (lower, upper), the neighbour above being taken where the exact bound lies
/// beyond.
inline Pair outward(Pair bounds, Mask beyond) noexcept {
  const Mask step = beyond & ((bounds < 0.0) | 1);
  return withPositiveZeros(negateFirst(pair(bits(bounds) + step)));
}

// Magnitudes that are neither zero nor within [2^-480, 2^510): products and residuals might underflow or overflow.
// (Zero's bits less one are no number, which compares false.)
inline Mask isTiny(Pair magnitude) noexcept { return pair(bits(magnitude) - 1) < 0x1p-480; }
inline Mask isHuge(Pair magnitude) noexcept { return magnitude >= 0x1p510; }

/// The two ways of productMinus, lane by lane.
struct FusedPairs {
  static Pair productMinus(Pair a, Pair b, Pair c) noexcept {
#if defined(__x86_64__)
    asm("vfmsub213pd {%2, %1, %0|%0, %1, %2}" : "+x"(a) : "x"(b), "x"(c));
    return a;
#else
    return Pair{std::fma(a[0], b[0], -c[0]), std::fma(a[1], b[1], -c[1])};
#endif
  }
};
struct SplitPairs {
  static Pair productMinus(Pair a, Pair b, Pair c) noexcept { return Split::productMinus<Pair, Mask>(a, b, c); }
};

// Out of line: what the kernels leave to Boost.Interval, and the kernels for processors without fused multiply-add.
Pair multiplySlow(Pair x, Pair y) noexcept;
Pair divideSlow(Pair x, Pair y) noexcept;
Pair squareSlow(Pair ends) noexcept;
Pair squareRootSlow(Pair x) noexcept;
Pair multiplySplit(Pair x, Pair y) noexcept;
Pair divideSplit(Pair x, Pair y) noexcept;

inline Pair negate(Pair x) noexcept { return withPositiveZeros(-swapped(x)); }

/// addUp in both lanes, infinities and NaN included: then no comparison holds. (A finite sum that overflows to -inf
/// lies below the exact one, which the comparisons see, and the step from -inf is the lowest double.)
inline Pair addOutward(Pair x, Pair y) noexcept {
  const Pair sum = x + y;
  return outward(sum, (sum - x < y) | (sum - y < x));
}
inline Pair add(Pair x, Pair y) noexcept { return addOutward(negateFirst(x), negateFirst(y)); }
/// [a, b] - [c, d] = [a - d, b - c].
inline Pair subtract(Pair x, Pair y) noexcept { return addOutward(negateFirst(x), negateSecond(swapped(y))); }

/// [a, b] [c, d]: the upper bound is the greater of b (b < 0 ? c : d) and a (a < 0 ? c : d), the lower bound's negative
/// the greater of -a (a < 0 ? d : c) and -b (b < 0 ? d : c). Rounding is monotone, so the greater of the rounded
/// products is the greater product, rounded, and the exact one lies beyond it just when either product does.
template <class Arithmetic>
inline Pair multiply(Pair x, Pair y) noexcept {
  const Pair xSize = magnitudes(x), ySize = magnitudes(y);
  if (any(isTiny(xSize) | isTiny(ySize) | isHuge(greater(xSize, ySize)))) [[unlikely]]
    return multiplySlow(x, y);
  const Pair xSwapped = swapped(x), ySwapped = swapped(y);
  const Pair x1 = negateFirst(x), y1 = bits(x) < 0 ? ySwapped : y;
  const Pair x2 = negateFirst(xSwapped), y2 = bits(xSwapped) < 0 ? ySwapped : y;
  const Pair bounds = greater(x1 * y1, x2 * y2);
  const Pair excess1 = Arithmetic::productMinus(x1, y1, bounds), excess2 = Arithmetic::productMinus(x2, y2, bounds);
  return outward(bounds, greater(excess1, excess2) > 0.0);
}

/// [a, b] / [c, d] without zero in [c, d]. For y < 0 it is -x / -y, whose (-lower, upper) of the numerator is (b, -a)
/// in place of (-a, b). A numerator n > 0 is divided by the least |y|, one below zero by the greatest; the quotient
/// lies beyond q just when n - q |y| > 0.
template <class Arithmetic>
inline Pair divide(Pair x, Pair y) noexcept {
  const Pair xSize = magnitudes(x), ySize = magnitudes(y);
  const Pair least = smaller(ySize, swapped(ySize)), greatest = greater(ySize, swapped(ySize));
  const Mask holdsZero = (bits(y) ^ bits(swapped(y))) | (least < 0x1p-480);
  if (any(holdsZero | isTiny(xSize) | isHuge(greater(xSize, greatest)))) [[unlikely]]
    return divideSlow(x, y);
  const Pair positive = negateFirst(x), numerator = bits(y) < 0 ? swapped(positive) : positive;
  const Pair denominator = bits(numerator) < 0 ? greatest : least;
  const Pair bounds = numerator / denominator;
  return outward(bounds, Arithmetic::productMinus(bounds, denominator, numerator) < 0.0);
}

/// x not empty: from the least to the greatest magnitude.
template <class Arithmetic>
inline Pair square(Pair x) noexcept {
  const Pair size = magnitudes(x), other = swapped(size);
  const Mask aroundZero = bits(x) ^ bits(swapped(x));
  const Pair ends{aroundZero[0] < 0 ? 0.0 : smaller(size, other)[0], greater(size, other)[1]};
  if (any(isTiny(ends) | isHuge(ends))) [[unlikely]]
    return squareSlow(ends);
  const Pair factors = negateFirst(ends), bounds = factors * ends;
  return outward(bounds, Arithmetic::productMinus(factors, ends, bounds) > 0.0);
}

/// x >= 0, not empty. The root is too small just when its square is.
template <class Arithmetic>
inline Pair squareRoot(Pair x) noexcept {
  if (any(isTiny(magnitudes(x)) | isHuge(x))) [[unlikely]]
    return squareRootSlow(x);
  const Pair roots = squareRoots(x);
  return outward(negateFirst(roots), negateFirst(Arithmetic::productMinus(roots, roots, x)) < 0.0);
}

inline Pair multiply(Pair x, Pair y) noexcept {
  if (hasFusedMultiplyAdd) [[likely]]
    return multiply<FusedPairs>(x, y);
  return multiplySplit(x, y);
}
inline Pair divide(Pair x, Pair y) noexcept {
  if (hasFusedMultiplyAdd) [[likely]]
    return divide<FusedPairs>(x, y);
  return divideSplit(x, y);
}
inline Pair square(Pair x) noexcept { return hasFusedMultiplyAdd ? square<FusedPairs>(x) : square<SplitPairs>(x); }
inline Pair squareRoot(Pair x) noexcept {
  return hasFusedMultiplyAdd ? squareRoot<FusedPairs>(x) : squareRoot<SplitPairs>(x);
}

}  // namespace gamut::detail

#ifdef __clang__
#pragma float_control(pop)
#endif
