// Elementary functions of double-doubles against MPFR with 400 bits.
#include "scalars/elementary/fine_functions.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <cmath>
#include <limits>
#include <random>

#include "scalars/elementary/mpfr_bounds.hpp"

namespace gamut::testing::fine_functions_test {
namespace {

using detail::DoubleDouble;
using detail::FineValue;

/// |f(x) - value| / error; f(x) and x = hi + lo with 400 bits, both sums exact there.
double shareOfError(int (*f)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t), const DoubleDouble& x, const FineValue& found) {
  detail::Number<400> argument, value;
  mpfr_set_d(argument, x.hi, MPFR_RNDN);
  mpfr_add_d(argument, argument, x.lo, MPFR_RNDN);
  f(value, argument, MPFR_RNDN);
  mpfr_sub_d(value, value, found.value.hi, MPFR_RNDN);
  mpfr_sub_d(value, value, found.value.lo, MPFR_RNDN);
  mpfr_abs(value, value, MPFR_RNDN);
  mpfr_div_d(value, value, found.error, MPFR_RNDU);
  return mpfr_get_d(value, MPFR_RNDU);
}

TEST(FineFunctions, AreWithinTheirErrorsAndTheseAreSmall) {
  std::mt19937_64 engine(5);
  double greatest = 0;
  for (int i = 0; i < 4000; ++i) {
    const double size = std::ldexp(1.0, static_cast<int>(engine() % 12) - 3);
    const double hi = std::uniform_real_distribution<>(-size, size)(engine);
    const DoubleDouble x{hi, hi * std::uniform_real_distribution<>(-0x1p-53, 0x1p-53)(engine)};
    const DoubleDouble positive = hi < 0 ? -x : x;
    const detail::FineSinCos turn = fineSinCos(x);
    const FineValue values[] = {turn.sin, turn.cos, fineAtan(x), fineLog(positive), fineExp(x)};
    const double shares[] = {shareOfError(mpfr_sin, x, values[0]), shareOfError(mpfr_cos, x, values[1]),
                             shareOfError(mpfr_atan, x, values[2]), shareOfError(mpfr_log, positive, values[3]),
                             shareOfError(mpfr_exp, x, values[4])};
    for (std::size_t f = 0; f < 5; ++f) {
      ASSERT_LE(shares[f], 1) << "function " << f << " of " << hi;
      ASSERT_LE(values[f].error, 0x1p-104 * std::fabs(values[f].value.hi) + 0x1p-140);
      greatest = std::max(greatest, shares[f]);
    }
  }
  EXPECT_GT(greatest, 0.2) << "the errors are those of two doubles";
}

TEST(FineFunctions, SayWhatIsNotDefinedOrTooLarge) {
  EXPECT_TRUE(std::isnan(detail::fineLog({-1, 0}).value.hi));
  EXPECT_FALSE(std::isfinite(detail::fineLog({0, 0}).value.hi));
  EXPECT_FALSE(std::isfinite(detail::fineExp({1000, 0}).value.hi));
  EXPECT_TRUE(std::isnan(detail::fineSinCos({std::numeric_limits<double>::infinity(), 0}).sin.value.hi));
}

}  // namespace
}  // namespace gamut::testing::fine_functions_test
