// The kernels of sin, cos, tan, exp, log, atan, asin and acos: their tables entry by entry, their errors against the
// claims, and the bounds made from them, which must equal MPFR's directed roundings bit for bit.
// GAMUT_ELEMENTARY_CASES=10000000 in the environment judges that many arguments a kernel and prints the worst errors.
#include "scalars/elementary/elementary.hpp"

#include <cfenv>
#include <cstdio>
#include <cstdlib>
#include <vector>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "scalars/elementary/kernels.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::elementary_test {
namespace {

using namespace gamut::testing;
using detail::DoubleDouble, detail::Bounds;

// ---- Tables and constants -------------------------------------------------------------------------------------------

/// hi is the double nearest to value, lo the one nearest to the rest.
void expectNearest(const DoubleDouble& entry, mpfr_ptr value, int index) {
  Mpfr rest(0, 600);
  EXPECT_EQ(entry.hi, mpfr_get_d(value, MPFR_RNDN)) << index;
  mpfr_sub_d(rest, value, entry.hi, MPFR_RNDN);
  EXPECT_EQ(entry.lo, mpfr_get_d(rest, MPFR_RNDN)) << index;
}

/// numerator / denominator * pi.
void setPartOfPi(mpfr_ptr value, long numerator, long denominator) {
  mpfr_const_pi(value, MPFR_RNDN);
  mpfr_mul_si(value, value, numerator, MPFR_RNDN);
  mpfr_div_si(value, value, denominator, MPFR_RNDN);
}

TEST(ElementaryTables, HoldTheSineOfEvery256thOfAHalfTurn) {
  Mpfr value(0, 600);
  for (int j = 0; j < 640; ++j) {
    setPartOfPi(value, j, 256);
    mpfr_sin(value, value, MPFR_RNDN);
    if (j % 256 == 0) mpfr_set_zero(value, 1);  // pi itself was rounded
    expectNearest(detail::sineTable[j], value, j);
  }
}

TEST(ElementaryTables, HoldThePowersOfTheHundredAndTwentyEighthRootOfTwo) {
  Mpfr value(0, 600);
  for (int j = 0; j < 128; ++j) {
    mpfr_set_d(value, j / 128.0, MPFR_RNDN);
    mpfr_exp2(value, value, MPFR_RNDN);
    expectNearest(detail::exponentialTable[j], value, j);
  }
}

TEST(ElementaryTables, HoldTheArctangentOfEvery128th) {
  Mpfr value(0, 600);
  for (int i = 0; i <= 128; ++i) {
    mpfr_set_d(value, i / 128.0, MPFR_RNDN);
    mpfr_atan(value, value, MPFR_RNDN);
    expectNearest(detail::arctangentTable[i], value, i);
  }
}

TEST(ElementaryTables, HoldLogarithmsAndShortInversesThatLeaveAsLittleAsTheBudgetSays) {
  constexpr std::int64_t subinterval = std::int64_t{1} << 45;
  const std::int64_t origin = std::bit_cast<std::int64_t>(1.0) - 75 * subinterval - subinterval / 2;
  Mpfr value(0, 600);
  for (int i = 0; i < 128; ++i) {
    const auto& [inverse, logarithm] = detail::logarithmTable[i];
    EXPECT_EQ(inverse * 4096, std::floor(inverse * 4096)) << i;
    mpfr_set_d(value, inverse, MPFR_RNDN);
    mpfr_log(value, value, MPFR_RNDN);
    mpfr_neg(value, value, MPFR_RNDN);
    expectNearest(logarithm, value, i);
    for (const std::int64_t bits : {origin + i * subinterval, origin + (i + 1) * subinterval - 1}) {
      mpfr_set_d(value, std::bit_cast<double>(bits), MPFR_RNDN);
      mpfr_mul_d(value, value, inverse, MPFR_RNDN);
      mpfr_sub_ui(value, value, 1, MPFR_RNDN);
      EXPECT_LE(std::abs(mpfr_get_d(value, MPFR_RNDA)), std::exp2(-7.988)) << i;
      EXPECT_TRUE(logarithm.hi == 0 || std::abs(logarithm.hi) > std::abs(mpfr_get_d(value, MPFR_RNDA))) << i;
    }
  }
  EXPECT_EQ(detail::logarithmTable[75].inverse, 1);
}

/// Each part but the last is value chopped below the bit named; the rest of all is at most 2^left.
void expectParts(std::initializer_list<double> parts, mpfr_ptr value, std::initializer_list<int> lastBits,
                 double left) {
  auto bit = lastBits.begin();
  for (const double part : parts) {
    if (bit == lastBits.end()) {
      EXPECT_EQ(part, mpfr_get_d(value, MPFR_RNDN));
    } else {
      Mpfr chopped(0, 600);
      mpfr_mul_2si(chopped, value, -*bit, MPFR_RNDN);
      mpfr_floor(chopped, chopped);
      mpfr_mul_2si(chopped, chopped, *bit++, MPFR_RNDN);
      EXPECT_EQ(mpfr_cmp_d(chopped, part), 0);
    }
    mpfr_sub_d(value, value, part, MPFR_RNDN);
  }
  EXPECT_LE(std::abs(mpfr_get_d(value, MPFR_RNDA)), std::exp2(left));
}

TEST(ElementaryTables, HoldPiAndLogTwoInPartsWhoseMultiplesAreExact) {
  Mpfr value(0, 600);
  setPartOfPi(value, 1, 256);
  const auto& p = detail::piOver256;
  expectParts({p[0], p[1], p[2], p[3]}, value, {-32, -58, -84}, -138.8);
  setPartOfPi(value, 1, 2);
  expectParts({detail::halfPi[0], detail::halfPi[1]}, value, {}, -108);
  mpfr_const_log2(value, MPFR_RNDN);
  expectParts({detail::logTwo[0], detail::logTwo[1]}, value, {-42}, -102);
  mpfr_const_log2(value, MPFR_RNDN);
  mpfr_div_ui(value, value, 128, MPFR_RNDN);
  expectParts({detail::logTwoOver128[0], detail::logTwoOver128[1]}, value, {-43}, -100);
}

// ---- Errors of the kernels ------------------------------------------------------------------------------------------

/// 2^exponent (hi + lo); NaN where the kernel says nothing.
struct Approximation {
  DoubleDouble value;
  std::int64_t exponent = 0;
};

double either(double x, RandomDoubles& random) { return random.integer(0, 1) == 0 ? x : -x; }

double logUniform(RandomDoubles& random, int low, int high) {
  return either(std::ldexp(random.uniform(1, 2), random.integer(low, high - 1)), random);
}

/// A few doubles away.
double near(RandomDoubles& random, double x) {
  for (int step = random.integer(-3, 3); step != 0; step += step < 0 ? 1 : -1) x = step < 0 ? nextDown(x) : nextUp(x);
  return x;
}

double angleArgument(RandomDoubles& random) {
  constexpr double step = 0x1.921fb54442d18p-7;  // pi / 256
  const int limit = 1 << random.integer(1, 26);
  const double k = random.integer(-limit, limit);
  switch (random.integer(0, 7)) {
    case 0:
      return random.uniform(-10, 10);
    case 1:
      return logUniform(random, -27, 20);
    case 2:
      return near(random, std::clamp(k + 0.5, -8e7, 8e7) * step);  // as far from the table's points as it gets
    case 3:
      return near(random, std::clamp(k, -8e7, 8e7) * step);
    case 4:
      return near(random, random.integer(-60000, 60000) * 64 * step);  // multiples of pi / 4
    case 5:
      return near(random, (random.integer(-600, 600) * 128 + 0.5 * random.integer(-3, 3)) * step);
    case 6:
      return random.integer(-600, 600) * 128 * step + either(random.uniform(0.4, 0.6), random) * step;  // the worst
    default:
      return random.integer(-60000, 60000) * 128 * step + logUniform(random, -60, -7);
  }
}

double exponentArgument(RandomDoubles& random) {
  constexpr double step = 0x1.62e42fefa39efp-8;  // log 2 / 128
  const int k = random.integer(-130000, 130000);
  switch (random.integer(0, 4)) {
    case 0:
      return random.uniform(-20, 20);
    case 1:
      return random.uniform(-708, 709);
    case 2:
      return near(random, (k + 0.5) * step);
    case 3:
      return near(random, k * step);
    default:
      return logUniform(random, -54, 9);
  }
}

double positiveArgument(RandomDoubles& random) {
  switch (random.integer(0, 4)) {
    case 0:
      return random.uniform(0.01, 100);
    case 1:
      return near(random, 1 + logUniform(random, -50, -5));
    case 2:  // where subintervals meet
      return std::ldexp(near(random, std::bit_cast<double>(std::bit_cast<std::int64_t>(1.0) +
                                                           (2 * std::int64_t{random.integer(-80, 80)} + 1) *
                                                               (std::int64_t{1} << 44))),
                        random.integer(-1, 1) * random.integer(0, 1000));
    case 3:
      return 1 + random.uniform(-0x1p-6, 0x1p-6);
    default:
      return std::max(std::abs(random.any()), smallest);
  }
}

double tangentArgument(RandomDoubles& random) {
  const double boundary = near(random, (random.integer(0, 127) + 0.5) / 128);
  switch (random.integer(0, 4)) {
    case 0:
      return random.uniform(0.001, 10);
    case 1:
      return std::abs(logUniform(random, -27, 60));
    case 2:
      return boundary;
    case 3:
      return 1 / boundary;
    default:
      return random.uniform(0x1p-10, 0x1p-6);
  }
}

double sineArgument(RandomDoubles& random) {
  const double boundary = near(random, std::sin(std::atan((random.integer(0, 127) + 0.5) / 128)));
  switch (random.integer(0, 5)) {
    case 0:
      return random.uniform(0.001, 1);
    case 1:
      return std::abs(logUniform(random, -27, 0));
    case 2:
      return boundary;
    case 3:
      return near(random, std::sqrt(1 - boundary * boundary));
    case 4:
      return 1 - std::abs(logUniform(random, -53, -1));
    default:
      return random.uniform(0x1p-10, 0x1p-6);
  }
}

double cosineArgument(RandomDoubles& random) {
  return either(random.integer(0, 9) == 0 ? logUniform(random, -60, -20) : sineArgument(random), random);
}

template <bool fused>
struct Kernels {
  static detail::SinCosValue sinCos(double x) {
    detail::SinCosValue value;
    if (!detail::sinCosKernel<fused>(x, value)) value = {{std::nan(""), 0}, {std::nan(""), 0}, 0};
    return value;
  }
  static Approximation sin(double x) { return {sinCos(x).sin}; }
  static Approximation cos(double x) { return {sinCos(x).cos}; }
  static Approximation tan(double x) { return {detail::tangentOf<fused>(sinCos(x))}; }
  static Approximation exp(double x) {
    Approximation result;
    result.value = detail::expKernel<fused>(x, result.exponent);
    return result;
  }
  static Approximation log(double x) { return {detail::logKernel<fused>(x)}; }
  static Approximation atan(double x) { return {detail::atanKernel<fused>(x)}; }
  static Approximation asin(double x) { return {detail::asinKernel<fused>(x)}; }
  static Approximation acos(double x) { return {detail::acosKernel<fused>(x)}; }
};

struct Kernel {
  const char* name;
  Approximation (*plain)(double);
  Approximation (*fused)(double);
  OfOne exact;
  Bounds (*bounds)(double);
  double claim;
  double (*argument)(RandomDoubles&);
};

void PrintTo(const Kernel& kernel, std::ostream* stream) { *stream << kernel.name; }

class ElementaryKernels : public ::testing::TestWithParam<Kernel> {};

/// |hi + lo - value| / |value|.
double relativeError(const Approximation& approximation, mpfr_ptr value) {
  static Mpfr difference(0, 200);
  mpfr_mul_2si(difference, value, -approximation.exponent, MPFR_RNDN);
  mpfr_sub_d(difference, difference, approximation.value.hi, MPFR_RNDN);
  mpfr_sub_d(difference, difference, approximation.value.lo, MPFR_RNDN);
  mpfr_div(difference, difference, value, MPFR_RNDN);
  mpfr_mul_2si(difference, difference, approximation.exponent, MPFR_RNDN);
  return std::abs(mpfr_get_d(difference, MPFR_RNDA));
}

/// How many arguments of a kernel are judged.
int numberOfCases() {
  const char* given = std::getenv("GAMUT_ELEMENTARY_CASES");
  return given ? std::atoi(given) : 4 * cases;
}

TEST_P(ElementaryKernels, ErrByNoMoreThanAQuarterOfTheClaim) {
  const auto& [name, plain, fused, exact, bounds, claim, argument] = GetParam();
  RandomDoubles random;
  Mpfr x, value(0, 200);
  double worst[2] = {0, 0}, where[2] = {0, 0};
  int silent = 0, undecided = 0;
  const int number = numberOfCases();
  for (int i = 0; i < number; ++i) {
    const double at = argument(random);
    mpfr_set_d(x, at, MPFR_RNDN);
    exact(value, x, MPFR_RNDN);
    if (mpfr_zero_p(static_cast<mpfr_ptr>(value))) continue;  // log 1
    const Approximation approximations[] = {plain(at), fused(at)};
    if (std::isnan(approximations[0].value.hi)) {
      ++silent;
      continue;
    }
    for (int form = 0; form < 2; ++form) {
      const double error = relativeError(approximations[form], value);
      ASSERT_LE(error, claim / 4) << name << " of " << at;
      if (error > worst[form]) worst[form] = error, where[form] = at;
    }
    const auto [h, l] = detail::exactSumOrdered(approximations[0].value.hi, approximations[0].value.lo);
    undecided += std::abs(l) <= claim * std::abs(h);
  }
  EXPECT_LT(silent, number / 20);  // of arguments chosen to be silent about
  if (std::getenv("GAMUT_ELEMENTARY_CASES")) {
    std::printf("%-5s claim 2^%.2f; worst seen: plain 2^%.2f at %a, fused 2^%.2f at %a; silent %.1e, undecided %.1e\n",
                name, std::log2(claim), std::log2(worst[0]), where[0], std::log2(worst[1]), where[1],
                double(silent) / number, double(undecided) / number);
  }
}

TEST_P(ElementaryKernels, LeaveToMpfrWhatTheyCannotDecide) {
  const Kernel& kernel = GetParam();
  RandomDoubles random;
  int undecided = 0;
  for (int i = 0; i < 100 * cases; ++i) {
    const double x = kernel.argument(random);
    const DoubleDouble value = kernel.plain(x).value;
    const auto [h, l] = detail::exactSumOrdered(value.hi, value.lo);
    if (std::abs(l) > kernel.claim * std::abs(h) || std::abs(h) == 1) continue;
    ++undecided;
    const auto [down, up] = kernel.bounds(x);
    ASSERT_EQ(down, rounded(kernel.exact, x, MPFR_RNDD)) << kernel.name << " of " << x;
    ASSERT_EQ(up, rounded(kernel.exact, x, MPFR_RNDU)) << kernel.name << " of " << x;
  }
  EXPECT_GT(undecided, 50);
}

Bounds sinBounds(double x) { return detail::sinCosBounds(x).sin; }
Bounds cosBounds(double x) { return detail::sinCosBounds(x).cos; }

#define GAMUT_KERNEL(name, boundsOf, claim, argument) \
  Kernel { #name, Kernels < false> ::name, Kernels < true> ::name, mpfr_##name, boundsOf, detail::claim, argument }
INSTANTIATE_TEST_SUITE_P(ElementaryKernels, ElementaryKernels,
                         ::testing::Values(GAMUT_KERNEL(sin, sinBounds, sinCosClaim, angleArgument),
                                           GAMUT_KERNEL(cos, cosBounds, sinCosClaim, angleArgument),
                                           GAMUT_KERNEL(tan, detail::tanBounds, tanClaim, angleArgument),
                                           GAMUT_KERNEL(exp, detail::expBounds, expClaim, exponentArgument),
                                           GAMUT_KERNEL(log, detail::logBounds, logClaim, positiveArgument),
                                           GAMUT_KERNEL(atan, detail::atanBounds, angleClaim, tangentArgument),
                                           GAMUT_KERNEL(asin, detail::asinBounds, angleClaim, sineArgument),
                                           GAMUT_KERNEL(acos, detail::acosBounds, angleClaim, cosineArgument)),
                         [](const auto& kernel) { return kernel.param.name; });
#undef GAMUT_KERNEL

// ---- Bounds at doubles ----------------------------------------------------------------------------------------------

/// A double next to k pi / 2, |k| < 2^bits.
double nearQuarterTurn(RandomDoubles& random, int bits) {
  static Mpfr multiple(0, 1200);
  setPartOfPi(multiple, random.integer(-(1 << 30), 1 << 30) >> (30 - bits), 2);
  return near(random, mpfr_get_d(multiple, MPFR_RNDN));
}

double anyDouble(RandomDoubles& random) { return random.any(); }
double anyPositive(RandomDoubles& random) { return std::abs(random.any()) + smallest; }
double ordinary(RandomDoubles& random) { return random.uniform(-10, 10); }
double tiny(RandomDoubles& random) { return logUniform(random, -1074, -20); }
double huge(RandomDoubles& random) { return logUniform(random, 19, 1023); }
double nearOne(RandomDoubles& random) { return near(random, 1 + logUniform(random, -53, -2)); }
double insideOne(RandomDoubles& random) { return (1 - random.uniform(0, 1) * std::exp2(random.integer(-53, 0))); }

struct BoundsOf {
  const char* name;
  Bounds (*bounds)(double);
  OfOne exact;
  std::vector<double (*)(RandomDoubles&)> arguments;
};

void PrintTo(const BoundsOf& function, std::ostream* stream) { *stream << function.name; }

class ElementaryBounds : public ::testing::TestWithParam<BoundsOf> {};

TEST_P(ElementaryBounds, AreDirectedRoundingsOfTheExactValue) {
  RandomDoubles random;
  for (const auto argument : GetParam().arguments) {
    for (int i = 0; i < cases; ++i) {
      const double x = argument(random);
      const auto [down, up] = GetParam().bounds(x);
      ASSERT_EQ(down, rounded(GetParam().exact, x, MPFR_RNDD)) << GetParam().name << " of " << x;
      ASSERT_EQ(up, rounded(GetParam().exact, x, MPFR_RNDU)) << GetParam().name << " of " << x;
    }
  }
}

/// Bounds in every state of the processor's arithmetic are those in the ordinary one, and the state is left alone.
template <class SetState, class GetState>
void expectSameBounds(const BoundsOf& function, int state, const SetState& set, const GetState& get) {
  RandomDoubles random;
  const auto ordinaryState = get();
  for (const auto argument : function.arguments) {
    for (int i = 0; i < cases / 10; ++i) {
      const double x = argument(random);
      const Bounds expected = function.bounds(x);
      if (std::max(std::abs(x), 0x1p-1022) != std::abs(x) ||
          std::max(std::abs(expected.down), 0x1p-1022) != std::abs(expected.down))
        continue;
      set(state);
      const Bounds bounds = function.bounds(x);
      const auto stateAfterwards = get();
      set(ordinaryState);
      ASSERT_EQ(stateAfterwards, state);
      ASSERT_EQ(bounds.down, expected.down) << function.name << " of " << x << " in state " << state;
      ASSERT_EQ(bounds.up, expected.up) << function.name << " of " << x << " in state " << state;
    }
  }
}

TEST_P(ElementaryBounds, AreTheSameInEveryRoundingMode) {
  for (const int mode : {FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO}) {
    expectSameBounds(
        GetParam(), mode, [](int m) { std::fesetround(m); }, [] { return std::fegetround(); });
    if (HasFatalFailure()) return;
  }
}

#if defined(__SSE2__)
TEST_P(ElementaryBounds, OfNormalNumbersAreTheSameWhereSubnormalOnesAreFlushed) {
  const unsigned ordinaryState = _mm_getcsr() & ~0x3fu;  // without the flags of what has happened
  for (const unsigned flush : {0x8000u, 0x0040u, 0x8040u}) {
    expectSameBounds(
        GetParam(), static_cast<int>(ordinaryState | flush), [](int s) { _mm_setcsr(unsigned(s)); },
        [] { return static_cast<int>(_mm_getcsr() & ~0x3fu); });
    if (HasFatalFailure()) return;
  }
}
#endif

const std::vector<double (*)(RandomDoubles&)> angles = {
    ordinary,
    tiny,
    huge,
    anyDouble,
    angleArgument,
    [](RandomDoubles& random) { return nearQuarterTurn(random, 8); },
    [](RandomDoubles& random) { return nearQuarterTurn(random, 30); },
    [](RandomDoubles& random) { return nearQuarterTurn(random, 30) * std::ldexp(1, random.integer(1, 900)); }};
const std::vector<double (*)(RandomDoubles&)> sines = {
    [](RandomDoubles& random) { return random.uniform(-1, 1); },
    [](RandomDoubles& random) { return either(insideOne(random), random); },
    [](RandomDoubles& random) { return either(sineArgument(random), random); },
    [](RandomDoubles& random) { return logUniform(random, -1074, -20); },
    [](RandomDoubles& random) { return random.integer(-2, 2) / 2.0; }};

INSTANTIATE_TEST_SUITE_P(
    Elementary, ElementaryBounds,
    ::testing::Values(BoundsOf{"sin", sinBounds, mpfr_sin, angles}, BoundsOf{"cos", cosBounds, mpfr_cos, angles},
                      BoundsOf{"tan", detail::tanBounds, mpfr_tan, angles},
                      BoundsOf{"exp",
                               detail::expBounds,
                               mpfr_exp,
                               {ordinary, tiny, anyDouble, exponentArgument,
                                [](RandomDoubles& random) { return random.uniform(700, 712); },
                                [](RandomDoubles& random) { return random.uniform(-750, -700); }}},
                      BoundsOf{"log",
                               detail::logBounds,
                               mpfr_log,
                               {anyPositive, nearOne, positiveArgument,
                                [](RandomDoubles& random) { return std::abs(tiny(random)); },
                                [](RandomDoubles& random) { return std::abs(huge(random)); },
                                [](RandomDoubles& random) { return double(random.integer(1, 1000)); }}},
                      BoundsOf{"atan",
                               detail::atanBounds,
                               mpfr_atan,
                               {ordinary, tiny, huge, anyDouble, nearOne,
                                [](RandomDoubles& random) { return either(tangentArgument(random), random); }}},
                      BoundsOf{"asin", detail::asinBounds, mpfr_asin, sines},
                      BoundsOf{"acos", detail::acosBounds, mpfr_acos, sines}),
    [](const auto& function) { return function.param.name; });

// ---- sin, cos and tan between doubles -------------------------------------------------------------------------------

/// Multiples of pi / 2 in (lower, upper], counted with 1400 bits.
class MultiplesOfQuarterTurn {
 public:
  explicit MultiplesOfQuarterTurn(const Interval& x) {
    setFloor(first_, x.lower());
    setFloor(last_, x.upper());
  }
  /// Whether one is residue * pi / 2 modulo 2 pi.
  bool have(unsigned long residue) {
    Mpfr m(0, 1200), remainder(0, 1200), four(4);
    for (unsigned long step = 1; step <= 4; ++step) {
      mpfr_add_ui(m, first_, step, MPFR_RNDN);
      if (mpfr_cmp(m, last_) > 0) return false;
      mpfr_sub_ui(m, m, residue, MPFR_RNDN);
      mpfr_fmod(remainder, m, four, MPFR_RNDN);
      if (mpfr_zero_p(static_cast<mpfr_ptr>(remainder))) return true;
    }
    return false;
  }

 private:
  static void setFloor(Mpfr& floor, double x) {
    Mpfr turns(0, 1400), halfPi(0, 1400);
    setPartOfPi(halfPi, 1, 2);
    mpfr_d_div(turns, x, halfPi, MPFR_RNDN);
    mpfr_floor(floor, turns);
  }
  Mpfr first_{0, 1200}, last_{0, 1200};
};

/// The range of sin or cos over x by MPFR; maximum and minimum are the quarters where they lie.
Interval waveRange(OfOne wave, const Interval& x, unsigned long maximum, unsigned long minimum) {
  MultiplesOfQuarterTurn multiples(x);
  const double lower = std::min(rounded(wave, x.lower(), MPFR_RNDD), rounded(wave, x.upper(), MPFR_RNDD));
  const double upper = std::max(rounded(wave, x.lower(), MPFR_RNDU), rounded(wave, x.upper(), MPFR_RNDU));
  return {multiples.have(minimum) ? -1 : lower, multiples.have(maximum) ? 1 : upper};
}

Interval tanRange(const Interval& x) {
  MultiplesOfQuarterTurn multiples(x);
  if (multiples.have(1) || multiples.have(3)) return Interval::entire();
  return {rounded(mpfr_tan, x.lower(), MPFR_RNDD), rounded(mpfr_tan, x.upper(), MPFR_RNDU)};
}

Interval between(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

Interval anyAngles(RandomDoubles& random) {
  switch (random.integer(0, 5)) {
    case 0:
      return random.intervalIn(-10, 10);
    case 1:
      return between(nearQuarterTurn(random, 3), nearQuarterTurn(random, 3));
    case 2: {
      const double x = nearQuarterTurn(random, 30);
      return between(x, near(random, x + random.integer(-1, 1) * random.uniform(0, 8)));
    }
    case 3: {
      const double x = huge(random);
      return between(x, near(random, x));
    }
    case 4: {
      const double x = logUniform(random, 17, 50);
      return between(x, x + random.uniform(-12, 12));
    }
    default:
      return between(tiny(random), random.integer(0, 1) == 0 ? tiny(random) : random.uniform(-7, 7));
  }
}

TEST(ElementaryRanges, OfSineAndCosineAndTangentEqualThoseFoundByMpfr) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const Interval x = anyAngles(random);
    const auto [sine, cosine] = sinCos(x);
    const Interval exactSine = waveRange(mpfr_sin, x, 1, 3), exactCosine = waveRange(mpfr_cos, x, 0, 2);
    ASSERT_THAT(sine, IsInterval(exactSine.lower(), exactSine.upper())) << x;
    ASSERT_THAT(cosine, IsInterval(exactCosine.lower(), exactCosine.upper())) << x;
    ASSERT_TRUE(isEqual(sin(x), sine) && isEqual(cos(x), cosine)) << x;
    const Interval exactTangent = tanRange(x);
    ASSERT_THAT(tan(x), IsInterval(exactTangent.lower(), exactTangent.upper())) << x;
  }
}

TEST(ElementaryRanges, AreTheSameInEveryRoundingMode) {
  for (const int mode : {FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO}) {
    RandomDoubles random;
    for (int i = 0; i < cases / 4; ++i) {
      const Interval x = anyAngles(random), y = random.intervalIn(-2, 2);
      const Interval expected[] = {sin(x), cos(x), tan(x), exp(y), log(y), atan(y), asin(y), acos(y)};
      std::fesetround(mode);
      const Interval actual[] = {sin(x), cos(x), tan(x), exp(y), log(y), atan(y), asin(y), acos(y)};
      std::fesetround(FE_TONEAREST);
      for (int f = 0; f < 8; ++f) ASSERT_TRUE(isEqual(actual[f], expected[f])) << f << " of " << x << " or " << y;
    }
  }
}

TEST(ElementaryRanges, OfInverseSineAndCosineAreThoseOfTheDomain) {
  EXPECT_THAT(asin(Interval(-2, 2)), IsInterval(-halfPi().upper(), halfPi().upper()));
  EXPECT_THAT(acos(Interval(-2, 2)), IsInterval(0, pi().upper()));
  EXPECT_THAT(asin(Interval(2, 3)), IsEmptyInterval());
  EXPECT_THAT(acos(Interval::empty()), IsEmptyInterval());
  EXPECT_THAT(sinCos(Interval::empty()).cos, IsEmptyInterval());
}

}  // namespace
}  // namespace gamut::elementary_test
