// What is written is what is read; a file explains itself; a write that fails or is killed leaves the old file.
#include "studies/results/results_file.hpp"
#include "studies/analyses/derivatives.hpp"
#include "studies/analyses/modes.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "studies/atomic_file.hpp"
#include "studies/results/detail/hdf5.hpp"
#include "tests/studies/damage.hpp"
#include "tests/studies/sample_results.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Standard output of a command.
std::string outputOf(const std::string& command) {
  std::string output;
  std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
  ::pclose(pipe);
  return output;
}

class ResultsFile : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string path_ = folder_.path("run.h5");
};

TEST_F(ResultsFile, GivesBackWhatWasWritten) {
  writeResults(sampleResults(), path_);
  const Results found = readResults(path_);
  EXPECT_THAT(differences(found, sampleResults()), IsEmpty());
  EXPECT_EQ(found.outputs[0].name, "tip height");
  EXPECT_EQ(found.seed, 0xFFFFFFFFFFFFFFFFU);
  EXPECT_EQ(found.interval.steps, 123456789012);
  EXPECT_TRUE(std::isnan(found.comparison.maximumOf[1]));
  EXPECT_EQ(found.fuzzy.outer[1].upper(2, 1), sampleResults().fuzzy.outer[1].upper(2, 1));
  EXPECT_EQ(found.comparison.disputed[0].farthest, (std::vector<double>{0.01, 0.25}));
}

/// Files were written before it was kept how the proof of requirements ended.
TEST_F(ResultsFile, HoldsRequirementsWithoutTheirProof) {
  Results results = sampleResults();
  const std::vector<RequirementResult> requirements = results.requirements;
  results.requirements = {};
  results.requirements.assign(requirements.begin(), requirements.end());
  writeResults(results, path_);
  EXPECT_THAT(differences(readResults(path_), results), IsEmpty());
  EXPECT_THAT(differences(results, sampleResults()),
              ::testing::ElementsAre("/requirements/proof", "/requirements/cells"));
}

TEST_F(ResultsFile, WithACellThatIsNoneIsRefused) {
  for (const RequirementCell& cell : {RequirementCell{4, 2, Decision::met, {0}, {1}},
                                      {4, 1, Decision::met, {0.5}, {0}},
                                      {4, 1, Decision::met, {0}, {1.5}}}) {
    Results results = sampleResults();
    results.requirements.cells.push_back(cell);
    writeResults(results, path_);
    EXPECT_THROW(readResults(path_), std::runtime_error);
  }
}

TEST_F(ResultsFile, WithADisputeOverACutThatIsNotThereIsRefused) {
  for (const int level : {-2, 3}) {
    Results results = sampleResults();
    ASSERT_EQ(results.fuzzy.alpha.size(), 3U);
    results.comparison.disputed[0].level = level;
    writeResults(results, path_);
    EXPECT_THROW(readResults(path_), ResultsFileError) << level;
  }
}

TEST_F(ResultsFile, KeepsAbsentPartsAbsent) {
  Results results = sampleResults();
  results.stochastic = {};
  results.fuzzy = {};
  results.comparison = {};
  results.uncertain.clear();
  results.requirements = {};
  results.distribution = {};
  results.sensitivity = {};
  results.of<DerivativeResult>() = {};
  results.surrogate = {};
  writeResults(results, path_);
  const Results found = readResults(path_);
  EXPECT_THAT(differences(found, results), IsEmpty());
  EXPECT_TRUE(found.interval.present);
  EXPECT_FALSE(found.stochastic.present || found.distribution.present || found.surrogate.present);
}

