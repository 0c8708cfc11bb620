// The sine-cosine kernel over arrays, compiled once a vector unit; what the kernel leaves goes to MPFR.
#include "scalars/elementary/vector_functions.hpp"

#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "scalars/elementary/sine_cosine_kernel.hpp"

namespace gamut {
namespace {

using namespace detail;

/// Correctly rounded (a sine or cosine of a double is never tiny enough to underflow where the kernel gives up).
SineCosine byMpfr(double x) {
  if (!std::isfinite(x)) return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  mpfr_t argument, s, c;
  mpfr_inits2(53, argument, s, c, static_cast<mpfr_ptr>(nullptr));
  mpfr_set_d(argument, x, MPFR_RNDN);
  mpfr_sin_cos(s, c, argument, MPFR_RNDN);
  const SineCosine result{mpfr_get_d(s, MPFR_RNDN), mpfr_get_d(c, MPFR_RNDN)};
  mpfr_clears(argument, s, c, static_cast<mpfr_ptr>(nullptr));
  return result;
}

constexpr std::size_t group = 32;  // values whose hard cases are looked for together

/// n values, n a multiple of `group`.
template <class V>
GAMUT_INLINE void overArray(const double* x, std::size_t n, double* s, double* c) {
  constexpr int vectors = static_cast<int>(group) / lanes<V>;
  for (std::size_t i = 0; i < n; i += group, x += group, s += group, c += group) {
    V angle[vectors];  // kept: the results may overwrite x
    BitsOf<V> anyHard{};
#pragma GCC unroll 1  // unrolled, the vectors would not fit the registers
    for (int j = 0; j < vectors; ++j) {
      V sine, cosine;
      BitsOf<V> hard;
      load(angle[j], x + j * lanes<V>);
      sineCosineKernel(angle[j], sine, cosine, hard);
      store(s + j * lanes<V>, sine);
      store(c + j * lanes<V>, cosine);
      anyHard |= hard;
    }
    std::uint64_t any = 0;
    for (int lane = 0; lane < lanes<V>; ++lane) any |= anyHard[lane];
    if (any == 0) [[likely]]
      continue;
    for (int j = 0; j < vectors; ++j)
      for (int lane = 0; lane < lanes<V>; ++lane) {
        const SineCosine both = sineCosine(angle[j][lane]);
        s[j * lanes<V> + lane] = both.sine;
        c[j * lanes<V> + lane] = both.cosine;
      }
  }
}

void onBaseline(const double* x, std::size_t n, double* s, double* c) { overArray<Vector2>(x, n, s, c); }
GAMUT_AVX2 void onAvx2(const double* x, std::size_t n, double* s, double* c) { overArray<Vector4>(x, n, s, c); }
GAMUT_AVX512 void onAvx512(const double* x, std::size_t n, double* s, double* c) { overArray<Vector8>(x, n, s, c); }

void checkLengths(std::size_t x, std::size_t y) {
  if (x != y) throw std::invalid_argument("sine and cosine need a place for the result of each argument");
}

/// The array in blocks that fit the first-level cache, handing each block's sines and cosines to `keep`.
template <class Keep>
void inBlocks(std::span<const double> x, Keep keep) {
  constexpr std::size_t block = 256;
  double s[block], c[block];
  for (std::size_t i = 0; i < x.size(); i += block) {
    const std::size_t n = std::min(block, x.size() - i);
    sineCosine(x.subspan(i, n), std::span(s, n), std::span(c, n));
    keep(i, n, s, c);
  }
}

}  // namespace

SineCosine sineCosine(double x) {
  SineCosine both;
  std::uint64_t hard;
  sineCosineKernel(x, both.sine, both.cosine, hard);
  return hard == 0 ? both : byMpfr(x);
}

void sineCosine(VectorUnit unit, std::span<const double> x, std::span<double> sine, std::span<double> cosine) {
  checkLengths(x.size(), sine.size());
  checkLengths(x.size(), cosine.size());
  const auto run = unit == VectorUnit::avx512 ? onAvx512 : unit == VectorUnit::avx2 ? onAvx2 : onBaseline;
  const std::size_t whole = x.size() / group * group, rest = x.size() - whole;
  run(x.data(), whole, sine.data(), cosine.data());
  if (rest == 0) return;
  double last[group] = {}, s[group], c[group];
  std::copy_n(&x[whole], rest, last);
  run(last, group, s, c);
  std::copy_n(s, rest, &sine[whole]);
  std::copy_n(c, rest, &cosine[whole]);
}

void sineCosine(std::span<const double> x, std::span<double> sine, std::span<double> cosine) {
  sineCosine(usableUnits().back(), x, sine, cosine);
}

void sine(std::span<const double> x, std::span<double> sine) {
  checkLengths(x.size(), sine.size());
  inBlocks(x, [&](std::size_t i, std::size_t n, const double* s, const double*) { std::copy_n(s, n, &sine[i]); });
}

void cosine(std::span<const double> x, std::span<double> cosine) {
  checkLengths(x.size(), cosine.size());
  inBlocks(x, [&](std::size_t i, std::size_t n, const double*, const double* c) { std::copy_n(c, n, &cosine[i]); });
}

}  // namespace gamut
