// Laws of Samples: every operation is the double's operation, sample by sample.
#include "scalars/samples.hpp"

#include <functional>
#include <sstream>
#include <stdexcept>

#include "scalars/elementary/vector_functions.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::samples_test {
namespace {

using namespace gamut::testing;
using ::testing::ElementsAre;

Samples randomPack(RandomDoubles& random, std::size_t size, double lower, double upper) {
  std::vector<double> values(size);
  for (double& value : values) value = random.uniform(lower, upper);
  return Samples(std::move(values));
}

TEST(Samples, ArithmeticIsSampleBySample) {
  RandomDoubles random;
  const Samples x = randomPack(random, cases, -5, 5), y = randomPack(random, cases, 1, 5);
  const Samples sum = x + y, difference = x - y, product = x * y, quotient = x / y, negative = -x;
  ASSERT_EQ(sum.size(), x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    ASSERT_EQ(sum[i], x[i] + y[i]);
    ASSERT_EQ(difference[i], x[i] - y[i]);
    ASSERT_EQ(product[i], x[i] * y[i]);
    ASSERT_EQ(quotient[i], x[i] / y[i]);
    ASSERT_EQ(negative[i], -x[i]);
  }
}

TEST(Samples, FunctionsAreSampleBySample) {
  const std::pair<std::function<Samples(Samples)>, std::function<double(double)>> functions[] = {
      {[](Samples x) { return sqr(x); }, [](double v) { return v * v; }},
      {[](Samples x) { return sqrt(x); }, [](double v) { return std::sqrt(v); }},
      {[](Samples x) { return abs(x); }, [](double v) { return std::abs(v); }},
      {[](Samples x) { return exp(x); }, [](double v) { return std::exp(v); }},
      {[](Samples x) { return log(x); }, [](double v) { return std::log(v); }},
      {[](Samples x) { return sin(x); }, [](double v) { return sineCosine(v).sine; }},
      {[](Samples x) { return cos(x); }, [](double v) { return sineCosine(v).cosine; }},
      {[](Samples x) { return tan(x); }, [](double v) { return std::tan(v); }},
      {[](Samples x) { return asin(x); }, [](double v) { return std::asin(v); }},
      {[](Samples x) { return acos(x); }, [](double v) { return std::acos(v); }},
      {[](Samples x) { return atan(x); }, [](double v) { return std::atan(v); }},
      {[](Samples x) { return sinh(x); }, [](double v) { return std::sinh(v); }},
      {[](Samples x) { return cosh(x); }, [](double v) { return std::cosh(v); }},
      {[](Samples x) { return tanh(x); }, [](double v) { return std::tanh(v); }},
      {[](Samples x) { return cbrt(x); }, [](double v) { return std::cbrt(v); }},
      {[](Samples x) { return exp2(x); }, [](double v) { return std::exp2(v); }},
      {[](Samples x) { return expm1(x); }, [](double v) { return std::expm1(v); }},
      {[](Samples x) { return log2(x); }, [](double v) { return std::log2(v); }},
      {[](Samples x) { return log10(x); }, [](double v) { return std::log10(v); }},
      {[](Samples x) { return log1p(x); }, [](double v) { return std::log1p(v); }},
      {[](Samples x) { return asinh(x); }, [](double v) { return std::asinh(v); }},
      {[](Samples x) { return atanh(x); }, [](double v) { return std::atanh(v); }},
      {[](Samples x) { return floor(x); }, [](double v) { return std::floor(v); }},
      {[](Samples x) { return ceil(x); }, [](double v) { return std::ceil(v); }},
      {[](Samples x) { return exp10(x); }, [](double v) { return std::pow(10.0, v); }},
      {[](Samples x) { return acosh(1 + x); }, [](double v) { return std::acosh(1 + v); }},
      {[](Samples x) { return atan2(x, 2 - x); }, [](double v) { return std::atan2(v, 2 - v); }},
      {[](Samples x) { return hypot(x, 3 * x); }, [](double v) { return std::hypot(v, 3 * v); }},
      {[](Samples x) { return sign(x - 0.25); }, [](double v) { return v > 0.25   ? 1.0
                                                                       : v < 0.25 ? -1.0
                                                                                  : 0.0; }},
      {[](Samples x) { return pow(x, 3); }, [](double v) { return std::pow(v, 3); }},
      {[](Samples x) { return pow(x, 0.7); }, [](double v) { return std::pow(v, 0.7); }},
      {[](Samples x) { return pow(x, x); }, [](double v) { return std::pow(v, v); }},
      {[](Samples x) { return min(x, 0.5); }, [](double v) { return std::min(v, 0.5); }},
      {[](Samples x) { return max(x, 0.5); }, [](double v) { return std::max(v, 0.5); }}};
  RandomDoubles random;
  const Samples x = randomPack(random, 1000, 0.01, 1);
  for (const auto& [ofSamples, ofDouble] : functions) {
    const Samples result = ofSamples(x);
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_EQ(result[i], ofDouble(x[i])) << x[i];
    ASSERT_EQ(ofSamples(0.25)[0], ofDouble(0.25));
  }
}

TEST(Samples, HaveTheSinesAndCosinesThatDoublesHaveWhateverTheirNumber) {
  RandomDoubles random;
  for (std::size_t size : {1u, 2u, 31u, 33u, 1000u}) {
    const Samples x = randomPack(random, size, -100, 100), s = sin(x), c = cos(x);
    for (std::size_t i = 0; i < size; ++i) {
      ASSERT_EQ(s[i], sineCosine(x[i]).sine);
      ASSERT_EQ(c[i], sineCosine(x[i]).cosine);
      ASSERT_NEAR(s[i], std::sin(x[i]), 3e-16);
    }
  }
}

TEST(Samples, AConstantCombinesWithPacksOfAnySize) {
  const Samples x({1, 2, 4});
  EXPECT_THAT((2 * x).values(), ElementsAre(2, 4, 8));
  EXPECT_THAT((x - 1).values(), ElementsAre(0, 1, 3));
  EXPECT_THAT((8 / x).values(), ElementsAre(8, 4, 2));
  EXPECT_THAT((Samples(3) * 2).values(), ElementsAre(6));
  EXPECT_TRUE((Samples(3) + 1).isConstant());
  Samples grows = 1;
  grows += x;
  EXPECT_THAT(grows.values(), ElementsAre(2, 3, 5));
  EXPECT_THAT((Samples(std::vector<double>{5}) + x).values(), ElementsAre(6, 7, 9));
}

TEST(Samples, CombineWithThemselves) {
  Samples x({1, 2, 4});
  x += x;
  EXPECT_THAT(x.values(), ElementsAre(2, 4, 8));
  x /= x;
  EXPECT_THAT(x.values(), ElementsAre(1, 1, 1));
}

TEST(Samples, OfDifferentSizesDoNotCombine) {
  EXPECT_THROW(Samples({1, 2}) + Samples({1, 2, 3}), std::invalid_argument);
  EXPECT_THROW(pow(Samples({1, 2}), Samples({1, 2, 3})), std::invalid_argument);
  EXPECT_THROW(Samples(std::vector<double>{}), std::invalid_argument);
}

TEST(Samples, KnowTheirRangeAndMean) {
  const Samples x({3, -1, 4});
  EXPECT_EQ(x.minimum(), -1);
  EXPECT_EQ(x.maximum(), 4);
  EXPECT_EQ(x.mean(), 2);
  EXPECT_EQ(Samples(7).mean(), 7);
}

TEST(Samples, AnEnclosedConstantIsItsMidpoint) {
  EXPECT_EQ(constant<Samples>(pi())[0], midpoint(pi()));
  EXPECT_TRUE(constant<Samples>(pi()).isConstant());
}

TEST(Samples, LieInTheIntervalEvaluationOfTheSameExpression) {
  RandomDoubles random;
  const Interval x(0.5, 1.5), y(-2, -1);
  const auto expression = [](const auto& a, const auto& b) { return (a + 2 * b) * (a - b) / (3 - b) - a * 0.5; };
  const Samples result = expression(randomPack(random, cases, 0.5, 1.5), randomPack(random, cases, -2, -1));
  const Interval enclosure = expression(x, y);
  EXPECT_TRUE(contains(enclosure, result.minimum()) && contains(enclosure, result.maximum()));
}

TEST(Samples, PrintTheirValues) {
  std::ostringstream text;
  text << Samples({1, 2.5}) << Samples(3);
  EXPECT_EQ(text.str(), "{1, 2.5}3");
}

}  // namespace
}  // namespace gamut::samples_test
