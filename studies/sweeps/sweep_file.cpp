#include "studies/sweeps/sweep_file.hpp"

#include "studies/results/detail/content.hpp"
#include "studies/results/detail/sealed_file.hpp"

namespace gamut {

void writeSweep(const SweepResults& sweep, OutputFile& file) {
  SweepResults written = sweep;  // describing is not const
  writeSealed(file, sweepKind, [&](hid_t whole) {
    writeGroups(whole, describe(written), {{unit::ofOutput, jointUnit(written.outputs)}});
  });
}

SweepResults readSweep(const std::string& path) {
  SweepResults sweep;
  readSealed(path, sweepKind, [&](const Hdf5Reader& root) {
    sweep = {};
    const std::vector<Group> groups = describe(sweep);
    readGroups(root, groups);
    if (sweep.plan.axes.empty() || sweep.points.size() != sweep.plan.points()) throw Hdf5Error("/points");
    if (sweep.outputs.empty()) throw Hdf5Error("/outputs");
    const std::vector<Group> whole = describe(sweep);
    for (const std::string& fault : {misshapen(whole), senseless(whole)})
      if (!fault.empty()) throw Hdf5Error(fault);
  });
  return sweep;
}

bool isSweepFile(const std::string& path) { return isSealedAs(path, sweepKind); }

}  // namespace gamut
