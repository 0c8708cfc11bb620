// States that no output needs stand still where that is asked for, and nothing else is changed.
#include "analyses/flow/needed_states.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include "analyses/flow/flow.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

using ::testing::ElementsAre;

/// A pendulum, a state that it drives, one that drives that, and one that grows beyond all bounds within 1 s.
Program pendulumWithOthers() {
  return record(5, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * sin(x[0]);
    dx[2] = x[1] * x[3];
    dx[3] = -x[3];
    dx[4] = x[4] * x[4];
  });
}

Program outputOf(int state) {
  return record(5, 1, 1,
                [state](auto, const auto& x, const auto&, auto& y) { y[0] = x[static_cast<std::size_t>(state)]; });
}

TEST(NeededStates, AreThoseThatOutputsDependOnAndAllThatTheseDependOn) {
  const Program f = pendulumWithOthers();
  const auto needed = [&](std::vector<Program> readers) { return neededStates(f, readers); };
  EXPECT_THAT(needed({outputOf(0)}), ElementsAre(1, 1, 0, 0, 0));
  EXPECT_THAT(needed({outputOf(2)}), ElementsAre(1, 1, 1, 1, 0));
  EXPECT_THAT(needed({outputOf(3)}), ElementsAre(0, 0, 0, 1, 0));
  EXPECT_THAT(needed({outputOf(4), outputOf(3)}), ElementsAre(0, 0, 0, 1, 1));
  EXPECT_THAT(needed({}), ElementsAre(0, 0, 0, 0, 0));
}

/// An output that needs no state has values behind where the motion of the second one ends.
TEST(NeededStates, AreThoseWhoseRatesMayHaveNoValue) {
  const Program f = record(5, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = 0.0 * x[0];
    dx[1] = 1.0 / sqrt(1.0 - square(sin(x[3])));
    dx[2] = sqrt(1.0 - square(sin(x[3]))) + sqrt(square(sin(x[3])) + 1.0);
    dx[3] = 1.0;
    dx[4] = 1.0 / (x[4] + 2.0);
  });
  const Program byTime = record(5, 0, 1, [](auto t, const auto&, const auto&, auto& y) { y[0] = cos(t); });
  const Program second = record(5, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[1]; });
  EXPECT_THAT(neededStates(f, std::array{byTime}), ElementsAre(0, 1, 1, 1, 1));
  EXPECT_THAT(neededStates(f, std::array{byTime}, true), ElementsAre(0, 1, 1, 1, 0));
  EXPECT_THAT(neededStates(f, std::array{second}, true), ElementsAre(0, 1, 1, 1, 0));  // the third by its other root
  FlowOptions options;
  options.dropsUnneeded = true;
  EXPECT_LT(Flow(f, byTime, options).enclose(Box(5, Interval(0.0)), 3.0, {3.0}).reached(), 1.6);
}

TEST(NeededStates, AloneAreFollowedWhereThatIsAskedFor) {
  const Box box = {Interval(0.9, 1.1), 0.0, 1.0, 1.0, 1.0, Interval(0.98, 1.02)};
  const std::vector<double> times = {0.5, 1.0, 1.5, 2.0};
  FlowOptions options;
  EXPECT_LT(Flow(pendulumWithOthers(), outputOf(0), options).enclose(box, 2.0, times).reached(), 1.0);
  options.dropsUnneeded = true;
  const Tube tube = Flow(pendulumWithOthers(), outputOf(0), options).enclose(box, 2.0, times);
  ASSERT_EQ(tube.reached(), 2.0) << tube.why();
  const Program alone = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * sin(x[0]);
  });
  const Tube pendulum = Flow(alone).enclose({box[0], box[1], box[5]}, 2.0, times);
  for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
    EXPECT_LT(std::fabs(tube.outputs(i)[0].lower() - pendulum.states(i)[0].lower()), 1e-3);
    EXPECT_LT(std::fabs(tube.outputs(i)[0].upper() - pendulum.states(i)[0].upper()), 1e-3);
  }
}

/// What is looked at besides counts as an output.
TEST(NeededStates, AreThoseOfAsidesToo) {
  FlowOptions options;
  options.dropsUnneeded = true;
  options.aside = {outputOf(3), {1.0}};
  const Box box = {1.0, 0.0, 1.0, Interval(1.0, 2.0), 1.0, 1.0};
  const Tube tube = Flow(pendulumWithOthers(), outputOf(0), options).enclose(box, 1.0, {0.5, 1.0});
  ASSERT_EQ(tube.reached(), 1.0) << tube.why();
  EXPECT_TRUE(isSubset(exp(Interval(-1.0)) * Interval(1.0, 2.0), tube.asides(2)[0]));
  EXPECT_FALSE(contains(tube.asides(2)[0], 1.0));
}

}  // namespace
}  // namespace gamut
