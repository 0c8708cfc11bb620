// What is written is what is read; a file explains itself; a write that fails or is killed leaves the old file.
#include "studies/results_file.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "studies/atomic_file.hpp"
#include "studies/detail/hdf5.hpp"
#include "tests/studies/sample_results.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Bit for bit, NaN included.
void expectSame(const Grid& found, const Grid& expected, const char* what) {
  ASSERT_EQ(found.times, expected.times) << what;
  ASSERT_EQ(found.outputs, expected.outputs) << what;
  ASSERT_EQ(found.data.size(), expected.data.size()) << what;
  EXPECT_EQ(std::memcmp(found.data.data(), expected.data.data(), found.data.size() * sizeof(double)), 0) << what;
}

void expectSame(const Bounds& found, const Bounds& expected, const char* what) {
  expectSame(found.lower, expected.lower, what);
  expectSame(found.upper, expected.upper, what);
}

class ResultsFile : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string path_ = folder_.path("run.h5");
};

TEST_F(ResultsFile, GivesBackTheStudyAndItsOrigin) {
  const Results expected = sampleResults();
  writeResults(expected, path_);
  const Results found = readResults(path_);
  EXPECT_EQ(found.studyText, expected.studyText);
  EXPECT_EQ(found.studyFile, expected.studyFile);
  EXPECT_EQ(found.title, expected.title);
  EXPECT_EQ(found.analysis, expected.analysis);
  EXPECT_EQ(found.seed, expected.seed);
  EXPECT_EQ(found.version, expected.version);
  EXPECT_EQ(found.host, expected.host);
  EXPECT_EQ(found.date, expected.date);
  EXPECT_EQ(found.libraries, expected.libraries);
  EXPECT_EQ(found.horizon, expected.horizon);
  EXPECT_EQ(found.time, expected.time);
  EXPECT_EQ(found.reportCpu, expected.reportCpu);
  ASSERT_EQ(found.outputs.size(), 2U);
  EXPECT_EQ(found.outputs[0].name, "tip height");
  EXPECT_EQ(found.outputs[1].quantity, "energy");
  EXPECT_EQ(found.outputs[1].unit, "J");
  ASSERT_EQ(found.uncertain.size(), 1U);
  EXPECT_EQ(found.uncertain[0].quantity, "shoulder.angle");
  EXPECT_EQ(found.uncertain[0].unit, "rad");
  EXPECT_EQ(found.uncertain[0].lower, 0.9);
  EXPECT_EQ(found.uncertain[0].nominal, 1.0);
  EXPECT_EQ(found.uncertain[0].upper, 1.1);
  EXPECT_EQ(found.uncertain[0].distribution, "uniform");
  EXPECT_EQ(found.uncertain[0].membership, "triangular");
}

TEST_F(ResultsFile, GivesBackEveryAnswer) {
  const Results expected = sampleResults();
  writeResults(expected, path_);
  const Results found = readResults(path_);
  ASSERT_TRUE(found.interval.present && found.stochastic.present && found.fuzzy.present);
  expectSame(found.interval.at, expected.interval.at, "at");
  expectSame(found.interval.over, expected.interval.over, "over");
  EXPECT_TRUE(found.interval.direct.empty());
  EXPECT_EQ(found.interval.reached, expected.interval.reached);
  EXPECT_EQ(found.interval.why, expected.interval.why);
  EXPECT_EQ(found.interval.pieces, expected.interval.pieces);
  EXPECT_EQ(found.interval.steps, expected.interval.steps);
  EXPECT_EQ(found.interval.cpu, expected.interval.cpu);
  EXPECT_EQ(found.stochastic.plan, expected.stochastic.plan);
  EXPECT_EQ(found.stochastic.samples, expected.stochastic.samples);
  EXPECT_EQ(found.stochastic.corners, expected.stochastic.corners);
  EXPECT_EQ(found.stochastic.alphaCorners, 18);
  EXPECT_EQ(found.stochastic.integrated, 1000);
  EXPECT_EQ(found.stochastic.stopped, "interrupted");
  EXPECT_EQ(found.stochastic.relativeTolerance, expected.stochastic.relativeTolerance);
  EXPECT_EQ(found.stochastic.absoluteTolerance, expected.stochastic.absoluteTolerance);
  EXPECT_EQ(found.stochastic.packWidth, 64);
  EXPECT_EQ(found.stochastic.reached, expected.stochastic.reached);
  EXPECT_EQ(found.stochastic.cpu, expected.stochastic.cpu);
  EXPECT_EQ(found.stochastic.why, "");
  expectSame(found.stochastic.envelope, expected.stochastic.envelope, "envelope");
  expectSame(found.stochastic.mean, expected.stochastic.mean, "mean");
  expectSame(found.stochastic.deviation, expected.stochastic.deviation, "deviation");
  expectSame(found.stochastic.error, expected.stochastic.error, "error");
  expectSame(found.stochastic.resolution, expected.stochastic.resolution, "resolution");
  EXPECT_EQ(found.stochastic.probabilities, expected.stochastic.probabilities);
  ASSERT_EQ(found.stochastic.quantiles.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i)
    expectSame(found.stochastic.quantiles[i], expected.stochastic.quantiles[i], "quantiles");
  EXPECT_EQ(found.fuzzy.alpha, expected.fuzzy.alpha);
  EXPECT_EQ(found.fuzzy.reached, expected.fuzzy.reached);
  EXPECT_EQ(found.fuzzy.cpu, expected.fuzzy.cpu);
  ASSERT_EQ(found.fuzzy.outer.size(), 3U);
  ASSERT_EQ(found.fuzzy.inner.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    expectSame(found.fuzzy.outer[i], expected.fuzzy.outer[i], "outer");
    expectSame(found.fuzzy.inner[i], expected.fuzzy.inner[i], "inner");
  }
}

