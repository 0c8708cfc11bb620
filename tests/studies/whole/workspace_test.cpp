// Studies of what outputs can reach: bounds of areas against closed forms in 34 digits, and what is refused.
#include <gmock/gmock.h>

#include <string>

#include "analyses/samples/arbiter.hpp"
#include "studies/analyses/workspace.hpp"
#include "studies/machine.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"

namespace gamut::workspaces {
namespace {

using ::testing::HasSubstr;
using Number = Precise;

std::string hinge(const std::string& name, const std::string& from, const std::string& to) {
  return "[[mechanism.element]]\ntype = \"revolute\"\nname = \"" + name + "\"\nfrom = \"" + from + "\"\nto = \"" + to +
         "\"\naxis = \"z\"\n";
}

std::string link(const std::string& name, const std::string& from, const std::string& to, const std::string& length) {
  return "[[mechanism.element]]\ntype = \"link\"\nname = \"" + name + "\"\nfrom = \"" + from + "\"\nto = \"" + to +
         "\"\nvector = [\"" + length + "\", 0, 0]\n";
}

/// Of two links; places in cm.
std::string studyOf(const std::string& asked, const std::string& analysis = "kinematics") {
  return "[study]\nanalysis = \"" + analysis + "\"\ncompare = [\"interval\"]\n[workspace]\n" + asked +
         "[mechanism]\nparameters = { a = \"0.5 m\", b = \"0.3 m\" }\n" + hinge("A", "inertial", "K1") +
         link("l1", "K1", "E", "a") + hinge("B", "E", "K2") + link("l2", "K2", "tool", "b") +
         "[[uncertain]]\nquantity = \"b\"\ninterval = \"± 1 %\"\n"
         "[[output]]\nname = \"x\"\nquantity = \"tool.position.x\"\nunit = \"cm\"\n"
         "[[output]]\nname = \"y\"\nquantity = \"tool.position.y\"\nunit = \"cm\"\n"
         "[[output]]\nname = \"angle\"\nquantity = \"A.angle + B.angle\"\n"
         "[[output]]\nname = \"still\"\nquantity = \"tool.position.z\"\n";
}

Results runOf(const std::string& text) { return run(Machine(readStudyText(text, "s.toml")), {}); }

/// A ring between a - b and a + b, cm².
TEST(Workspace, HasTheAreaOfARing) {
  const Results results = runOf(studyOf("outputs = [\"x\", \"y\"]\ncells = 32\n"));
  const WorkspaceResult& found = results.of<WorkspaceResult>();
  ASSERT_EQ(found.reached.data.size(), 1024);
  const Number circle = 4 * atan(Number(1));
  const auto area = [&](const Number& inner, const Number& outer) { return circle * (outer * outer - inner * inner); };
  const Number b("0.3"), part("0.01");
  // For all values of b between the inner circle of the least b and the outer one of it; for any, of the greatest.
  EXPECT_LE(Number(found.least), area(50 - 100 * b * (1 - part), 50 + 100 * b * (1 - part)));
  EXPECT_GE(Number(found.most), area(50 - 100 * b * (1 + part), 50 + 100 * b * (1 + part)));
  EXPECT_GT(found.least, 14000);
  EXPECT_LT(found.most, 22000);
  EXPECT_EQ(found.unitOfArea(), "cm²");
  EXPECT_EQ(found.why, "");
}

/// Angles of joints are numbers: their sum goes from one end to the other, over more than a turn.
TEST(Workspace, OfAnglesIsTheirRange) {
  const Results results = runOf(studyOf("outputs = [\"angle\"]\nranges = { A = [-1, 2] }\nangles = \"180 deg\"\n"));
  const WorkspaceResult& found = results.of<WorkspaceResult>();
  const Number whole = 3 + 8 * atan(Number(1));
  EXPECT_LE(Number(found.least), whole);
  EXPECT_GE(Number(found.most), whole);
  EXPECT_GT(Number(found.least), whole * Number("0.9"));
  EXPECT_EQ(found.second, "");
  EXPECT_EQ(found.unitOfArea(), "rad");
}

TEST(Workspace, SaysWhatIsTheSameEverywhere) {
  const Results results = runOf(studyOf("outputs = [\"still\"]\n"));
  EXPECT_EQ(results.of<WorkspaceResult>().why, "'still' is the same everywhere");
  EXPECT_TRUE(results.of<WorkspaceResult>().told().empty());
}

TEST(Workspace, IsRefusedWithTheKeyInPlace) {
  const auto refusalOf = [](const std::string& text) -> std::string {
    try {
      readStudyText(text, "s.toml");
    } catch (const StudyError& error) {
      return error.what();
    }
    return "it was read";
  };
  EXPECT_THAT(refusalOf(studyOf("outputs = [\"z\"]\n")), HasSubstr("s.toml:5:11: unknown output 'z'"));
  EXPECT_THAT(refusalOf(studyOf("outputs = [\"x\", \"x\"]\n")), HasSubstr("names 'x' twice; expected two outputs"));
  EXPECT_THAT(refusalOf(studyOf("outputs = []\n")), HasSubstr("workspace.outputs has 0 entries; expected 1 to 2"));
  EXPECT_THAT(refusalOf(studyOf("angles = 1\n")), HasSubstr("workspace.outputs is not said"));
  EXPECT_THAT(refusalOf(studyOf("outputs = [\"x\"]\ncells = 2\n")), HasSubstr("workspace.cells"));
  EXPECT_THAT(refusalOf(studyOf("outputs = [\"x\"]\nranges = { C = [0, 1] }\n")), HasSubstr("'C'"));
}

}  // namespace
}  // namespace gamut::workspaces
