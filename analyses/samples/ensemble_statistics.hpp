// What an ensemble says, gathered in one pass: envelope, inner alpha-cuts, moments and quantiles. The memory that it
// takes does not depend on the number of samples: quantiles come from a histogram of each output at each time, and are
// as fine as its bins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "analyses/samples/batch_statistics.hpp"
#include "analyses/samples/counts.hpp"
#include "analyses/samples/order_statistics.hpp"
#include "analyses/samples/sample_block.hpp"
#include "analyses/table.hpp"

namespace gamut {

/// How samples of different numbers hang together.
enum class Dependence {
  none,     ///< not at all
  batches,  ///< those of one batch do, batches do not
  all       ///< they are not random
};

/// What the samples of the plan say. Errors and bounds are of 95 % confidence, of each number by
/// itself: NaN where none holds.
struct Statistics {
  Table mean, meanError;              ///< half the width of its interval
  Table deviation, deviationError;    ///< with N-1; NaN for a single sample
  std::vector<double> probabilities;  ///< of the quantiles
  std::vector<Table> quantiles;       ///< one a probability; between samples by linear interpolation
  std::vector<Table> lower, upper;    ///< likewise: between which quantiles of all motions lie
  Table resolution;                   ///< no quantile there is farther than this from that of the samples themselves
};

/// The share of the samples below some values, which rise.
struct SampledShares {
  std::vector<double> value, below;
};

/// What the first samples said already, powers of two and at least 64 of them: [time][output] each.
struct Convergence {
  std::size_t samples = 0;
  Table width;      ///< between the least and the greatest
  Table meanError;  ///< as in Statistics
};

class EnsembleStatistics {
 public:
  /// `expected`: between which values the histograms' bins lie; what lies beyond is counted in two open ends. `levels`:
  /// of alpha. `samples`: no more than these come with weight.
  EnsembleStatistics(const Envelope& expected, std::size_t levels,
                     std::size_t samples = std::numeric_limits<std::size_t>::max());

  /// Includes a block. What comes out depends on the blocks and their order alone, not on the number of jobs.
  void include(const SampleBlock& block, int jobs) { include(block, jobs, 0, times_); }
  /// What it says of the times from `from` to before `to` alone.
  void include(const SampleBlock& block, int jobs, std::size_t from, std::size_t to);

  // Each of the first `times` output times, NaN for the others.

  /// Of all samples, weight or none.
  Envelope envelope(std::size_t times) const;
  /// Of those that lie in the cuts of each level. NaN where none does.
  std::vector<Envelope> innerCuts(std::size_t times) const;
  /// Throws std::invalid_argument unless the probabilities rise from 0 to 1.
  Statistics statistics(std::size_t times, Dependence dependence,
                        const std::vector<double>& probabilities = {0.01, 0.05, 0.5, 0.95, 0.99}) const;
  const std::vector<Convergence>& convergence() const { return first_; }

  /// Of one output at one time, at the bins' ends; nothing without samples that arrived.
  SampledShares shares(std::size_t time, std::size_t output) const;
  /// Forgets all but the shares at these times, which rise. To be called once, when all else has been asked.
  void keepShares(const std::vector<std::size_t>& times);
  void archive(Archive& all);
  /// What is known of the times from `from` to before `to`, where the same blocks were included.
  void archiveTimes(Archive& all, std::size_t from, std::size_t to);

  /// Bins of each histogram where there are so many: 4096, or fewer, so that all together have some 2^25, but at
  /// least 64.
  static std::size_t binsFor(std::size_t histograms);
  /// So many bytes all of these take, with what the first samples said.
  static double bytesFor(std::size_t histograms, std::size_t levels, std::size_t samples);

 private:
  /// One output at one time.
  struct Cell {
    double lower = 0, upper = 0, scale = 0;   // of the bins; bins per unit
    double count = 0, mean = 0, squares = 0;  // mean of the differences from `lower`
    double least, greatest;                   // of the samples with weight
  };

  class SortedSamples;
  SortedSamples sorted(std::size_t index) const;
  void includePack(Cell& cell, std::size_t index, const double* row);
  void includeInLevels(std::size_t index, const double* row, const std::size_t* levels, std::size_t count);
  void includeMoments(Cell& cell, const double* row);
  Envelope envelopeOf(std::size_t level, std::size_t times) const;
  void quantilesOf(std::size_t index, Statistics& result) const;
  void boundQuantiles(std::size_t index, const std::vector<std::optional<Ranks>>& ranks, Statistics& result) const;
  void boundQuantiles(std::size_t index, Statistics& result) const;

  std::size_t times_, outputs_, levels_, bins_;
  std::vector<Cell> cells_;               // [time][output]
  std::vector<double> least_, greatest_;  // [time][output][levels that hold the sample]: of all samples
  Counts counts_;                         // [time][output][bin]: below, the bins, above; of samples with weight
  BatchStatistics batches_;
  std::vector<Convergence> first_;
  std::optional<std::vector<std::size_t>> kept_;  // times, where only their shares are left
};

}  // namespace gamut
