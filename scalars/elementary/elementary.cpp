// Chooses between the kernels and MPFR, and between the kernels' two forms (with and without fused multiply-add).
#include "scalars/elementary/elementary.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "scalars/elementary/kernels.hpp"
#include "scalars/elementary/rounding.hpp"

namespace gamut::detail {
namespace {

// ---- The processor --------------------------------------------------------------------------------------------------

// A kernel is compiled in both forms, the fused one for processors that have the instruction even where the build does
// not rely on it.
#if defined(__x86_64__) && !defined(__FMA__)
#define GAMUT_WITH_FUSED_MULTIPLY_ADD [[gnu::target("fma")]]
#else
#define GAMUT_WITH_FUSED_MULTIPLY_ADD
#endif

template <class Kernel>
GAMUT_WITH_FUSED_MULTIPLY_ADD typename Kernel::Result runFused(double x) {
  return Kernel::template of<true>(x);
}

template <class Kernel>
typename Kernel::Result run(double x) {
  return hasFusedMultiplyAdd ? runFused<Kernel>(x) : Kernel::template of<false>(x);
}

// ---- Bounds from an approximation -----------------------------------------------------------------------------------

/// x times 2^n by its exponent bits; x and the result are normal.
[[gnu::always_inline]] inline double scaled(double x, std::int64_t n) {
  return std::bit_cast<double>(std::bit_cast<std::int64_t>(x) + n * (std::int64_t{1} << 52));
}

/// Bounds of one value, if the kernel was able to tell.
struct Decided {
  Bounds bounds;
  bool known;
};

/// h and its neighbour on the side of l, h != 0: away from zero where their signs agree.
[[gnu::always_inline]] inline Bounds between(double h, double l) {
  const auto bits = std::bit_cast<std::int64_t>(h), step = 1 | (bits ^ std::bit_cast<std::int64_t>(l)) >> 63;
  const double next = std::bit_cast<double>(bits + step);
  return l > 0 ? Bounds{h, next} : Bounds{next, h};
}

/// The bounds of a value that is irrational and within claim of hi + lo, relative to itself (see the header).
/// The kernels' claims exceed what is proved by 3 %, for taking |h| for the value and rounding claim * |h|.
[[gnu::always_inline]] inline Decided decide(const DoubleDouble& value, double claim) {
  const auto [h, l] = exactSumOrdered(value.hi, value.lo);
  return {between(h, l), std::abs(l) > claim * std::abs(h)};
}

/// The same for a value that is known to be in (-1, 1): if the nearest double is 1 or -1, the value is on its inside.
[[gnu::always_inline]] inline Decided decideInsideOne(const DoubleDouble& value, double claim) {
  const auto [h, l] = exactSumOrdered(value.hi, value.lo);
  const bool isOne = std::abs(h) == 1;
  return {between(h, isOne ? -h : l), isOne || std::abs(l) > claim * std::abs(h)};
}

[[gnu::always_inline]] inline Bounds negated(const Bounds& bounds) { return {-bounds.up, -bounds.down}; }

// ---- The kernels with their decisions -------------------------------------------------------------------------------

struct SinCosAt {
  struct Result {
    SinCosTurn turn;
    bool known;
  };
  template <bool fused>
  [[gnu::always_inline]] static Result of(double x) {
    SinCosValue value;
    if (!sinCosKernel<fused>(x, value)) return {{}, false};
    const Decided sine = decideInsideOne(value.sin, sinCosClaim), cosine = decideInsideOne(value.cos, sinCosClaim);
    return {{{sine.bounds, cosine.bounds}, static_cast<int>(value.quadrant & 7)}, sine.known && cosine.known};
  }
};

struct TanAt {
  struct Result {
    TanTurn turn;
    bool known;
  };
  template <bool fused>
  [[gnu::always_inline]] static Result of(double x) {
    SinCosValue value;
    if (!sinCosKernel<fused>(x, value)) return {{}, false};
    const Decided tangent = decide(tangentOf<fused>(value), tanClaim);
    return {{tangent.bounds, static_cast<int>(value.quadrant & 7)}, tangent.known};
  }
};

struct ExpAt {
  using Result = Decided;
  template <bool fused>
  [[gnu::always_inline]] static Result of(double x) {
    std::int64_t exponent;
    const DoubleDouble value = expKernel<fused>(x, exponent);
    const auto [bounds, known] = decide(value, expClaim);
    return {{scaled(bounds.down, exponent), scaled(bounds.up, exponent)}, known};
  }
};

struct LogAt {
  using Result = Decided;
  template <bool fused>
  [[gnu::always_inline]] static Result of(double x) {
    return decide(logKernel<fused>(x), logClaim);
  }
};

struct AtanAt {
  using Result = Decided;
  template <bool fused>
  [[gnu::always_inline]] static Result of(double x) {
    return decide(atanKernel<fused>(x), angleClaim);
  }
};

struct AsinAt {
  using Result = Decided;
  template <bool fused>
  [[gnu::always_inline]] static Result of(double x) {
    return decide(asinKernel<fused>(x), angleClaim);
  }
};

struct AcosAt {
  using Result = Decided;
  template <bool fused>
  [[gnu::always_inline]] static Result of(double x) {
    return decide(acosKernel<fused>(x), angleClaim);
  }
};

// ---- Tiny arguments -------------------------------------------------------------------------------------------------

/// Below 2^-27 the functions x + c x^3 + ... with |c| <= 1/3 differ from x by less than x 2^-55, so by less than the
/// distance to the next double, which is at least x 2^-53.
constexpr double tiny = 0x1p-27;

/// x - c x^3..., 0 < |x| < tiny: nearer to zero than x.
Bounds shrunk(double x) { return x > 0 ? Bounds{nextDown(x), x} : Bounds{x, nextUp(x)}; }
/// x + c x^3..., 0 < |x| < tiny: farther from zero.
Bounds grown(double x) { return x > 0 ? Bounds{x, nextUp(x)} : Bounds{nextDown(x), x}; }

/// pi / 2, which no double in [pi / 2 - 2^-54, pi / 2 + 2^-54] separates from its bounds.
constexpr Bounds quarterTurn{0x1.921fb54442d18p+0, 0x1.921fb54442d19p+0};

// ---- Quadrants ------------------------------------------------------------------------------------------------------

/// floor(2 x / pi) modulo 8 in 1280 bits: the integer part has at most 1024. No double comes closer to a multiple of
/// pi / 2 than 2^-62, except to the multiple 0, beside which its sign decides; so the other bits decide the floor. -1
/// where they did not (they always do).
int quadrantByMpfr(double x) {
  constexpr int precision = 1280;
  const WideExponents wide;
  thread_local Number<precision + 64> pi;
  thread_local Number<precision> low, high;
  thread_local Number<8> eight;
  thread_local bool known = false;
  if (!known) {
    mpfr_const_pi(pi, MPFR_RNDN);  // error below 2^-1340, less than a last bit of the quotient
    mpfr_set_ui(eight, 8, MPFR_RNDN);
    known = true;
  }
  mpfr_set_d(low, x, MPFR_RNDN);
  mpfr_mul_2ui(low, low, 1, MPFR_RNDN);
  mpfr_div(low, low, pi, MPFR_RNDD);
  mpfr_nextbelow(low);  // covers pi's error
  mpfr_set(high, low, MPFR_RNDN);
  for (int step = 0; step < 3; ++step) mpfr_nextabove(high);
  mpfr_floor(low, low);
  mpfr_floor(high, high);
  if (!mpfr_equal_p(low, high)) return -1;
  mpfr_fmod(low, low, eight, MPFR_RNDN);  // exact; carries the sign of x
  return static_cast<int>(mpfr_get_si(low, MPFR_RNDN)) & 7;
}

int slowQuadrant(double x) { return x == 0 ? 0 : quadrantByMpfr(x); }

// ---- Fast answers ---------------------------------------------------------------------------------------------------

/// The answer without MPFR, where there is one.
SinCosAt::Result fastSinCos(double x) {
  const double size = std::abs(x);
  if (!(size < 0x1p20) || !isArithmeticNearest()) return {{}, false};
  if (size >= tiny) return run<SinCosAt>(x);
  if (x == 0) return {{{{0, 0}, {1, 1}}, 0}, true};
  return {{{shrunk(x), {nextDown(1), 1}}, x > 0 ? 0 : 7}, true};
}

TanAt::Result fastTan(double x) {
  const double size = std::abs(x);
  if (!(size < 0x1p20) || !isArithmeticNearest()) return {{}, false};
  if (size >= tiny) return run<TanAt>(x);
  if (x == 0) return {{{0, 0}, 0}, true};
  return {{grown(x), x > 0 ? 0 : 7}, true};
}

Decided fastExp(double x) {
  const double size = std::abs(x);
  if (!(size <= 709 && x >= -708) || !isArithmeticNearest()) return {{}, false};  // in between the result is normal
  if (size >= 0x1p-54) return run<ExpAt>(x);
  if (x == 0) return {{1, 1}, true};
  return {x > 0 ? Bounds{1, nextUp(1)} : Bounds{nextDown(1), 1}, true};  // |e^x - 1| < 2^-53
}

Decided fastLog(double x) {
  if (!(x > 0 && x < std::numeric_limits<double>::infinity()) || !isArithmeticNearest()) return {{}, false};
  if (x == 1) return {{0, 0}, true};
  return run<LogAt>(x);
}

Decided fastAtan(double x) {
  if (!isArithmeticNearest()) return {{}, false};
  const double size = std::abs(x);
  if (size < tiny) return {x == 0 ? Bounds{0, 0} : shrunk(x), true};
  // From 2^60 on, atan |x| is within 2^-60 of pi / 2, and quarterTurn's.
  const Decided decided = size < 0x1p60 ? run<AtanAt>(size) : Decided{quarterTurn, true};
  return {x < 0 ? negated(decided.bounds) : decided.bounds, decided.known};
}

Decided fastAsin(double x) {
  const double size = std::abs(x);
  if (!isArithmeticNearest()) return {{}, false};
  if (size < tiny) return {x == 0 ? Bounds{0, 0} : grown(x), true};
  const Decided decided = size < 1 ? run<AsinAt>(size) : Decided{quarterTurn, true};
  return {x < 0 ? negated(decided.bounds) : decided.bounds, decided.known};
}

Decided fastAcos(double x) {
  if (!isArithmeticNearest() || x == -1) return {{}, false};
  if (x == 1) return {{0, 0}, true};
  if (std::abs(x) < 0x1p-60) return {quarterTurn, true};  // pi / 2 - x - ...
  return run<AcosAt>(x);
}

}  // namespace

Bounds expBounds(double x) {
  const Decided fast = fastExp(x);
  return fast.known ? fast.bounds : evaluate(mpfr_exp, x);
}
Bounds logBounds(double x) {
  const Decided fast = fastLog(x);
  return fast.known ? fast.bounds : evaluate(mpfr_log, x);
}
Bounds atanBounds(double x) {
  const Decided fast = fastAtan(x);
  return fast.known ? fast.bounds : evaluate(mpfr_atan, x);
}
Bounds asinBounds(double x) {
  const Decided fast = fastAsin(x);
  return fast.known ? fast.bounds : evaluate(mpfr_asin, x);
}
Bounds acosBounds(double x) {
  const Decided fast = fastAcos(x);
  return fast.known ? fast.bounds : evaluate(mpfr_acos, x);
}

SinCosBounds sinCosBounds(double x) {
  const SinCosAt::Result fast = fastSinCos(x);
  return fast.known ? fast.turn.value : evaluateSinCos(x);
}
Bounds tanBounds(double x) {
  const TanAt::Result fast = fastTan(x);
  return fast.known ? fast.turn.value : evaluate(mpfr_tan, x);
}

SinCosTurn sinCosTurn(double x) {
  const SinCosAt::Result fast = fastSinCos(x);
  return fast.known ? fast.turn : SinCosTurn{evaluateSinCos(x), slowQuadrant(x)};
}
TanTurn tanTurn(double x) {
  const TanAt::Result fast = fastTan(x);
  return fast.known ? fast.turn : TanTurn{evaluate(mpfr_tan, x), slowQuadrant(x)};
}

}  // namespace gamut::detail
