// Runs the analyses that a study names on one mechanism and one set of uncertain quantities, and compares their
// answers.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "studies/machine.hpp"
#include "studies/results/results.hpp"

namespace gamut {

class Checkpoints;
class Communicator;

/// What belongs to a run, not to the study.
struct RunOptions {
  int jobs = 1;                        ///< threads
  std::optional<std::uint64_t> seed;   ///< instead of the study's
  std::optional<std::size_t> samples;  ///< instead of the study's
  std::optional<double> timeLimit;     ///< of the whole run, s of CPU, instead of the study's
  std::optional<double> memoryLimit;   ///< likewise, bytes
  /// Called with the name of what is being done and the fraction done of it, from any thread.
  std::function<void(const std::string& task, double fraction)> progress;
  /// Called, from a thread of its own, if an enclosure that was told to end has not done so for a minute.
  std::function<void(const std::string& why)> overdue;
  /// Called by the thread that runs, whenever a part of the results is there, with those that there are.
  std::function<void(const Results& soFar)> found;
  const std::atomic<bool>* cancelled = nullptr;  ///< set from outside to end early; what was computed is kept
  Checkpoints* checkpoints = nullptr;            ///< what it remembers of itself, made by the thread that runs it
  Communicator* communicator = nullptr;          ///< of the ranks that run it, likewise; limits are of each of them
};

/// The study's limits, or those of the options.
Limits limitsOf(const Study& study, const RunOptions& options);

/// About as many bytes as its samples take, and what is kept of them until it is written.
double memoryNeeded(const Study& study, const RunOptions& options);

/// Everything that the study asks for. An analysis that ends early says why in its part of the results; no verdict is
/// given (ComparisonResult::present is false) unless samples and either enclosures or alpha-cuts were asked for. Of
/// ranks the first has the results, however many there are the same to the last bit but for costs; others may be told
/// of no part in them (Communicator::Parted).
Results run(const Machine& machine, const RunOptions& options = {});
inline Results run(const Study& study, const RunOptions& options = {}) { return run(Machine(study), options); }

}  // namespace gamut
