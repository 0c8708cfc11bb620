// Sine and cosine of doubles in additions, multiplications and bit operations only, so that one double and vectors of
// any length give the same bits on every machine. For 0 <= |x| <= 2^20, with u = 2^-53, all rounded to nearest (in
// another rounding mode k can be one off and the errors are not bounded):
//
// Reduction (Cody and Waite 1980): a = |x|, k = round(a 2/pi) <= 2^20 and r = a - k pi/2, |r| <= pi/4 + 2^-31. pi/2 is
// P1 + P2 + P3 + delta with P1, P2 of 33 bits, P3 < 2^-68.7 of 53 and |delta| < 2^-122.8. So k P1 and k P2 are exact,
// a - k P1 is exact (Sterbenz: the two are within a factor of 2, or k = 0), its difference from k P2 is high + e
// exactly (TwoDiff), and d = e - k P3 has an error <= u|d| + u k P3 <= u (u|high| + 2 k 2^-68.7). Then r + tail = high
// + d exactly (Fast2Sum, |high| >= |d|), and the sum of all errors is <= 2^-105 |r| + k 2^-120. Lanes with |r| < k
// 2^-62 are left to the caller: elsewhere the relative error of r + tail is < 2^-57.9.
//
// Sine: r + (r z S + tail (1 - z/2)), z = r², S the Taylor polynomial up to r^17/17!. Its remainder is <= r^19/19! <=
// 2^-63 r (the series alternates). The bracket is <= 0.104 |r|; z and S carry relative errors <= u and 2u (the first
// term of S rules: the others are < 4 % of it), the two products and the sum one each: <= 6u 0.104 |r| = 0.625 u |r|.
// With r <= 1.111 sin r that is 0.695 u; the reduction adds 0.034 u (r cos r <= sin r), 1 - z/2 for cos r behind tail
// <= u r adds 1.111 u r^4/24 <= 0.018 u, the remainder 0.001 u: 0.748 u of the sine, <= 0.748 ulp, and half an ulp for
// the last addition: < 1.25 ulp.
//
// Cosine: w + ((1 - w - z/2) + (z² C - r tail)), w = 1 - z/2 rounded, whose rounding the bracket returns exactly
// (Fast2Sum); C the Taylor polynomial up to r^16/16!. z/2 <= 0.309 has the error 0.309 u of z's rounding; z² C <=
// 0.0159 has <= 6u of its own, 0.096 u. Of the rest, the reduction is r sin r 2^-57.9 <= 0.019 u, r for sin r behind
// |tail| <= u/2 is <= 0.040 u and the remainder r^18/18! <= 0.019 u: 0.078 u. The cosine is in [0.707, 1], where an ulp
// is u: < 0.309 + 0.096 + 0.078 ulp, and half an ulp for the last addition: < 1 ulp.
#pragma once

#include "scalars/elementary/vector_unit.hpp"

namespace gamut::detail {

/// By Horner's scheme, with 1/n! for n = 3, 5, ... 17 and n = 4, 6, ... 16.
template <class V>
GAMUT_INLINE void taylorSeries(const V& z, V& sines, V& cosines) {
  sines =
      z * (z * (z * (z * (z * (z * (z * (z * 0x1.952c77030ad4ap-49 - 0x1.ae7f3e733b81fp-41) + 0x1.6124613a86d09p-33) -
                               0x1.ae64567f544e4p-26) +
                          0x1.71de3a556c734p-19) -
                     0x1.a01a01a01a01ap-13) +
                0x1.1111111111111p-7) -
           0x1.5555555555555p-3);
  cosines = z * (z * (z * (z * (z * (z * (z * 0x1.ae7f3e733b81fp-45 - 0x1.93974a8c07c9dp-37) + 0x1.1eed8eff8d898p-29) -
                                0x1.27e4fb7789f5cp-22) +
                           0x1.a01a01a01a01ap-16) -
                      0x1.6c16c16c16c17p-10) +
                 0x1.5555555555555p-5);
}

/// s = sin x, c = cos x where `hard` comes out zero; elsewhere (|x| > 2^20, x a NaN, or x so close to a multiple of
/// pi/2 that the reduction has lost too much) s and c mean nothing. V: double or a vector of doubles.
template <class V>
GAMUT_INLINE void sineCosineKernel(const V& x, V& s, V& c, BitsOf<V>& hard) {
  using Bits = BitsOf<V>;
  constexpr std::uint64_t signBit = std::uint64_t{1} << 63;
  constexpr double toInteger = 0x1.8p52;  // adding it leaves the nearest integer in the low bits

  Bits bits, quadrant;
  reinterpret(bits, x);
  const Bits sign = bits & signBit;
  bits = bits & ~signBit;
  V a;
  reinterpret(a, bits);

  const V shifted = a * 0x1.45f306dc9c883p-1 + toInteger;
  reinterpret(quadrant, shifted);
  const V k = shifted - toInteger;
  const V first = a - k * 0x1.921fb544p+0;
  const V second = k * 0x1.0b4611a6p-34;
  const V high = first - second;
  const V taken = high - first;
  const V low = (first - (high - taken)) - (second + taken);
  const V d = low - k * 0x1.3198a2e037073p-69;
  const V r = high + d;
  const V tail = (high - r) + d;

  const V z = r * r;
  V sines, cosines;
  taylorSeries(z, sines, cosines);
  const V half = 0.5 * z;
  const V w = 1.0 - half;
  const V sine = r + (r * sines + tail * w);
  const V cosine = w + (((1.0 - w) - half) + (z * cosines - r * tail));

  // An odd quadrant swaps the two; signs follow from the quadrant, the sine's from x too.
  Bits sineBits, cosineBits;
  reinterpret(sineBits, sine);
  reinterpret(cosineBits, cosine);
  const Bits swap = ((sineBits ^ cosineBits) & (~(quadrant & 1) + 1));
  sineBits = (sineBits ^ swap) ^ sign ^ ((quadrant & 2) << 62);
  cosineBits = (cosineBits ^ swap) ^ (((quadrant + 1) & 2) << 62);

  // The sign bit of 2^20 - |x| and of |r| - k 2^-62; a NaN's comes from its exponent, since 2^62 - NaN's bits < 0.
  V near;
  Bits rBits, far, nearBits;
  reinterpret(rBits, r);
  rBits = rBits & ~signBit;
  reinterpret(near, rBits);
  near = near - k * 0x1p-62;
  reinterpret(nearBits, near);
  far = (Bits{} + 0x4130000000000000u) - bits;  // 0x413... is 2^20: positive doubles are ordered as their bits are
  hard = (far | nearBits) & signBit;
  reinterpret(s, sineBits);
  reinterpret(c, cosineBits);
}

}  // namespace gamut::detail
