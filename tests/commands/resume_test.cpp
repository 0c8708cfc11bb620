// Runs that are killed at any moment and go on: the same results bit for bit as of one that was not.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "studies/results/results_file.hpp"
#include "tests/commands/program.hpp"
#include "tests/commands/started_program.hpp"
#include "tests/studies/long_study.hpp"

namespace gamut::resume_test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Words = std::vector<std::string>;

class Resume : public FromOutside {
 protected:
  Resume() {
    folder_.write("s.toml", longStudy());
    const Outcome whole = gamut("run s.toml --quiet -o whole.h5 --report whole.html --checkpoint off");
    code_ = whole.exitCode;
    EXPECT_THAT(code_, AnyOf(0, 3)) << whole.error;
    whole_ = readResults(folder_.path("whole.h5"));
  }

  bool isThere(const std::string& name) const { return std::filesystem::exists(folder_.path(name)); }

  /// Starts it, and kills it after so many seconds of work. The exit code, or -SIGKILL.
  int killed(Words words, double seconds, int signal = SIGKILL) const {
    for (const char* word : {"--quiet", "--jobs"}) words.emplace_back(word);
    words.emplace_back(seconds < 0.3 ? "1" : "2");
    StartedProgram program(folder_, words);
    program.awaitWork();
    program.signalAfter(seconds, signal);
    return program.wait();
  }

  /// Killed at one moment or another.
  void leaveACheckpoint(const Words& words) const {
    for (int i = 0; i < 40 && !isThere("s.h5.checkpoint"); ++i) {
      forget();
      killed(words, (0.1 + 0.02 * i) * whole_.cpu);
    }
    ASSERT_TRUE(isThere("s.h5.checkpoint"));
    ASSERT_FALSE(isThere("s.h5"));
  }

  void expectTheSame() const {
    EXPECT_THAT(differencesButCosts(readResults(folder_.path("s.h5")), whole_), IsEmpty());
    EXPECT_TRUE(isThere("s.html"));
    EXPECT_FALSE(isThere("s.h5.checkpoint"));
  }

  void forget() const {
    for (const char* name : {"s.h5", "s.html", "s.h5.checkpoint"}) std::filesystem::remove(folder_.path(name));
  }

  int code_ = -1;
  Results whole_;
};

TEST_F(Resume, EndsWithTheSameBitsWheneverItIsKilled) {
  std::mt19937 random(20261130);  // NOLINT(cert-msc*): the same moments in every run
  std::uniform_real_distribution<double> moment(0, 0.9 * whole_.cpu);
  int resumed = 0;
  for (int i = 0; i < 30; ++i) {
    const double first = moment(random), second = moment(random);
    SCOPED_TRACE(fmt::format("killed after {:.3f} s, and after {:.3f} s more", first, second));
    int code = killed({"run", "s.toml", "--checkpoint", "0.02"}, first);
    EXPECT_THAT(code, AnyOf(code_, -SIGKILL));
    if (code == -SIGKILL && i % 3 == 0 && isThere("s.h5.checkpoint")) code = killed({"resume", "s.h5"}, second);
    if (isThere("s.h5.checkpoint")) {
      const bool isWritten = isThere("s.h5");  // it was killed behind that
      const Outcome end = gamut(isWritten ? "resume s.h5 --quiet --force" : "resume s.h5 --quiet");
      EXPECT_EQ(end.exitCode, code_) << end.error;
      EXPECT_EQ(end.error, "");
      ++resumed;
    } else if (code == -SIGKILL && !isThere("s.h5")) {
      EXPECT_EQ(gamut("resume s.h5").exitCode, 2);  // before its first record
      EXPECT_EQ(gamut("run s.toml --quiet").exitCode, code_);
    }
    if (isThere("s.html")) expectTheSame();
    forget();
  }
  EXPECT_GE(resumed, 5);
}

TEST_F(Resume, AddsUpWhatBothProcessesTook) {
  leaveACheckpoint({"run", "s.toml", "--checkpoint", "0.02"});
  EXPECT_EQ(gamut("resume s.h5 --quiet").exitCode, code_);
  expectTheSame();
  // What it took is that of both.
  EXPECT_GT(readResults(folder_.path("s.h5")).cpu, 0.3 * whole_.cpu);
}

