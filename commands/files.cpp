// Notes go to standard error: they are no answer.
#include "commands/files.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <system_error>

#include "commands/options.hpp"

namespace gamut {

Study readStudyNoting(const std::string& path, bool isQuiet) {
  Study study = readStudy(path);
  if (!isQuiet)
    for (const std::string& note : study.notes) fmt::print(stderr, "{}\n", note);
  return study;
}

OutputFile reserve(const std::string& path, const std::string& input, bool force) {
  std::error_code error;
  if (std::filesystem::equivalent(path, input, error)) throw UsageError(path + ": cannot be written; it is the input");
  return {path, force ? OutputFile::Existing::isReplaced : OutputFile::Existing::isKept};
}

}  // namespace gamut
