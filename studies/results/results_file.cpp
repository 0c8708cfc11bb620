// A seal in front of what HDF5 writes; HDF5 reads in a child process, and what it said is read again here.
#include "studies/results/results_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <sstream>

#include "studies/atomic_file.hpp"
#include "studies/readable.hpp"
#include "studies/results/detail/apart.hpp"
#include "studies/results/detail/content.hpp"
#include "studies/results/detail/hdf5.hpp"
#include "studies/results/detail/seal.hpp"

namespace gamut {
namespace {

/// Reads a file's content in a child process: a file with a right seal is what some program wrote, not what gamut run
/// wrote, and HDF5 crashes or hangs at some. The child may need the content's size once more as it is and unpacked,
/// 1100 times as large at most; it takes 0.1 s for 5 MB, and is given fifty times that, or a hundred. Throws Hdf5Error.
Results readApart(const std::string& content, const std::vector<Boxed<FurtherPart>>& further) {
  const auto read = [&] {
    Hdf5Transcript transcript;
    try {
      readContent(Hdf5Reader(content, transcript), further);
    } catch (const Hdf5Error&) {  // the transcript ends with it
    }
    return transcript.bytes();
  };
  std::optional<std::string> transcript = resultApart(read, (std::size_t{512} << 20) + 2200 * content.size(),
                                                      static_cast<unsigned>(5 + content.size() / 1000000));
  if (!transcript) throw Hdf5Error("the file");
  Hdf5Transcript told(*std::move(transcript));
  return readContent(Hdf5Reader(told), further);
}

}  // namespace

void writeResults(const Results& results, OutputFile& file) {
  const Hdf5Silence silence;
  std::string content;
  try {
    content = hdf5InMemory(sealSize, [&](hid_t whole) { writeContent(whole, results); });
    seal(content);
  } catch (const Hdf5Error& error) {
    throw WriteError(fmt::format("{}: cannot be written; HDF5 failed at {}", file.path(), error.what()));
  }
  file.write(content);
}

void writeResults(const Results& results, const std::string& path) {
  OutputFile file(path, OutputFile::Existing::isReplaced);
  writeResults(results, file);
}

Results readResults(const std::string& path, const std::vector<Boxed<FurtherPart>>& further) {
  const Hdf5Silence silence;  // the child's too
  if (const std::string fault = whyUnreadable(path); !fault.empty())
    throw ResultsFileError(fmt::format("{}: {}; expected a results file written by gamut run", path, fault));
  std::ifstream file(path, std::ios::binary);
  const std::string content = (std::ostringstream() << file.rdbuf()).str();
  try {
    checkSeal(content);
  } catch (const SealError& refused) {
    throw ResultsFileError(fmt::format("{}: {}", path, refused.what()));
  }
  try {
    return readApart(content, further);
  } catch (const Hdf5Error& damaged) {
    throw ResultsFileError(
        fmt::format("{}: damaged: {} cannot be read; expected the file as gamut run wrote it", path, damaged.what()));
  }
}

std::string hdf5Version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace gamut
