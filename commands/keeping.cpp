// What is there is read before anything is written.
#include "commands/keeping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "studies/results/extent.hpp"
#include "studies/results/results_file.hpp"

namespace gamut {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t mostParts = 100;

/// No file, or an empty one.
bool isNothing(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return !error;
  return fs::is_regular_file(path, error) && fs::file_size(path, error) == 0 && !error;
}

/// Why what is at `path` stays; empty if it may go.
struct Older {
  std::string why;
  bool isEnough = false;  ///< it is of the same run, and holds all that the new results do
};

Older olderAt(const std::string& path, const Results& results) {
  if (isNothing(path)) return {};
  try {
    const Results older = readResults(path);
    if (older.stopped.empty()) return {"which is of a run that was not stopped", false};
    if (holdsAsMuch(results, older)) return {};
    return {"which holds more", asksTheSame(results, older) && holdsAsMuch(older, results)};
  } catch (const std::exception&) {  // of another format, damaged, too large to read now
    return {"of which this version cannot tell what it holds", false};
  }
}

}  // namespace

Keeping::Keeping(const Results& results, OutputFile& resultsFile, OutputFile& reportFile)
    : resultsFile_(&resultsFile), reportFile_(&reportFile) {
  if (resultsFile_->isTaken() || reportFile_->isTaken())
    placeBeside();
  else if (!results.stopped.empty())
    placeResults(results);
}

/// Under the first number by which neither file is called; whatever is free of the names asked for stays free.
void Keeping::placeBeside() {
  const OutputFile& taken = resultsFile_->isTaken() ? *resultsFile_ : *reportFile_;
  for (std::size_t number = 2; number <= mostParts; ++number) {
    const std::string results = numberedName(resultsFile_->target(), number),
                      report = numberedName(reportFile_->target(), number);
    if (!take(otherResults_, results, OutputFile::Existing::isKept) ||
        !take(otherReport_, report, OutputFile::Existing::isKept))
      continue;
    note_ = fmt::format("{} stays: another program has put it there during the run; the results are in {}",
                        taken.path(), results);
    resultsFile_ = &*otherResults_;
    reportFile_ = &*otherReport_;
    return;
  }
  throw WriteError(refusal_);
}

void Keeping::placeResults(const Results& results) {
  const std::string target = resultsFile_->target();
  const Older first = olderAt(target, results);
  if (first.why.empty()) return placeReport(0);
  note_ = fmt::format("{}: {} stays, {}", results.stopped, resultsFile_->path(), first.why);
  for (std::size_t number = 1; number <= mostParts; ++number) {
    const std::string path = partialName(target, number);
    const Older older = olderAt(path, results);
    if (older.isEnough) {
      note_ += fmt::format("; nothing was written, since {} holds as much as was found now, or more", path);
      resultsFile_ = reportFile_ = nullptr;
      return;
    }
    if (!older.why.empty() || !take(otherResults_, path)) continue;
    resultsFile_ = &*otherResults_;
    note_ += fmt::format("; what was found is in {}", path);
    return placeReport(number);
  }
  throw WriteError(refusal_.empty() ? partialName(target, 1) + ": cannot be written; too many such files hold more"
                                    : refusal_);
}

/// The page of what stays is not replaced. Pages do not say how much they show, but whether it is all.
void Keeping::placeReport(std::size_t number) {
  const std::string target = reportFile_->target();
  const auto mayGo = [](const std::string& path) { return isNothing(path) || isPageOfPart(path); };
  if (number == 0 && mayGo(target)) return;
  for (std::size_t i = std::max<std::size_t>(number, 1); i <= mostParts; ++i) {
    const std::string path = partialName(target, i);
    if (!mayGo(path) || !take(otherReport_, path)) continue;
    if (number == 0)
      note_ = fmt::format("{} stays, since it does not say that it is of a run that was stopped; the page is {}",
                          reportFile_->path(), path);
    reportFile_ = &*otherReport_;
    return;
  }
  reportFile_ = nullptr;
}

bool Keeping::take(std::optional<OutputFile>& file, const std::string& path, OutputFile::Existing existing) {
  try {
    file.emplace(path, existing);
    return true;
  } catch (const OutputRefused& error) {  // a folder, or somebody else's
    refusal_ = error.what();
    return false;
  }
}

bool isPageOfPart(const std::string& path) {
  std::array<char, 256> begin{};
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), begin.size());
  return std::string_view(begin.data(), static_cast<std::size_t>(file.gcount())).find("data-run=\"partial\"") !=
         std::string_view::npos;
}

std::string numberedName(const std::string& path, std::size_t number) {
  const fs::path whole(path);
  fs::path name = whole.stem();
  name += "." + std::to_string(number);
  name += whole.extension();
  return (whole.parent_path() / name).string();
}

std::string partialName(const std::string& path, std::size_t number) {
  const fs::path whole(path);
  fs::path name = whole.stem();
  name += ".partial" + (number > 1 ? std::to_string(number) : std::string());
  name += whole.extension();
  return (whole.parent_path() / name).string();
}

}  // namespace gamut
