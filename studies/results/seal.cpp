// The user block is written anew from the file's content and compared as a whole, so that no byte of it can change
// unseen.
#include "studies/results/detail/seal.hpp"

#include <fmt/format.h>
#include <openssl/sha.h>

#include <charconv>

namespace gamut {
namespace {

std::string digestOf(std::string_view content) {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256(reinterpret_cast<const unsigned char*>(content.data()), content.size(), digest);
  std::string text;
  for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

std::string sealOf(std::string_view file, const FileKind& kind) {
  std::string text = fmt::format("{}{}\nbytes {}\nsha256 {}\n", kind.title, kind.version, file.size(),
                                 digestOf(file.substr(sealSize)));
  text.resize(sealSize, '\0');
  return text;
}

[[noreturn]] void refuseVersion(int version, const FileKind& kind) {
  throw SealError(fmt::format("written in format {} by {} build of gamut; expected format {}, so {}", version,
                              version < kind.version ? "an older" : "a newer", kind.version,
                              version < kind.version ? kind.again : "use that build"));
}

/// Throws if there is another version's user block.
void checkVersion(std::string_view file, const FileKind& kind) {
  const std::string_view number = file.substr(kind.title.size(), 9);
  int version = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), version);
  if (error == std::errc() && end != number.data() + number.size() && *end == '\n' && version > 0 &&
      version != kind.version)
    refuseVersion(version, kind);
}

/// Throws if it is a file of this kind, which was not expected.
void refuseKind(std::string_view file, const FileKind& other, const FileKind& kind) {
  if (file.starts_with(other.title) && other.title != kind.title)
    throw SealError(fmt::format("holds {}; expected {}", other.name, kind.file));
}

}  // namespace

void seal(std::string& file, const FileKind& kind) { file.replace(0, sealSize, sealOf(file, kind)); }

void checkSeal(std::string_view file, const FileKind& kind) {
  constexpr std::string_view hdf5 = "\x89HDF\r\n\x1a\n";
  const std::string expected = fmt::format("; expected {}", kind.file);
  if (file.starts_with(kind.title)) checkVersion(file, kind);
  for (const FileKind& other : {resultsKind, sweepKind}) refuseKind(file, other, kind);
  if (file.starts_with(hdf5)) {
    // Format 1 kept its name and version as attributes of these names.
    if (file.find("format_version") != file.npos && file.find("Gamut results") != file.npos) refuseVersion(1, kind);
    throw SealError(fmt::format("an HDF5 file, but not of Gamut results{}", expected));
  }
  if (!file.starts_with(kind.title)) throw SealError(fmt::format("not a Gamut results file{}", expected));
  const std::string_view lines = file.substr(0, sealSize);
  if (file.size() <= sealSize || lines != sealOf(file, kind)) {
    const std::string size = fmt::format("\nbytes {}\n", file.size());
    const bool isWhole = lines.find(size) != lines.npos;
    throw SealError(fmt::format("damaged: {}; expected the file as gamut {} wrote it",
                                isWhole ? "its digest is not that of its content"
                                        : fmt::format("its {} bytes are not as many as it says", file.size()),
                                kind.command));
  }
}

}  // namespace gamut
