#include "studies/results/results_file.hpp"

#include <fmt/format.h>

#include "studies/results/detail/content.hpp"
#include "studies/results/detail/sealed_file.hpp"

namespace gamut {

void writeResults(const Results& results, OutputFile& file) {
  writeSealed(file, resultsKind, [&](hid_t whole) { writeContent(whole, results); });
}

void writeResults(const Results& results, const std::string& path) {
  OutputFile file(path, OutputFile::Existing::isReplaced);
  writeResults(results, file);
}

Results readResults(const std::string& path, const std::vector<Boxed<FurtherPart>>& further) {
  Results results;
  readSealed(path, resultsKind, [&](const Hdf5Reader& root) { results = readContent(root, further); });
  return results;
}

std::string hdf5Version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace gamut
