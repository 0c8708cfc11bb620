// Results in an HDF5 file that explains itself to h5dump and h5py: dimension scales, units, long names. Layout:
// docs/results-file.md.
#pragma once

#include <stdexcept>
#include <string>

#include "studies/atomic_file.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// A file that is no Gamut results file, or a damaged one; what() is one line "path: what; expected what".
class ResultsFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes all of `results`. Throws WriteError if it cannot be written.
void writeResults(const Results& results, OutputFile& file);
/// An older file at `path` is replaced in one step, when the new one is whole.
void writeResults(const Results& results, const std::string& path);

/// Reads what writeResults wrote, every number and word alike (control characters in words as escapes); a file that
/// differs in one byte is refused. Throws ResultsFileError. What the HDF5 library cannot survive ends a child process:
/// only for a process without other threads. Of analyses beside the answers those that have a part among `further` are
/// read.
Results readResults(const std::string& path, const std::vector<Boxed<FurtherPart>>& further = furtherParts());

/// Of the library that writes and reads them: "1.10.8".
std::string hdf5Version();

}  // namespace gamut
