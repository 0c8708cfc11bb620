// Vector sine and cosine: judged by MPFR at every kind of argument, and the same bits on every vector unit.
#include "scalars/elementary/vector_functions.hpp"

#include <stdexcept>
#include <vector>

#include "tests/scalars/reference.hpp"

namespace gamut::testing::vector_functions_test {
namespace {

/// |value - f(x)| in units of the last place of the double nearest to f(x).
double errorInUlp(OfOne f, double x, double value) {
  Mpfr argument(x), truth(0, 120);
  f(truth, argument, MPFR_RNDN);
  const double nearest = mpfr_get_d(truth, MPFR_RNDN);
  mpfr_sub_d(truth, truth, value, MPFR_RNDN);
  int exponent = 0;
  std::frexp(nearest, &exponent);
  return std::fabs(mpfr_get_d(truth, MPFR_RNDN)) / std::ldexp(1.0, std::max(exponent - 53, -1074));
}

std::vector<double> argumentsOfEveryKind() {
  RandomDoubles random;
  std::vector<double> x{0.0, -0.0, smallest, -smallest, largest, -largest, 0x1p20, -0x1p20};
  x.push_back(std::nextafter(0x1p20, infinity));
  for (double range : {0.8, 4.0, 100.0, 1e4, 0x1p20, 1e7, 1e15, 1e300})
    for (int i = 0; i < cases; ++i) x.push_back(random.uniform(-range, range));
  for (int i = 0; i < cases; ++i) x.push_back(random.any());
  // Neighbours of k pi/2: small k, which mechanisms meet, and k up to the end of the fast reduction and beyond.
  for (int i = 0; i < cases / 2; ++i) {
    const double k = i < 1000 ? i : std::ldexp(random.uniform(1, 2), random.integer(1, 24));
    double near = std::round(k) * midpoint(halfPi());
    for (int step = random.integer(0, 3); step > 0; --step) near = std::nextafter(near, infinity);
    x.push_back(near);
    x.push_back(-near);
  }
  return x;
}

TEST(VectorFunctions, SineAndCosineAreWithinTwoUlpOfTheTruth) {
  const std::vector<double> x = argumentsOfEveryKind();
  ASSERT_GE(x.size(), 100000u);
  std::vector<double> s(x.size()), c(x.size());
  sineCosine(x, s, c);
  double worstSine = 0, worstCosine = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    worstSine = std::max(worstSine, errorInUlp(mpfr_sin, x[i], s[i]));
    worstCosine = std::max(worstCosine, errorInUlp(mpfr_cos, x[i], c[i]));
    ASSERT_LE(worstSine, 1.25) << "sine of " << x[i];
    ASSERT_LE(worstCosine, 1.25) << "cosine of " << x[i];
  }
  RecordProperty("worst sine, ulp", std::to_string(worstSine));
  RecordProperty("worst cosine, ulp", std::to_string(worstCosine));
}

TEST(VectorFunctions, GiveTheSameBitsOnEveryUnitAndForOneDouble) {
  const std::vector<double> x = argumentsOfEveryKind();
  std::vector<double> s(x.size()), c(x.size());
  for (VectorUnit unit : usableUnits()) {
    sineCosine(unit, x, s, c);
    for (std::size_t i = 0; i < x.size(); ++i) {
      const SineCosine both = sineCosine(x[i]);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(s[i]), std::bit_cast<std::uint64_t>(both.sine)) << nameOf(unit) << x[i];
      ASSERT_EQ(std::bit_cast<std::uint64_t>(c[i]), std::bit_cast<std::uint64_t>(both.cosine)) << nameOf(unit) << x[i];
    }
  }
}

TEST(VectorFunctions, KeepTheSymmetriesExactly) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const double x = random.any();
    const SineCosine plus = sineCosine(x), minus = sineCosine(-x);
    ASSERT_EQ(plus.sine, -minus.sine);
    ASSERT_EQ(plus.cosine, minus.cosine);
  }
  EXPECT_TRUE(std::signbit(sineCosine(-0.0).sine));
  EXPECT_FALSE(std::signbit(sineCosine(0.0).sine));
  EXPECT_EQ(sineCosine(0.0).cosine, 1);
}

TEST(VectorFunctions, OfAnInfinityOrANanAreNan) {
  const std::vector<double> x{infinity, -infinity, std::nan("")};
  std::vector<double> s(3), c(3);
  sine(x, s);
  cosine(x, c);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(std::isnan(s[i]) && std::isnan(c[i])) << x[i];
}

TEST(VectorFunctions, AcceptArraysOfAnyLengthAndMayOverwriteThem) {
  for (std::size_t n : {0u, 1u, 7u, 8u, 9u, 255u, 256u, 700u}) {
    std::vector<double> x(n), s, c;
    for (std::size_t i = 0; i < n; ++i) x[i] = 0.01 * static_cast<double>(i);
    s = c = x;
    sine(s, s);
    cosine(c, c);
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_EQ(s[i], sineCosine(x[i]).sine);
      ASSERT_EQ(c[i], sineCosine(x[i]).cosine);
    }
  }
  std::vector<double> three(3), two(2);
  EXPECT_THROW(sine(three, two), std::invalid_argument);
}

}  // namespace
}  // namespace gamut::testing::vector_functions_test
