// The user block is written anew from the file's content and compared as a whole, so that no byte of it can change
// unseen.
#include "studies/results/detail/seal.hpp"

#include <fmt/format.h>
#include <openssl/sha.h>

#include <charconv>

namespace gamut {
namespace {

/// 1 was without user block, with texts by reference; 2 without the samples' values and motions; 4 without tables; 8
/// without what stopped a run.
constexpr int formatVersion = 11;
constexpr std::string_view title = "Gamut results, format ";

std::string digestOf(std::string_view content) {
  unsigned char digest[SHA256_DIGEST_LENGTH];
  SHA256(reinterpret_cast<const unsigned char*>(content.data()), content.size(), digest);
  std::string text;
  for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

std::string sealOf(std::string_view file) {
  std::string text =
      fmt::format("{}{}\nbytes {}\nsha256 {}\n", title, formatVersion, file.size(), digestOf(file.substr(sealSize)));
  text.resize(sealSize, '\0');
  return text;
}

[[noreturn]] void refuseVersion(int version) {
  throw SealError(fmt::format("written in format {} by {} build of gamut; expected format {}, so {}", version,
                              version < formatVersion ? "an older" : "a newer", formatVersion,
                              version < formatVersion ? "run the study again" : "use that build"));
}

/// Throws if there is another version's user block.
void checkVersion(std::string_view file) {
  const std::string_view number = file.substr(title.size(), 9);
  int version = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), version);
  if (error == std::errc() && end != number.data() + number.size() && *end == '\n' && version > 0 &&
      version != formatVersion)
    refuseVersion(version);
}

}  // namespace

void seal(std::string& file) { file.replace(0, sealSize, sealOf(file)); }

void checkSeal(std::string_view file) {
  constexpr std::string_view hdf5 = "\x89HDF\r\n\x1a\n", expected = "; expected a results file written by gamut run";
  if (file.starts_with(title)) checkVersion(file);
  if (file.starts_with(hdf5)) {
    // Format 1 kept its name and version as attributes of these names.
    if (file.find("format_version") != file.npos && file.find("Gamut results") != file.npos) refuseVersion(1);
    throw SealError("an HDF5 file, but not of Gamut results" + std::string(expected));
  }
  if (!file.starts_with(title)) throw SealError("not a Gamut results file" + std::string(expected));
  const std::string_view lines = file.substr(0, sealSize);
  if (file.size() <= sealSize || lines != sealOf(file)) {
    const std::string size = fmt::format("\nbytes {}\n", file.size());
    const bool isWhole = lines.find(size) != lines.npos;
    throw SealError(fmt::format("damaged: {}; expected the file as gamut run wrote it",
                                isWhole ? "its digest is not that of its content"
                                        : fmt::format("its {} bytes are not as many as it says", file.size())));
  }
}

}  // namespace gamut