TEST_F(Resume, NeedsNoStudyFileAndTakesAnotherNameForThePage) {
  leaveACheckpoint({"run", "s.toml", "--checkpoint", "0.02", "--samples", "3000"});
  std::filesystem::remove(folder_.path("s.toml"));
  EXPECT_EQ(gamut("resume s.h5 --report other.html").exitCode, code_);
  EXPECT_TRUE(isThere("other.html"));
  const Results results = readResults(folder_.path("s.h5"));
  EXPECT_EQ(results.stochastic.samples, 3008);
  EXPECT_EQ(results.studyFile, "s.toml");
  EXPECT_EQ(results.studyText, whole_.studyText);
}

/// An extension that was killed, of results in their place and of such as are written elsewhere.
TEST_F(Resume, GoesOnWithMoreSamples) {
  const Outcome more = gamut("extend whole.h5 --samples 30000 --quiet -o more.h5");
  EXPECT_THAT(more.exitCode, AnyOf(0, 3)) << more.error;
  const Results longer = readResults(folder_.path("more.h5"));
  const double cpu = longer.extensions.back().cpu;
  for (const bool isInPlace : {true, false}) {
    SCOPED_TRACE(isInPlace);
    Words words{"extend", "whole.h5", "--samples", "30000", "--checkpoint", "0.02", "-o", "s.h5"};
    if (isInPlace) words = {"extend", "s.h5", "--samples", "30000", "--checkpoint", "0.02"};
    for (int i = 0; i < 40 && !isThere("s.h5.checkpoint"); ++i) {
      forget();
      if (isInPlace) std::filesystem::copy_file(folder_.path("whole.h5"), folder_.path("s.h5"));
      killed(words, (0.2 + 0.02 * i) * cpu);
    }
    ASSERT_TRUE(isThere("s.h5.checkpoint"));
    EXPECT_THAT(gamut("extend whole.h5 --samples 30000 -o s.h5").error, HasSubstr(isInPlace ? "exists" : "was killed"));
    const Outcome end = gamut("resume s.h5 --quiet");
    EXPECT_EQ(end.exitCode, more.exitCode) << end.error;
    EXPECT_EQ(end.error, "");
    EXPECT_THAT(differencesButCosts(readResults(folder_.path("s.h5")), longer), IsEmpty());
    EXPECT_TRUE(isThere("s.html"));
    EXPECT_FALSE(isThere("s.h5.checkpoint"));
    EXPECT_GT(readResults(folder_.path("s.h5")).extensions.back().cpu, 0.3 * cpu);  // of both processes
  }
}

/// A signal keeps what a kill would, where there is nothing to write yet.
TEST_F(Resume, GoesOnWithMoreSamplesAfterASignal) {
  EXPECT_THAT(gamut("extend whole.h5 --samples 30000 --quiet -o more.h5").exitCode, AnyOf(0, 3));
  const Results longer = readResults(folder_.path("more.h5"));
  for (int i = 0; i < 60 && !isThere("s.h5.checkpoint"); ++i) {
    forget();
    const Words words{"extend", "whole.h5", "--samples", "30000", "--checkpoint", "0.005", "-o", "s.h5"};
    EXPECT_THAT(killed(words, 0.02 + 0.005 * i, SIGTERM), AnyOf(3, -SIGTERM));
    EXPECT_FALSE(isThere("s.h5.checkpoint") && isThere("s.h5"));
  }
  ASSERT_TRUE(isThere("s.h5.checkpoint"));
  const Outcome end = gamut("resume s.h5 --quiet");
  EXPECT_EQ(end.error, "");
  EXPECT_THAT(differencesButCosts(readResults(folder_.path("s.h5")), longer), IsEmpty());
  EXPECT_FALSE(isThere("s.h5.checkpoint"));
}

