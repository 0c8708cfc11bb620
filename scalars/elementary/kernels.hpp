// sin and cos, exp, log, atan, asin, acos and tan as double-doubles, with the error budget of each.
//
// Each kernel returns hi + lo = f(x) (1 + d) and a budget above its code bounds |d|, term by term, in round-to-nearest
// with neither overflow nor underflow. u = 2^-53; '3 u' without more is a relative error. The plan is the same
// everywhere: a table value T at a grid point, the first-order term as an exact product, and a short Taylor series
// whose values are so small beside the result that plain doubles do. Products of two errors (2^-100) are left out of
// the lists; each claim leaves more than 3 % for them and for the roundings of the caller's test.
// Proved below, claimed, and the worst seen over 10^7 arguments each against 200 bits, most of them adversarial (table
// boundaries, neighbours of multiples of pi / 512 and log 2 / 256, arguments near 1):
//
//                      proved      claimed     worst seen: plain    fused
//   sin, cos           2^-66.68    2^-65.54    2^-67.71             2^-67.83
//   tan                2^-65.68    2^-64.54    2^-67.73             2^-67.82
//   exp                2^-67.77    2^-66       2^-68.44             2^-68.52
//   log                2^-67.26    2^-66       2^-68.48             2^-68.62
//   atan               2^-67.46    2^-66       2^-68.52             2^-68.65
//   asin, acos         2^-67.46    2^-66       2^-68.37             2^-68.61
//
//   GAMUT_ELEMENTARY_CASES=10000000 test_scalars --gtest_filter='*ElementaryKernels.Err*'
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "scalars/elementary/double_double.hpp"