TEST_F(ResultsFile, ExplainsItselfToH5dump) {
  if (std::system("command -v h5dump > /dev/null 2>&1") != 0) GTEST_SKIP() << "h5dump (hdf5-tools) is not installed";
  writeResults(sampleResults(), path_);
  const std::string at = outputOf("h5dump -d /interval/at_lower " + path_);
  for (const char* word : {"\"units\"", "\"m, J\"", "\"long_name\"", "enclosure at the output times, lower bound",
                           "\"DIMENSION_LIST\"", "\"DIMENSION_LABELS\"", "\"time\", \"output\""})
    EXPECT_THAT(at, HasSubstr(word));
  const std::string time = outputOf("h5dump -d /time " + path_);
  for (const char* word : {"\"DIMENSION_SCALE\"", "\"NAME\"", "\"units\"", "\"s\""}) EXPECT_THAT(time, HasSubstr(word));
  const std::string fuzzy = outputOf("h5dump -A -d /fuzzy/outer_upper " + path_);
  EXPECT_THAT(fuzzy, HasSubstr("( 3, 3, 2 )"));
  EXPECT_THAT(fuzzy, HasSubstr("\"alpha\", \"time\", \"output\""));
  const std::string study = outputOf("h5dump -g /study " + path_);
  for (const char* word :
       {"9.8.7", "somewhere", "sample.toml", "18446744073709551615", "SUNDIALS", "\"horizon_units\""})
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
  results.distribution = {};
  results.sensitivity = {};
  results.of<DerivativeResult>() = {};
  results.of<ModesResult>() = {};
  results.surrogate = {};
  results.requirements = {};
  results.margins = {};
  writeResults(results, path_);
  EXPECT_LT(std::filesystem::file_size(path_), 5000U * 2 * 8);
  EXPECT_THAT(differences(readResults(path_), results), IsEmpty());
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
            folder_.path("none.h5") + ": does not exist; expected a results file written by gamut run");
  const std::string text = folder_.path("text.h5");
  std::ofstream(text) << "[study]\n";
  EXPECT_EQ(message(text), text + ": not a Gamut results file; expected a results file written by gamut run");
  const std::string foreign = folder_.path("foreign.h5");
  Hdf5Handle(H5Fcreate(foreign.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, foreign);
  EXPECT_EQ(message(foreign),
            foreign + ": an HDF5 file, but not of Gamut results; expected a results file written by gamut run");
}

TEST_F(ResultsFile, OfAnOlderBuildIsRefusedWithItsFormat) {
  {
    const Hdf5Handle file(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose, path_);
    Hdf5Writer root(file);
    root.attribute("format", std::string("Gamut results"));
    root.attribute("format_version", std::int64_t{1});
  }
  try {
    readResults(path_);
    ADD_FAILURE() << "was read";
  } catch (const ResultsFileError& error) {
    EXPECT_EQ(error.what(), path_ +
                                ": written in format 1 by an older build of gamut; expected format 11, so run the "
                                "study again");
  }
}

/// Files of this format that were written before units and assemblies were kept: quantities are told in SI units.
TEST_F(ResultsFile, WithoutStatedUnitsIsReadAll) {
  Results results = sampleResults();
  results.uncertain[0].told = "deg";
  results.assembly = "pin: coupler.angle = 1 rad";
  writeResults(results, path_);
  EXPECT_EQ(readResults(path_).uncertain[0].told, "deg");
  EXPECT_EQ(readResults(path_).assembly, results.assembly);
  {
    const Hdf5Handle file(H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, path_);
    ASSERT_GE(H5Ldelete(file, "/study/uncertain/told", H5P_DEFAULT), 0);
    ASSERT_GE(H5Adelete_by_name(file, "/study", "assembly", H5P_DEFAULT), 0);
  }
  std::ifstream in(path_, std::ios::binary);
  const std::string bytes = sealed({std::istreambuf_iterator<char>(in), {}});
  std::ofstream(path_, std::ios::binary) << bytes;
  Results older = sampleResults();
  older.assembly.clear();
  EXPECT_THAT(differences(readResults(path_), older), IsEmpty());
}

