// Robots from outside: gamut info shows a URDF file, gamut new writes a study of it that runs, and what is no robot is
// refused in one line.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "tests/commands/program.hpp"
#include "tests/studies/sample_robots.hpp"

namespace gamut {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class RobotCommands : public FromOutside {
 protected:
  void expectRefused(const std::string& arguments, const std::string& error) const {
    const Outcome outcome = gamut(arguments);
    EXPECT_EQ(outcome.exitCode, 2) << arguments;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.error, StartsWith(error));
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  }
};

TEST_F(RobotCommands, InfoShowsTheTree) {
  folder_.write("r.urdf", sampleRobot);
  const Outcome info = gamut("info r.urdf");
  EXPECT_EQ(info.exitCode, 0);
  EXPECT_EQ(info.out,
            R"(sample: 6 links, 3 degrees of freedom, joints: 2 continuous, 1 fixed, 1 prismatic, 1 revolute, 14.15 kg
  ground            10 kg
    upper           2.5 kg   hinge         revolute about (0 0 -1)                        -2 to 2 rad, 100 N m, 3 rad/s
      slide         1.25 kg  slider        prismatic along (0.6 0 0.8)                    -0.5 to 0.75 m, 50 N, 1 m/s
        hand-frame  no mass  weld          fixed
          left      0.2 kg   left-finger   continuous about (1 0 0)
          right     0.2 kg   right-finger  continuous about (1 0 0), follows left-finger
)");
  EXPECT_THAT(info.error, HasSubstr("r.urdf:10: note: <visual>: shapes and meshes are left out\n"));
  folder_.write("robot", sampleRobot);
  EXPECT_EQ(gamut("info robot").out, info.out) << "it is XML, whatever its name";
}

TEST_F(RobotCommands, NewWritesAStudyThatRunsAndRefersToTheFile) {
  std::filesystem::create_directory(folder_.path("robots"));
  std::filesystem::create_directory(folder_.path("studies"));
  folder_.write("robots/r.urdf", sampleRobot);
  const Outcome written = gamut("new studies/arm --robot robots/r.urdf");
  EXPECT_EQ(written.exitCode, 0) << written.error;
  EXPECT_THAT(written.out, StartsWith("studies/arm.toml: a study to start from\n"));
  const std::string study = folder_.read("studies/arm.toml");
  for (const char* line : {"robot = \"../robots/r.urdf\"", "friction = false", "hinge.angle = \"0.2 rad\"",
                           "slider.displacement = \"0 m\"", "left-finger.angle = \"0.2 rad\"",
                           "quantity = \"upper.mass\"\ninterval = \"± 1 %\""})
    EXPECT_THAT(study, HasSubstr(line));
  const Outcome run = gamut("run studies/arm.toml --samples 64 --jobs 2 -o arm.h5 --report arm.html");
  EXPECT_EQ(run.exitCode, 0) << run.error;
  EXPECT_THAT(run.out,
              AllOf(StartsWith("“energy” stays between "), HasSubstr("\nAll 244 sampled motions stay inside")));
  std::filesystem::remove(folder_.path("robots/r.urdf"));
  EXPECT_EQ(gamut("replay arm.h5 0").exitCode, 0) << "the results hold the robot";
  expectRefused("validate studies/arm.toml",
                "studies/arm.toml:11:9: studies/../robots/r.urdf: does not exist; expected");
}

TEST_F(RobotCommands, NewSaysWhatKeepsAStudyFromRunning) {
  folder_.write("r.urdf",
                "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"j\" type=\"continuous\">"
                "<parent link=\"a\"/><child link=\"b\"/></joint></robot>");
  const Outcome written = gamut("new r --urdf r.urdf");
  EXPECT_EQ(written.exitCode, 0);
  EXPECT_THAT(written.error, HasSubstr("note: this study does not run as it is: r.toml:"));
  EXPECT_THAT(written.error, HasSubstr("the joint 'j' moves no mass"));
  expectRefused("new r.urdf --urdf none.urdf",
                "none.urdf: does not exist; expected a robot's description (URDF, MJCF or SDFormat)");
}

TEST_F(RobotCommands, RefuseWhatIsNoRobotInOneLine) {
  folder_.write("bad.urdf", "<robot name=\"r\">\n<link name=\"a\"/>\n<link name=\"b\"/></robot>");
  expectRefused("info bad.urdf", "bad.urdf:3: 'b' has no parent, and 'a' of line 2 has none either; expected one root");
  expectRefused("new r --urdf bad.urdf", "bad.urdf:3: 'b' has no parent");
  EXPECT_FALSE(folder_.has("r.toml"));
  folder_.write("empty.urdf", "");
  expectRefused("info empty.urdf", "empty.urdf:1: not valid XML: there is nothing in it");
  expectRefused("info none.urdf", "none.urdf: does not exist; expected a robot's description (URDF, MJCF or SDFormat)");
  folder_.write("s.toml", "[mechanism]\nurdf = \"bad.urdf\"\n");
  expectRefused("quantities s.toml", "bad.urdf:3: 'b' has no parent");
}

TEST_F(RobotCommands, LookAtALargeFileWithinLittleMemory) {
  std::filesystem::resize_file(folder_.write("large.urdf", "<robot>"), 100'000'000);
  const std::string limited = "ulimit -v 400000; ";
  const Outcome info = gamut("info large.urdf", limited);
  EXPECT_EQ(info.exitCode, 2) << info.error;
  EXPECT_EQ(info.error,
            "large.urdf: has more than 4 MB; expected a robot's description (URDF, MJCF or SDFormat) without meshes\n");
  // As many elements as such a file can hold.
  std::string many = "<robot name=\"r\"><link name=\"a\"/>";
  while (many.size() < 3'990'000) many += "<b/>";
  folder_.write("many.urdf", many + "</robot>");
  const Outcome read = gamut("info many.urdf", limited);
  EXPECT_EQ(read.exitCode, 0) << read.error;
  EXPECT_THAT(read.error, HasSubstr("<b> (99"));
}

}  // namespace
}  // namespace gamut
