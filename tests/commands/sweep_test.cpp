// gamut sweep from outside: one command, whatever comes in between.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "studies/sweeps/sweep_file.hpp"
#include "tests/commands/program.hpp"
#include "tests/commands/started_program.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/sweep_bits.hpp"

namespace gamut::sweep_command_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Words = std::vector<std::string>;

class SweepCommand : public FromOutside {
 protected:
  SweepCommand() {
    folder_.write("s.toml",
                  sampleStudy + "[[requirement]]\nname = \"slow\"\nalways = \"abs(hinge.rate) < 1.7 rad/s\"\n");
  }

  static constexpr const char* over = " --over rod.length=0.4:0.6:3 --over 'start=20 deg:40 deg:2' --quiet";

  SweepResults swept(const std::string& name = "s.sweep.h5") const { return readSweep(folder_.path(name)); }
};

TEST_F(SweepCommand, WritesOneFileAndOnePage) {
  const Outcome run = gamut(std::string("sweep s.toml --jobs 2 --json") + over);
  EXPECT_EQ(run.exitCode, 0) << run.error;
  const nlohmann::json told = nlohmann::json::parse(run.out);
  EXPECT_EQ(told["points"], 6);
  EXPECT_EQ(told["states"]["done"], 6);
  EXPECT_EQ(told["refuted"], 0);
  EXPECT_EQ(told["axes"][1]["name"], "start");
  EXPECT_EQ(told["axes"][1]["unit"], "deg");
  EXPECT_EQ(told["axes"][1]["values"], (std::vector<double>{20, 40}));
  const auto& slow = told["requirements"][0];
  EXPECT_EQ(slow["met"].get<int>() + slow["violated"].get<int>() + slow["partly"].get<int>() + slow["open"].get<int>(),
            6);
  EXPECT_EQ(told["results"], "s.sweep.h5");
  EXPECT_EQ(told["report"], "s.sweep.html");
  EXPECT_EQ(swept().count(PointState::done), 6U);
  EXPECT_THAT(folder_.read("s.sweep.html"), HasSubstr("</html>"));
  EXPECT_EQ(folder_.count(), 3U);
}

TEST_F(SweepCommand, SaysInWordsWhatItFound) {
  const Outcome run = gamut("sweep s.toml --over rod.length=0.4:0.6:3");
  EXPECT_EQ(run.exitCode, 0) << run.error;
  EXPECT_THAT(run.out, StartsWith("Swept over rod.length from 0.4 to 0.6 m (3 values): 3 points, 3 done.\n"));
  EXPECT_THAT(run.out, HasSubstr("guaranteed at so many points  met  violated  for some  open\n"));
  EXPECT_THAT(run.out, HasSubstr("  results: s.sweep.h5\n  report:  s.sweep.html\n"));
}

TEST_F(SweepCommand, GoesOnWithTheSameSweepAndNoOther) {
  ASSERT_EQ(gamut(std::string("sweep s.toml") + over).exitCode, 0);
  const std::vector<std::uint64_t> bits = bitsOf(swept());
  const Outcome again = gamut("sweep s.toml --over rod.length=0.4:0.6:3 --over 'start=20 deg:40 deg:2'");
  EXPECT_EQ(again.exitCode, 0);
  EXPECT_EQ(again.error, "note: s.sweep.h5 holds 6 of 6 points, with which this goes on\n");
  EXPECT_EQ(bitsOf(swept()), bits);
  for (const char* other : {"--over rod.length=0.4:0.6:4", "--over rod.length=0.4:0.6:3",
                            "--over rod.length=0.4:0.6:3 --over 'start=20 deg:40 deg:2' --samples 32"}) {
    const Outcome refused = gamut(std::string("sweep s.toml ") + other);
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_EQ(refused.error, "gamut: s.sweep.h5: holds another sweep; expected another name, or --force\n");
  }
  EXPECT_EQ(bitsOf(swept()), bits);
  EXPECT_EQ(gamut("sweep s.toml --over rod.length=0.5 --force --quiet").exitCode, 0);
  EXPECT_EQ(swept().points.size(), 1U);
  folder_.write("r.h5", "something else");
  EXPECT_EQ(gamut("sweep s.toml --over rod.length=0.5 --quiet -o r.h5").exitCode, 2);
  EXPECT_EQ(folder_.read("r.h5"), "something else");
}

TEST_F(SweepCommand, TakesPointsFromATable) {
  folder_.write("p.csv", "rod.length [cm], start [deg]\n40, 20\n60, 40\n");
  ASSERT_EQ(gamut("sweep s.toml --points p.csv --quiet").exitCode, 0);
  const SweepResults list = swept();
  EXPECT_FALSE(list.plan.isGrid);
  ASSERT_EQ(list.points.size(), 2U);
  ASSERT_EQ(gamut(std::string("sweep s.toml -o g.h5") + over).exitCode, 0);
  const SweepResults grid = swept("g.h5");
  for (const auto& [one, other] : {std::pair<std::size_t, std::size_t>{0, 0}, {1, 5}}) {
    EXPECT_NEAR(list.at(OfOutput::lastLower, one, 0), grid.at(OfOutput::lastLower, other, 0), 1e-12);
    EXPECT_EQ(list.at(OfRequirement::word, one, 0), grid.at(OfRequirement::word, other, 0));
  }
}

