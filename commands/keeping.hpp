// Where the results of a run go. What was found before an interrupt or a limit takes the place of nothing that holds
// more: then it goes to NAME.partial.h5, and its page to NAME.partial.html. What another program put there during the
// run is not ours to replace: then both go to NAME.2.h5 and NAME.2.html, or the next free number.
#pragma once

#include <optional>
#include <string>

#include "studies/atomic_file.hpp"
#include "studies/results/results.hpp"

namespace gamut {

class Keeping {
 public:
  /// Looks at what is there already if the run was stopped, or is there by now though it is to be kept, and reserves
  /// other names if need be. Throws as OutputFile
  /// does.
  Keeping(const Results& results, OutputFile& resultsFile, OutputFile& reportFile);

  /// None is written where a file of that name holds as much, and is of the same run.
  OutputFile* results() { return resultsFile_; }
  OutputFile* report() { return reportFile_; }
  /// What is not where it was to be, and why; empty if all is.
  const std::string& note() const { return note_; }

 private:
  void placeBeside();
  void placeResults(const Results& results);
  void placeReport(std::size_t number);
  bool take(std::optional<OutputFile>& file, const std::string& path,
            OutputFile::Existing existing = OutputFile::Existing::isReplaced);

  OutputFile *resultsFile_, *reportFile_;
  std::optional<OutputFile> otherResults_, otherReport_;
  std::string note_, refusal_;
};

/// Whether a page says that it is of a run that was stopped.
bool isPageOfPart(const std::string& path);

/// "arm.partial.h5" of arm.h5; of a second one arm.partial2.h5.
std::string partialName(const std::string& path, std::size_t number);

/// "arm.2.h5" of arm.h5.
std::string numberedName(const std::string& path, std::size_t number);

}  // namespace gamut
