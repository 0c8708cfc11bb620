// libFuzzer on the reader of study files: any bytes give a study or one line that says what is wrong. Built by the
// preset "fuzz"; campaigns/fuzz.sh runs it.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "studies/printable.hpp"
#include "studies/study.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    gamut::readStudyText(text, "s.toml");
  } catch (const gamut::StudyError& error) {
    const std::string line = error.what();
    if (gamut::hasControlCharacters(line) || line.find("; expected ") == line.npos) {
      std::fprintf(stderr, "not one line that says what is expected: %s\n", line.c_str());
      std::abort();
    }
  }
  return 0;
}