TEST_F(SweepCommand, TakesWhatTheStudyStates) {
  folder_.write("t.toml", folder_.read("s.toml") + "[[sweep]]\nquantity = \"rod.length\"\nvalues = [0.4, 0.5]\n");
  EXPECT_EQ(gamut("sweep t.toml --quiet").exitCode, 0);
  EXPECT_EQ(swept("t.sweep.h5").points.size(), 2U);
  const Outcome none = gamut("sweep s.toml");
  EXPECT_EQ(none.exitCode, 2);
  EXPECT_EQ(none.error,
            "gamut: s.toml: nothing is swept; expected --over NAME=FROM:TO:COUNT, --points FILE.csv, or [[sweep]] in "
            "it\n");
}

TEST_F(SweepCommand, RefusesBeforeAnyWork) {
  const auto said = [&](const std::string& options) {
    const Outcome run = gamut("sweep s.toml " + options);
    EXPECT_EQ(run.exitCode, 2) << options;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.error.find('\n'), run.error.size() - 1) << run.error;
    return run.error;
  };
  EXPECT_EQ(said("--over rod.lenght=1:2:3"), "gamut: s.toml: unknown number 'rod.lenght'; expected 'rod.length'\n");
  EXPECT_THAT(said("--over rod.length=1:2"), HasSubstr("'1:2' is no range"));
  EXPECT_THAT(said("--over 'rod.length=1 kg'"), HasSubstr("'rod.length' is in m, not in kg"));
  EXPECT_THAT(said("--over 'rod.length=1 apple'"), HasSubstr("apple"));
  EXPECT_THAT(said("--over rod.length=1 --points p.csv"), HasSubstr("--over and --points are both given"));
  EXPECT_THAT(said("--points p.csv"), HasSubstr("the table 'p.csv' cannot be read"));
  EXPECT_THAT(said("--over rod.length=-1:-0.5:2 --over bob.mass=-1"), HasSubstr("expected"));
  EXPECT_EQ(said("--over rod.length=1 --force -o s.toml"), "gamut: s.toml: cannot be written; it is the input\n");
  EXPECT_EQ(said("--over rod.length=1 --force --report s.toml"), "gamut: s.toml: cannot be written; it is the input\n");
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(SweepCommand, EndsAsTheWorstPoint) {
  folder_.write("fixed.toml", sampleStudyWith("interval = \"± 1 %\"", "interval = [\"29 deg\", \"31 deg\"]"));
  const Outcome run = gamut("sweep fixed.toml --over 'start=30 deg:60 deg:3'");
  EXPECT_EQ(run.exitCode, 3) << run.error;
  EXPECT_THAT(run.out, HasSubstr("3 points, 1 done, 2 cannot be run.\n"));
  EXPECT_THAT(run.out, HasSubstr("cannot be run at start = 45 deg: "));
  EXPECT_EQ(gamut("sweep s.toml --over rod.length=0.4 --time-limit 0.000001 --quiet").exitCode, 3);
}

TEST_F(SweepCommand, IsInterruptedAndKilledAndEndsWithTheSameBits) {
  ASSERT_EQ(gamut(std::string("sweep s.toml -o whole.h5") + over).exitCode, 0);
  const std::vector<std::uint64_t> bits = bitsOf(swept("whole.h5"));
  const Words words{"sweep",  "s.toml", "--over", "rod.length=0.4:0.6:3", "--over", "start=20 deg:40 deg:2",
                    "--jobs", "2",      "--quiet"};
  int number = 0;
  for (const double delay : {0.0, 0.05, 0.2, 0.5, 1.0, 2.0}) {
    for (const int kind : {SIGINT, SIGKILL, SIGTERM}) {
      SCOPED_TRACE(fmt::format("{} after {} s", kind, delay));
      StartedProgram sweep(folder_, words);
      sweep.awaitWork();
      sweep.signalAfter(delay, kind);
      const int code = sweep.wait();
      EXPECT_THAT(code, ::testing::AnyOf(0, 3, -SIGKILL));
      if (std::filesystem::exists(folder_.path("s.sweep.h5"))) {
        const SweepResults there = swept();
        EXPECT_TRUE(code != 0 || there.count(PointState::open) == 0);
      }
      if (++number % 3 == 0) {
        EXPECT_EQ(gamut(std::string("sweep s.toml") + over).exitCode, 0);
        EXPECT_EQ(bitsOf(swept()), bits);
        std::filesystem::remove(folder_.path("s.sweep.h5"));
        std::filesystem::remove(folder_.path("s.sweep.html"));
      }
    }
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path("")))
    EXPECT_FALSE(entry.path().filename().string().ends_with(".gamut-part")) << entry.path();
}

}  // namespace gamut::sweep_command_test
