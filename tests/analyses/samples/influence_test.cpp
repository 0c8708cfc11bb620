// Measures of influence of functions whose gains are known.
#include "analyses/samples/influence.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace gamut {
namespace {

/// Of y = f(values) at one time, from cuts [c - s, c + s], s falling from r at level 0 to r times the core at level 1.
template <class F>
std::vector<double> sharesOf(const std::vector<double>& centre, const std::vector<double>& radius, const F& f,
                             const std::vector<double>& core = {}) {
  const std::vector<double> alpha{0.25, 0.5, 1};
  std::vector<Box> boxes(alpha.size());
  for (std::size_t level = 0; level < alpha.size(); ++level)
    for (std::size_t q = 0; q < centre.size(); ++q) {
      const double least = core.empty() ? 0 : core[q], reach = (least + (1 - alpha[level]) * (1 - least)) * radius[q];
      boxes[level].push_back(Interval(centre[q] - reach, centre[q] + reach));
    }
  Sampling sampling(Plan::random, centre.size(), 4, 1, boxes);
  std::vector<Uncertain> uncertain;
  for (std::size_t q = 0; q < centre.size(); ++q) {
    const Interval range(centre[q] - radius[q], centre[q] + radius[q]);
    uncertain.push_back({"q", range, centre[q], Distribution::uniform(range), {}});
  }
  InfluenceMeasures measures(sampling, alpha, {1}, 1);
  SampleBlock block(0, sampling.size(), false, centre.size(), 2, 1);
  for (std::size_t i = 0; i < block.size(); ++i) {
    const std::vector<double> values = sampling.values(i, uncertain);
    std::ranges::copy(values, block.values(i).begin());
    block(i, 1, 0) = f(values);
  }
  measures.include(block);
  return measures.shares(0, 0);
}

TEST(Influence, OfASumIsItsGainTimesTheValue) {
  const auto shares = sharesOf({2, 5, 1}, {0.1, 1, 0.5}, [](const auto& v) { return 3 * v[0] - v[1] + 0 * v[2]; });
  EXPECT_NEAR(shares[0], 6.0 / 11, 1e-12);
  EXPECT_NEAR(shares[1], 5.0 / 11, 1e-12);
  EXPECT_NEAR(shares[2], 0, 1e-12);
}

TEST(Influence, OfAProductIsTheGainAtTheMiddle) {
  const auto shares = sharesOf({2, 5}, {0.5, 2}, [](const auto& v) { return v[0] * v[1]; });
  EXPECT_NEAR(shares[0], 0.5, 1e-12);  // 5 * 2 against 2 * 5
}

TEST(Influence, OfAQuantityWithACoreIsThatOfOneWithAnApex) {  // which has no width at the highest level
  const auto shares = sharesOf({2, 5}, {0.5, 2}, [](const auto& v) { return v[0] * v[1]; }, {0, 0.5});
  EXPECT_NEAR(shares[0], 0.5, 1e-12);
}

TEST(Influence, OfWhatIsZeroIsNone) {
  const auto shares = sharesOf({0, 3}, {0.5, 0.1}, [](const auto& v) { return 100 * v[0] + v[1]; });
  EXPECT_NEAR(shares[0], 0, 1e-12);
  EXPECT_NEAR(shares[1], 1, 1e-12);
  for (const double share : sharesOf({1, 3}, {0.5, 0.1}, [](const auto&) { return 0.0; }))
    EXPECT_TRUE(std::isnan(share));
}

TEST(Influence, OfTwelveQuantitiesComesFromAnOrthogonalArray) {
  const std::vector<double> centre(12, 1), radius(12, 0.25);
  const auto shares = sharesOf(centre, radius, [](const auto& v) {
    double sum = 0;
    for (std::size_t q = 0; q < v.size(); ++q) sum += static_cast<double>(q) * v[q];
    return sum;
  });
  for (std::size_t q = 0; q < 12; ++q) EXPECT_NEAR(shares[q], static_cast<double>(q) / 66, 1e-12) << q;
}

}  // namespace
}  // namespace gamut
