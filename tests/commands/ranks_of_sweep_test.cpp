// Sweeps whose points are shared out among processes by MPI.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "studies/sweeps/sweep_file.hpp"
#include "tests/commands/ranks_of_program.hpp"
#include "tests/studies/sweep_bits.hpp"

namespace gamut::ranks_of_sweep_test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

/// A few points that are quick, one that cannot be run, and a setting that tells them apart.
class RanksOfSweep : public OneRankApart {
 protected:
  RanksOfSweep() {
    folder_.write("q.toml", sampleStudyWith("interval = \"± 1 %\"", "interval = [\"29 deg\", \"31 deg\"]") +
                                "[[requirement]]\nname = \"slow\"\nalways = \"abs(hinge.rate) < 1.7 rad/s\"\n");
  }

  static constexpr const char* over =
      " --over rod.length=0.4:0.6:3 --over 'start=29.5, 30, 45 deg' --over stochastic.samples=16,64 ";

  SweepResults swept(const std::string& name) const { return readSweep(folder_.path(name)); }
};

TEST_F(RanksOfSweep, ComeToTheSame) {
  const Outcome alone = gamut(std::string("sweep q.toml --quiet --jobs 2 -o alone.h5") + over);
  EXPECT_EQ(alone.exitCode, 3) << alone.error;
  const SweepResults whole = swept("alone.h5");
  EXPECT_EQ(whole.count(PointState::done), 12U);
  EXPECT_EQ(whole.count(PointState::refused), 6U);
  for (const int ranks : {1, 2, 3, 5}) {
    SCOPED_TRACE(ranks);
    const Outcome shared = onRanks(ranks, std::string("sweep q.toml --force -o q.h5") + over);
    EXPECT_EQ(shared.exitCode, 3) << shared.error;
    EXPECT_EQ(bitsOf(swept("q.h5")), bitsOf(whole));
    EXPECT_EQ(wordsOf(swept("q.h5")), wordsOf(whole));
    EXPECT_THAT(shared.out, HasSubstr("18 points, 12 done, 6 cannot be run."));
    EXPECT_EQ(shared.out.find("Swept"), shared.out.rfind("Swept"));  // one of them says it
    EXPECT_THAT(folder_.read("q.html"), HasSubstr("</html>"));
  }
}

/// Each rank's own children have taken the CPU time of a point.
TEST_F(RanksOfSweep, AllHaveTheirShare) {
  const Outcome shared = onRanks(3, "sweep s.toml --quiet --over rod.length=0.4:0.6:3 -o s.h5", "",
                                 "sh -c '\"$0\" \"$@\"; e=$?; times > cpu.$OMPI_COMM_WORLD_RANK; exit $e' ");
  ASSERT_EQ(shared.exitCode, 0) << shared.error;
  double least = 1e9;
  for (const SweepPoint& point : swept("s.h5").points) least = std::min(least, point.cpu);
  for (const int rank : {0, 1, 2}) {
    std::ifstream told(folder_.path(fmt::format("cpu.{}", rank)));
    double minutes = 0, seconds = 0;
    char m = ' ', s = ' ';
    std::string ofShell;
    std::getline(told, ofShell);
    told >> minutes >> m >> seconds >> s;
    EXPECT_GT(60 * minutes + seconds, 0.8 * least) << rank;
  }
}

/// They hear the study, and what is asked, from the first.
TEST_F(RanksOfSweep, NeedNoStudyOfTheirOwn) {
  std::filesystem::create_directory(folder_.path("elsewhere"));
  const Outcome run = apart("cd elsewhere", "sweep q.toml --quiet --over 'start=29.5, 30, 30.5 deg' -o q.h5");
  EXPECT_EQ(run.exitCode, 0) << run.error;
  EXPECT_EQ(swept("q.h5").count(PointState::done), 3U);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path("elsewhere")));
}

TEST_F(RanksOfSweep, ComplainOnce) {
  expectComplaint(apart("set -- \"$@\" --nowhere", "sweep q.toml --over rod.length=1"), 2, "rank 2: unknown option");
  expectComplaint(onRanks(3, "sweep q.toml --over rod.lenght=1"), 2, "q.toml: unknown number 'rod.lenght'");
  std::filesystem::copy_file(GAMUT_PROGRAM, folder_.path("other"));
  std::ofstream(folder_.path("other"), std::ios::app) << "\n";
  const std::string other = fmt::format("set -- \"$0\" \"$@\"; shift; exec {} ", folder_.path("other"));
  expectComplaint(apart(other + "\"$@\"", "sweep q.toml --over rod.length=1"), 2,
                  "q.toml: rank 2 has another program or processor than rank 0");
  gamut("sweep q.toml --quiet --over rod.length=1");
  expectComplaint(onRanks(3, "sweep q.toml --over rod.length=2"), 2, "q.sweep.h5: holds another sweep");
}

/// Whichever is killed or interrupted, the job ends, with what had ended until then; the same command goes on, with as
/// many as one likes.
TEST_F(RanksOfSweep, GoOnWhereOneWasEnded) {
  const std::string over = " --over rod.length=0.4:0.6:15 --quiet";
  ASSERT_EQ(gamut("sweep s.toml -o alone.h5 --samples 500 --jobs 2" + over).exitCode, 0);
  const std::vector<std::uint64_t> bits = bitsOf(swept("alone.h5"));
  const std::string name = folder_.path("s.h5"), command = "sweep s.toml --samples 500 -o " + name + over;
  int wereEnded = 0;
  for (const std::string kind : {"KILL -n", "KILL -o", "TERM -n"}) {
    SCOPED_TRACE(kind);
    for (const char* of : {"s.h5", "s.html"}) std::filesystem::remove(folder_.path(of));
    // Points are children of ranks, and are called as these.
    const std::string end = fmt::format(
        "{{ (for i in $(seq 3000); do sleep 0.01; [ ! -s '{0}' ] || break; done; "
        "pkill -{1} -P $(pgrep -d, -f -- '^mpirun .*-o {0}') -f -- '^{2} sweep .*-o {0}') & }} && ",
        name, kind, GAMUT_PROGRAM);
    const Outcome ended = onRanks(3, command, end);
    if (!kind.starts_with("KILL")) {
      EXPECT_THAT(ended.exitCode, AnyOf(0, 3)) << ended.error;
    }
    const SweepResults there = swept("s.h5");
    wereEnded += there.count(PointState::open) > 0 && there.count(PointState::done) > 0 ? 1 : 0;
    EXPECT_TRUE(ended.exitCode != 0 || there.count(PointState::open) == 0);
    const Outcome whole = kind.ends_with("o") ? onRanks(2, command) : gamut(command);
    EXPECT_EQ(whole.exitCode, 0) << whole.error;
    EXPECT_EQ(bitsOf(swept("s.h5")), bits);
  }
  EXPECT_GE(wereEnded, 1);
}

}  // namespace
}  // namespace gamut::ranks_of_sweep_test
