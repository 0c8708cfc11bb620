// Studies of linkages whose rows follow from each other: Bennett's, as it is shipped, against its motion in closed form
// in 128 bits, and what of an assumption is told, checked and refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "studies/machine.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/analyses/reference.hpp"
#include "tests/studies/four_bar_text.hpp"
#include "tests/studies/replaced.hpp"

namespace gamut {
namespace redundant_studies {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using testing::Vector;

std::string bennett() { return textOfStudy(GAMUT_SOURCE_DIR "/studies/examples/bennett/study.toml"); }

Machine machineOf(const std::string& text) { return Machine(readStudyText(text, "s.toml")); }

std::string refusalOf(const std::string& text) {
  try {
    machineOf(text);
  } catch (const StudyError& error) {
    return error.what();
  }
  return "";
}

Tube enclosed(const Machine& machine, const std::vector<double>& times) {
  FlowOptions options;
  options.remainders = machine.remainders;
  return Flow(machine.equations().f, machine.equations().g, options).enclose(machine.box, times.back(), times);
}

/// sin((alpha + beta)/2) / sin((beta - alpha)/2)
template <class S>
S ratioOf(const S& radians) {
  using std::sin;
  return S(sin(S(55.0 * radians)) / sin(S(15.0 * radians)));
}

/// Crank and rocker turn about axes that stand still, the rocker −2 k / (1 + k² + (k² − 1) cos θ) times as fast.
Program byHand() {
  return record(2, 2, [](auto, const auto& x, const auto& p, auto& dx) {
    const Recorded k = ratioOf<Recorded>(constant<Recorded>(pi() / Interval(180.0)));
    const Recorded below = 1.0 + sqr(k) + (sqr(k) - 1.0) * cos(x[0]), ratio = -2.0 * k / below;
    const Recorded slope = ratio * (sqr(k) - 1.0) * sin(x[0]) / below;
    const Recorded rocker = testing::decimal("0.01");
    dx[0] = x[1];
    dx[1] = (p[0] - rocker * ratio * slope * sqr(x[1])) / (p[1] + rocker * sqr(ratio));
  });
}

TEST(RedundantStudy, HoldsEveryMotionOfBennettsLinkage) {
  const Machine machine = machineOf(bennett());
  const Tube tube = enclosed(machine, {0.125, 0.25, 0.5});
  ASSERT_EQ(tube.reached(), 0.5) << tube.why();
  EXPECT_LE(tube.tightness(), 1.02);
  const Box quantities(machine.box.begin() + static_cast<std::ptrdiff_t>(machine.states), machine.box.end());
  ASSERT_EQ(machine.freeParameters.size(), 2U);
  testing::Reference reference(byHand());
  testing::Points points;
  const Precise degree = boost::math::constants::pi<Precise>() / 180, k = ratioOf<Precise>(degree);
  for (int n = 0; n < 6; ++n) {
    const Vector p = n % 2 == 0 ? points.corner(quantities) : points.inside(quantities);
    const std::vector<Vector> truth = reference({20 * degree, Precise("1.5"), p[0], p[1]}, tube.times());
    for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
      const Precise crank = truth[i][0], half = crank / 2, next = 2 * atan2(Precise(k * cos(half)), Precise(sin(half)));
      EXPECT_THAT(tube.outputs(i)[0], testing::Encloses(Precise(crank / degree))) << tube.times()[i];
      EXPECT_THAT(tube.outputs(i)[1], testing::Encloses(Precise(next / degree))) << tube.times()[i];
      EXPECT_THAT(tube.outputs(i)[2], testing::Encloses(truth[i][1])) << tube.times()[i];
    }
  }
}

TEST(RedundantStudy, TellsWhatIsAssumed) {
  const std::string text = replaced(replaced(bennett(), "horizon = \"0.5 s\"", "horizon = \"0.1 s\""), "256", "32");
  const Study study = readStudyText(text, "s.toml");
  EXPECT_THAT(study.notes, Contains(HasSubstr("of 'last' follow from the other rows of all loops, is assumed, not "
                                              "proved")));
  const Results results = run(study, {});
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_THAT(results.assumptions, HasSubstr("of 'last' follow from the other rows of all loops"));
  EXPECT_TRUE(run(readStudyText(testing::fourBarText("0.1", ""), "s.toml"), {}).assumptions.empty());
}

/// Where nothing is said, what it seems to be is.
TEST(RedundantStudy, SaysWhichRowsSeemToFollow) {
  EXPECT_THAT(refusalOf(replaced(bennett(), "\"hinge\"\nredundant = 3", "\"hinge\"")),
              HasSubstr("`redundant = 3` of 'last', which assumes, as it seems, that places along"));
  const std::string other =
      replaced(replaced(bennett(), "\"hinge\"\nredundant = 3", "\"hinge\""), "a*sin(beta)", "1.01*a*sin(beta)");
  EXPECT_THAT(refusalOf(other), HasSubstr("is closed by 5 coordinates"));
  EXPECT_THAT(refusalOf(other), ::testing::Not(HasSubstr("as it seems")));
}

/// What the rows rest on may be uncertain only where they hold for all of it.
TEST(RedundantStudy, RefusesQuantitiesOnWhichItRests) {
  const auto uncertain = [](const std::string& name, const std::string& text) {
    return replaced(text, "[[output]]",
                    "[[uncertain]]\nquantity = \"" + name + "\"\ninterval = \"± 0.1 %\"\n\n[[output]]");
  };
  EXPECT_EQ(refusalOf(uncertain("a", bennett())), "");
  EXPECT_EQ(refusalOf(uncertain("alpha", bennett())), "");
  EXPECT_EQ(refusalOf(uncertain("crank.angle", bennett())), "");
  const std::string two = replaced(replaced(bennett(), "third_end\"\nvector = [\"a\"", "third_end\"\nvector = [\"c\""),
                                   "a = \"0.3 m\"", "a = \"0.3 m\", c = \"0.3 m\"");
  EXPECT_EQ(refusalOf(two), "");
  EXPECT_THAT(refusalOf(uncertain("c", two)),
              HasSubstr("rows of the loop 'last' that are `redundant` do not follow from the others"));
  EXPECT_THAT(refusalOf(uncertain("c", two)), HasSubstr("where 'c', which is uncertain, is"));
}

}  // namespace
}  // namespace redundant_studies
}  // namespace gamut
