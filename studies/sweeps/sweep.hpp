// Runs a study at every point of a sweep: each in a process of its own, so that it is what a run of that study alone
// is, has limits of its own, and ends nobody else if it fails.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "studies/sweeps/sweep_results.hpp"

namespace gamut {

class Communicator;

struct SweepOptions {
  int jobs = 1;  ///< points at a time; where there are fewer points, the threads of each
  std::optional<std::uint64_t> seed = {};
  std::optional<std::size_t> samples = {};
  std::optional<double> timeLimit = {};  ///< of each point, s of CPU, instead of the study's
  /// Of each point, bytes, likewise; where nobody states one, those that run at a time share the machine.
  std::optional<double> memoryLimit = {};
  /// Called when a point has ended, and the fraction done of all.
  std::function<void(double fraction)> progress = {};
  /// Called with what there is, not before `betweenKeeps` have passed since it was called before, and once at the end.
  std::function<void(const SweepResults& sweep)> keep = {};
  double betweenKeeps = 2;                       ///< s
  const std::atomic<bool>* cancelled = nullptr;  ///< set from outside: points that are not finished stay open
  Communicator* communicator = nullptr;          ///< of the ranks that share the points, made by this thread
};

/// A sweep of which nothing was run: what is asked, with the texts of all files that the study names. Throws Refusal as
/// SweptStudy::check, StudyError where the study can be read at no point.
SweepResults plannedSweep(const std::string& text, const std::string& name, const SweepPlan& plan,
                          const SweepOptions& options);

/// What the study itself states, or no axis.
SweepPlan sweepStatedIn(const std::string& text, const std::string& name);

/// A list of points: the first row of a CSV file names numbers, each followed by its unit if it has one, `rod.length
/// [mm]`; each other row is a point. Throws StudyError, std::invalid_argument with a sentence for what is no table.
SweepPlan sweepPointsIn(const std::string& path);

/// The study of a point, word for word.
std::string studyTextAt(const SweepResults& sweep, std::size_t point);

/// Runs all points that are open or failed. In whatever order they end, the results are the same. Not for a process in
/// which other threads may hold a lock that a run needs. Of ranks the first has the sweep and all of the options; the
/// others hear it from that one, have their own `jobs` and `cancelled`, and may be told of no part in what follows
/// (Communicator::Parted). Throws std::invalid_argument on all where one has another program or processor.
void runSweep(SweepResults& sweep, const SweepOptions& options);

}  // namespace gamut
