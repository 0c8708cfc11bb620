// Distributions of several outputs at once share work: the widest have it first, and what is nothing has none.
#include "analyses/probability/output_distributions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "analyses/work.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

const std::atomic<bool> goesOn{false};

/// Of p, q in [0, 1], uniform: p, p + q and p - p, at one time.
struct Sums {
  std::vector<Uncertain> uncertain = {quantity("p"), quantity("q")};
  Box box = {Interval(0.0, 1.0), Interval(0.0, 1.0)};
  TightenedModels models{modelImage(record(0, 2, 3,
                                           [](const auto&, const auto&, const auto& p, auto& y) {
                                             y[0] = p[0];
                                             y[1] = p[0] + p[1];
                                             y[2] = 0 * p[1];
                                           }),
                                    0.0, box, {0, 1, 2}),
                         1.2, 0};
  TightenedSurrogate surrogate{
      models, {{0, 1}, 0, 3, [](std::size_t, std::size_t) { return Interval::entire(); }, {}, &goesOn}};
  ModelMasses masses{{&uncertain[0], &uncertain[1]}, {}};

  static Uncertain quantity(const std::string& name) {
    Uncertain uncertain;
    uncertain.name = name;
    uncertain.range = Interval(0.0, 1.0);
    uncertain.nominal = 0.5;
    uncertain.distribution = Distribution::uniform(uncertain.range);
    return uncertain;
  }

  OutputDistributions within(double work, double gap) {
    const std::uint64_t began = Work::counted();
    OutputDistributions found({0}, {0, 0, 1},
                              {gap, 2, &goesOn, [=] { return work - static_cast<double>(Work::counted() - began); }});
    surrogate.take();
    found.find(surrogate, masses);
    return found;
  }
};

TEST(OutputDistributions, HoldClosedFormsAsCloselyAsIsAskedFor) {
  for (const double gap : {0.1, 0.01}) {
    const OutputDistributions found = Sums().within(1e10, gap);
    const DistributionBounds &one = found.at(0, 0), &sum = found.at(0, 1);
    ASSERT_GE(one.value.size(), 2U);
    ASSERT_GE(sum.value.size(), 2U);
    EXPECT_LE(std::max(one.gap, sum.gap), gap);
    EXPECT_FALSE(found.isLimited());
    for (std::size_t i = 0; i < one.value.size(); ++i) {
      const double truth = std::clamp(one.value[i], 0.0, 1.0);
      EXPECT_TRUE(one.lower[i] <= truth && truth <= one.upper[i]) << one.value[i];
    }
    for (std::size_t i = 0; i < sum.value.size(); ++i) {
      const double v = std::clamp(sum.value[i], 0.0, 2.0);
      const double truth = v <= 1 ? 0.5 * v * v : 1 - 0.5 * (2 - v) * (2 - v);
      EXPECT_TRUE(sum.lower[i] <= truth && truth <= sum.upper[i]) << sum.value[i];
    }
  }
}

TEST(OutputDistributions, WithoutWorkSayNothing) {
  const OutputDistributions found = Sums().within(0, 0.01);
  for (std::size_t output = 0; output < 3; ++output) {
    EXPECT_TRUE(found.at(0, output).value.empty());
    EXPECT_EQ(found.at(0, output).gap, 1);
  }
}

TEST(OutputDistributions, AreOfNothingWithoutModels) {
  Sums sums;
  sums.models.reset();
  const OutputDistributions found = sums.within(1e10, 0.01);
  EXPECT_TRUE(sums.surrogate.isNone());
  EXPECT_TRUE(found.isVague(sums.surrogate));
  EXPECT_EQ(found.at(0, 0).gap, 1);
}

}  // namespace
}  // namespace gamut
