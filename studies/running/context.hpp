// What every unit of a run has at hand: the machine, how it is run, who watches, and what is spent.
#pragma once

#include <cstdint>
#include <functional>
#include <new>
#include <string>

#include "analyses/work.hpp"
#include "studies/machine.hpp"
#include "studies/results/results.hpp"
#include "studies/running/run.hpp"
#include "studies/watch.hpp"

namespace gamut {

/// Work (analyses/work.hpp) that was done for each.
struct Spent {
  double enclosure = 0, samples = 0, cuts = 0, requirements = 0, probabilities = 0;
};

struct Run {
  Run(const Machine& whatMoves, const RunOptions& howToRun, const Limits& itsLimits);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  Bounds emptyBounds() const { return {study.times.size(), study.outputs.size()}; }
  /// What tells the user how far a task is.
  std::function<void(double)> progressOf(const std::string& task) const;
  /// What enclosure and samples took: of this, others have their shares.
  double basis() const;
  bool isEnclosed() const { return study.asksFor<IntervalResult>() || study.asksFor<FuzzyResult>(); }
  bool moves() const { return study.moves(); }

  const Machine& machine;
  const Study& study;  ///< the machine's
  const RunOptions& options;
  const Limits limits;
  Watch watch;
  Spent spent;  ///< by the units, as they end
};

/// Of ranks the first one's number: what is counted in time differs between them.
double agreed(const Run& run, double own);

/// From its making to its end, adds the work of this thread and of those that it waits for to `*work`, and the
/// process's CPU time, s, to `*cpu`; null: to nobody.
class Charge {
 public:
  explicit Charge(double* work, double* cpu = nullptr) : work_(work), cpu_(cpu) {}
  ~Charge() {
    if (work_ != nullptr) *work_ += static_cast<double>(Work::counted() - counted_);
    if (cpu_ != nullptr) *cpu_ += processCpuSeconds() - began_;
  }
  Charge(const Charge&) = delete;
  Charge& operator=(const Charge&) = delete;

 private:
  double* const work_;
  double* const cpu_;
  const std::uint64_t counted_ = Work::counted();
  const double began_ = processCpuSeconds();
};

/// Does it; false where memory did not suffice, of which the watch is told.
template <class Task>
bool hasRoomFor(Run& run, const Task& task) {
  try {
    task();
    return true;
  } catch (const std::bad_alloc&) {
    run.watch.memoryFailed();
    return false;
  }
}

/// So much work may still be done for requirements, or for probabilities: their share of what enclosure and samples
/// took, and what answers before them have left. Counted, so that it is the same in every run.
double workForRequirements(const Run& run);
double workForProbabilities(const Run& run);

}  // namespace gamut
