// A results file says in its first bytes, HDF5's user block, how long it is and what the SHA-256 digest of the rest is:
// damage is found before any library interprets the content. Text, so that common tools can tell:
//
//   head -n 3 study.h5; tail -c +513 study.h5 | sha256sum
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace gamut {

/// Of the user block, whatever the format's version.
constexpr std::size_t sealSize = 512;

/// What is wrong with a file's first bytes or its digest; a clause.
class SealError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a sealed file holds.
struct FileKind {
  std::string_view title;    ///< with which it begins, before the format's number
  int version;               ///< of the format
  std::string_view name;     ///< "results"
  std::string_view file;     ///< "a results file written by gamut run"
  std::string_view command;  ///< "run"
  std::string_view again;    ///< what to do where a file is of an older format: "run the study again"
};

/// Format 1 was without user block, with texts by reference; 2 without the samples' values and motions; 4 without
/// tables; 8 without what stopped a run.
inline constexpr FileKind resultsKind{
    "Gamut results, format ", 11, "results", "a results file written by gamut run", "run", "run the study again"};
inline constexpr FileKind sweepKind{"Gamut sweep, format ",          1,       "a sweep",
                                    "a file written by gamut sweep", "sweep", "sweep the study again"};

/// Fills the user block in front of `file`.
void seal(std::string& file, const FileKind& kind = resultsKind);

/// Throws SealError unless `file` is what seal() gave of this kind, byte for byte.
void checkSeal(std::string_view file, const FileKind& kind = resultsKind);

}  // namespace gamut
