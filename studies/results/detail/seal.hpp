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

/// Fills the user block in front of `file`.
void seal(std::string& file);

/// Throws SealError unless `file` is what seal() gave, byte for byte.
void checkSeal(std::string_view file);

}  // namespace gamut
