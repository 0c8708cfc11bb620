// gamut compare from outside: what it says of two runs, by what exit code, and what it refuses.
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "studies/results/results_file.hpp"
#include "tests/commands/program.hpp"
#include "tests/studies/sample_results.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;

class CompareCommand : public FromOutside {
 protected:
  /// Runs a study into NAME.h5.
  void run(const std::string& name, const std::string& study, const std::string& options = "") const {
    folder_.write(name + ".toml", study);
    EXPECT_EQ(gamut("run " + name + ".toml --quiet --force " + options).exitCode, 0);
  }
};

TEST_F(CompareCommand, FindsNothingBetweenARunAndItselfOrAnotherSeed) {
  run("a", sampleStudy);
  run("b", sampleStudy, "--seed 3 --samples 64");
  const std::string same = "The same question: the studies are the same, word for word.\n";
  const Outcome itself = gamut("compare a.h5 a.h5"), other = gamut("compare a.h5 b.h5");
  EXPECT_EQ(itself.exitCode, 0) << itself.out;
  EXPECT_EQ(other.exitCode, 0) << other.out;
  EXPECT_THAT(itself.out, HasSubstr(same + "Nothing"));
  EXPECT_THAT(other.out, HasSubstr(same + "Other samples: seed 7 in A, 3 in B; number 16 in A, 64 in B.\nNothing"));
}

TEST_F(CompareCommand, SaysWhatBecameWiderAndWhatIsTolerated) {
  run("a", sampleStudy);
  run("b", sampleStudyWith("± 1 %", "± 2 %"));
  const Outcome wider = gamut("compare a.h5 b.h5");
  EXPECT_EQ(wider.exitCode, 1);
  EXPECT_THAT(wider.out,
              HasSubstr("wider intervals in B, which hold those of A.\nNothing contradicts, but B is worse"));
  EXPECT_THAT(wider.out, HasSubstr("  worse: angle: the enclosure is "));
  EXPECT_EQ(gamut("compare b.h5 a.h5").exitCode, 0);
  folder_.write("t.toml", "wider = 2\n[output.angle]\nwider = \"300 %\"\n");
  EXPECT_EQ(gamut("compare a.h5 b.h5 --tolerances t.toml").exitCode, 0);
}

TEST_F(CompareCommand, FindsALostVerdictWorse) {
  run("a", sampleStudy);
  run("b", sampleStudyWith("\"interval\", \"stochastic\", \"fuzzy\"", "\"stochastic\""));
  const Outcome lost = gamut("compare a.h5 b.h5");
  EXPECT_EQ(lost.exitCode, 1);
  EXPECT_THAT(lost.out, HasSubstr("  worse: verdict: inside in A, none in B\n"));
  EXPECT_EQ(gamut("compare b.h5 a.h5").exitCode, 0);
}

TEST_F(CompareCommand, TellsAProofOfAnErrorFromModelsThatDiffer) {
  run("a", sampleStudy);
  Results results = readResults(folder_.path("a.h5"));
  results.interval.at.lower(3, 0) = results.interval.at.upper(3, 0) += 1;
  writeResults(results, folder_.path("b.h5"));
  const Outcome proof = gamut("compare a.h5 b.h5");
  EXPECT_EQ(proof.exitCode, 1);
  EXPECT_THAT(proof.out, HasSubstr("\nOne of both is wrong: "));
  EXPECT_THAT(proof.out, HasSubstr("\n  angle: the enclosures have no value in common at 0.3 s: ["));
  run("c", sampleStudyWith("-9.81", "-8.5"));
  const Outcome models = gamut("compare a.h5 c.h5");
  EXPECT_EQ(models.exitCode, 1);
  EXPECT_THAT(
      models.out,
      HasSubstr("of another motion: gravity.z is -9.81 m/s^2 in A, -8.5 m/s^2 in B.\nA and B are proved to differ"));
}

TEST_F(CompareCommand, PrintsOneJsonObject) {
  run("a", sampleStudy);
  run("b", sampleStudyWith("± 1 %", "± 2 %"));
  const Outcome compared = gamut("compare a.h5 b.h5 --json");
  EXPECT_EQ(compared.exitCode, 1);
  EXPECT_EQ(compared.out.find('\n'), compared.out.size() - 1);
  const Json json = Json::parse(compared.out);
  EXPECT_EQ(json["verdict"], "worse");
  EXPECT_EQ(json["question"]["first_in_second"], true);
  EXPECT_EQ(json["question"]["same"], false);
  EXPECT_GT(json["outputs"]["angle"]["enclosure"]["greatest"], 1.9);
  EXPECT_EQ(json["worse"][0]["of"], "wider");
  EXPECT_TRUE(json["contradictions"].empty());
}

