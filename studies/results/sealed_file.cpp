#include "studies/results/detail/sealed_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <sstream>

#include "studies/readable.hpp"
#include "studies/results/detail/apart.hpp"
#include "studies/results/results_file.hpp"

namespace gamut {
namespace {

/// Reads a file's content in a child process: a file with a right seal is what some program wrote, not what gamut
/// wrote, and HDF5 crashes or hangs at some. The child may need the content's size once more as it is and unpacked,
/// 1100 times as large at most; it takes 0.1 s for 5 MB, and is given fifty times that, or a hundred. Throws Hdf5Error.
void readApart(const std::string& content, const std::function<void(const Hdf5Reader&)>& read) {
  const auto transcribed = [&] {
    Hdf5Transcript transcript;
    try {
      read(Hdf5Reader(content, transcript));
    } catch (const Hdf5Error&) {  // the transcript ends with it
    }
    return transcript.bytes();
  };
  std::optional<std::string> transcript = resultApart(transcribed, (std::size_t{512} << 20) + 2200 * content.size(),
                                                      static_cast<unsigned>(5 + content.size() / 1000000));
  if (!transcript) throw Hdf5Error("the file");
  Hdf5Transcript told(*std::move(transcript));
  read(Hdf5Reader(told));
}

}  // namespace

std::string sealedContent(const FileKind& kind, const std::function<void(hid_t)>& fill) {
  const Hdf5Silence silence;
  std::string content = hdf5InMemory(sealSize, fill);
  seal(content, kind);
  return content;
}

void writeSealed(OutputFile& file, const FileKind& kind, const std::function<void(hid_t)>& fill) {
  std::string content;
  try {
    content = sealedContent(kind, fill);
  } catch (const Hdf5Error& error) {
    throw WriteError(fmt::format("{}: cannot be written; HDF5 failed at {}", file.path(), error.what()));
  }
  file.write(content);
}

void readSealed(const std::string& path, const FileKind& kind, const std::function<void(const Hdf5Reader&)>& read) {
  const Hdf5Silence silence;  // the child's too
  if (const std::string fault = whyUnreadable(path); !fault.empty())
    throw ResultsFileError(fmt::format("{}: {}; expected {}", path, fault, kind.file));
  std::ifstream file(path, std::ios::binary);
  const std::string content = (std::ostringstream() << file.rdbuf()).str();
  try {
    checkSeal(content, kind);
  } catch (const SealError& refused) {
    throw ResultsFileError(fmt::format("{}: {}", path, refused.what()));
  }
  try {
    readApart(content, read);
  } catch (const Hdf5Error& damaged) {
    throw ResultsFileError(fmt::format("{}: damaged: {} cannot be read; expected the file as gamut {} wrote it", path,
                                       damaged.what(), kind.command));
  }
}

bool isSealedAs(const std::string& path, const FileKind& kind) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(kind.title.size(), '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return file.gcount() == static_cast<std::streamsize>(begin.size()) && begin == kind.title;
}

}  // namespace gamut
