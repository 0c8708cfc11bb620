// The file of a sweep: ours from the beginning to the end, written whole now and then.
#pragma once

#include <memory>
#include <string>

#include "studies/atomic_file.hpp"
#include "studies/sweeps/sweep_results.hpp"

namespace gamut {

class KeptSweep {
 public:
  /// Where the same sweep is there already, `sweep` becomes what was found of it, unless that is to be replaced. Throws
  /// OutputRefused where another one is there, or as OutputFile does; ResultsFileError where it is damaged.
  KeptSweep(const std::string& path, bool isReplaced, SweepResults& sweep);

  /// Whether there was something to go on with.
  bool isGoneOn() const { return isGoneOn_; }
  /// Writes it. What keeps it from being written is a problem until it succeeds.
  void keep(const SweepResults& sweep);
  /// One line; empty if there is none.
  const std::string& problem() const { return problem_; }

 private:
  std::string path_, problem_;
  bool isGoneOn_ = false;
  std::unique_ptr<OutputFile> file_;
};

}  // namespace gamut
