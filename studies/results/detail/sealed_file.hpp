// Files that describe themselves, sealed: a seal in front of what HDF5 writes; HDF5 reads in a child process, and what
// it said is read again here.
#pragma once

#include <functional>
#include <string>

#include "studies/atomic_file.hpp"
#include "studies/results/detail/hdf5.hpp"
#include "studies/results/detail/seal.hpp"

namespace gamut {

/// The bytes of a file that `fill` writes. Throws Hdf5Error.
std::string sealedContent(const FileKind& kind, const std::function<void(hid_t)>& fill);

/// Writes them. Throws WriteError.
void writeSealed(OutputFile& file, const FileKind& kind, const std::function<void(hid_t)>& fill);

/// Reads a file of this kind by `read`, which is called here and in a child process, and throws Hdf5Error naming what
/// makes no sense. Throws ResultsFileError.
void readSealed(const std::string& path, const FileKind& kind, const std::function<void(const Hdf5Reader&)>& read);

/// Whether a file begins as those of this kind do.
bool isSealedAs(const std::string& path, const FileKind& kind);

}  // namespace gamut
