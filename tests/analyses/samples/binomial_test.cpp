// Clopper and Pearson's interval against closed forms, and that it holds as often as it says.
#include "analyses/samples/binomial.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace gamut {
namespace {

TEST(ConfidenceOfShare, IsThatOfClosedForms) {
  EXPECT_TRUE(isEqual(confidenceOfShare(0, 0), Interval(0.0, 1.0)));
  const Interval none = confidenceOfShare(0, 10), all = confidenceOfShare(10, 10);
  EXPECT_EQ(none.lower(), 0);
  EXPECT_NEAR(none.upper(), 1 - std::pow(0.025, 0.1), 1e-12);
  EXPECT_EQ(all.upper(), 1);
  EXPECT_NEAR(all.lower(), std::pow(0.025, 0.1), 1e-12);
}

TEST(ConfidenceOfShare, HoldsAsOftenAsItSays) {
  std::mt19937_64 engine(3);
  for (const double probability : {0.003, 0.2, 0.5, 0.97}) {
    std::binomial_distribution<int> draw(200, probability);
    int held = 0;
    for (int i = 0; i < 2000; ++i) held += contains(confidenceOfShare(draw(engine), 200), probability);
    EXPECT_GT(held, 0.94 * 2000) << probability;
  }
}

}  // namespace
}  // namespace gamut
