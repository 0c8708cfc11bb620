// How far off mean, deviation and shares of samples are: their batches are independent and of the same size, so that
// what they say scatters about what all motions together would say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "analyses/samples/counts.hpp"
#include "analyses/samples/sampling.hpp"
#include "analyses/table.hpp"

namespace gamut {

/// Half the widths of 95 % confidence intervals, NaN where a batch has fewer than two samples: Student's t with 15
/// degrees of freedom, for which what the batches say is taken as normally distributed.
class BatchStatistics {
 public:
  /// `expected`: between which values shares are counted, in so many equal parts. `samples`: no more than these come.
  BatchStatistics(const Envelope& expected, std::size_t samples, std::size_t parts);

  /// The values of one row, of consecutive samples from `number` on; those that are not finite do not count.
  void include(std::size_t cell, std::size_t number, const double* row, std::size_t count);

  double meanError(std::size_t cell) const;
  double deviationError(std::size_t cell) const;
  /// Of the share of values below some value: one for each of the equal parts of what was expected.
  std::vector<double> shareErrors(std::size_t cell) const;

  std::size_t parts() const { return parts_; }
  void archive(Archive& all);
  /// So many cells, from `first` on.
  void archiveCells(Archive& all, std::size_t first, std::size_t count);

  /// Parts where so many outputs at so many times are counted: 64, or fewer, so that all together have some 2^21, but
  /// at least 8.
  static std::size_t partsFor(std::size_t cells);
  /// So many bytes each of these takes.
  static double cellBytes(std::size_t samples, std::size_t parts);

 private:
  /// One output at one time: sums of differences from the first value.
  struct Cell {
    double lower, scale;  // parts per unit
    double shift = std::numeric_limits<double>::quiet_NaN();
    double sums[batchCount] = {}, squares[batchCount] = {};
    std::uint32_t counts[batchCount] = {};
  };

  std::size_t placeOf(std::size_t cell) const { return cell * (parts_ + 2) * batchCount; }

  std::size_t parts_;
  std::vector<Cell> cells_;
  Counts shares_;  // [cell][part, with what lies below and above][batch]
};

/// Half the 95 % confidence interval of the mean of these independent values; NaN unless all are numbers.
double halfWidth(const double (&values)[batchCount]);

}  // namespace gamut
