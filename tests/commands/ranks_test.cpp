// Runs that are shared out among processes by MPI: the same results bit for bit, on as many as there are.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/commands/ranks_of_program.hpp"

namespace gamut::ranks_test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST_F(RanksOfProgram, ComeToTheSame) {
  const Outcome alone = gamut("run s.toml --quiet --memory-limit 2 -o alone.h5");
  for (const int ranks : {1, 2, 3}) {
    SCOPED_TRACE(ranks);
    const Outcome shared = onRanks(ranks, "run s.toml --memory-limit 2 --force -o s.h5");
    EXPECT_EQ(shared.exitCode, alone.exitCode) << shared.error;
    EXPECT_THAT(differencesButCosts(results("s.h5"), results("alone.h5")), IsEmpty());
    EXPECT_NE(shared.out.find("CPU: "), std::string::npos);
    EXPECT_EQ(shared.out.find("CPU: "), shared.out.rfind("CPU: "));  // one of them says it
    EXPECT_TRUE(std::filesystem::exists(folder_.path("s.html")));
  }
}

TEST_F(OneRankApart, EndsAllBeforeTheyBegin) {
  std::filesystem::create_directory(folder_.path("elsewhere"));
  expectComplaint(apart("cd elsewhere", "run s.toml"), 2, "rank 2: s.toml: does not exist");
  folder_.write("elsewhere/s.toml", "title = 1\n");
  expectComplaint(apart("cd elsewhere", "run s.toml"), 2, "rank 2: s.toml:1");
  folder_.write("elsewhere/s.toml", longStudy() + "\n");
  expectComplaint(apart("cd elsewhere", "run s.toml"), 2, "s.toml: rank 2 has another program, processor or study");
  expectComplaint(apart("set -- \"$@\" --memory-limit 0.001", "run s.toml"), 2, "rank 2: s.toml: samples of");
  expectComplaint(apart("set -- \"$@\" --nowhere", "run s.toml"), 2, "rank 2: unknown option");
  expectComplaint(apart("mkdir gone; cd gone; rmdir ../gone", "run " + folder_.path("s.toml")), 4,
                  "rank 2: filesystem error");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("s.h5")));
}

TEST_F(OneRankApart, IsHeardWhateverTheFirstDoes) {
  expectComplaint(apart("set -- \"$@\" --nowhere", "resume s.h5"), 2, "rank 2: unknown option");
  const Outcome help = onRanks(3, "run --help");
  EXPECT_EQ(help.exitCode, 0) << help.error;
  EXPECT_EQ(help.out.find("Exit codes:"), help.out.rfind("Exit codes:"));
}

TEST_F(RanksOfProgram, ComplainOnce) {
  folder_.write("bad.toml", "title = 1\n");
  const Outcome bad = onRanks(3, "run bad.toml");
  EXPECT_EQ(bad.exitCode, 2);
  EXPECT_THAT(bad.error, HasSubstr("bad.toml:1"));
  EXPECT_EQ(bad.error.find("bad.toml:1"), bad.error.rfind("bad.toml:1"));
  folder_.write("s.h5", "");
  EXPECT_THAT(onRanks(2, "run s.toml").error, HasSubstr("s.h5: exists"));
  EXPECT_THAT(onRanks(2, "run -", "echo | ").error, HasSubstr("several processes cannot read a study from standard"));
}

/// Whichever dies, the job ends; what was remembered until then is enough to go on, with as many as one likes.
TEST_F(RanksOfProgram, GoOnWhereOneWasKilled) {
  const Outcome alone = gamut("run s.toml --quiet --memory-limit 2 -o alone.h5");
  const std::string name = folder_.path("s.h5"), checkpoint = name + ".checkpoint";
  int resumed = 0;
  for (int i = 0; i < 4; ++i) {
    for (const char* kind : {"", ".checkpoint"}) std::filesystem::remove(name + kind);
    std::filesystem::remove(folder_.path("s.html"));
    const std::string kill = fmt::format(
        "{{ (for i in $(seq 3000); do [ ! -s '{0}' ] || break; sleep 0.01; [ ! -s '{1}' ] || exit; done; "
        "pkill -KILL -{2} -f -- '^{3} run .*-o {1}') & }} && ",
        checkpoint, name, i % 2 == 0 ? "n" : "o", GAMUT_PROGRAM);
    const Outcome killed =
        onRanks(3, fmt::format("run s.toml --quiet --memory-limit 2 --checkpoint 0.02 -o {}", name), kill);
    if (!std::filesystem::exists(checkpoint)) continue;
    EXPECT_NE(killed.exitCode, 0);
    const Outcome end = i < 2 ? onRanks(2, "resume s.h5 --quiet --force") : gamut("resume s.h5 --quiet --force");
    EXPECT_EQ(end.exitCode, alone.exitCode) << end.error;
    EXPECT_THAT(differencesButCosts(results("s.h5"), results("alone.h5")), IsEmpty());
    ++resumed;
  }
  EXPECT_GE(resumed, 2);
}

