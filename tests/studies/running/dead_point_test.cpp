// Dead points that are ahead, against where the same linkage by hand comes to them.
#include "studies/running/dead_point.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "studies/running/run.hpp"
#include "tests/analyses/reference.hpp"
#include "tests/studies/four_bar_text.hpp"
#include "tests/studies/replaced.hpp"

namespace gamut {
namespace dead_points {
namespace {

using testing::fourBarText, testing::uncertain;
using ::testing::HasSubstr;

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

/// The rate of the rocker at these times.
std::vector<double> rockerByHand(const std::vector<double>& times) {
  const std::array<Precise, 4> lengths{Precise("0.3"), Precise("0.8"), Precise("0.6"), Precise("0.9")};
  testing::Reference reference(testing::byHand());
  const std::vector<testing::Vector> truth = reference({1, 4, lengths[0], lengths[1], lengths[2], lengths[3]}, times);
  std::vector<double> rates;
  for (const testing::Vector& state : truth)
    rates.push_back(static_cast<double>(
        testing::fourBarByHand<Precise>(state[0], state[1], lengths, [](const char* n) { return Precise(n); }).rocker));
  return rates;
}

TEST(DeadPoint, IsFoundWhereTheRockerTurns) {
  const auto dead = deadPointOf(readStudyText(byRocker(""), "s.toml"));
  ASSERT_TRUE(dead);
  EXPECT_LT(dead->to - dead->from, 1e-4);
  std::vector<double> times;
  for (int i = 1; i <= 1024; ++i) times.push_back(dead->from * i / 1024.0);
  times.push_back(dead->to);
  const std::vector<double> rates = rockerByHand(times);
  for (std::size_t i = 0; i + 1 < rates.size(); ++i) EXPECT_GT(rates[i] * rates.front(), 0) << times[i];
  EXPECT_LT(rates.back() * rates.front(), 0);
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
  EXPECT_THAT(results.interval.why, HasSubstr("the nominal motion comes to a dead point of A.angle, B.angle between"));
  EXPECT_THAT(results.interval.advice, HasSubstr("mechanism.loops = \"multipliers\", or dependent = ["));
}

/// Each sample has one of its own, also where nominally the crank turns fully; or ends where all of the linkage is in
/// line.
TEST(DeadPoint, IsThatOfTheSampleThatEndsThere) {
  const auto ended = [](const std::vector<std::string>& lengths, const std::string& interval) {
    const std::string text = replaced(fourBarText("1", uncertain(lengths, interval)), "[\"interval\", ", "[");
    return run(readStudyText(text, "s.toml"), {}).stochastic;
  };
  const StochasticResult wide = ended({"a", "d"}, "± 20 %");
  ASSERT_GT(wide.failed.size(), 1U);
  EXPECT_THAT(wide.why, HasSubstr(" s: its motion comes to a dead point of "));
  const std::regex between(
      "its motion comes to a dead point of [AB].angle, [BD].angle between ([0-9.]+) s and ([0-9.]+) "
      "s, where they follow from no others; what helps: mechanism.loops = \"multipliers\".*");
  for (const FailedSampleResult& sample : wide.failed) {
    std::smatch found;
    ASSERT_TRUE(std::regex_match(sample.why, found, between)) << sample.number << ": " << sample.why;
    EXPECT_LT(0.999 * std::stod(found[1]), sample.reached);
    EXPECT_GT(1.001 * std::stod(found[2]), sample.reached);
  }
  const StochasticResult narrow = ended({"a", "b", "c", "d"}, "± 10 %");  // at one corner a + d = b + c
  EXPECT_THAT(narrow.failed,
              ::testing::Contains(::testing::Field(&FailedSampleResult::why, HasSubstr("depend on each other"))));
}

/// Said before it runs, in the place of the loop.
TEST(DeadPoint, IsNotedAhead) {
  const std::string note = noteOfDeadPoint(readStudyText(byRocker(""), "s.toml"));
  EXPECT_THAT(note,
              ::testing::MatchesRegex("s.toml:[0-9]+:[0-9]+: note: the nominal motion comes to a dead point of "
                                      "A.angle, B.angle between 0\\.[0-9]+ s and 0\\.[0-9]+ s, where they follow "
                                      "from no others; what helps: mechanism.loops = \"multipliers\", or dependent "
                                      "= .*, which are firm there"));
  EXPECT_EQ(noteOfDeadPoint(readStudyText(fourBarText("2", ""), "s.toml")), "");
  const std::string before = replaced(replaced(byRocker(""), "horizon = 1\n", "horizon = 0.05\n"), "output_step = 1\n",
                                      "output_step = 0.05\n");
  EXPECT_EQ(noteOfDeadPoint(readStudyText(before, "s.toml")), "");
  const std::string passed = replaced(byRocker(""), "[mechanism]", "[mechanism]\nloops = \"multipliers\"");
  EXPECT_EQ(noteOfDeadPoint(readStudyText(passed, "s.toml")), "");
}

/// Parallel cranks, and a kite, fold flat.
TEST(DeadPoint, IsPassedByNothingWhereALoopLiesInLine) {
  for (const char* lengths : {"a = \"0.6 m\", b = \"0.9 m\", c = \"0.6 m\", d = \"0.9 m\"",
                              "a = \"0.3 m\", b = \"0.3 m\", c = \"0.8 m\", d = \"0.8 m\""}) {
    const std::string text =
        replaced(fourBarText("2", ""), "a = \"0.3 m\", b = \"0.8 m\", c = \"0.6 m\", d = \"0.9 m\"", lengths);
    for (const std::string& each : {text, replaced(text, "[mechanism]", "[mechanism]\nloops = \"multipliers\"")}) {
      const auto dead = deadPointOf(readStudyText(each, "s.toml"));
      ASSERT_TRUE(dead) << lengths;
      EXPECT_EQ(dead->alike, std::vector<std::string>{"C"}) << lengths;
      EXPECT_THAT(dead->sentence(), HasSubstr("to where rows of C depend on each other"));
      EXPECT_THAT(dead->advice(), ::testing::Not(HasSubstr("multipliers")));
    }
  }
}

/// Of a linkage that a drive leaves no freedom the rows of the loop alone tell, along the links or not.
TEST(DeadPoint, IsFoundWhereALinkageIsStretchedByItsDrive) {
  const double stretched = (std::acos((0.09 + 0.1225 - 0.25) / 0.21) - 80 * std::acos(-1.0) / 180) / 1.5;
  std::string text = R"(
[study]
analysis = "inverse-dynamics"
horizon = 1
output_step = 0.125
[[output]]
quantity = "rocker.angle"
)";
  const auto hinge = [&](const std::string& name, const std::string& from, const std::string& angle) {
    text += "[[mechanism.element]]\ntype = \"revolute\"\nname = \"" + name + "\"\nfrom = \"" + from + "\"\nto = \"" +
            name + "_frame\"\naxis = \"z\"\ninitial = { angle = \"" + angle + "\" }\n";
  };
  const auto arm = [&](const std::string& name, const std::string& from, const std::string& length) {
    text += "[[mechanism.element]]\ntype = \"link\"\nname = \"" + name + "\"\nfrom = \"" + from + "\"\nto = \"" + name +
            "_end\"\nvector = [\"" + length + "\", 0, 0]\n";
  };
  hinge("crank", "inertial", "0 deg");
  text.replace(text.rfind("initial = {"), std::string::npos, "[[mechanism.element]]\ntype = \"drive\"\n");
  text += "name = \"input\"\njoint = \"crank\"\nposition = \"80 deg + 1.5 rad/s*t\"\n";
  arm("crank_arm", "crank_frame", "300 mm");
  hinge("coupler", "crank_arm_end", "-110 deg");
  arm("coupler_arm", "coupler_frame", "400 mm");
  arm("ground", "inertial", "350 mm");
  hinge("rocker", "ground_end", "150 deg");
  arm("rocker_arm", "rocker_frame", "100 mm");
  text +=
      "[[mechanism.element]]\ntype = \"closure\"\nname = \"pin\"\nas = \"pin\"\nfrom = \"rocker_arm_end\"\n"
      "to = \"coupler_arm_end\"\naxis = \"z\"\n";
  const auto dead = deadPointOf(readStudyText(text, "s.toml"));
  ASSERT_TRUE(dead);
  EXPECT_LE(dead->from, stretched);
  EXPECT_GE(dead->to, stretched);
  EXPECT_LT(dead->to - dead->from, 1e-4);
  EXPECT_EQ(dead->coordinates, (std::vector<std::string>{"coupler.angle", "rocker.angle"}));
  EXPECT_TRUE(dead->isDriven);
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
