// The program as several processes, which MPI joins.
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <string>

#include "studies/results/results_file.hpp"
#include "tests/commands/program.hpp"
#include "tests/studies/long_study.hpp"

namespace gamut {

class RanksOfProgram : public FromOutside {
 protected:
  void SetUp() override {
    if (std::system("command -v mpirun > /dev/null") != 0) GTEST_SKIP() << "there is no mpirun";
    folder_.write("s.toml", longStudy());
  }

  /// On so many processes, more than the machine has if need be, each with one thread.
  Outcome onRanks(int ranks, const std::string& arguments, const std::string& before = "",
                  const std::string& eachBy = "") const {
    return gamut(
        arguments + " --jobs 1",
        before + fmt::format("OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe "
                             "-n {} {}",
                             ranks, eachBy));
  }

  Results results(const std::string& name) const { return readResults(folder_.path(name)); }
};

/// Three, of which the last does something of its own first.
class OneRankApart : public RanksOfProgram {
 protected:
  Outcome apart(const std::string& own, const std::string& arguments) const {
    return onRanks(3, arguments, "",
                   fmt::format("sh -c '[ $OMPI_COMM_WORLD_RANK -lt 2 ] || {{ {}; }}; exec \"$0\" \"$@\"' ", own));
  }
  /// One line, of that rank.
  static void expectComplaint(const Outcome& outcome, int exitCode, const std::string& what) {
    EXPECT_EQ(outcome.exitCode, exitCode) << outcome.error;
    EXPECT_THAT(outcome.error, ::testing::HasSubstr("gamut: " + what));
    EXPECT_EQ(outcome.error.find("gamut: "), outcome.error.rfind("gamut: ")) << outcome.error;
  }
};

}  // namespace gamut
