// Play of a pin in its hole and of a slider in its guide: where the frames lie, in every scalar.
#include "mechanics/elements/play.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "mechanics/skeleton.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "tests/mechanics/machines.hpp"

namespace gamut {
namespace {

using Offset = Vector3<double>;

Mechanism withPlay(const Axis& axis, double eccentricity, double direction, double axial = 0) {
  Mechanism m;
  m.add(Play{"play", "inertial", "A", axis, 0.25, eccentricity, direction, axial});
  return m;
}

Offset whereIs(const Mechanism& m, const std::string& frame = "A") {
  Assembly<double> assembly(m);
  Offset place;
  for (int i = 0; i < 3; ++i) place[i] = assembly.output(frame + ".position." + components[i]);
  return place;
}

TEST(Play, LiesInItsDirectionAcrossTheAxis) {
  const double c = 0.125 * std::cos(0.75), s = 0.125 * std::sin(0.75);
  const auto at = [&](const Axis& axis) { return whereIs(withPlay(axis, 0.5, 0.75, 0.5)); };
  EXPECT_LE((at(axisZ) - Offset(c, s, 0.5)).norm(), 1e-16);
  EXPECT_LE((at(axisX) - Offset(0.5, c, s)).norm(), 1e-16);
  EXPECT_LE((at(axisY) - Offset(s, 0.5, c)).norm(), 1e-16);
  EXPECT_LE((at(Axis(0, 0, -1)) - Offset(c, -s, -0.5)).norm(), 1e-16) << "about the axis, the other way round";
}

TEST(Play, IsADiscAcrossASkewAxisToo) {
  const Axis axis(1, -2, 2);
  const Offset u(1 / 3.0, -2 / 3.0, 2 / 3.0);
  const Offset first = whereIs(withPlay(axis, 1, 0)), quarter = whereIs(withPlay(axis, 1, std::numbers::pi / 2));
  EXPECT_NEAR(first.norm(), 0.25, 1e-16);
  EXPECT_NEAR(first.dot(u), 0, 1e-16);
  EXPECT_LE((u.cross(first) - quarter).norm(), 1e-16);
  const Offset any = whereIs(withPlay(axis, 0.5, -2.0, 0.125));
  EXPECT_LE((any - (0.5 * std::cos(-2.0) * first + 0.5 * std::sin(-2.0) * quarter + 0.125 * u)).norm(), 1e-16);
}

/// The ends of the slider, half its length ahead and behind.
TEST(GuidePlay, HoldsBothEndsOffTheAxis) {
  for (const auto& [axis, across] : {std::pair(axisX, axisY), {axisY, axisX}, {axisZ, Axis(-1, 0, 0)}}) {
    Mechanism m;
    m.add(GuidePlay{"guide", "inertial", "A", axis, across, 0.5, 0.0625, 0.5, -1.0});
    ExpressionVector ahead{0.0, 0.0, 0.0}, behind = ahead;
    Offset along, off;
    for (int i = 0; i < 3; ++i) {
      along[i] = axis.direction()[static_cast<std::size_t>(i)];
      off[i] = across.direction()[static_cast<std::size_t>(i)];
      ahead[static_cast<std::size_t>(i)] = 0.25 * along[i];
      behind[static_cast<std::size_t>(i)] = -0.25 * along[i];
    }
    m.add(Link{"front", "A", "F", ahead});
    m.add(Link{"rear", "A", "R", behind});
    EXPECT_NEAR(whereIs(m, "F").dot(off), 0.5 * 0.0625, 1e-16);
    EXPECT_NEAR(whereIs(m, "R").dot(off), -0.0625, 1e-16);
    EXPECT_NEAR((whereIs(m, "F") - whereIs(m, "R")).norm(), 0.5, 1e-15);
    EXPECT_NEAR(whereIs(m).dot(along), 0, 1e-16);
  }
}

TEST(Play, IsTheSameInEveryScalar) {
  Mechanism m;
  m.add(Play{"pin", "inertial", "A", Axis(1, 2, 0), 0.25, 0.5, 0.75, 0.125});
  m.add(Revolute{"hinge", "A", "B", axisZ, 0.5});
  m.add(GuidePlay{"guide", "B", "C", axisX, axisZ, 0.5, 0.0625, 0.75, -0.25});
  m.add(Link{"rod", "C", "D", {0.5, 0.25, 1.0}});
  const std::vector<std::string> free = {"pin.eccentricity", "pin.direction", "guide.front"};
  const std::vector<double> values = {0.5, 0.75, 0.75};
  const Offset place = whereIs(m, "D");
  const Program recorded = recordOutputs(m, free, {"D.position.x", "D.position.y", "D.position.z"});
  Evaluator<double> evaluator(recorded);
  evaluator.setParameters(values);
  const std::vector<double> state{0.5, 0.0}, found = evaluator(0.0, state);
  Assembly<Interval> intervals(m);
  Assembly<Samples> samples(m);
  Assembly<Fuzzy> fuzzy(m);
  for (std::size_t i = 0; i < 3; ++i) {
    const double exact = place[static_cast<int>(i)];
    const std::string output = std::string("D.position.") + components[i];
    EXPECT_NEAR(found[i], exact, 1e-15);
    EXPECT_NEAR(midpoint(intervals.output(output)), exact, 1e-15);
    EXPECT_LE(width(intervals.output(output)), 1e-14);
    EXPECT_NEAR(samples.output(output)[0], exact, 1e-15);
    EXPECT_NEAR(midpoint(fuzzy.output(output).cut(0.0)), exact, 1e-15);
  }
}

/// What holds the frame behind is what is exerted on it: about the hole's axis an eccentric force has a moment.
TEST(Play, HandsOnForceAndItsMoment) {
  Mechanism m = withPlay(axisZ, 1, 0);
  m.add(Mass{"bob", "A", 2.0});
  m.setGravity({0.0, -10.0, 0.0});
  Assembly<double> assembly(m);
  EXPECT_NEAR(assembly.output("play.reaction.force.y"), 20, 1e-14);
  EXPECT_NEAR(assembly.output("play.reaction.moment.z"), 0, 1e-14);
}

TEST(Play, IsSeenAsSoonAsItMayBeThere) {
  EXPECT_EQ(skeletonOf(withPlay(axisZ, 0, 0)).points.size(), 1U);
  EXPECT_EQ(skeletonOf(withPlay(axisZ, 0, 0), {"play.eccentricity", "play.direction"}).points.size(), 2U);
}

template <class Element>
std::string saidOf(Element element) {
  Mechanism m;
  m.add(std::move(element));
  m.add(Revolute{"hinge", "A", "B", axisZ});
  try {
    m.check();
  } catch (const std::invalid_argument& refusal) {
    return refusal.what();
  }
  return "none";
}

TEST(Play, StaysWithinItsClearance) {
  using ::testing::HasSubstr;
  const auto play = [](double clearance, double eccentricity) {
    return saidOf(Play{"pin", "inertial", "A", axisZ, clearance, eccentricity});
  };
  EXPECT_EQ(play(0.25, 1), "none");
  EXPECT_EQ(play(0, 0), "none");
  EXPECT_THAT(play(-0.25, 0), HasSubstr("the clearance of 'pin' is negative"));
  EXPECT_THAT(play(0.25, 1.5), HasSubstr("the eccentricity of 'pin' is not from 0 to 1"));
  EXPECT_THAT(play(0.25, -0.5), HasSubstr("the eccentricity of 'pin' is not from 0 to 1"));
  const auto guide = [](double clearance, double length, double front, double rear, const Axis& across = axisY) {
    return saidOf(GuidePlay{"guide", "inertial", "A", axisX, across, length, clearance, front, rear});
  };
  EXPECT_EQ(guide(0.25, 1, 1, -1), "none");
  EXPECT_THAT(guide(-0.25, 1, 0, 0), HasSubstr("the clearance of 'guide' is negative"));
  EXPECT_THAT(guide(0.25, 0.25, 0, 0), HasSubstr("the length of 'guide' is less than twice its clearance"));
  EXPECT_THAT(guide(0.25, 1, 1.5, 0), HasSubstr("`front` of 'guide' is not from -1 to 1"));
  EXPECT_THAT(guide(0.25, 1, 0, -2), HasSubstr("`rear` of 'guide' is not from -1 to 1"));
  EXPECT_THAT(guide(0.25, 1, 0, 0, axisX), HasSubstr("the directions of 'guide' are no two coordinate axes"));
  EXPECT_THAT(guide(0.25, 1, 0, 0, Axis(0, 1, 1)), HasSubstr("the directions of 'guide' are no two coordinate axes"));
}

}  // namespace
}  // namespace gamut
