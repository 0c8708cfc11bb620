// gamut extend from outside: which files it writes, what it says, and what it refuses.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "studies/results/results_file.hpp"
#include "tests/commands/program.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using Json = nlohmann::json;

class ExtendCommand : public FromOutside {
 protected:
  ExtendCommand() {
    folder_.write("s.toml", sampleStudy);
    EXPECT_EQ(gamut("run s.toml --quiet").exitCode, 0);
  }

  Results results(const std::string& name = "s.h5") const { return readResults(folder_.path(name)); }

  /// In one line, and nothing is touched.
  void refuses(const std::string& arguments, const std::string& line) const {
    const std::string before = folder_.read("s.h5"), page = folder_.read("s.html");
    const auto count = folder_.count();
    const Outcome extended = gamut("extend " + arguments);
    EXPECT_EQ(extended.exitCode, 2) << arguments;
    EXPECT_EQ(extended.out, "");
    EXPECT_EQ(extended.error, line + "\n");
    EXPECT_TRUE(folder_.read("s.h5") == before && folder_.read("s.html") == page);
    EXPECT_EQ(folder_.count(), count);
  }
};

TEST_F(ExtendCommand, ReplacesResultsAndReport) {
  const std::string page = folder_.read("s.html");
  const Outcome extended = gamut("extend s.h5 --samples 100");
  EXPECT_EQ(extended.exitCode, 0) << extended.error;
  EXPECT_EQ(extended.error, "");
  EXPECT_THAT(extended.out, HasSubstr("All 144 sampled motions stay inside"));
  EXPECT_THAT(extended.out, EndsWith("  results: s.h5\n  report:  s.html\n"));
  EXPECT_EQ(results().stochastic.samples, 112);  // in batches of 16
  EXPECT_NE(folder_.read("s.html"), page);
  EXPECT_THAT(folder_.read("s.html"), HasSubstr("from 16 samples, by Gamut "));
  EXPECT_EQ(folder_.count(), 3U);
  EXPECT_EQ(gamut("check s.h5").exitCode, 0);
  EXPECT_EQ(gamut("replay s.h5 111").error, "");
  EXPECT_THAT(gamut("info s.h5").out, HasSubstr("\n  extended from 16 samples by Gamut "));
}

TEST_F(ExtendCommand, WritesElsewhereAndOverwritesOnlyWhenForced) {
  const std::string before = folder_.read("s.h5");
  EXPECT_EQ(gamut("extend s.h5 --samples 64 -o t.h5 --quiet").out, "");
  EXPECT_EQ(folder_.read("s.h5"), before);
  EXPECT_EQ(results("t.h5").stochastic.samples, 64);
  EXPECT_TRUE(folder_.has("t.html"));
  EXPECT_EQ(gamut("extend s.h5 --samples 96 -o t.h5 --quiet").exitCode, 2);
  EXPECT_EQ(results("t.h5").stochastic.samples, 64);
  const Outcome forced = gamut("extend s.h5 --samples 96 -o t.h5 --force --json");
  EXPECT_EQ(forced.exitCode, 0);
  const Json json = Json::parse(forced.out);
  EXPECT_EQ(json["verdict"], "inside");
  EXPECT_EQ(json["samples"], 96);
  EXPECT_EQ(json["files"]["results"], "t.h5");
}

TEST_F(ExtendCommand, RefusesInOneLine) {
  refuses("s.h5", "gamut: --samples is missing; see gamut extend --help");
  refuses("none.h5 --samples 64", "none.h5: does not exist; expected a results file written by gamut run");
  refuses("s.h5 --samples 16", "gamut: s.h5: holds 16 samples, and would hold 16; expected more");
  refuses("s.h5 --samples 8", "gamut: s.h5: holds 16 samples, and would hold 8; expected more");
  refuses("s.h5 --samples 64 --report s.h5", "gamut: s.h5: is both results and report; expected two names");
  refuses("s.h5 --samples 64 -o s.h5 --force", "gamut: s.h5: cannot be written; it is the input");
  folder_.write("t.toml", sampleStudyWith("\"sobol\"", "\"latin-hypercube\""));
  EXPECT_EQ(gamut("run t.toml --quiet").exitCode, 0);
  refuses("t.h5 --samples 64",
          "gamut: t.h5: its samples are of the plan latin-hypercube, by which more samples lie elsewhere, all of them; "
          "expected sobol, halton or random, or run the study again");
  folder_.write("u.toml", sampleStudyWith(R"(["interval", "stochastic", "fuzzy"])", R"(["interval"])"));
  EXPECT_EQ(gamut("run u.toml --quiet").exitCode, 0);
  refuses("u.h5 --samples 64",
          "gamut: u.h5: holds no samples; expected results of a study that compares \"stochastic\"");
}