TEST_F(ResultsFile, IsRefusedIfItsNumbersMakeNoSense) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto message = [&](const auto& change) -> std::string {
    Results results = sampleResults();
    change(results);
    writeResults(results, path_);
    try {
      readResults(path_);
    } catch (const ResultsFileError& error) {
      return error.what();
    }
    return "it was read";
  };
  const auto refused = [&](const std::string& what) {
    return path_ + ": damaged: " + what + " cannot be read; expected the file as gamut run wrote it";
  };
  EXPECT_EQ(message([](Results& r) { r.interval.at.upper(1, 1) = -1e9; }), refused("/interval/at"));
  EXPECT_EQ(message([](Results& r) { r.interval.over.lower(1, 1) = infinity; }), refused("/interval/over"));
  EXPECT_EQ(message([](Results& r) { r.fuzzy.outer[1].lower(0, 0) = 1e9; }), refused("/fuzzy/outer"));
  EXPECT_EQ(message([](Results& r) { r.interval.at.upper(1, 1) = infinity; }), "it was read");
  EXPECT_EQ(message([](Results& r) { r.uncertain[0].upper = 0; }), refused("/study/uncertain"));
  EXPECT_EQ(message([](Results& r) { r.comparison.disputed[0].lower = 2; }), refused("/comparison/disputed"));
  EXPECT_EQ(message([](Results& r) { r.comparison.disputed[0].number = -1; }), refused("/comparison/disputed/number"));
  EXPECT_EQ(message([](Results& r) { r.stochastic.samples = -1; }), refused("/stochastic/samples"));
  EXPECT_EQ(message([](Results& r) { r.time[1] = 0.03; }), refused("/time"));
  EXPECT_EQ(message([](Results& r) { r.fuzzy.alpha[1] = 1.5; }), refused("/fuzzy/alpha"));
}

TEST_F(ResultsFile, TellsItsDigestToCommonTools) {
  writeResults(sampleResults(), path_);
  const std::string digest = outputOf("tail -c +513 '" + path_ + "' | sha256sum").substr(0, 64);
  EXPECT_EQ(outputOf("sed -n 3p '" + path_ + "'"), "sha256 " + digest + "\n");
}

TEST_F(ResultsFile, KeepsLongTextsAndShowsControlCharactersInWords) {
  Results results = sampleResults();
  results.studyText = std::string(200000, 'x') + "\r\nß\t";
  results.title = "";
  results.studyFile = "a\x1b[31m\n.toml";
  results.outputs[0].name = "";
  writeResults(results, path_);
  const Results found = readResults(path_);
  EXPECT_EQ(found.studyText, results.studyText);
  EXPECT_EQ(found.title, "");
  EXPECT_EQ(found.studyFile, "a\\u001b[31m\\n.toml");
  EXPECT_EQ(found.outputs[0].name, "");
}

/// xarray's own words for a file.
TEST_F(ResultsFile, IsReadByXarrayWithUnitsAndNamedDimensions) {
  if (std::system("/usr/bin/python3 -c 'import xarray, h5netcdf' > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "python3-xarray and python3-h5netcdf are not installed";
  writeResults(sampleResults(), path_);
  std::string program = "import xarray\n", expected;
  const auto expect = [&](const std::string& group, const std::string& expression, const std::string& shown) {
    program += "f = xarray.open_dataset('" + path_ + "', engine='h5netcdf', group='" + group + "')\n";
    program += "print(" + expression + ")\n";
    expected += shown + "\n";
  };
  expect("/", "f.output.values, f.time.values, f.time.units", "['tip height' 'energy'] [0.   0.01 0.02] s");
  expect("interval", "f.at_lower.dims, f.at_lower.units, f.why",
         "('time', 'output') m, J the enclosure became wider than 1e6");
  expect("fuzzy", "f.outer_upper.dims, f.alpha.values", "('alpha', 'time', 'output') [0.  0.5 1. ]");
  expect("stochastic", "f.quantiles.sel(probability=0.95).shape, f.samples", "(3, 2) 4096");
  expect("comparison", "f.maximum_of.values, f.overestimation.units", "[12. nan] 1");
  expect("comparison/disputed", "f.decided.sel(number=17).item()", "Taylor 53 bits");
  expect("/", "f.quantity.values", "['first angle']");
  expect("study/uncertain", "f.upper.dims, f.upper.values, f.upper.units", "('quantity',) [1.1] rad");
  expect("study/libraries", "f.version.sel(name='HDF5').item()", "1.10");
  expect("study", R"(f.text.item() == '[study]\ntitle = "α"\n')", "True");
  EXPECT_EQ(outputOf("/usr/bin/python3 " + folder_.write("show.py", program)), expected);
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

}  // namespace
}  // namespace gamut