/// Results are replaced where they were extended in place, a page of another name is not; a link stands for its file.
TEST_F(Resume, ReplacesNoPageUnasked) {
  leaveACheckpoint({"run", "s.toml", "--checkpoint", "0.02"});
  std::filesystem::create_symlink("s.h5", folder_.path("link.h5"));
  EXPECT_THAT(gamut("run s.toml -o link.h5").error,
              HasSubstr("s.h5.checkpoint: is of a run that was killed; expected"));
  EXPECT_TRUE(isThere("s.h5.checkpoint"));
  EXPECT_EQ(gamut("resume link.h5 --quiet").exitCode, code_);
  std::filesystem::remove(folder_.path("link.h5"));
  expectTheSame();
  for (int i = 0; i < 40 && !isThere("s.h5.checkpoint"); ++i) {
    forget();
    std::filesystem::copy_file(folder_.path("whole.h5"), folder_.path("s.h5"));
    killed({"extend", "s.h5", "--samples", "30000", "--checkpoint", "0.02"}, 0.3 + 0.02 * i);
  }
  ASSERT_TRUE(isThere("s.h5.checkpoint"));
  folder_.write("notes.html", "mine");
  const Outcome refused = gamut("resume s.h5 --report notes.html");
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_THAT(refused.error, HasSubstr("notes.html"));
  EXPECT_EQ(folder_.read("notes.html"), "mine");
  EXPECT_THAT(gamut("resume s.h5 --quiet").exitCode, AnyOf(0, 3));
  EXPECT_FALSE(isThere("s.h5.checkpoint"));
}

TEST_F(Resume, RefusesOtherResultsThanWereExtended) {
  for (int i = 0; i < 40 && !isThere("s.h5.checkpoint"); ++i) {
    forget();
    killed({"extend", "whole.h5", "--samples", "30000", "--checkpoint", "0.02", "-o", "s.h5"}, 0.3 + 0.02 * i);
  }
  ASSERT_TRUE(isThere("s.h5.checkpoint"));
  gamut("run s.toml --quiet --force -o whole.h5 --samples 100");
  const Outcome other = gamut("resume s.h5");
  EXPECT_EQ(other.exitCode, 2);
  EXPECT_THAT(other.error, HasSubstr("whole.h5: is not what it was when s.h5.checkpoint began; expected the results"));
  EXPECT_TRUE(isThere("s.h5.checkpoint"));
}

TEST_F(Resume, SaysWhatThereIsInstead) {
  const auto said = [&](const std::string& arguments) {
    const Outcome run = gamut(arguments);
    EXPECT_EQ(run.exitCode, 2) << arguments;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.error.find('\n'), run.error.size() - 1) << run.error;
    return run.error;
  };
  EXPECT_EQ(said("resume s.h5"),
            "gamut: s.h5.checkpoint: is not there, and neither is s.h5: run the study again; expected the results of a "
            "run that was killed after its first checkpoint\n");
  EXPECT_THAT(
      said("resume whole.h5"),
      HasSubstr(
          "whole.h5.checkpoint: is not there, whole.h5 is there, to which gamut extend brings more samples; expected"));
  folder_.write("s.h5.checkpoint", "something else");
  EXPECT_THAT(said("resume s.h5"), HasSubstr("s.h5.checkpoint: is no checkpoint"));
  EXPECT_THAT(said("run s.toml"), HasSubstr("s.h5.checkpoint: is of a run that was killed; expected gamut resume s.h5, "
                                            "another name, or --force"));
  EXPECT_THAT(said("run s.toml --checkpoint 0"), HasSubstr("--checkpoint: '0' is no time above 0, or off"));
  EXPECT_THAT(said("run s.toml --checkpoint '2 kg'"), HasSubstr("'2 kg' is no time above 0, or off"));
  EXPECT_EQ(gamut("run s.toml --quiet --force --samples 16").exitCode, code_);
  EXPECT_FALSE(isThere("s.h5.checkpoint"));
}

TEST_F(Resume, ADiskThatIsFullCostsCheckpointsNotTheRun) {
  const Outcome run = gamut("run s.toml --quiet --checkpoint 0.02", "ulimit -f 2000; ");
  EXPECT_EQ(run.exitCode, code_) << run.error;
  EXPECT_THAT(run.error, HasSubstr("note: s.h5.checkpoint cannot be written (File too large); the run goes on"));
  expectTheSame();
}

}  // namespace
}  // namespace gamut::resume_test