/// A limit of time, which each notes for itself.
TEST_F(RanksOfProgram, KeepWhatWasFoundUntilALimit) {
  const Outcome ended = onRanks(3, "run s.toml --quiet --samples 200000 --time-limit 0.3");
  EXPECT_EQ(ended.exitCode, 3) << ended.error;
  EXPECT_THAT(results("s.h5").stopped, HasSubstr("the time limit of 0.3 s CPU"));
}

/// More samples, as of a run that is shared out.
TEST_F(OneRankApart, ExtendTogether) {
  ASSERT_THAT(gamut("run s.toml --quiet --memory-limit 2").exitCode, AnyOf(0, 3));
  const int code = gamut("extend s.h5 --samples 12000 --quiet --memory-limit 2 -o alone.h5").exitCode;
  EXPECT_THAT(code, AnyOf(0, 3));
  const Outcome shared = onRanks(3, "extend s.h5 --samples 12000 --memory-limit 2 -o t.h5");
  EXPECT_EQ(shared.exitCode, code) << shared.error;
  EXPECT_THAT(differencesButCosts(results("t.h5"), results("alone.h5")), IsEmpty());
  EXPECT_EQ(shared.out.find("CPU: "), shared.out.rfind("CPU: "));
  std::filesystem::create_directory(folder_.path("elsewhere"));
  expectComplaint(apart("cd elsewhere", "extend s.h5 --samples 20000"), 2, "rank 2: s.h5: does not exist");
  expectComplaint(onRanks(3, "extend s.h5 --samples 8"), 2, "s.h5: holds 4000 samples, and would hold 8");
  std::filesystem::copy_file(folder_.path("t.h5"), folder_.path("elsewhere/s.h5"));
  expectComplaint(apart("cd elsewhere", "extend s.h5 --samples 20000"), 2, "s.h5: rank 2 has another program");
}

/// Whatever is not shared out is done once, whoever is there besides.
TEST_F(RanksOfProgram, DoOneThingAlone) {
  gamut("run s.toml --quiet");
  const std::string three = "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 3 ";
  for (const char* command :
       {"info s.h5", "check s.h5", "compare s.h5 s.h5", "report s.h5 -o again.html", "replay s.h5 3",
        "export s.h5 --csv tables", "sample s.h5 --samples 20", "tolerance s.toml", "validate s.toml", "new fresh.toml",
        "quantities s.toml", "schema", "completion bash"}) {
    SCOPED_TRACE(command);
    std::string made[2];
    Outcome outcomes[2];
    for (const int shared : {0, 1}) {
      outcomes[shared] = gamut(command, shared == 1 ? three : "");
      for (const char* file : {"again.html", "fresh.toml"})
        if (folder_.has(file)) made[shared] += folder_.read(file);
      for (const char* file : {"again.html", "fresh.toml", "tables"}) std::filesystem::remove_all(folder_.path(file));
    }
    EXPECT_THAT(outcomes[0].out + made[0], Not(IsEmpty()));
    EXPECT_EQ(outcomes[1].out, outcomes[0].out);
    EXPECT_EQ(outcomes[1].exitCode, outcomes[0].exitCode) << outcomes[1].error;
    EXPECT_EQ(made[1], made[0]);
    if (outcomes[0].exitCode == 0) {
      EXPECT_EQ(outcomes[1].error, outcomes[0].error);
    }
  }
}

}  // namespace
}  // namespace gamut::ranks_test
