// Models of outputs: what every test of containment judges them by, and what is kept of them at all.
#include <gmock/gmock.h>

#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

/// A pendulum with uncertain angle, rate and stiffness; outputs of it, one with a kink, one that jumps.
Containment pendulumOfStiffness() {
  Containment c;
  c.f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * sin(x[0]);
  });
  c.g = record(2, 1, 4, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = cos(x[0]);
    y[1] = p[0] * x[1] + t;
    y[2] = abs(x[0]);
    y[3] = sign(x[1]) * x[0];
  });
  c.box = {Interval(0.5, 1.0), Interval(-0.2, 0.3), Interval(9.0, 10.0)};
  c.horizon = 1;
  for (int i = 1; i < 10; ++i) c.times.push_back(0.1 * i);
  return c;
}

TEST(FlowModels, HoldEverySolutionAtItsPlace) {
  const Containment c = pendulumOfStiffness();
  Judge judge(c);
  ASSERT_TRUE(judge.tube().models());
  EXPECT_GT(judge.tube().pieces(), 1);
  judge.judge(40);
  EXPECT_EQ(judge.modelled(), 40U * (6 * 10));  // five moments and an output time an interval
}

TEST(FlowModels, HoldWithInputsAndWithRemaindersInSymbols) {
  Containment c = pendulumOfStiffness();
  c.g = standardOutputs(2, 1);
  c.box[2] = Interval(9.7, 9.9);
  c.options.split = false;
  Judge unsplit(c);
  unsplit.judge(20);
  EXPECT_GT(unsplit.modelled(), 0U);
  c.options.varying = {{0, 1.0}};
  Judge varying(c);
  EXPECT_EQ(varying.tube().models()->components[2].symbol, -1);
  varying.judge(20);
  EXPECT_GT(varying.modelled(), 0U);
}

/// Where an output is extreme it is about as far as its enclosure reaches, whatever parts the box is cut into.
TEST(FlowModels, TellWhereOutputsAreExtreme) {
  Containment c = pendulumOfStiffness();
  c.g = record(2, 1, 3, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = cos(x[0]);                            // greatest inside
    y[1] = p[0] * x[1] - sqr(x[0]);              // of all quantities
    y[2] = x[1] * x[1] - 0.5 * sqr(p[0] - 9.3);  // turns in two
  });
  for (const int pieces : {1, 64}) {
    c.options.maxPieces = pieces;
    c.options.extremesAt = {0, 3, 7, 10};
    const Tube tube = c.tube();
    ASSERT_EQ(tube.reachedTimes(), 11U);
    for (std::size_t row = 0; row < tube.reachedTimes(); ++row) {
      const std::vector<OutputExtremes>& extremes = tube.extremes()[row];
      if (!std::ranges::binary_search(c.options.extremesAt, row)) {
        EXPECT_TRUE(extremes.empty());
        continue;
      }
      ASSERT_EQ(extremes.size(), 3U);
      for (std::size_t o = 0; o < 3; ++o) {
        const Interval enclosure = tube.outputs(row)[o];
        const auto valueAt = [&](const std::vector<double>& place) {
          Box start;
          for (std::size_t i = 0; i < place.size(); ++i) {
            EXPECT_TRUE(contains(c.box[i], place[i]));
            start.push_back(Interval(place[i]));
          }
          return midpoint(Flow(c.f, *c.g).enclose(start, c.horizon, tube.times()).outputs(row)[o]);
        };
        const double hardly = 0.02 * width(enclosure);
        EXPECT_NEAR(valueAt(extremes[o].leastAt), enclosure.lower(), hardly) << pieces << ' ' << row << ' ' << o;
        EXPECT_NEAR(valueAt(extremes[o].greatestAt), enclosure.upper(), hardly) << pieces << ' ' << row << ' ' << o;
      }
    }
  }
}

/// They are about as tight as the enclosures themselves: the hull over the parts of the box.
TEST(FlowModels, AreAsTightAsEnclosures) {
  const Containment c = pendulumOfStiffness();
  const Tube tube = c.tube();
  for (std::size_t row = 1; row < tube.reachedTimes(); ++row)
    for (std::size_t o = 0; o < 2; ++o) {
      const Interval enclosure = tube.outputs(row)[o];
      for (const auto& snapshot : tube.models()->at[row]) {
        EXPECT_LT(width(snapshot->outputs[o].bound), 1.01 * width(enclosure)) << row;
        EXPECT_LT(snapshot->outputs[o].radius, 0.02 * width(enclosure)) << row;
      }
    }
}

TEST(FlowModels, AreKeptOnlyWhereAskedForAndWhereThereIsRoom) {
  Containment c = pendulumOfStiffness();
  EXPECT_FALSE(Flow(c.f, *c.g).enclose(c.box, c.horizon, c.times).models());
  c.options.modelled = {3, 0};
  const Tube some = c.tube();
  ASSERT_TRUE(some.models());
  EXPECT_EQ(some.models()->at[5][0]->outputs.size(), 2U);
  c.options.modelBytes = 1000;
  const Tube none = c.tube();
  EXPECT_FALSE(none.models());
  EXPECT_EQ(none.why(), "");
  c.options.modelled = {4};
  EXPECT_THROW(c.tube(), std::invalid_argument);
}

TEST(FlowModels, OfAnImageAreItsPolynomials) {
  const Program g = record(1, 1, 2, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = x[0] * p[0] + t;
    y[1] = sin(x[0]);
  });
  const Box box{Interval(1.0, 2.0), Interval(3.0, 4.0)};
  const auto models = modelImage(g, 0.5, box, {0});
  ASSERT_TRUE(models);
  ASSERT_EQ(models->at.size(), 1U);
  const FlowSnapshot& whole = *models->at[0][0];
  ASSERT_EQ(whole.outputs.size(), 1U);
  // (1.5 + 0.5 ξ)(3.5 + 0.5 η) + 0.5
  const OutputModel& model = whole.outputs[0];
  ASSERT_EQ(model.c.size(), 6U);
  EXPECT_EQ(model.c[0], 5.75);
  EXPECT_LT(model.radius, 1e-14);
  EXPECT_TRUE(contains(model.bound, 3.5) && contains(model.bound, 8.5));
}

}  // namespace
}  // namespace gamut::testing
