// libFuzzer on the reader of results files and all that shows what was read. Mutations are carried behind the checks:
// the digest, and sometimes HDF5's own checksums, are made right. Built by the preset "fuzz"; campaigns/fuzz.sh runs
// it.
#include <pthread.h>
#include <sanitizer/common_interface_defs.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "reports/report.hpp"
#include "reports/summary.hpp"
#include "reports/verdict.hpp"
#include "studies/printable.hpp"
#include "studies/results/results_file.hpp"
#include "tests/studies/damage.hpp"
#include "tests/studies/sample_results.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t limit);

/// The first of the corpus, in the folder that the last argument names.
extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  // The end of a child is no finding: it is what children are for.
  ::pthread_atfork(nullptr, nullptr, [] { __sanitizer_set_death_callback(nullptr); });
  const std::filesystem::path folder = (*arguments)[*count - 1];
  if (!std::filesystem::is_directory(folder)) return 0;
  gamut::Results results = gamut::sampleResults();
  gamut::writeResults(results, folder / "sample.h5");
  results.interval = {};
  results.fuzzy = {};
  results.comparison = {};
  gamut::writeResults(results, folder / "samples_alone.h5");
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t limit, unsigned seed) {
  std::mt19937_64 random(seed);
  std::string bytes(reinterpret_cast<const char*>(data), size);
  const unsigned way = random() % 4;
  if (way == 0 && size > 1) {
    bytes = gamut::damaged(std::move(bytes), random);
  } else if (way == 1) {
    const std::size_t header = bytes.find("OHDR", random() % (size + 1));  // in the midst of what HDF5 interprets
    if (header != std::string::npos && header + 300 < size)
      bytes[header + random() % 300] = static_cast<char>(random());
  } else {
    bytes.resize(LLVMFuzzerMutate(data, size, limit));
    std::memcpy(bytes.data(), data, bytes.size());
  }
  if (random() % 4 != 0) bytes = gamut::withHdf5Checksums(std::move(bytes));
  if (random() % 32 != 0) bytes = gamut::sealed(std::move(bytes));
  const std::size_t kept = std::min(bytes.size(), limit);
  std::memcpy(data, bytes.data(), kept);
  return kept;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string path =
      std::filesystem::temp_directory_path() / ("gamut-fuzz-" + std::to_string(::getpid()) + ".h5");
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const gamut::Results results = gamut::readResults(path);
    gamut::judge(results);
    gamut::infoText(results);
    gamut::textSummary(results);
    gamut::renderReport(results);
  } catch (const gamut::ResultsFileError& error) {
    const std::string line = error.what();
    if (gamut::hasControlCharacters(line) || line.find("; expected ") == line.npos) {
      std::fprintf(stderr, "not one line that says what is expected: %s\n", line.c_str());
      std::abort();
    }
  }
  ::unlink(path.c_str());
  return 0;
}