TEST_F(ResultsFile, WithoutAPackWidthIsOfSamplesIntegratedOneByOne) {
  writeResults(sampleResults(), path_);
  {
    const Hdf5Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, path_);
    for (const char* attribute : {"pack_width", "alpha_corners", "integrated", "stopped"})
      ASSERT_GE(H5Adelete_by_name(file, "stochastic", attribute, H5P_DEFAULT), 0);
  }
  const Results found = readResults(path_);
  EXPECT_EQ(found.stochastic.packWidth, 1);
  EXPECT_EQ(found.stochastic.samples, 4096);
  EXPECT_EQ(found.stochastic.integrated, 4096 + 3 + 1);
  EXPECT_EQ(found.stochastic.stopped, "");
}

TEST_F(ResultsFile, GivesBackTheComparisonAndDisputedSamples) {
  const Results expected = sampleResults();
  writeResults(expected, path_);
  const Results found = readResults(path_);
  EXPECT_EQ(found.comparison.verdict, "incomplete");
  EXPECT_EQ(found.comparison.maximum, 13);
  EXPECT_EQ(found.comparison.median, 2.5);
  EXPECT_EQ(found.comparison.maximumOf[0], 12);
  EXPECT_TRUE(std::isnan(found.comparison.maximumOf[1]));
  expectSame(found.comparison.overestimation, expected.comparison.overestimation, "overestimation");
  expectSame(found.comparison.excess, expected.comparison.excess, "excess");
  ASSERT_EQ(found.comparison.disputed.size(), 2U);
  const DisputedSample& sample = found.comparison.disputed[0];
  EXPECT_EQ(sample.number, 17);
  EXPECT_EQ(sample.time, 1U);
  EXPECT_EQ(sample.output, 0U);
  EXPECT_EQ(sample.value, 0.09);
  EXPECT_EQ(sample.lower, 0.1);
  EXPECT_EQ(sample.upper, 1.1);
  EXPECT_EQ(sample.distance, 0.01);
  EXPECT_EQ(sample.error, 1e-9);
  EXPECT_EQ(sample.decided, "tolerance 1e-12");
  EXPECT_TRUE(sample.outside);
  EXPECT_FALSE(found.comparison.disputed[1].outside);
  EXPECT_EQ(found.comparison.disputed[1].decided, "unresolved");
}

TEST_F(ResultsFile, KeepsAbsentPartsAbsent) {
  Results results = sampleResults();
  results.stochastic = {};
  results.fuzzy = {};
  results.comparison = {};
  results.uncertain.clear();
  writeResults(results, path_);
  const Results found = readResults(path_);
  EXPECT_TRUE(found.interval.present);
  EXPECT_FALSE(found.stochastic.present);
  EXPECT_FALSE(found.fuzzy.present);
  EXPECT_FALSE(found.comparison.present);
  EXPECT_TRUE(found.uncertain.empty());
}

/// Standard output of a command.
std::string outputOf(const std::string& command) {
  std::string output;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
  ::pclose(pipe);
  return output;
}

