#include "commands/kept_sweep.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

#include "studies/sweeps/sweep_file.hpp"

namespace gamut {

KeptSweep::KeptSweep(const std::string& path, bool isReplaced, SweepResults& sweep) : path_(path) {
  std::error_code error;
  if (!isReplaced && std::filesystem::exists(path, error) && isSweepFile(path)) {
    SweepResults there = readSweep(path);
    if (!asksTheSame(there, sweep))
      throw OutputRefused(fmt::format("{}: holds another sweep{}; expected another name, or --force", path,
                                      there.version == sweep.version ? "" : ", of Gamut " + there.version));
    sweep = std::move(there);
    isGoneOn_ = true;
  }
  file_ = std::make_unique<OutputFile>(
      path, isReplaced || isGoneOn_ ? OutputFile::Existing::isReplaced : OutputFile::Existing::isKept);
}

void KeptSweep::keep(const SweepResults& sweep) try {
  problem_.clear();
  if (!file_) file_ = std::make_unique<OutputFile>(path_, OutputFile::Existing::isReplaced);
  writeSweep(sweep, *file_);
  file_ = std::make_unique<OutputFile>(path_, OutputFile::Existing::isReplaced);  // ours until the next time
} catch (const WriteError& error) {
  problem_ = error.what();
  file_.reset();
}

}  // namespace gamut
