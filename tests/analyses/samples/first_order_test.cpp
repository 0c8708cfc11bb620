// Linear functions that are found again, and how probable it is that they are above zero.
#include "analyses/samples/first_order.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "analyses/samples/ensemble.hpp"
#include "tests/analyses/motions.hpp"

namespace gamut::testing_motions {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

const std::vector<Uncertain> two{uniformly("a", 1, 2, 3), uniformly("b", -1, 0, 3)};

TEST(FirstOrder, FindsLinearFunctionsAgain) {
  FirstOrder fit(two);
  // a - 2 is its deviation in half widths, b/2 the other's.
  for (const double a : {1.0, 2.0, 2.5})
    for (const double b : {-1.0, 0.5, 3.0}) fit.include(std::vector{a, b}, 7 + 3 * (a - 2) - 5 * b / 2);
  fit.include(std::vector{1.0, 1.0}, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(fit.count(), 9U);
  EXPECT_THAT(fit.coefficients(), ElementsAre(DoubleNear(7, 1e-12), DoubleNear(3, 1e-12), DoubleNear(-5, 1e-12)));
}

TEST(FirstOrder, IsNotKnownOfFewSamplesNorAlongALine) {
  FirstOrder few(two), line(two);
  for (int i = 0; i < 5; ++i) few.include(std::vector{1.0 + 0.1 * i * i, 0.2 * i}, i);
  EXPECT_THAT(few.coefficients(), IsEmpty());
  for (int i = 0; i < 50; ++i) line.include(std::vector{1 + 0.01 * i, 0.02 * i}, i);
  EXPECT_THAT(line.coefficients(), IsEmpty());
}

TEST(FirstOrder, HasTheSharesOfItsDistribution) {
  // ξ, uniform on [-1, 1], above -0.5: 3/4 of it; where it is a constant, all or nothing; never of what is not known.
  const std::vector<Uncertain> one{uniformly("a", 1, 2, 3)};
  const std::vector<double> shares =
      sharesAboveZero({{0.5, 1}, {1, 0}, {0, 0}, {0, 0}, {}}, {0, 0, 1, 0, 0}, one, {}, 1);
  ASSERT_EQ(shares.size(), 5U);
  EXPECT_NEAR(shares[0], 0.75, 1e-3);
  EXPECT_EQ(shares[1], 1);
  EXPECT_NEAR(shares[2], 1, 1e-9);
  EXPECT_EQ(shares[3], 0);
  EXPECT_TRUE(std::isnan(shares[4]));
}

TEST(IndependentSamples, AreThoseOfTheirSeedWhateverTheThreads) {
  const UncertainMotion system = oscillator();
  EnsembleOptions options;
  options.samples = 100;
  const auto valuesOf = [&] {
    std::vector<double> values, last;
    integrateIndependent(system, options, [&](const SampleBlock& block) {
      EXPECT_EQ(block.first(), values.size() / 2);
      EXPECT_TRUE(block.hasWeight());
      for (std::size_t i = 0; i < block.size(); ++i) {
        values.insert(values.end(), block.values(i).begin(), block.values(i).end());
        const double t = system.motion.times.back();
        last.push_back(block(i, system.motion.times.size() - 1, 0));
        EXPECT_NEAR(last.back(), block.values(i)[1] * std::cos(block.values(i)[0] * t), 1e-4);
      }
    });
    values.insert(values.end(), last.begin(), last.end());
    return values;
  };
  const std::vector<double> one = valuesOf();
  EXPECT_EQ(one.size(), 300U);
  options.jobs = 3;
  EXPECT_EQ(valuesOf(), one);
  options.seed = 2;
  EXPECT_NE(valuesOf(), one);
}

}  // namespace
}  // namespace gamut::testing_motions
