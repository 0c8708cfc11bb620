// Results inside an HDF5 file, field by field as they describe themselves.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "studies/results/detail/hdf5.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// What stands for the unit of each of many: unit::ofOutput, and what of all outputs is written in its place.
using JointUnits = std::map<std::string_view, std::string>;

/// Throws Hdf5Error naming what could not be written, std::logic_error for a field whose shape does not fit.
void writeGroups(hid_t file, std::vector<Group> groups, JointUnits units);

/// Fills groups one after the other; what a later one has may depend on what was read before. Throws Hdf5Error naming
/// what is missing, or of another kind or shape than described.
void readGroups(const Hdf5Reader& root, const std::vector<Group>& groups);

/// One unit for all records, or one a record with commas between them.
template <class Record>
std::string jointUnit(const std::vector<Record>& records) {
  const bool isOne = std::ranges::all_of(records, [&](const Record& r) { return r.unit == records.front().unit; });
  std::string joint;
  for (std::size_t i = 0; i < (isOne ? std::min<std::size_t>(records.size(), 1) : records.size()); ++i)
    joint += (i == 0 ? "" : ", ") + records[i].unit;
  return joint;
}

/// Throws Hdf5Error naming what could not be written, std::logic_error for a field whose shape does not fit.
void writeContent(hid_t file, const Results& results);

/// Throws Hdf5Error naming what is missing, of another kind or shape than described, or makes no sense.
Results readContent(const Hdf5Reader& root, const std::vector<Boxed<FurtherPart>>& further);

}  // namespace gamut
