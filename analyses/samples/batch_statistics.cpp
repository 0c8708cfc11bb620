// Sums, and counts in coarse parts, of each batch.
#include "analyses/samples/batch_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>

namespace gamut {
namespace {

constexpr double studentQuantile = 2.1314495455597742;  // 0.975, 15 degrees of freedom
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t mostParts = 64, leastParts = 8, wantedParts = std::size_t{1} << 21;

/// Batches take turns.
std::size_t mostInBatch(std::size_t samples) { return samples / batchCount + 1; }

}  // namespace

double halfWidth(const double (&values)[batchCount]) {
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / batchCount;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return studentQuantile * std::sqrt(squares / (batchCount * (batchCount - 1.0)));
}

std::size_t BatchStatistics::partsFor(std::size_t cells) {
  return std::clamp(wantedParts / std::max<std::size_t>(cells, 1), leastParts, mostParts);
}

double BatchStatistics::cellBytes(std::size_t samples, std::size_t parts) {
  const std::size_t each = Counts::bytesOf(mostInBatch(samples));
  return static_cast<double>(sizeof(Cell) + (parts + 2) * batchCount * each);
}

BatchStatistics::BatchStatistics(const Envelope& expected, std::size_t samples, std::size_t parts)
    : parts_(parts), cells_(expected.lower.data.size()), shares_(placeOf(cells_.size()), mostInBatch(samples)) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const double lower = expected.lower.data[i], scale = static_cast<double>(parts) / (expected.upper.data[i] - lower);
    cells_[i].lower = lower;
    cells_[i].scale = std::isfinite(scale) && scale > 0 ? scale : 0;
  }
}

void BatchStatistics::include(std::size_t index, std::size_t number, const double* row, std::size_t count) {
  Cell& cell = cells_[index];
  const double last = static_cast<double>(parts_ + 1);
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(row[i])) continue;
    const std::size_t batch = (number + i) % batchCount;
    if (std::isnan(cell.shift)) cell.shift = row[i];
    const double difference = row[i] - cell.shift;
    ++cell.counts[batch];
    cell.sums[batch] += difference;
    cell.squares[batch] += difference * difference;
    if (cell.scale == 0) continue;
    const double part = std::clamp(1 + std::floor((row[i] - cell.lower) * cell.scale), 0.0, last);
    shares_.increment(placeOf(index) + static_cast<std::size_t>(part) * batchCount + batch);
  }
}

double BatchStatistics::meanError(std::size_t index) const {
  const Cell& cell = cells_[index];
  double means[batchCount];
  for (std::size_t b = 0; b < batchCount; ++b) means[b] = cell.counts[b] < 2 ? unknown : cell.sums[b] / cell.counts[b];
  return halfWidth(means);
}

/// Of the mean squares about the mean of all, which have no bias as deviations of batches have: s² is their mean, so
/// that s is off by half their error over s; and by s/(2N), by which N-1 corrects what is no error of evenly spread
/// samples.
double BatchStatistics::deviationError(std::size_t index) const {
  const Cell& cell = cells_[index];
  double count = 0, sum = 0, all = 0;
  for (std::size_t b = 0; b < batchCount; ++b) count += cell.counts[b], sum += cell.sums[b];
  const double mean = sum / count;
  double squares[batchCount];
  for (std::size_t b = 0; b < batchCount; ++b) {
    const double n = cell.counts[b];
    squares[b] = n < 2 ? unknown : std::max((cell.squares[b] - 2 * mean * cell.sums[b]) / n + mean * mean, 0.0);
    all += squares[b] / batchCount;
  }
  return all == 0 ? 0.0 : halfWidth(squares) / (2 * std::sqrt(all)) + std::sqrt(all) / (2 * count);
}

/// At the ends of a part batches are compared. In between one that has a sample in each stratum, and is equal to the
/// others at the ends, has it anywhere: as if samples of a part were independent there, of n √n/2 at most lie below.
std::vector<double> BatchStatistics::shareErrors(std::size_t index) const {
  const Cell& cell = cells_[index];
  std::vector<double> errors(parts_, unknown);
  if (cell.scale == 0 || std::ranges::any_of(cell.counts, [](std::uint32_t count) { return count < 2; })) return errors;
  const double all = std::accumulate(std::begin(cell.counts), std::end(cell.counts), 0.0);
  double below[batchCount] = {}, before = 0;
  for (std::size_t part = 0; part <= parts_; ++part) {
    double inside = 0;
    for (std::size_t b = 0; b < batchCount; ++b) {
      const double share = shares_[placeOf(index) + part * batchCount + b];
      inside += share;
      below[b] += share / cell.counts[b];
    }
    const double error = halfWidth(below);
    if (part > 0)
      errors[part - 1] = std::hypot(std::max(before, error), studentQuantile * 0.5 * std::sqrt(inside) / all);
    before = error;
  }
  return errors;
}

}  // namespace gamut
