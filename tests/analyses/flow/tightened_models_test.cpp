// Models take the place of others only where they reach as far, and cost no more than they may.
#include "analyses/flow/tightened_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "analyses/work.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

constexpr double horizon = 3;
const Box pendulumBox = {Interval(0.75, 1.25), Interval(-0.2, 0.2), Interval(9.5)};

Tube pendulumUntil(double end, FlowOptions options) {
  Program f = record(2, 1, 2, [](const auto&, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * sin(x[0]);
  });
  Program g = record(2, 1, 1, [](const auto&, const auto& x, const auto&, auto& y) { y[0] = cos(x[0]); });
  options.modelled = {0};
  options.split = false;
  options.degree = options.tightness > 1.25 ? 2 : 6;  // whatever it takes to be tighter
  return Flow(std::move(f), std::move(g), std::move(options)).enclose(pendulumBox, end, {1.0, 2.0, end});
}

Tube pendulum(FlowOptions options) { return pendulumUntil(horizon, std::move(options)); }

/// The greatest radius at the end, on any part.
double radiusOf(const FlowModels& models) {
  double radius = 0;
  for (const auto& snapshot : models.at.back()) radius = std::max(radius, snapshot->outputs[0].radius);
  return radius;
}

TightenedModels firstModels(const TightenedModels::Enclose& enclose) {
  FlowOptions options;
  options.tightness = 1.5;
  const std::uint64_t began = Work::counted();
  const Tube tube = pendulum(options);
  EXPECT_EQ(tube.why(), "");
  return {tube.models(), options.tightness, static_cast<double>(Work::counted() - began), enclose};
}

TEST(TightenedModels, BecomeTighterAsFarAsWorkAllows) {
  TightenedModels models = firstModels(pendulum);
  ASSERT_TRUE(models.mayTighten());
  EXPECT_EQ(models.excess(), 0.5);
  const double before = radiusOf(*models);
  EXPECT_FALSE(models.tighten(8, 1e3, {}));
  EXPECT_TRUE(models.isWorkDone());
  EXPECT_EQ(radiusOf(*models), before);
  EXPECT_TRUE(models.tighten(8, 1e12, {}));
  EXPECT_FALSE(models.isWorkDone());
  EXPECT_LT(radiusOf(*models), 0.5 * before);
  EXPECT_EQ(models.excess(), 0x1p-4);
  EXPECT_EQ(models.firstExcess(), 0.5);
}

TEST(TightenedModels, StayWhereOthersDoNotReachAsFar) {
  TightenedModels models = firstModels([](FlowOptions options) { return pendulumUntil(2, std::move(options)); });
  const std::shared_ptr<const FlowModels> first = models.get();
  EXPECT_FALSE(models.tighten(8, 1e12, {}));
  EXPECT_EQ(models.get(), first);
  EXPECT_EQ(models.excess(), 0.5);
  EXPECT_FALSE(firstModels({}).mayTighten());
  EXPECT_FALSE(TightenedModels().mayTighten());
}

}  // namespace
}  // namespace gamut
