// Sums, and counts in coarse parts, of each batch.
#include "analyses/samples/batch_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gamut {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double halfWidth(const double (&values)[batchCount]) {
  constexpr double quantile = 2.1314495455597742;  // Student's t, 0.975, 15 degrees of freedom
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / batchCount;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return quantile * std::sqrt(squares / (batchCount * (batchCount - 1.0)));
}

BatchStatistics::BatchStatistics(const Envelope& expected)
    : cells_(expected.lower.data.size()), shares_(cells_.size() * (parts + 2) * batchCount, 0) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const double lower = expected.lower.data[i], scale = parts / (expected.upper.data[i] - lower);
    cells_[i].lower = lower;
    cells_[i].scale = std::isfinite(scale) && scale > 0 ? scale : 0;
  }
}

void BatchStatistics::include(std::size_t index, std::size_t number, const double* row, std::size_t count) {
  Cell& cell = cells_[index];
  std::uint32_t* shares = shares_.data() + index * (parts + 2) * batchCount;
  constexpr double last = parts + 1;
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
    ++shares[static_cast<std::size_t>(part) * batchCount + batch];
  }
}

double BatchStatistics::meanError(std::size_t index) const {
  const Cell& cell = cells_[index];
  double means[batchCount];
  for (std::size_t b = 0; b < batchCount; ++b) means[b] = cell.counts[b] < 2 ? unknown : cell.sums[b] / cell.counts[b];
  return halfWidth(means);
}

double BatchStatistics::deviationError(std::size_t index) const {
  const Cell& cell = cells_[index];
  double deviations[batchCount];
  for (std::size_t b = 0; b < batchCount; ++b) {
    const double n = cell.counts[b], squares = cell.squares[b] - cell.sums[b] * (cell.sums[b] / n);
    deviations[b] = n < 2 ? unknown : std::sqrt(std::max(squares, 0.0) / (n - 1));
  }
  return halfWidth(deviations);
}

std::vector<double> BatchStatistics::shareErrors(std::size_t index) const {
  const Cell& cell = cells_[index];
  const std::uint32_t* shares = shares_.data() + index * (parts + 2) * batchCount;
  std::vector<double> errors(parts + 1, unknown);
  if (cell.scale == 0 || std::ranges::any_of(cell.counts, [](double count) { return count < 2; })) return errors;
  double below[batchCount] = {};
  for (std::size_t part = 0; part <= parts; ++part) {
    for (std::size_t b = 0; b < batchCount; ++b) below[b] += shares[part * batchCount + b] / cell.counts[b];
    errors[part] = halfWidth(below);
  }
  return errors;
}

}  // namespace gamut
