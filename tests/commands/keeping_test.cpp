// What a stopped run found takes the place of nothing that holds more.
#include "commands/keeping.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <optional>
#include <string>

#include "reports/report.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class Kept : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { whole = run(readStudyText(sampleStudy, "s.toml")); }
  static void TearDownTestSuite() { whole = {}; }

  /// Of a run that was stopped at that share of its horizon.
  static Results partial(double share = 0.5, const std::string& why = "the run was interrupted") {
    Results results = whole;
    results.stopped = why;
    results.interval.reached = share * results.horizon;
    return results;
  }

  void write(const std::string& name, const Results& results) const {
    writeResults(results, folder_.path(name + ".h5"));
    writeReport(results, folder_.path(name + ".html"));
  }

  struct Where {
    std::string results, report, note;
  };

  /// Names without the folder; writes both.
  Where keep(const Results& results, const std::string& resultsName = "s.h5",
             const std::string& reportName = "s.html") const {
    OutputFile resultsFile(folder_.path(resultsName), OutputFile::Existing::isReplaced),
        reportFile(folder_.path(reportName), OutputFile::Existing::isReplaced);
    Keeping keeping(results, resultsFile, reportFile);
    Where where{"", "", keeping.note()};
    const auto nameOf = [](const OutputFile& file) { return std::filesystem::path(file.path()).filename().string(); };
    if (keeping.results() != nullptr) {
      where.results = nameOf(*keeping.results());
      writeResults(results, *keeping.results());
    }
    if (keeping.report() != nullptr) {
      where.report = nameOf(*keeping.report());
      keeping.report()->write(renderReport(results));
    }
    return where;
  }

  void expectAt(const Where& where, const std::string& results, const std::string& report) const {
    EXPECT_EQ(where.results, results) << where.note;
    EXPECT_EQ(where.report, report) << where.note;
    EXPECT_EQ(where.note.empty(), results == "s.h5" && report == "s.html") << where.note;
  }

  inline static Results whole;
  TemporaryFolder folder_;
};

TEST_F(Kept, IsWhatWasFoundWhereNothingIsYet) {
  expectAt(keep(partial()), "s.h5", "s.html");
  EXPECT_TRUE(isPageOfPart(folder_.path("s.html")));
}

TEST_F(Kept, IsAWholeRunInThePlaceOfAnything) {
  for (const Results& older : {whole, partial()}) {
    write("s", older);
    expectAt(keep(whole), "s.h5", "s.html");
    EXPECT_FALSE(isPageOfPart(folder_.path("s.html")));
  }
  folder_.write("s.h5", "anything");
  expectAt(keep(whole), "s.h5", "s.html");
}

TEST_F(Kept, AreWholeResultsBesidePartialOnes) {
  write("s", whole);
  const std::string results = folder_.read("s.h5"), page = folder_.read("s.html");
  const Where where = keep(partial());
  expectAt(where, "s.partial.h5", "s.partial.html");
  EXPECT_THAT(where.note, StartsWith("the run was interrupted: "));
  EXPECT_THAT(where.note, HasSubstr("s.h5 stays, which is of a run that was not stopped; what was found is in "));
  EXPECT_THAT(where.note, EndsWith("s.partial.h5"));
  EXPECT_TRUE(folder_.read("s.h5") == results && folder_.read("s.html") == page);
}

/// Without --force nothing is replaced, nor lost: not what came during the run, nor what the run found.
TEST_F(Kept, IsWhatAppearedDuringTheRunAndWhatTheRunFound) {
  for (const Results& found : {whole, partial()}) {
    for (const char* appearing : {"s.h5", "s.html"}) {
      SCOPED_TRACE(appearing + found.stopped);
      TemporaryFolder folder;
      OutputFile results(folder.path("s.h5"), OutputFile::Existing::isKept),
          report(folder.path("s.html"), OutputFile::Existing::isKept);
      EXPECT_FALSE(results.isTaken() || report.isTaken());
      folder.write(appearing, "another's");
      folder.write("s.2.html", "older");
      Keeping keeping(found, results, report);
      ASSERT_NE(keeping.results(), nullptr);
      ASSERT_NE(keeping.report(), nullptr);
      EXPECT_EQ(keeping.results()->path(), folder.path("s.3.h5"));
      EXPECT_EQ(keeping.report()->path(), folder.path("s.3.html"));
      EXPECT_EQ(keeping.note(), folder.path(appearing) +
                                    " stays: another program has put it there during the run; the results are in " +
                                    folder.path("s.3.h5"));
      writeResults(found, *keeping.results());
      keeping.report()->write("page");
      EXPECT_EQ(folder.read(appearing), "another's");
      EXPECT_EQ(folder.read("s.2.html"), "older");
      EXPECT_EQ(readResults(folder.path("s.3.h5")).stopped, found.stopped);
    }
  }
}

/// With --force it goes where it was to go, whatever came there.
TEST_F(Kept, IsNothingThatMayBeReplaced) {
  OutputFile results(folder_.path("s.h5"), OutputFile::Existing::isReplaced),
      report(folder_.path("s.html"), OutputFile::Existing::isReplaced);
  folder_.write("s.h5", "another's");
  EXPECT_FALSE(results.isTaken());
  Keeping keeping(whole, results, report);
  EXPECT_EQ(keeping.results(), &results);
  EXPECT_EQ(keeping.note(), "");
}

