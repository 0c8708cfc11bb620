// The four-bar linkage again, told otherwise: what it does is the same.
#include <gtest/gtest.h>

#include <string>

#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/studies/four_bar_text.hpp"
#include "tests/studies/replaced.hpp"

namespace gamut {
namespace loop_shapes {
namespace {

using testing::fourBarText, testing::uncertain;

const std::string lengths = "a = \"0.3 m\", b = \"0.8 m\", c = \"0.6 m\", d = \"0.9 m\"";

std::string linkage() { return fourBarText("0.4", uncertain({"a"}, "± 0.1 %")); }

/// Angle and rate of the crank at the end.
Interval atEnd(const Results& results, std::size_t output) {
  return {results.interval.at.lower(1, output), results.interval.at.upper(1, output)};
}

Results known(const std::string& text) {
  Results results = run(readStudyText(text, "s.toml"));
  EXPECT_EQ(results.interval.reached, 0.4) << results.interval.why;
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  return results;
}

void expectAlike(const Interval& a, const Interval& b) {
  EXPECT_NEAR(a.lower(), b.lower(), 1e-4 * width(b));
  EXPECT_NEAR(a.upper(), b.upper(), 1e-4 * width(b));
}

TEST(LoopShapes, MoveAlikeInMillimetresAndKilometres) {
  const Results metres = known(linkage());
  for (const char* others : {"a = \"300 mm\", b = \"800 mm\", c = \"600 mm\", d = \"900 mm\"",
                             "a = \"0.0003 km\", b = \"0.0008 km\", c = \"0.0006 km\", d = \"0.0009 km\""}) {
    const Results again = known(replaced(linkage(), lengths, others));
    for (const std::size_t output : {0, 1}) expectAlike(atEnd(again, output), atEnd(metres, output));
  }
}

/// From guesses on the other branch, all mirrored, gravity too.
TEST(LoopShapes, AreMirroredOnTheOtherBranch) {
  std::string text = replaced(linkage(), "angle = 1, rate = 4", "angle = -1, rate = -4");
  text = replaced(text, "angle = -0.5", "angle = 0.5");
  text = replaced(text, "initial = { angle = 1.6 }", "initial = { angle = -1.6 }");
  text = replaced(text, "\"-9.81\"", "\"9.81\"");
  text = replaced(text, "[\"0.4\", \"0.1\", 0]", "[\"0.4\", \"-0.1\", 0]");
  const Results there = known(text), here = known(linkage());
  for (const std::size_t output : {0, 1}) expectAlike(atEnd(there, output), -atEnd(here, output));
}

}  // namespace
}  // namespace loop_shapes
}  // namespace gamut