TEST_F(ExtendCommand, WritesNothingWhenItEndsBeforeTheSamplesCameAgain) {
  const std::string before = folder_.read("s.h5");
  const Outcome ended = gamut("extend s.h5 --samples 1000000 --time-limit 1e-6");
  EXPECT_EQ(ended.exitCode, 3);
  EXPECT_THAT(ended.error, HasSubstr("before the 48 samples that it holds had come again; nothing was written\n"));
  EXPECT_EQ(folder_.read("s.h5"), before);
}

TEST_F(ExtendCommand, KeepsWhatWasFoundBeforeALimitBesideWholeResults) {
  const std::string before = folder_.read("s.h5"), page = folder_.read("s.html");
  const Outcome ended = gamut("extend s.h5 --samples 10000000 --time-limit 1.5 --json");
  EXPECT_EQ(ended.exitCode, 3);
  EXPECT_THAT(ended.error,
              HasSubstr("note: the time limit of 1.5 s CPU for the whole run was reached: s.h5 stays, which "
                        "is of a run that was not stopped; what was found is in s.partial.h5\n"));
  EXPECT_TRUE(folder_.read("s.h5") == before && folder_.read("s.html") == page);
  EXPECT_GT(results("s.partial.h5").stochastic.integrated, 256);
  EXPECT_EQ(gamut("check s.partial.h5").exitCode, 3);
  const Json json = Json::parse(ended.out);
  EXPECT_EQ(json["stopped"], "the time limit of 1.5 s CPU for the whole run was reached");
  EXPECT_EQ(json["files"]["results"], "s.partial.h5");
  EXPECT_EQ(json["files"]["report"], "s.partial.html");
}

TEST_F(ExtendCommand, BringsStoppedResultsToTheirEnd) {
  const std::int64_t whole = results().stochastic.integrated;
  gamut("extend s.h5 --samples 10000000 --time-limit 1.5 --quiet");
  Results part = results("s.partial.h5");
  EXPECT_EQ(gamut("extend s.partial.h5 --samples 10000000 --time-limit 1 --quiet").exitCode, 3);
  EXPECT_GE(results("s.partial.h5").stochastic.integrated, part.stochastic.integrated);
  Results stopped = results();
  stopped.stopped = stopped.stochastic.stopped = "the run was interrupted";
  stopped.stochastic.integrated = whole - 1;
  writeResults(stopped, folder_.path("s.h5"));
  EXPECT_EQ(gamut("check s.h5").exitCode, 3);
  EXPECT_EQ(gamut("extend s.h5 --samples 16 --quiet").exitCode, 0);
  EXPECT_EQ(results().stopped, "");
  EXPECT_EQ(results().stochastic.integrated, whole);
}

TEST_F(ExtendCommand, SaysThatABoundIsLeft) {
  Results tampered = results();
  tampered.interval.at.upper(3, 0) = tampered.stochastic.mean(3, 0);
  writeResults(tampered, folder_.path("s.h5"));
  const Outcome extended = gamut("extend s.h5 --samples 64");
  EXPECT_EQ(extended.exitCode, 1);
  EXPECT_EQ(results().comparison.verdict, Agreement::outside);
}

TEST_F(ExtendCommand, NotesThatSamplesAreNotTheSame) {
  EXPECT_EQ(gamut("run s.toml --samples 64 --force --quiet").exitCode, 0);
  Results other = results();
  other.host = "elsewhere";
  for (double& number : other.stochastic.kept.motions) number *= 1 + 1e-15;
  writeResults(other, folder_.path("s.h5"));
  const Outcome extended = gamut("extend s.h5 --samples 128");
  EXPECT_EQ(extended.exitCode, 0);
  EXPECT_THAT(extended.error, HasSubstr(" are not the same bit for bit; they were taken by Gamut "));
  EXPECT_THAT(extended.error, HasSubstr(" on elsewhere, this is Gamut "));
}

}  // namespace
}  // namespace gamut
