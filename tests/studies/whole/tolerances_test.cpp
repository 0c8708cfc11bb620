// Files of tolerances: what they state, and what is refused in one line.
#include "studies/tolerances.hpp"

#include <gmock/gmock.h>

#include <string>

#include "studies/study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::EndsWith;
using ::testing::StartsWith;

const std::vector<std::string> outputs{"tip z", "angle"};

std::string complaintOf(const std::string& text) {
  try {
    readTolerancesText(text, "t.toml", outputs);
  } catch (const StudyError& error) {
    return error.what();
  }
  return "";
}

TEST(Tolerances, AreThoseOfTheGuideWhereNothingIsStated) {
  const Tolerances tolerances = readTolerancesText("", "t.toml", outputs);
  EXPECT_EQ(tolerances.wider, 0.01);
  EXPECT_EQ(tolerances.gap, 0.01);
  EXPECT_EQ(tolerances.shorter, 0);
  EXPECT_FALSE(tolerances.cpu);
  EXPECT_FALSE(tolerances.overestimation);
  EXPECT_EQ(&tolerances.ofOutput("angle"), &tolerances);
}

TEST(Tolerances, OfAnOutputAreItsOwnAndOtherwiseThoseOfAll) {
  const Tolerances tolerances = readTolerancesText(
      "wider = \"2 %\"\nshorter = 0.1\ncpu = 1.5\noverestimation = 0.25\n[output.\"tip z\"]\nwider = 0.5\ngap = 0\n",
      "t.toml", outputs);
  EXPECT_EQ(tolerances.wider, 0.02);
  EXPECT_EQ(tolerances.shorter, 0.1);
  EXPECT_EQ(tolerances.cpu, 1.5);
  EXPECT_EQ(tolerances.ofOutput("angle").wider, 0.02);
  EXPECT_EQ(tolerances.ofOutput("tip z").wider, 0.5);
  EXPECT_EQ(tolerances.ofOutput("tip z").gap, 0);
  EXPECT_EQ(tolerances.ofOutput("tip z").overestimation, 0.25);
}

TEST(Tolerances, RefuseInOneLineWhatTheyDoNotKnow) {
  EXPECT_EQ(complaintOf("widr = 0.1"),
            "t.toml:1:1: unknown key 'widr'; expected 'wider'? (one of: wider, gap, overestimation, shorter, cpu, "
            "output)");
  EXPECT_EQ(complaintOf("\n[output.\"tip x\"]\n"),
            "t.toml:2:9: unknown key 'tip x' in [output]; expected 'tip z'? (one of: tip z, angle)");
  EXPECT_THAT(complaintOf("[output.angle]\ncpu = 2\n"),
              StartsWith("t.toml:2:1: unknown key 'cpu' in [output.\"angle\"]; expected "));
  EXPECT_EQ(complaintOf("wider = -0.1"), "t.toml:1:9: wider is negative; expected 0 or more, such as 0.01 or \"1 %\"");
  EXPECT_EQ(complaintOf("cpu = 0"), "t.toml:1:7: cpu is not positive; expected a number above 0");
  EXPECT_THAT(complaintOf("wider = \"1 mm\""), EndsWith("; expected a number without unit"));
  EXPECT_EQ(complaintOf(std::string("\0", 1)), "t.toml: is no text; expected a file of tolerances (TOML)");
  EXPECT_THAT(complaintOf("output = 3"), StartsWith("t.toml:1:10: output is the number 3; expected a table"));
}

TEST(Tolerances, AreReadFromAFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(readTolerances(folder.write("t.toml", "gap = 0.5\n"), outputs).gap, 0.5);
  EXPECT_THROW(readTolerances(folder.path("none.toml"), outputs), StudyError);
}

}  // namespace
}  // namespace gamut
