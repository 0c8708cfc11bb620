// gamut new: the study that it writes is the shipped one, runs, and is never written over another.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "studies/atomic_file.hpp"
#include "tests/commands/program.hpp"

namespace gamut {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class NewCommand : public FromOutside {
 protected:
  static std::string shippedStudy() {
    std::ifstream file(GAMUT_SOURCE_DIR "/studies/examples/spring_pendulum/study.toml", std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
};

TEST_F(NewCommand, WritesAStudyThatRunsAtOnceAndSaysWhatToDoNext) {
  const Outcome written = gamut("new arm");
  EXPECT_EQ(written.exitCode, 0);
  EXPECT_EQ(written.error, "");
  EXPECT_THAT(written.out, StartsWith("arm.toml: "));
  for (const char* next : {"gamut run arm.toml", "gamut validate arm.toml"}) EXPECT_THAT(written.out, HasSubstr(next));
  EXPECT_EQ(folder_.read("arm.toml"), shippedStudy());
  EXPECT_EQ(gamut("validate arm.toml").exitCode, 0);
  const Outcome run = gamut("run arm.toml --jobs 2");
  EXPECT_EQ(run.exitCode, 0) << run.error;
  EXPECT_THAT(run.out,
              ContainsRegex("All 14[0-9][0-9] sampled motions stay inside the guaranteed enclosure from 0 s to 2 s"));
}

TEST_F(NewCommand, TakesAPathAndAddsToml) {
  std::filesystem::create_directory(folder_.path("machines"));
  EXPECT_EQ(gamut("new machines/left.arm").exitCode, 0);
  EXPECT_TRUE(folder_.has("machines/left.arm.toml"));
  EXPECT_EQ(gamut("new arm.toml").exitCode, 0);
  EXPECT_TRUE(folder_.has("arm.toml"));
  EXPECT_FALSE(folder_.has("arm.toml.toml"));
  EXPECT_THAT(gamut("new \"the machine's arm\"").out, HasSubstr("gamut run 'the machine'\\''s arm.toml' "));
  EXPECT_TRUE(folder_.has("the machine's arm.toml"));
  EXPECT_EQ(gamut("new -").out, shippedStudy());
}

TEST_F(NewCommand, OverwritesOnlyWhenForced) {
  folder_.write("arm.toml", "precious");
  const Outcome refused = gamut("new arm");
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_EQ(refused.out, "");
  EXPECT_EQ(refused.error, "gamut: arm.toml: exists already; expected another name, or --force\n");
  EXPECT_EQ(folder_.read("arm.toml"), "precious");
  EXPECT_EQ(gamut("new arm --force").exitCode, 0);
  EXPECT_EQ(folder_.read("arm.toml"), shippedStudy());
}

TEST_F(NewCommand, RefusesInOneLineWhatIsNoName) {
  for (const char* arguments : {"", "''", ".", "..", "none/", "none/arm", "one two", "--arm"}) {
    SCOPED_TRACE(arguments);
    const Outcome refused = gamut("new " + std::string(arguments));
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_EQ(refused.out, "");
    EXPECT_THAT(refused.error, StartsWith("gamut: "));
    EXPECT_EQ(refused.error.find('\n'), refused.error.size() - 1);
  }
  EXPECT_EQ(folder_.count(), 0U);
}

TEST_F(NewCommand, WritesTheWholeStudyOrNone) {
  const Outcome run = gamut("new arm", "ulimit -f 1 && ");
  EXPECT_EQ(run.exitCode, 4);
  EXPECT_THAT(run.error, StartsWith("gamut: arm.toml: cannot be written; "));
  EXPECT_EQ(folder_.count(), 0U);
}

}  // namespace
}  // namespace gamut
