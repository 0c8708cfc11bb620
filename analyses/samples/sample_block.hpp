// Samples of consecutive numbers on their way from integration into the statistics, in packs: a row is the packWidth
// values of one output at one time. Whoever looks at them in between may put better values in their place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "analyses/samples/cvode.hpp"
#include "scalars/evaluation/sample_pack.hpp"

namespace gamut {

class Archive;
class SharedWork;

class SampleBlock {
 public:
  SampleBlock() : SampleBlock(0, 0, false, 0, 0, 0) {}
  /// Numbers first … first + count - 1. Without weight: corners, the centre and points of a transformation, which
  /// count in envelopes alone. `memory`: a former block's, since as much of it anew takes long to get.
  SampleBlock(std::size_t first, std::size_t count, bool hasWeight, std::size_t quantities, std::size_t times,
              std::size_t outputs, std::vector<double> memory = {})
      : runs(count),
        levels(count, 0),
        first_(first),
        hasWeight_(hasWeight),
        quantities_(quantities),
        outputs_(outputs),
        cells_(times * outputs),
        values_(count * quantities),
        rows_(std::move(memory)) {
    // What is integrated is written whole, but where a pack has no sample.
    const bool isNew = rows_.empty();
    rows_.resize(packs() * cells_ * packWidth, std::numeric_limits<double>::quiet_NaN());
    if (!isNew && packs() > 0) std::ranges::fill(pack(packs() - 1), std::numeric_limits<double>::quiet_NaN());
  }

  /// Its memory, without which it is of no more use.
  std::vector<double> release() { return std::move(rows_); }

  void archive(Archive& all);
  /// Of these alone all but the motions, and these: the first of all or of a pack.
  void archiveValues(Archive& all, std::size_t first, std::size_t count);
  void archiveMotions(Archive& all, std::size_t first, std::size_t count);
  /// The rows of a pack at these times, one behind the other.
  void archiveRows(Archive& all, std::size_t pack, std::size_t from, std::size_t to);

  /// Whether the motions of a pack are all here.
  bool isHere(std::size_t pack) const;
  /// Of motions that are not here, those of the samples that some rank names: all of them, by rising number. `samples`:
  /// those of this rank's that it names.
  void fetch(std::vector<std::size_t>& samples);

  std::size_t first() const { return first_; }
  std::size_t size() const { return runs.size(); }
  std::size_t packs() const { return (size() + packWidth - 1) / packWidth; }
  bool hasWeight() const { return hasWeight_; }

  /// The values of sample i's (0 <= i < size()) uncertain quantities.
  std::span<double> values(std::size_t i) { return std::span(values_).subspan(i * quantities_, quantities_); }
  std::span<const double> values(std::size_t i) const {
    return std::span(values_).subspan(i * quantities_, quantities_);
  }
  /// NaN where the sample did not arrive.
  double& operator()(std::size_t i, std::size_t time, std::size_t output) { return rows_[place(i, time, output)]; }
  double operator()(std::size_t i, std::size_t time, std::size_t output) const { return rows_[place(i, time, output)]; }
  /// The rows of one pack: of the first output at the first time, then of the next output, then the next time; NaN
  /// where a pack that is not full has no sample.
  std::span<double> pack(std::size_t i) { return std::span(rows_).subspan(i * cells_ * packWidth, cells_ * packWidth); }
  std::span<const double> pack(std::size_t i) const {
    return std::span(rows_).subspan(i * cells_ * packWidth, cells_ * packWidth);
  }
  /// Copies of one sample's trajectory, [time][output].
  std::vector<double> trajectory(std::size_t i) const {
    std::vector<double> result(cells_);
    for (std::size_t cell = 0; cell < cells_; ++cell) result[cell] = rows_[place(i, 0, cell)];
    return result;
  }
  /// Leaves the others out.
  void keepFirst(std::size_t count) {
    runs.resize(count);
    levels.resize(count);
    values_.resize(count * quantities_);
    rows_.resize(packs() * cells_ * packWidth);
    for (std::size_t i = count; i < packs() * packWidth; ++i)
      for (std::size_t cell = 0; cell < cells_; ++cell)
        rows_[place(i, 0, cell)] = std::numeric_limits<double>::quiet_NaN();
  }
  void setTrajectory(std::size_t i, std::span<const double> trajectory) {
    for (std::size_t cell = 0; cell < cells_; ++cell) rows_[place(i, 0, cell)] = trajectory[cell];
  }

  std::vector<Integration> runs;    ///< how each sample's integration went
  std::vector<std::size_t> levels;  ///< of how many levels of alpha each sample's values lie in the cuts
  /// Of ranks that share it out pack by pack, each has the others' motions at some times alone; null: all is here.
  SharedWork* spread = nullptr;

 private:
  std::size_t place(std::size_t i, std::size_t time, std::size_t output) const {
    return (i / packWidth * cells_ + time * outputs_ + output) * packWidth + i % packWidth;
  }

  std::size_t first_;
  bool hasWeight_;
  std::size_t quantities_, outputs_, cells_;
  std::vector<double> values_, rows_;
};

}  // namespace gamut
