// Distributions of several outputs at once share work: the widest have it first, and what is nothing has none.
#include "analyses/probability/output_distributions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

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

/// y = exp(x) of a state at rest, by polynomials of degree 1 at first: what they miss is more than is asked for.
TEST(OutputDistributions, AskForTighterPolynomialsWhereTheseKeepThemApart) {
  const Box box = {Interval(0.5, 1.5)};
  const auto enclose = [&](FlowOptions options) {
    options.modelledAt = {0};
    options.split = false;
    options.degree = options.tightness > 1.25 ? 1 : 8;
    Program f = record(1, 0, 1, [](const auto&, const auto& x, const auto&, auto& dx) { dx[0] = 0 * x[0]; });
    Program g = record(1, 0, 1, [](const auto&, const auto& x, const auto&, auto& y) { y[0] = exp(x[0]); });
    return Flow(std::move(f), std::move(g), std::move(options)).enclose(box, 1, {1.0});
  };
  FlowOptions loose;
  loose.tightness = 1.5;
  TightenedModels models(enclose(loose).models(), loose.tightness, 0, enclose);
  ASSERT_TRUE(models);
  const double least = std::exp(0.5), most = std::exp(1.5);
  TightenedSurrogate surrogate(
      models,
      {{0}, 0, 1, [&](std::size_t, std::size_t) { return Interval(least, most); }, [] { return FlowOptions(); }});
  Uncertain x = Sums::quantity("x");
  x.range = box[0];
  x.nominal = 1;
  x.distribution = Distribution::uniform(x.range);
  ModelMasses masses({&x}, {});
  OutputDistributions found({1}, {0}, {0.01, 2, nullptr, [] { return 1e10; }});
  surrogate.take();
  ASSERT_FALSE(surrogate.isNone());
  EXPECT_TRUE(found.isVague(surrogate));
  for (const SurrogatePart& part : *surrogate.partsAt(1)) {  // what is known besides narrows bounds
    EXPECT_GE(part.outputs[0].bound.lower(), least);
    EXPECT_LE(part.outputs[0].bound.upper(), most);
  }
  found.find(surrogate, masses);
  EXPECT_FALSE(found.isVague(surrogate));
  EXPECT_LT(models.excess(), models.firstExcess());
  const DistributionBounds& bounds = found.at(0, 0);
  EXPECT_LE(bounds.gap, 0.01);
  for (std::size_t i = 0; i < bounds.value.size(); ++i) {
    const double truth = std::clamp(std::log(bounds.value[i]) - 0.5, 0.0, 1.0);
    EXPECT_TRUE(bounds.lower[i] <= truth && truth <= bounds.upper[i]) << bounds.value[i];
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
