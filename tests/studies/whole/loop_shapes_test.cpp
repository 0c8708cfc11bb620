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

/// As many linkages beside each other, which have nothing to do with each other but the equations.
std::string linkages(int count) {
  const std::string one = linkage();
  const std::size_t begin = one.find("[[mechanism.element]]"), end = one.find("[[uncertain]]");
  std::string all = one.substr(0, end);
  for (int k = 1; k < count; ++k) {
    std::string copy = one.substr(begin, end - begin);
    for (const char* name : {"A", "B", "C", "D", "K1", "K2", "K3", "PB", "PD", "C1", "C2", "crank", "coupler", "rocker",
                             "ab", "bc", "dc", "ground"}) {
      const std::string quoted = "\"" + std::string(name) + "\"", own = "\"" + (name + std::to_string(k)) + "\"";
      for (std::size_t at = copy.find(quoted); at != std::string::npos; at = copy.find(quoted, at + own.size()))
        copy.replace(at, quoted.size(), own);
    }
    all += copy;
  }
  return all + one.substr(end);
}

/// Of more than six dependent coordinates starts are told by polynomials, from which one step leads to where loops
/// close: where that did not, samples began beside the enclosure.
TEST(LoopShapes, MoveAlikeBesideThreeOthers) {
  const Results alone = known(linkage()), together = known(linkages(4));
  for (const std::size_t output : {0, 1}) expectAlike(atEnd(together, output), atEnd(alone, output));
}

}  // namespace
}  // namespace loop_shapes
}  // namespace gamut
