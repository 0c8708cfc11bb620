// Sweeps in an HDF5 file that explains itself, as results do; layout: docs/sweeps.md.
#pragma once

#include <string>

#include "studies/atomic_file.hpp"
#include "studies/sweeps/sweep_results.hpp"

namespace gamut {

/// Writes all of it. Throws WriteError.
void writeSweep(const SweepResults& sweep, OutputFile& file);

/// Reads what writeSweep wrote. Throws ResultsFileError. As readResults, only for a process without other threads.
SweepResults readSweep(const std::string& path);

/// Whether a file that is there begins as those of sweeps do.
bool isSweepFile(const std::string& path);

}  // namespace gamut
