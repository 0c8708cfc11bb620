// Results files that are damaged: each is refused in one line, none crashes, hangs or is taken for a verdict.
#include <gmock/gmock.h>

#include "reports/verdict.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/studies/damage.hpp"
#include "tests/studies/sample_study.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr int rounds = 125;

class DamagedResults : public ::testing::Test {
 protected:
  /// The results of a run: small data in headers, larger ones in chunks.
  static void SetUpTestSuite() {
    const std::string study = sampleStudyWith("output_step = 0.1", "output_step = 0.005");
    RunOptions options;
    options.jobs = 1;
    const TemporaryFolder folder;
    writeResults(run(readStudyText(study, "s.toml"), options), folder.path("s.h5"));
    whole_ = folder.read("s.h5");
  }
  static void TearDownTestSuite() { whole_.clear(); }

  /// What reading says; "" if it reads.
  std::string complaint(const std::string& bytes, Agreement& verdict) const {
    folder_.write("d.h5", bytes);
    try {
      verdict = judge(readResults(folder_.path("d.h5"))).word;
    } catch (const ResultsFileError& error) {
      return error.what();
    }
    return "";
  }

  TemporaryFolder folder_;
  static inline std::string whole_;
};

TEST_F(DamagedResults, AreRefusedWhateverWasDamaged) {
  Agreement verdict = Agreement::incomplete;
  ASSERT_EQ(complaint(whole_, verdict), "");
  ASSERT_EQ(verdict, Agreement::inside);
  std::mt19937_64 random(1);
  for (int i = 0; i < rounds; ++i) {
    const std::string bytes = damaged(whole_, random);
    if (bytes == whole_) continue;
    const std::string message = complaint(bytes, verdict);
    EXPECT_THAT(message, StartsWith(folder_.path("d.h5") + ": ")) << "damage number " << i << " was not seen";
    EXPECT_THAT(message, HasSubstr("; expected ")) << i;
    EXPECT_THAT(message, Not(HasSubstr("\n"))) << i;
  }
}

TEST_F(DamagedResults, AreNoVerdictEvenIfTheirDigestIsRight) {
  std::mt19937_64 random(2);
  int refused = 0;
  for (int i = 0; i < rounds; ++i) {
    Agreement verdict = Agreement::inside;
    const std::string message = complaint(sealed(damaged(whole_, random)), verdict);
    EXPECT_EQ(verdict, Agreement::inside) << "damage number " << i;
    EXPECT_THAT(message, Not(HasSubstr("\n"))) << i;
    refused += message.empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 0.6 * rounds);
}

TEST_F(DamagedResults, DoNotCrashEvenIfHdf5sChecksumsAreRight) {
  std::mt19937_64 random(3);
  for (int i = 0; i < rounds; ++i) {
    std::string bytes = whole_;
    Agreement verdict = Agreement::incomplete;
    // Headers are a small part of the file; damage meets them here.
    for (int flips = 0; flips < 3; ++flips) {
      const std::size_t header = bytes.find("OHDR", random() % bytes.size());
      if (header == std::string::npos || header + 300 > bytes.size()) continue;
      bytes[header + 6 + random() % 250] = static_cast<char>(random());
    }
    EXPECT_THAT(complaint(sealed(withHdf5Checksums(bytes)), verdict), Not(HasSubstr("\n"))) << i;
  }
}

TEST_F(DamagedResults, SayWhatIsWrong) {
  Agreement verdict = Agreement::incomplete;
  const std::string path = folder_.path("d.h5"), expected = "; expected the file as gamut run wrote it";
  std::string flipped = whole_;
  flipped.back() ^= 1;
  EXPECT_EQ(complaint(flipped, verdict), path + ": damaged: its digest is not that of its content" + expected);
  EXPECT_EQ(complaint(whole_.substr(0, 5000), verdict),
            path + ": damaged: its 5000 bytes are not as many as it says" + expected);
  EXPECT_EQ(complaint(sealed(whole_.substr(0, 600)), verdict), path + ": damaged: the file cannot be read" + expected);
  std::string newer = whole_;
  newer.replace(newer.find("format 11"), 9, "format 12");
  EXPECT_EQ(complaint(newer, verdict),
            path + ": written in format 12 by a newer build of gamut; expected format 11, so use that build");
}

}  // namespace
}  // namespace gamut
