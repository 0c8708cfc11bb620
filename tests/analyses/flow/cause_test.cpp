// A flow that ends, or is loose, names one cause: the one that is to blame.
#include <gmock/gmock.h>

#include "analyses/flow/flow.hpp"

namespace gamut {
namespace {

using Kind = FlowCause::Kind;
using ::testing::HasSubstr;
using ::testing::Not;

/// A pendulum, and a state whose rate divides by what the angle never makes zero.
Program dividing() {
  return record(3, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -sin(x[0]);
    dx[2] = 1.0 / (9.0 + x[0]);
  });
}

FlowOptions named() {
  FlowOptions options;
  options.stateNames = {"angle", "rate", "sum"};
  return options;
}

/// All solutions stay above an angle of -4, but what a linear remainder has grown to does not.
TEST(FlowCause, IsTheRemainderWhereThatMeetsAnEdge) {
  FlowOptions options = named();
  options.split = false;
  options.degree = 2;
  options.frameDegree = 0;
  const Tube tube = Flow(dividing(), options).enclose({Interval(2.6, 2.9), 0.0, 0.0}, 40);
  ASSERT_LT(tube.reached(), 40);
  EXPECT_EQ(tube.cause().kind, Kind::remainder) << tube.why();
  EXPECT_THAT(tube.why(), HasSubstr("of which steps have added"));
  EXPECT_THAT(tube.why(), Not(HasSubstr("a division")));
  EXPECT_EQ(tube.cause().advice(), "interval.split = true");
}

TEST(FlowCause, IsWhatKeepsTheBoxFromBisection) {
  FlowOptions options = named();
  options.maxPieces = 2;
  options.tightness = 1.0001;
  options.degree = 2;
  const Tube few = Flow(dividing(), options).enclose({Interval(2.0, 2.9), 0.0, 0.0}, 4, {2, 4});
  EXPECT_EQ(few.limitCause().kind, Kind::pieces) << few.limit();
  EXPECT_EQ(few.limit(), "all 2 pieces that are allowed are used");
  EXPECT_EQ(few.limitCause().advice(), "interval.max_pieces = 8");
  options.split = false;
  const Tube none = Flow(dividing(), options).enclose({Interval(2.0, 2.9), 0.0, 0.0}, 4, {2, 4});
  EXPECT_EQ(none.limitCause().kind, Kind::unsplit) << none.limit();
  EXPECT_EQ(none.limitCause().advice(), "interval.split = true");
}

/// Bisection, for the states' sake, does nothing for outputs of a linear motion: what helps is the degree, up to where
/// nothing is loose, whether one was stated or not.
TEST(FlowCause, IsTheDegreeWhereThatIsTooLowForOutputs) {
  const Program f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -x[0]; });
  const Program sine = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = sin(8.0 * x[0]); });
  const Program bell =
      record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = exp(-16.0 * sqr(x[0])); });
  const auto tubeOf = [&](const Program& g, int degree) {
    FlowOptions options = named();
    options.stateNames = {"x"};
    options.degree = degree;
    return Flow(f, g, options).enclose({Interval(0.5, 1.5)}, 1, {0.5, 1});
  };
  Tube tube = tubeOf(sine, 3);
  for (int degree = 5; degree <= 11; degree += 2) {
    EXPECT_EQ(tube.limitCause().kind, Kind::vain) << tube.limit();
    ASSERT_EQ(tube.limitCause().advice(), "interval.degree = " + std::to_string(degree));
    Tube better = tubeOf(sine, degree);
    EXPECT_LT(better.tightness() - 1, 0.7 * (tube.tightness() - 1)) << degree;
    tube = std::move(better);
  }
  EXPECT_LT(tube.tightness(), 1.02);
  EXPECT_TRUE(tube.limitCause().isNone());
  const Tube automatic = tubeOf(bell, -1);  // of outputs the highest that is chosen by itself
  ASSERT_EQ(automatic.limitCause().advice(), "interval.degree = 18");
  EXPECT_LT(tubeOf(bell, 18).tightness(), 0.5 * automatic.tightness());
}

TEST(FlowCause, AdvisesNoDegreeThatMayNotBeStated) {
  EXPECT_EQ((FlowCause{Kind::vain, "", 40}).advice(), "interval.degree = 40");
  EXPECT_EQ((FlowCause{Kind::vain, "", 42}).advice(), "");
  EXPECT_EQ((FlowCause{Kind::remainder, "", 42}).advice(), "");
}

TEST(FlowCause, IsAnEdgeWhereTheMotionComesToIt) {
  const Program f = record(1, 0, [](auto t, const auto& x, const auto&, auto& dx) { dx[0] = -1.0 - 1e-9 * t / x[0]; });
  const Tube tube = Flow(f).enclose({Interval(0.99, 1.01)}, 3);
  EXPECT_EQ(tube.cause().kind, Kind::edge) << tube.why();
  EXPECT_EQ(tube.cause().advice(), "");
}

/// Outputs go on there, motions do not: of a crank that turns, and of a pendulum that a controller drives over the top.
TEST(FlowCause, IsTheJumpOfAnAngleOfTwoCoordinates) {
  const Program crank = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = 1.0 + 0.0 * x[0];
    dx[1] = p[0] * atan2(sin(x[0]), cos(x[0]));
  });
  const Program pendulum = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -10.0 * sin(x[0]) / p[0] - 2.0 * atan2(-p[0] * cos(x[0]), p[0] * sin(x[0])) / sqr(p[0]);
  });
  for (const Program& f : {crank, pendulum}) {
    const Tube tube = Flow(f).enclose({0.0, 8.0, Interval(0.79, 0.81)}, 4);
    EXPECT_EQ(tube.cause().kind, Kind::edge) << tube.why();
    EXPECT_THAT(tube.why(), HasSubstr("(atan2) that may be half a turn, where it jumps"));
    EXPECT_GT(tube.reached(), 0.5);
  }
}

TEST(FlowCause, HasASentenceOfEachKind) {
  for (int kind = 1; kind <= static_cast<int>(Kind::rounds); ++kind)
    EXPECT_NE((FlowCause{static_cast<Kind>(kind), "x", 1}).sentence(), "") << kind;
  EXPECT_EQ(FlowCause{}.sentence(), "");
  EXPECT_EQ(FlowCause{}.advice(), "");
}

}  // namespace
}  // namespace gamut