TEST_F(Kept, AreWholeResultsOfAnotherStudy) {
  write("s", run(readStudyText(sampleStudyWith("samples = 16", "samples = 32"), "t.toml")));
  expectAt(keep(partial()), "s.partial.h5", "s.partial.html");
}

TEST_F(Kept, IsWhatCameFartherOfTwoParts) {
  write("s", partial(0.5));
  expectAt(keep(partial(0.25)), "s.partial.h5", "s.partial.html");
  expectAt(keep(partial(0.5)), "s.h5", "s.html");
  expectAt(keep(partial(0.75)), "s.h5", "s.html");
}

TEST_F(Kept, AreBothOfTwoPartsThatHoldMoreInDifferentRespects) {
  write("s", partial(0.5));
  Results other = partial(0.75);
  other.stochastic.integrated -= 1;
  expectAt(keep(other), "s.partial.h5", "s.partial.html");
  other = partial(0.75);
  other.interval.tightness = 2 * whole.interval.tightness + 1;
  expectAt(keep(other), "s.h5", "s.html");  // it came farther
  write("s", partial(1));
  other.interval.reached = other.horizon;
  expectAt(keep(other), "s.partial.h5", "s.partial.html");
}

TEST_F(Kept, IsNoFileThatHoldsLessOfTheSameThanOneBeside) {
  write("s", whole);
  expectAt(keep(partial(0.5)), "s.partial.h5", "s.partial.html");
  const std::string before = folder_.read("s.partial.h5");
  const Where where = keep(partial(0.25));
  EXPECT_EQ(where.results, "");
  EXPECT_EQ(where.report, "");
  EXPECT_THAT(where.note, HasSubstr("nothing was written, since "));
  EXPECT_EQ(folder_.read("s.partial.h5"), before);
  EXPECT_EQ(folder_.count(), 4U);
  Results other = partial(0.25);
  other.studyText += "# another\n";
  expectAt(keep(other), "s.partial2.h5", "s.partial2.html");
  expectAt(keep(partial(0.75)), "s.partial.h5", "s.partial.html");
}

TEST_F(Kept, IsWhatNobodyCanRead) {
  for (const std::string content : {"my notes", "Gamut results, format 1\n"}) {
    folder_.write("s.h5", content);
    const Where where = keep(partial());
    expectAt(where, "s.partial.h5", "s.partial.html");
    EXPECT_THAT(where.note, HasSubstr("s.h5 stays, of which this version cannot tell what it holds; "));
    EXPECT_EQ(folder_.read("s.h5"), content);
    std::filesystem::remove(folder_.path("s.partial.h5"));
    std::filesystem::remove(folder_.path("s.partial.html"));
  }
}

TEST_F(Kept, IsNoEmptyFile) {
  folder_.write("s.h5", "");
  expectAt(keep(partial()), "s.h5", "s.html");
}

TEST_F(Kept, IsAPageOfAWholeRunWithoutItsResults) {
  writeReport(whole, folder_.path("s.html"));
  const Where where = keep(partial());
  EXPECT_EQ(where.results, "s.h5");
  EXPECT_EQ(where.report, "s.partial.html");
  EXPECT_THAT(where.note, HasSubstr("s.html stays"));
}

TEST_F(Kept, IsWhateverElseHasThePartialName) {
  write("s", whole);
  std::filesystem::create_directory(folder_.path("s.partial.h5"));
  folder_.write("s.partial.html", "my notes");
  expectAt(keep(partial()), "s.partial2.h5", "s.partial2.html");
  write("s.partial3", whole);
  Results other = partial(0.25);
  other.seed += 1;
  expectAt(keep(other), "s.partial4.h5", "s.partial4.html");
  EXPECT_EQ(folder_.read("s.partial.html"), "my notes");
}

TEST_F(Kept, IsNotTakenForAPartOfTheOtherFile) {
  write("s", whole);
  expectAt(keep(partial(), "s.h5", "s.partial.h5"), "s.partial2.h5", "s.partial.partial2.h5");
}

TEST_F(Kept, AreResultsWhereALinkLeads) {
  std::filesystem::create_directory(folder_.path("there"));
  writeResults(whole, folder_.path("there/t.h5"));
  std::filesystem::create_symlink("there/t.h5", folder_.path("s.h5"));
  const Where where = keep(partial());
  EXPECT_EQ(where.results, "t.partial.h5");
  EXPECT_TRUE(folder_.has("there/t.partial.h5"));
}

TEST_F(Kept, NamesPartsBesideWholes) {
  EXPECT_EQ(partialName("s.h5", 1), "s.partial.h5");
  EXPECT_EQ(partialName("a/b.c/s.h5", 2), "a/b.c/s.partial2.h5");
  EXPECT_EQ(partialName("/s", 1), "/s.partial");
  EXPECT_EQ(partialName("s.partial.h5", 1), "s.partial.partial.h5");
}

}  // namespace
}  // namespace gamut
