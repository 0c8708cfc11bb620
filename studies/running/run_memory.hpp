// What a run remembers of itself between its units: one that was killed goes on behind the last that it remembers.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "analyses/checkpoints.hpp"
#include "studies/running/units.hpp"

namespace gamut {

class Archive;

/// All that results hold, a part that is there, and whatever is in it.
void archive(Archive& all, Results& results);
void archive(Archive& all, Suspect& suspect);
/// What such groups hold.
void archiveGroups(Archive& all, const std::vector<Group>& groups);

/// Samples and what they said so far. They are read into those of a run that has said nothing yet of others than the
/// first.
void archiveSamples(Archive& all, const Run& run, SampledMotion& samples, Results& results);

class RunMemory {
 public:
  /// Recalls what these were, if the run's checkpoints hold it. All must outlive it.
  RunMemory(Run& run, SampledMotion& samples, Enclosure& enclosure, ModelMasses& masses, Results& results);
  ~RunMemory();
  RunMemory(const RunMemory&) = delete;
  RunMemory& operator=(const RunMemory&) = delete;

  /// Does the next unit, unless it had been done, and remembers that if it took long enough. A rank that had to part in
  /// a unit is called back behind it, unless the first is to stop then.
  void operator()(const std::function<void()>& unit);

 private:
  void note();
  void archiveAll(Archive& all);

  Run& run_;
  SampledMotion& samples_;
  Enclosure& enclosure_;
  ModelMasses& masses_;
  Results& results_;
  std::size_t next_ = 0, done_ = 0;
  CheckpointedTask checkpoint_;
};

}  // namespace gamut