namespace gamut::detail {

/// The claims: |hi + lo - f(x)| <= claim * |f(x)|.
constexpr double sinCosClaim = 0x1.6p-66, tanClaim = 0x1.6p-65, expClaim = 0x1p-66, logClaim = 0x1p-66,
                 angleClaim = 0x1p-66;

// ---- Tables: hi is the double nearest to the value, lo to the rest, so they are exact to 2^-106 ---------------------

/// sin(j pi / 256), j = 0 ... 639; zeros where it is zero.
extern const std::array<DoubleDouble, 640> sineTable;
/// 2^(j / 128), j = 0 ... 127.
extern const std::array<DoubleDouble, 128> exponentialTable;
/// 1 / c for the middle c of a subinterval, rounded to a multiple of 2^-12, and -log of that multiple.
struct LogarithmEntry {
  double inverse;
  DoubleDouble logarithm;
};
extern const std::array<LogarithmEntry, 128> logarithmTable;
/// atan(i / 128).
extern const std::array<DoubleDouble, 129> arctangentTable;

// ---- Constants in parts of few bits, so that their multiples are exact; the last is nearest to the rest -------------

constexpr double piOver256[] = {0x1.921fb5p-7, 0x1.110b46p-33, 0x1.1a6262p-61, 0x1.3145c06e0e689p-85};
constexpr double logTwoOver128[] = {0x1.62e42fefap-8, 0x1.cf79abc9e3b3ap-47};
constexpr double logTwo[] = {0x1.62e42fefa38p-1, 0x1.ef35793c7673p-45};
constexpr double halfPi[] = {0x1.921fb54442d18p0, 0x1.1a62633145c07p-54};

// ---- The integer nearest to a double --------------------------------------------------------------------------------

/// k = y rounded to nearest for |y| < 2^50, and the same as an integer: 1.5 * 2^52 + y is rounded to an integer, which
/// then stands in the last bits.
struct Nearest {
  double value;
  std::int64_t integer;
};
[[gnu::always_inline]] inline Nearest nearestInteger(double y) {
  constexpr double shift = 0x1.8p52;
  const double shifted = shift + y;
  return {shifted - shift, std::bit_cast<std::int64_t>(shifted) - std::bit_cast<std::int64_t>(shift)};
}

// ---- sin and cos ----------------------------------------------------------------------------------------------------

/// sin(b + r) from b's sine and cosine; sine and cosine are sin r - r and cos r - 1 + z / 2, halfSquare is -z / 2.
/// |b's sine| >= |b's cosine r|, or it is zero, and r is small: so the leading terms are ordered for exact sums.
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble turned(const DoubleDouble& sin, const DoubleDouble& cos,
                                                  const DoubleDouble& r, double halfSquare, double sine,
                                                  double cosine) {
  const auto [first, firstLow] = exactProduct<fused>(cos.hi, r.hi);
  const auto [second, secondLow] = exactProduct<fused>(sin.hi, halfSquare);
  const auto [sum, low] = exactSumOrdered(sin.hi, first);
  const auto [hi, lower] = exactSumOrdered(sum, second);
  double rest = multiplyAdd<fused>(cos.hi, r.lo, multiplyAdd<fused>(cos.lo, r.hi, firstLow + secondLow));
  rest = multiplyAdd<fused>(sin.hi, cosine, multiplyAdd<fused>(sin.lo, halfSquare, rest));
  return {hi, multiplyAdd<fused>(cos.hi, sine, rest + ((low + lower) + sin.lo))};
}

struct SinCosValue {
  DoubleDouble sin, cos;
  std::int64_t quadrant;  ///< floor(2 x / pi)
};

/// For 2^-27 <= |x| < 2^20. False, with nothing said, where x is too close to a multiple k pi / 256 for the parts of
/// pi: closer than |k| 2^-66, at most one argument in 2^30.
///
/// Reduction: k = x 256 / pi rounded to nearest, |k| < 2^26.4; r = x - k pi / 256, |r| <= R = 2^-7.348.
///   pi / 256 = P1 + P2 + P3 + P4 + 2^-138.8, the first three multiples of 2^-32, 2^-58, 2^-84 with 26 bits at most:
///   their products with k are exact.
///   x - k P1: exact by Sterbenz' lemma. The product x 256 / pi errs by 2 u, so (|k| - 1/2)(1 - 2^-51) pi / 256 <= |x|
///     <= (|k| + 1/2)(1 + 2^-51) pi / 256, and P1 is less than pi / 256 by 2^-26.6 of it: k P1 is within [x / 2, 2 x].
///   ... - k P2: exact. For k != 0, |x| > 2^-8, so all terms are multiples of 2^-60, and the result stays below
///     R + 2^26.4 2^-58 < 2^-7 = 2^53 2^-60.
///   ... - k P3: exact as t + f.
///   ... - k P4: product |k| 2^-84.7 u, sum u (u |t| + |k| 2^-84.7), constant |k| 2^-138.8; together less than
///     |k| 2^-136.3 + 2^-106 |t|.
///   As |t| >= |k| 2^-66, r = r.hi + r.lo is exact to 2^-70.2, and the sign of r is that of r.hi.
/// Values: with S = sin, C = cos of k pi / 256, z = r.hi^2 rounded, relative to V = |sin x|:
///   sin x = S + C r - S z / 2 + C (sin r - r) + S (cos r - 1 + z / 2).
///   |C r| <= 1.01 V and |S| <= 2.01 V (worst at S = sin(pi / 256), r = -R), z <= 2^-14.69.
///   reduction                     1.01 * 2^-70.2                                              2^-70.1
///   series, sin after r^7 / 7!    1.01 z^4 / 9!                                               2^-77.2
///   series, cos after z^3 / 6!    2.01 z^4 / 8!                                               2^-73.0
///   S, C r.hi, S z / 2            exact sums and products
///   their low parts, C r.lo       plain operations on what is 2^-53 of V                      2^-102
///   C (sin r - r)                 z: 3 u (rounded; r.lo left out), r.hi z: 2 u more, coefficient -1/6: 0.5 u, sum with
///                                 z/120...: 1.01 u, product 1 u, C for its high part 1 u, product with it 1 u, added
///                                 to the low parts 1 u: 10.6 u of 1.01 z / 6 = 2^-17.26        2^-66.85
///   S (cos r - 1 + z / 2)         13 u of 2.01 z^2 / 24                                       2^-82.2
///   together                                                                                  2^-66.68
/// cos x likewise with (C, -S) for (S, C).
template <bool fused>
[[gnu::always_inline]] inline bool sinCosKernel(double x, SinCosValue& value) {
  constexpr double p1 = piOver256[0], p2 = piOver256[1], p3 = piOver256[2], p4 = piOver256[3];
  const auto [k, index] = nearestInteger(x * 0x1.45f306dc9c883p6);  // 256 / pi
  const double s = multiplyAdd<fused>(-k, p2, multiplyAdd<fused>(-k, p1, x));
  const DoubleDouble t = exactSum(s, -k * p3);
  if (!(std::abs(t.hi) >= std::abs(k) * 0x1p-66)) return false;
  const DoubleDouble r = exactSumOrdered(t.hi, t.lo - k * p4);  // |t.hi| >= 2^17 |k p4|

  // |r| < pi / 256, so floor(2 x / pi) = floor(k / 128), but one less where k is a multiple of 128 and r < 0.
  value.quadrant = (index - ((index & 127) == 0 && r.hi < 0)) >> 7;

  const auto [z, zLow] = exactProduct<fused>(r.hi, r.hi);
  const double sine =
      r.hi * z *
      multiplyAdd<fused>(z, multiplyAdd<fused>(z, -0x1.a01a01a01a01ap-13, 0x1.1111111111111p-7), -0x1.5555555555555p-3);
  const double halfSquare = -0.5 * z;
  const double cosine = multiplyAdd<fused>(z * z, multiplyAdd<fused>(z, -0x1.6c16c16c16c17p-10, 0x1.5555555555555p-5),
                                           -multiplyAdd<fused>(r.hi, r.lo, 0.5 * zLow));
  const DoubleDouble* entry = &sineTable[index & 511];
  value.sin = turned<fused>(entry[0], entry[128], r, halfSquare, sine, cosine);
  value.cos = turned<fused>(entry[128], -entry[0], r, halfSquare, sine, cosine);
  return true;
}

/// tan x = sin x / cos x: 2^-66.68 twice and the quotient's 2^-98, together 2^-65.68. (|lo| of both is up to 2^-17 of
/// hi, so they are normalised first, exactly.)
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble tangentOf(const SinCosValue& value) {
  return quotient<fused>(exactSumOrdered(value.sin.hi, value.sin.lo), exactSumOrdered(value.cos.hi, value.cos.lo));
}

// ---- exp ------------------------------------------------------------------------------------------------------------

/// For |x| <= 709: exp(x) = 2^exponent (hi + lo), the sum in (0.99, 2.01).
///
/// Reduction: k = x 128 / log 2 rounded to nearest, |k| <= 2^17; r = x - k log 2 / 128, |r| <= 2^-8.528.
///   log 2 / 128 = L1 + L2 + 2^-100, L1 of 36 bits. k L1 is exact; x - k L1 is exact by Sterbenz' lemma as above (L1 is
///   less than log 2 / 128 by 2^-37.6 of it). k L2 errs by u 2^-29.1 + 2^-83; the difference is exact as r.hi + r.lo.
/// Values: T = 2^(j / 128), exp = T + T r + T (exp(r) - 1 - r), relative to the result, T < 1.003 of it:
///   reduction                     2^-82.1 + 2^-83, absolute in r                              2^-81.4
///   series after r^6 / 6!         1.003 r^7 / 7!                                              2^-71.9
///   T, T r.hi                     exact sum and product
///   their low parts, T r.lo       plain operations on what is 2^-53                           2^-103
///   T (exp(r) - 1 - r)            z = r.hi^2: 3 u (rounded; r.lo left out), 1/2 + r/6: 1.01 u, sum with z/24...:
///                                 1.01 u, product 1 u, T for its high part 1 u, product with it 1 u, added to the
///                                 low parts 1 u: 9.1 u of 1.003 r^2 / 2 = 2^-18.05             2^-67.86
///   together                                                                                  2^-67.77
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble expKernel(double x, std::int64_t& exponent) {
  const auto [k, index] = nearestInteger(x * 0x1.71547652b82fep7);  // 128 / log 2
  const DoubleDouble r = exactSum(multiplyAdd<fused>(-k, logTwoOver128[0], x), -k * logTwoOver128[1]);
  const double z = r.hi * r.hi;
  const double low = multiplyAdd<fused>(r.hi, 0x1.5555555555555p-3, 0.5);                    // 1/2 + r/6
  const double high = multiplyAdd<fused>(r.hi, 0x1.1111111111111p-7, 0x1.5555555555555p-5);  // 1/24 + r/120
  const double series = z * multiplyAdd<fused>(z, multiplyAdd<fused>(z, 0x1.6c16c16c16c17p-10, high), low);
  const DoubleDouble power = exponentialTable[index & 127];
  exponent = index >> 7;
  const auto [first, firstLow] = exactProduct<fused>(power.hi, r.hi);
  const auto [hi, sumLow] = exactSumOrdered(power.hi, first);
  const double rest = multiplyAdd<fused>(power.hi, r.lo, multiplyAdd<fused>(power.lo, r.hi, firstLow + power.lo));
  return {hi, multiplyAdd<fused>(power.hi, series, rest + sumLow)};
}

// ---- log ------------------------------------------------------------------------------------------------------------

/// For finite x > 0: log x = e log 2 + log m, m in [0.705, 1.411), log m = T + log(1 + r), T = -log c, r = c m - 1,
/// where c, a multiple of 2^-12, is near 1 / m for the 128 subintervals that the leading bits tell apart.
///
/// The subinterval around 1 is [1 - 2^-9, 1 + 2^-8) with c = 1, T = 0, e = 0. Elsewhere V = |log x| > |r| / 1.01 and
/// > 2^-9.01. |r| <= 2^-7.988 (the worst is the subinterval above 1).
/// r: c m = p exactly in two doubles; p.hi - 1 is exact by Sterbenz' lemma and a multiple of 2^-52 (below 1 of 2^-53),
///   p.lo is at most half of that: so r = r.hi + r.lo exactly and normalised.
/// e log 2 = e M1 + e M2, M1 of 42 bits: e M1 is exact; e M2 errs by e 2^-96.9, and e != 0 means V > |e| / 3.
/// log(1 + r) = r - r^2 / 2 + r^3 / 3 - ... Relative to V:
///   e M2, T                                                                                   2^-95
///   e M1, T, r.hi, z / 2          exact sums; z + its low part = r.hi^2
///   low parts, r.hi r.lo          plain operations on what is 2^-53 of V                      2^-103
///   series after r^9 / 9          1.01 r^9 / 10                                               2^-75.2
///   r^3 / 3 - r^4 / 4...          z: 3 u (rounded; r.lo left out), r.hi z: 2 u more, coefficient 1/3: 0.5 u, sum with
///                                 r/4: 1.01 u, with z/5...: 1.01 u, product 1 u, added to the low parts 1 u:
///                                 9.6 u of 1.01 r^2 / 3 = 2^-17.54                             2^-67.27
///   together                                                                                  2^-67.26
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble logKernel(double x) {
  // The bits of 1, less 75 and a half subintervals of 2^45: counted from there, 1 is inside the 76th.
  constexpr std::int64_t origin = 0x3ff0000000000000 - 75 * (std::int64_t{1} << 45) - (std::int64_t{1} << 44);
  const double subnormal = x < 0x1p-1022 ? 1 : 0;
  const std::int64_t bits = std::bit_cast<std::int64_t>(subnormal != 0 ? x * 0x1p54 : x), place = bits - origin;
  const double m = std::bit_cast<double>(bits - (place >> 52 << 52));
  const double e = static_cast<double>(place >> 52) - 54 * subnormal;
  const auto& [c, table] = logarithmTable[place >> 45 & 127];

  const DoubleDouble p = exactProduct<fused>(c, m), r = exactSumOrdered(p.hi - 1, p.lo);
  const auto [z, zLow] = exactProduct<fused>(r.hi, r.hi);
  const double a = multiplyAdd<fused>(r.hi, -0.25, 0x1.5555555555555p-2);                  // 1/3 - r/4
  const double b = multiplyAdd<fused>(r.hi, -0x1.5555555555555p-3, 0x1.999999999999ap-3);  // 1/5 - r/6
  const double d = multiplyAdd<fused>(r.hi, -0.125, 0x1.2492492492492p-3);                 // 1/7 - r/8
  const double series =
      multiplyAdd<fused>(z, multiplyAdd<fused>(z, multiplyAdd<fused>(z, 0x1.c71c71c71c71cp-4, d), b), a);

  // The terms shrink, or those before are zero: |e M1| > |T| > |r.hi| > z / 2.
  const auto [s1, low1] = exactSumOrdered(e * logTwo[0], table.hi);
  const auto [s2, low2] = exactSumOrdered(s1, r.hi);
  const auto [s3, low3] = exactSumOrdered(s2, -0.5 * z);
  const double rest = multiplyAdd<fused>(e, logTwo[1], table.lo) + (low1 + low2 + low3) +
                      (r.lo - multiplyAdd<fused>(r.hi, r.lo, 0.5 * zLow));
  return {s3, multiplyAdd<fused>(r.hi * z, series, rest)};
}

// ---- atan, asin, acos -----------------------------------------------------------------------------------------------

/// quarters * pi / 2 + sign * atan(a / b) for 0 <= a <= b (1 + u), 2^-60 < b, both normalised; sign = 1 or -1, and
/// quarters is 0 (then a >= 2^-60 and sign = 1), or 1, or 2.
///
/// atan(a / b) = T + atan(t), T = atan(c), c = i / 128 nearest to a / b, t = (a - c b) / (b + c a), |t| <= 2^-7.999.
/// Numerator and denominator: c a.hi, c b.hi exact in two doubles, the leading sum exact, low parts by plain operations
///   to 2^-103 b; with c = 0 both are exact. t by quotient(): 2^-98 of t and, for c > 0, 2^-103, while V > 2^-8.01.
/// Relative to V = atan(a / b), |t| <= 1.001 V; quarter turns only make the result greater:
///   t, T                                                                                      2^-94
///   series after t^9 / 9          1.001 t^10 / 11                                             2^-83.4
///   t^3 / 3 - t^5 / 5...          z = t.hi^2: 3 u (rounded; t.lo left out), t.hi z: 2 u more, coefficient -1/3: 0.5 u,
///                                 sum with z/5...: 1.01 u, product 1 u, added to the low parts 1 u:
///                                 8.6 u of 1.001 t^2 / 3 = 2^-17.58                            2^-67.47
///   quarter turn                  u of t^3 / 3 of at least pi / 4                             2^-78
///   a / b                         as much as it errs itself: 2^-98 (asin, acos)               2^-98
///   together                                                                                  2^-67.46
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble angleKernel(const DoubleDouble& a, const DoubleDouble& b, double quarters,
                                                       double sign) {
  const auto [nearest, index] = nearestInteger(128 * (a.hi / b.hi));
  const double c = nearest * 0x1p-7;
  const auto [cb, cbLow] = exactProduct<fused>(c, b.hi);
  const auto [difference, differenceLow] = exactSum(a.hi, -cb);
  const auto [ca, caLow] = exactProduct<fused>(c, a.hi);
  const auto [sum, sumLow] = exactSumOrdered(b.hi, ca);
  const DoubleDouble numerator = exactSum(difference, (differenceLow - cbLow) + multiplyAdd<fused>(-c, b.lo, a.lo));
  const DoubleDouble denominator{sum, (sumLow + caLow) + multiplyAdd<fused>(c, a.lo, b.lo)};
  const DoubleDouble t = quotient<fused>(numerator, denominator);

  const double z = t.hi * t.hi;
  const double series = multiplyAdd<fused>(
      z,
      multiplyAdd<fused>(z, multiplyAdd<fused>(z, 0x1.c71c71c71c71cp-4, -0x1.2492492492492p-3), 0x1.999999999999ap-3),
      -0x1.5555555555555p-2);
  const DoubleDouble table = arctangentTable[index];
  const auto [angle, angleLow] = exactSumOrdered(table.hi, t.hi);
  const double rest = multiplyAdd<fused>(t.hi * z, series, angleLow + (table.lo + t.lo));
  const auto [hi, low] = exactSumOrdered(quarters * halfPi[0], sign * angle);
  return {hi, multiplyAdd<fused>(quarters, halfPi[1], low) + sign * rest};
}

/// For 2^-27 <= x <= 2^60: atan x; beyond 1 it is pi / 2 - atan(1 / x).
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble atanKernel(double x) {
  const bool steep = x > 1;
  return angleKernel<fused>({steep ? 1 : x, 0}, {steep ? x : 1, 0}, steep ? 1 : 0, steep ? -1 : 1);
}

/// sqrt(1 - x^2) for 0 <= x < 1, to 2^-99: x^2 is exact in two doubles; 1 - hi is exact, with a low part only where
/// x^2 < 1/2; that less lo is rounded to 2^-107 there, and exact otherwise. Half of 2^-106, and squareRoot's 2^-100.
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble cosineOfArcsine(double x) {
  const auto [square, squareLow] = exactProduct<fused>(x, x);
  const auto [rest, restLow] = exactSumOrdered(1, -square);
  return squareRoot<fused>(exactSumOrdered(rest, restLow - squareLow));
}

/// For 2^-27 <= x < 1: asin x is the angle with sine x and cosine s = sqrt(1 - x^2).
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble asinKernel(double x) {
  const DoubleDouble s = cosineOfArcsine<fused>(x), sine{x, 0};
  const bool steep = x > s.hi;
  return angleKernel<fused>(steep ? s : sine, steep ? sine : s, steep ? 1 : 0, steep ? -1 : 1);
}

/// For 2^-60 <= |x| < 1: acos x, the angle with cosine x.
template <bool fused>
[[gnu::always_inline]] inline DoubleDouble acosKernel(double x) {
  const double size = std::abs(x);
  const DoubleDouble s = cosineOfArcsine<fused>(size), cosine{size, 0};
  const bool steep = size <= s.hi, left = x < 0;
  return angleKernel<fused>(steep ? cosine : s, steep ? s : cosine, steep ? 1 : left ? 2 : 0, steep != left ? -1 : 1);
}

}  // namespace gamut::detail
