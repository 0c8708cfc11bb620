// Results inside an HDF5 file, field by field as they describe themselves.
#pragma once

#include "studies/results/detail/hdf5.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// Throws Hdf5Error naming what could not be written, std::logic_error for a field whose shape does not fit.
void writeContent(hid_t file, const Results& results);

/// Throws Hdf5Error naming what is missing, of another kind or shape than described, or makes no sense.
Results readContent(const Hdf5Reader& root, const std::vector<Boxed<FurtherPart>>& further);

}  // namespace gamut