TEST_F(ResultsFile, ExplainsItselfToH5dump) {
  if (std::system("command -v h5dump > /dev/null 2>&1") != 0) GTEST_SKIP() << "h5dump (hdf5-tools) is not installed";
  writeResults(sampleResults(), path_);
  const std::string at = outputOf("h5dump -d /interval/at_lower " + path_);
  for (const char* word : {"\"units\"", "\"m\", \"J\"", "\"long_name\"", "enclosure at the output time, lower bound",
                           "\"DIMENSION_LIST\"", "\"DIMENSION_LABELS\"", "\"time\", \"output\""})
    EXPECT_THAT(at, HasSubstr(word));
  const std::string time = outputOf("h5dump -d /time " + path_);
  for (const char* word : {"\"DIMENSION_SCALE\"", "\"NAME\"", "\"units\"", "\"s\""}) EXPECT_THAT(time, HasSubstr(word));
  const std::string fuzzy = outputOf("h5dump -A -d /fuzzy/outer_upper " + path_);
  EXPECT_THAT(fuzzy, HasSubstr("( 3, 3, 2 )"));
  EXPECT_THAT(fuzzy, HasSubstr("\"alpha\", \"time\", \"output\""));
  const std::string study = outputOf("h5dump -g /study " + path_);
  for (const char* word : {"9.8.7", "somewhere", "sample.toml", "18446744073709551615", "SUNDIALS"})
    EXPECT_THAT(study, HasSubstr(word));
}

TEST_F(ResultsFile, CompressesLargeGrids) {
  Results results = sampleResults();
  results.time.resize(5000);
  for (std::size_t i = 0; i < 5000; ++i) results.time[i] = static_cast<double>(i);
  results.interval.at = Bounds(5000, 2);
  results.interval.over = {};
  results.stochastic = {};
  results.fuzzy = {};
  results.comparison = {};
  writeResults(results, path_);
  EXPECT_LT(std::filesystem::file_size(path_), 5000U * 2 * 8);
  expectSame(readResults(path_).interval.at, results.interval.at, "at");
}

TEST_F(ResultsFile, IsRefusedInOneLineWhenItIsSomethingElse) {
  const auto message = [](const std::string& path) -> std::string {
    try {
      readResults(path);
    } catch (const ResultsFileError& error) {
      return error.what();
    }
    return "it was read";
  };
  EXPECT_EQ(message(folder_.path("none.h5")),
            folder_.path("none.h5") + ": cannot be read; expected a results file written by gamut run");
  const std::string text = folder_.path("text.h5");
  std::ofstream(text) << "[study]\n";
  EXPECT_EQ(message(text), text +
                               ": not a Gamut results file, or damaged (the file cannot be read); expected a results "
                               "file written by gamut run");
  const std::string foreign = folder_.path("foreign.h5");
  Hdf5Handle(H5Fcreate(foreign.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, foreign);
  EXPECT_EQ(message(foreign),
            foreign + ": an HDF5 file, but not of Gamut results; expected a results file written by gamut run");
}

TEST_F(ResultsFile, IsRefusedAtEveryTruncation) {
  writeResults(sampleResults(), path_);
  const auto size = std::filesystem::file_size(path_);
  const std::string cut = folder_.path("cut.h5");
  for (std::uintmax_t keep = 0; keep < size; keep += size / 97 + 1) {
    std::filesystem::copy_file(path_, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(cut, keep);
    try {
      readResults(cut);
      ADD_FAILURE() << "read although only " << keep << " of " << size << " bytes are there";
    } catch (const ResultsFileError& error) {
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    }
  }
}

TEST_F(ResultsFile, OfAnEarlierRunSurvivesAWriteThatFails) {
  writeResults(sampleResults(), path_);
  Results bad = sampleResults();
  bad.title = "never seen";
  bad.interval.at = Bounds(1, 1);  // not times x outputs
  EXPECT_THROW(writeResults(bad, path_), std::logic_error);
  EXPECT_EQ(readResults(path_).title, sampleResults().title);
  EXPECT_EQ(folder_.count(), 1U) << "a temporary file was left behind";
}

TEST_F(ResultsFile, OfAnEarlierRunSurvivesAKilledWrite) {
  writeResults(sampleResults(), path_);
  const pid_t child = ::fork();
  if (child == 0) {
    replaceFile(path_, [](const std::string& temporary) {
      std::ofstream(temporary) << "half a file";
      ::kill(::getpid(), SIGKILL);
    });
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(readResults(path_).title, sampleResults().title);
}

TEST(ReplaceFile, NamesAFolderThatDoesNotExist) {
  try {
    replaceFileText("/nowhere/at/all/x.html", "x");
    ADD_FAILURE() << "was written";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "/nowhere/at/all/x.html: cannot be written; the folder /nowhere/at/all does not exist");
  }
}

}  // namespace
}  // namespace gamut
