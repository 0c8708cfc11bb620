// Dead points that are ahead, against where the same linkage by hand comes to them.
#include "studies/running/dead_point.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "studies/running/run.hpp"
#include "tests/analyses/reference.hpp"
#include "tests/studies/four_bar_text.hpp"

namespace gamut {
namespace dead_points {
namespace {

using testing::fourBarText, testing::uncertain;
using ::testing::HasSubstr;

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  return text.replace(text.find(old), old.size(), by);
}

/// The four-bar linkage that starts as ever, told by its rocker: where that is, and how fast, follows from the crank.
std::string byRocker(const std::string& uncertain) {
  const auto at =
      testing::fourBarByHand<double>(1, 4, {0.3, 0.8, 0.6, 0.9}, [](const char* n) { return std::stod(n); });
  const double angle = std::atan2(at.closing[1], at.closing[0] - 0.9);
  const std::string text =
      replaced(fourBarText("1", uncertain, "dependent = [\"A\", \"B\"]"), "angle = 1, rate = 4", "angle = 1");
  return replaced(text, "initial = { angle = 1.6 }",
                  "initial = { angle = " + std::to_string(angle) + ", rate = " + std::to_string(at.rocker) + " }");
}

/// The first time at which the rocker turns, of so many parts of a second.
double turnByHand() {
  std::vector<double> times;
  for (int i = 1; i <= 1024; ++i) times.push_back(i / 1024.0);
  const std::array<Precise, 4> lengths{Precise("0.3"), Precise("0.8"), Precise("0.6"), Precise("0.9")};
  testing::Reference reference(testing::byHand());
  const std::vector<testing::Vector> truth = reference({1, 4, lengths[0], lengths[1], lengths[2], lengths[3]}, times);
  double before = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double rate =
        static_cast<double>(testing::fourBarByHand<Precise>(truth[i][0], truth[i][1], lengths, [](const char* n) {
                              return Precise(n);
                            }).rocker);
    if (rate * before < 0) return times[i];
    before = rate;
  }
  return 0;
}

TEST(DeadPoint, IsFoundWhereTheRockerTurns) {
  const auto dead = deadPointOf(readStudyText(byRocker(""), "s.toml"));
  ASSERT_TRUE(dead);
  const double turn = turnByHand();
  ASSERT_GT(turn, 0.05);
  EXPECT_NEAR(dead->time, turn, 0.003);
  EXPECT_EQ(dead->coordinates, (std::vector<std::string>{"A.angle", "B.angle"}));
  EXPECT_EQ(dead->others.size(), 2U);
  EXPECT_FALSE(dead->isDriven);
}

TEST(DeadPoint, IsNotThereForACrankThatTurnsFully) {
  EXPECT_FALSE(deadPointOf(readStudyText(fourBarText("2", ""), "s.toml")));
}

TEST(DeadPoint, IsToldWhereARunEnds) {
  const std::string text = replaced(byRocker(uncertain({"a"}, "± 0.1 %")), ", \"stochastic\"", "");
  const Results results = run(readStudyText(text, "s.toml"), {});
  EXPECT_LT(results.interval.reached, 1);
  EXPECT_THAT(results.interval.why, HasSubstr("the nominal motion comes to a dead point of A.angle, B.angle at about"));
  EXPECT_THAT(results.interval.advice, HasSubstr("mechanism.loops = \"multipliers\", or dependent = ["));
}

/// No force carries a driven rocker beyond its extreme.
TEST(DeadPoint, IsOneOfADrive) {
  std::string text = replaced(fourBarText("2", "", "dependent = [\"A\", \"B\"]"), "angle = 1, rate = 4", "angle = 1");
  text = replaced(text, "initial = { angle = 1.6 }\n", "");
  text = replaced(text, "[[mechanism.element]]\ntype = \"closure\"",
                  "[[mechanism.element]]\ntype = \"drive\"\nname = \"motor\"\njoint = \"D\"\n"
                  "position = \"2.06 rad + 1 rad/s*t\"\n[[mechanism.element]]\ntype = \"closure\"");
  for (const std::string& each : {text, replaced(text, "[mechanism]", "[mechanism]\nloops = \"multipliers\"")}) {
    const Results results = run(readStudyText(each, "s.toml"), {});
    EXPECT_LT(results.interval.reached, 2);
    EXPECT_THAT(results.interval.why, HasSubstr("the nominal motion comes to a dead point of A.angle, B.angle"));
    EXPECT_THAT(results.interval.advice, HasSubstr("a drive of another joint"));
  }
}

}  // namespace
}  // namespace dead_points
}  // namespace gamut
