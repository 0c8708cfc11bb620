// gamut export from outside: tables of a real run, in a folder that is there whole or not at all.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "studies/results/results_file.hpp"
#include "tests/commands/program.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace export_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class ExportCommand : public FromOutside {
 protected:
  void SetUp() override {
    folder_.write("s.toml", sampleStudy);
    ASSERT_EQ(gamut("run s.toml --quiet").exitCode, 0);
  }
};

TEST_F(ExportCommand, WritesAllTablesOfARun) {
  const Outcome list = gamut("export s.h5");
  EXPECT_EQ(list.exitCode, 0) << list.error;
  EXPECT_THAT(list.out, HasSubstr("interval.time "));
  const Outcome all = gamut("export s.h5 --csv tables");
  EXPECT_EQ(all.exitCode, 0) << all.error;
  EXPECT_THAT(all.out, StartsWith("tables: "));
  EXPECT_EQ(gamut("export s.h5 --table interval.time").out, folder_.read("tables/interval.time.csv"));
  const Results results = readResults(folder_.path("s.h5"));
  std::istringstream lines(folder_.read("tables/interval.time.csv"));
  std::string heading, first;
  std::getline(lines, heading);
  std::getline(lines, first);
  EXPECT_THAT(heading, StartsWith("time (s),angle: "));
  EXPECT_THAT(first, StartsWith("0,"));
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(folder_.path("tables"))) ++files;
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(list.out, '\n')), files + 1);
}

TEST_F(ExportCommand, ReplacesNothingButTables) {
  ASSERT_EQ(gamut("export s.h5 --csv tables").exitCode, 0);
  const std::size_t before = folder_.count();
  EXPECT_EQ(gamut("export s.h5 --csv tables").error,
            "gamut: tables: exists already; expected another name, or --force\n");
  folder_.write("tables/values.csv", "old");
  EXPECT_EQ(gamut("export s.h5 --csv tables/ --force").exitCode, 0);
  EXPECT_THAT(folder_.read("tables/values.csv"), StartsWith("path,value,unit,meaning\n"));
  folder_.write("tables/thesis.txt", "mine");
  const Outcome refused = gamut("export s.h5 --csv tables --force");
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_EQ(refused.error,
            "gamut: tables: is not replaced, as it holds thesis.txt, which is no table; expected another name\n");
  EXPECT_EQ(folder_.read("tables/thesis.txt"), "mine");
  EXPECT_EQ(gamut("export s.h5 --csv s.toml --force").exitCode, 2);
  EXPECT_EQ(gamut("export s.h5 --csv none/tables").exitCode, 2);
  EXPECT_EQ(folder_.count(), before) << "nothing is left behind";
}

/// What may not grow beyond a block cannot take all tables: none is there then.
TEST_F(ExportCommand, LeavesNothingBehindThatIsNotWhole) {
  const std::size_t before = folder_.count();
  const Outcome full = gamut("export s.h5 --csv tables", "ulimit -f 1; ");
  EXPECT_EQ(full.exitCode, 4) << full.error;
  EXPECT_THAT(full.error, StartsWith("gamut: tables: cannot be written; "));
  EXPECT_EQ(folder_.count(), before);
}

TEST_F(ExportCommand, SaysWhatIsThere) {
  const Outcome unknown = gamut("export s.h5 --table intervall.time");
  EXPECT_EQ(unknown.exitCode, 2);
  EXPECT_EQ(unknown.error, "gamut: s.h5: holds no table 'intervall.time'; expected 'interval.time'\n");
  EXPECT_EQ(gamut("export s.h5 --table values --csv t").exitCode, 2);
}

}  // namespace export_test
}  // namespace gamut
