// What bounds say of the argument of a jump and of its sign, against values by hand.
#include "analyses/flow/step/jumps.hpp"

#include <gtest/gtest.h>

#include "analyses/flow/formulation.hpp"
#include "scalars/recorded.hpp"

namespace gamut::testing {
namespace {

struct Jump {
  Interval start, up, down;
  double seconds;
  Interval ever, then;
};

TEST(JumpBound, ArgumentsGoNoFurtherThanTheirRatesTakeThem) {
  const Jump cases[] = {
      {{1, 2}, {-1, -0.5}, {0.5, 1}, 1, {0, 2}, {0, 1.5}},     // comes down, some arrive
      {{1, 2}, {-1, -0.5}, {0.5, 1}, 8, {0, 2}, {0, 0}},       // all have arrived, and are held
      {{-2, -1}, {-1, -0.5}, {0.5, 1}, 8, {-2, 0}, {0, 0}},    // from below
      {{-1, 1}, {-2, -1}, {1, 2}, 0.5, {-1, 1}, {-0.5, 0.5}},  // from both sides
      {{0, 0}, {1, 2}, {3, 4}, 1, {0, 2}, {1, 2}},             // leaves upwards
      {{0, 0}, {-4, -3}, {-2, -1}, 1, {-2, 0}, {-2, -1}},      // downwards
      {{0, 0}, {-1, 0.25}, {1, 2}, 2, {0, 0.5}, {0, 0.5}},     // some leave, others stay
      {{0, 0}, {1, 1}, {-1, -1}, 2, {-2, 2}, {-2, 2}},         // driven away, at any time
      {{0, 0}, {2, 2}, {0, 0}, 1, {0, 2}, {0, 2}},             // a rate of zero below lets it stay
      {{3, 4}, {-1, 1}, {-5, 5}, 2, {1, 6}, {1, 6}},           // above all the time
      {{1, 1}, {-1, -1}, {-2, -2}, 3, {-6, 1}, {-6, 0}},       // passes
      {{-1, 1}, {-3, 3}, {-3, 3}, 0, {-1, 1}, {-1, 1}},        // no time
  };
  for (const Jump& c : cases) {
    JumpBound bound;
    bound.start = c.start;
    bound.up = c.up;
    bound.down = c.down;
    const JumpBound::Reach reach = bound.after(c.seconds);
    EXPECT_TRUE(isSubset(c.ever, reach.ever)) << c.start << c.up << c.down;
    EXPECT_TRUE(isSubset(c.then, reach.then)) << c.start << c.up << c.down;
    EXPECT_LT(width(reach.ever), width(c.ever) + 1e-12) << c.start << c.up << c.down;
    EXPECT_LT(width(reach.then), width(c.then) + 1e-12) << c.start << c.up << c.down;
  }
}

/// u = x, u̇ = p - sign x.
TEST(JumpBounder, SaysWhichSignsOccur) {
  const Program f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] - sign(x[0]); });
  const FlowJumps jumps(differentiatedFor(f, {}), {});
  ASSERT_EQ(jumps.count(), 1u);
  JumpBounder bounder(jumps);
  const auto signOf = [&](const Interval& p, const Interval& start, double h) {
    bounder.setParameters({Embedded{midpoint(p), 0.5 * width(p), 0, 0}});
    std::vector<JumpBound> bounds(1);
    bounder.bound(Interval(0, h), {Interval(-4, 4)}, {start}, h, bounds);
    return bounds[0];
  };
  const JumpBound held = signOf(Interval(0.25, 0.5), Interval(0.0), 1);
  EXPECT_TRUE(held.holds);
  EXPECT_TRUE(isSubset(Interval(0.25, 0.5), held.sign));  // the sign that balances p
  EXPECT_LT(width(held.sign), 0.26);
  const JumpBound leaves = signOf(Interval(1.5, 2), Interval(0.0), 1);
  EXPECT_FALSE(leaves.maySlide);
  EXPECT_TRUE(isEqual(leaves.sign, Interval(1.0)));
  const JumpBound some = signOf(Interval(0.75, 1.25), Interval(0.0), 1);
  EXPECT_TRUE(some.maySlide);
  EXPECT_TRUE(isSubset(Interval(0.75, 1), some.sign));
  EXPECT_LT(width(some.sign), 0.26);
  const JumpBound comes = signOf(Interval(0.25, 0.5), Interval(1, 2), 8);
  EXPECT_TRUE(isSubset(Interval(0.25, 1), comes.sign));
  EXPECT_GT(comes.sign.lower(), 0.24);
  const JumpBound stays = signOf(Interval(0.25, 0.5), Interval(1, 2), 0.5);
  EXPECT_TRUE(isEqual(stays.sign, Interval(1.0)));
  EXPECT_FALSE(signOf(Interval(0.25, 0.5), Interval::entire(), 1).isKnown());
  EXPECT_FALSE(signOf(Interval(0.25, 0.5), Interval::empty(), 1).isKnown());  // it has no value
}

TEST(FlowJumps, KnowNothingOfArgumentsThatInputsMove) {
  const Program f =
      record(1, 2, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[1] - sign(x[0] - p[0]); });
  const Program differentiated = differentiatedFor(f, {{0}});
  EXPECT_TRUE(FlowJumps(differentiated, {}).forms[0].has_value());
  EXPECT_FALSE(FlowJumps(differentiated, {0}).forms[0].has_value());
  EXPECT_TRUE(FlowJumps(differentiated, {1}).forms[0].has_value());
}

}  // namespace
}  // namespace gamut::testing