TEST_F(CompareCommand, RefusesInOneLine) {
  run("a", sampleStudy);
  writeResults(sampleResults(), folder_.path("c.h5"));
  folder_.write("t.toml", "widr = 1\n");
  const auto refuses = [&](const std::string& arguments, const std::string& line) {
    const Outcome compared = gamut("compare " + arguments);
    EXPECT_EQ(compared.exitCode, 2) << arguments;
    EXPECT_EQ(compared.out, "");
    EXPECT_EQ(compared.error, line + "\n");
  };
  refuses("a.h5 none.h5", "none.h5: does not exist; expected a results file written by gamut run");
  refuses("a.toml a.h5", "a.toml: not a Gamut results file; expected a results file written by gamut run");
  refuses("a.h5", "gamut: B.h5 is missing; see gamut compare --help");
  run("d", sampleStudyWith("name = \"angle\"\nquantity = \"hinge.angle\"\n[[output]]\nquantity = \"tip.position.z\"",
                           "name = \"angle\"\nquantity = \"hinge.rate\""));
  refuses("a.h5 d.h5",
          "gamut: a.h5 and d.h5: the output 'angle' is in rad in the first and in rad/s in the second; expected units "
          "of one kind");
  refuses("a.h5 c.h5",
          "gamut: a.h5 and c.h5: no output is in both; expected results of studies with outputs of the same name");
  refuses("a.h5 a.h5 --tolerances t.toml",
          "t.toml:1:1: unknown key 'widr'; expected 'wider'? (one of: wider, gap, overestimation, shorter, cpu, "
          "output)");
}

/// Another unit is no other quantity: of one kind it is compared, of another that output alone is left out.
TEST_F(CompareCommand, ComparesInTheUnitsOfTheFirst) {
  run("a", sampleStudy);
  run("b", sampleStudyWith("quantity = \"tip.position.z\"", "quantity = \"tip.position.z\"\nunit = \"mm\""));
  const Outcome compared = gamut("compare a.h5 b.h5");
  EXPECT_EQ(compared.exitCode, 0) << compared.out;
  EXPECT_THAT(compared.out, HasSubstr("output tip.position.z is in mm in B; it is compared in m\n"));
  EXPECT_THAT(compared.out, HasSubstr("tip.position.z (m)"));
  EXPECT_EQ(compared.out.find("not compared"), std::string::npos);
  EXPECT_THAT(gamut("compare b.h5 a.h5").out, HasSubstr("output tip.position.z is in m in B; it is compared in mm\n"));
  EXPECT_EQ(gamut("report a.h5 b.h5").exitCode, 0);
  EXPECT_THAT(folder_.read("a-and-b.html"), HasSubstr("it is compared in m"));
  run("c",
      sampleStudyWith("name = \"angle\"\nquantity = \"hinge.angle\"", "name = \"angle\"\nquantity = \"hinge.rate\""));
  EXPECT_THAT(gamut("compare a.h5 c.h5").out,
              HasSubstr("output angle is in rad in A and in rad/s in B, so not compared\n"));
}

TEST_F(CompareCommand, ReportPutsTwoBesideEachOther) {
  run("a", sampleStudy);
  run("b", sampleStudyWith("± 1 %", "± 2 %"));
  const Outcome written = gamut("report a.h5 b.h5");
  EXPECT_EQ(written.exitCode, 0) << written.error;
  EXPECT_EQ(written.out, "a-and-b.html\n");
  EXPECT_THAT(folder_.read("a-and-b.html"),
              ::testing::AllOf(HasSubstr("<b>guaranteed, wider:</b> angle (2"), HasSubstr("wider intervals in B"),
                               HasSubstr("class=\"of-b")));
  EXPECT_EQ(gamut("report a.h5 b.h5").exitCode, 2) << "it is there";
  EXPECT_EQ(gamut("report a.h5 b.h5 -o page.html").out, "page.html\n");
  EXPECT_EQ(gamut("report a.h5 b.h5 -o b.h5 --force").error, "gamut: b.h5: cannot be written; it is the input\n");
  folder_.write("torn.h5", "no results");  // what cannot be written is refused before anything is read
  EXPECT_EQ(gamut("report a.h5 torn.h5 -o a.h5 --force").error, "gamut: a.h5: cannot be written; it is the input\n");
  EXPECT_EQ(gamut("report torn.h5 a.h5 -o a.h5 --force").error, "gamut: a.h5: cannot be written; it is the input\n");
  EXPECT_THAT(gamut("report torn.h5 -o page.html").error, StartsWith("gamut: page.html: exists already"));
  EXPECT_EQ(gamut("report torn.h5 -o other.html").exitCode, 2);
  EXPECT_FALSE(folder_.has("other.html"));
  run("c", sampleStudyWith("name = \"angle\"\nquantity = \"hinge.angle\"\n[[output]]\nquantity = \"tip.position.z\"",
                           "name = \"other\"\nquantity = \"hinge.angle\""));
  const Outcome nothing = gamut("report a.h5 c.h5");
  EXPECT_EQ(nothing.exitCode, 2);
  EXPECT_THAT(nothing.error, StartsWith("gamut: a.h5 and c.h5: "));
  EXPECT_EQ(nothing.error.find('\n'), nothing.error.size() - 1);
  EXPECT_FALSE(folder_.has("a-and-c.html"));
}

}  // namespace
}  // namespace gamut
