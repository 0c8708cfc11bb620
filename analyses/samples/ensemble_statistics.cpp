// Moments by Welford's method for packs, merged pair by pair in the order of the packs (Chan, Golub & LeVeque, The
// American Statistician 37, 1983); quantiles by counting.
#include "analyses/samples/ensemble_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analyses/workers.hpp"

namespace gamut {
namespace {

constexpr std::size_t mostBins = 4096, leastBins = 64, wantedCounts = std::size_t{1} << 25;
constexpr double infinity = std::numeric_limits<double>::infinity();

double ulpOf(double x) { return std::nextafter(std::abs(x), infinity) - std::abs(x); }

void checkRising(const std::vector<double>& probabilities) {
  for (std::size_t q = 0; q < probabilities.size(); ++q)
    if (!(probabilities[q] >= 0 && probabilities[q] <= 1) || (q > 0 && probabilities[q] < probabilities[q - 1]))
      throw std::invalid_argument("the probabilities of quantiles rise from 0 to 1");
}

/// Sum of f(value) over the finite values of a row, in a fixed order that vector instructions can keep.
template <class F>
double sumOver(const double* row, const F& f) {
  constexpr int lanes = 8;
  std::array<double, lanes> sums{};
  for (int i = 0; i < packWidth; i += lanes)
    for (int k = 0; k < lanes; ++k) sums[static_cast<std::size_t>(k)] += f(row[i + k]);
  return ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]));
}

}  // namespace

void Envelope::include(std::size_t time, std::size_t output, double value) {
  if (!std::isfinite(value)) return;
  double& low = lower(time, output);
  double& high = upper(time, output);
  if (!(low <= value)) low = value;
  if (!(high >= value)) high = value;
}

std::size_t EnsembleStatistics::binsFor(std::size_t histograms) {
  return std::clamp(wantedCounts / std::max<std::size_t>(histograms, 1), leastBins, mostBins);
}

EnsembleStatistics::EnsembleStatistics(const Envelope& expected, std::size_t levels)
    : times_(expected.lower.times),
      outputs_(expected.lower.outputs),
      levels_(levels),
      bins_(binsFor(expected.lower.data.size())),
      cells_(expected.lower.data.size()),
      least_(cells_.size() * (levels + 1), infinity),
      greatest_(cells_.size() * (levels + 1), -infinity),
      counts_(cells_.size() * (bins_ + 2), 0) {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    Cell& cell = cells_[i];
    cell.least = infinity;
    cell.greatest = -infinity;
    const double lower = expected.lower.data[i], upper = expected.upper.data[i];
    if (!(lower <= upper) || !std::isfinite(upper - lower)) continue;  // two open ends that meet at 0
    cell.lower = lower;
    cell.upper = upper;
    const double scale = static_cast<double>(bins_) / (upper - lower);
    cell.scale = std::isfinite(scale) ? scale : 0;
  }
}

void EnsembleStatistics::include(const SampleBlock& block, int jobs) {
  forEachIndex(jobs, times_, nullptr, [&] {
    return [&](std::size_t time) {
      for (std::size_t index = time * outputs_; index < (time + 1) * outputs_; ++index)
        for (std::size_t p = 0; p < block.packs(); ++p) {
          const double* row = block.pack(p).data() + index * packWidth;
          const std::size_t first = p * packWidth;
          includeInLevels(index, row, block.levels.data() + first,
                          std::min<std::size_t>(packWidth, block.size() - first));
          if (block.hasWeight()) includePack(cells_[index], index, row);
        }
    };
  });
}

void EnsembleStatistics::includeInLevels(std::size_t index, const double* row, const std::size_t* levels,
                                         std::size_t count) {
  double* least = least_.data() + index * (levels_ + 1);
  double* greatest = greatest_.data() + index * (levels_ + 1);
  for (std::size_t i = 0; i < count; ++i) {
    const double value = row[i];
    if (!std::isfinite(value)) continue;
    const std::size_t level = levels[i];
    least[level] = std::min(least[level], value);
    greatest[level] = std::max(greatest[level], value);
  }
}

void EnsembleStatistics::includeMoments(Cell& cell, const double* row) {
  const double count = sumOver(row, [](double value) { return std::isfinite(value) ? 1.0 : 0.0; });
  if (count == 0) return;
  // Differences from a value nearby, which are exact for most: rounding is relative to the width, not to the values.
  const double shift = cell.lower;
  const double mean = sumOver(row, [=](double value) { return std::isfinite(value) ? value - shift : 0.0; }) / count;
  const double squares = sumOver(row, [=](double value) {
    const double difference = (value - shift) - mean;
    return std::isfinite(value) ? difference * difference : 0.0;
  });
  const double all = cell.count + count, difference = mean - cell.mean;
  cell.mean += difference * (count / all);
  cell.squares += squares + difference * difference * (cell.count * (count / all));
  cell.count = all;
}

void EnsembleStatistics::includePack(Cell& cell, std::size_t index, const double* row) {
  includeMoments(cell, row);
  std::uint32_t* counts = counts_.data() + index * (bins_ + 2);
  const double last = static_cast<double>(bins_ - 1);
  for (int i = 0; i < packWidth; ++i) {
    const double value = row[i];
    if (!std::isfinite(value)) continue;
    cell.least = std::min(cell.least, value);
    cell.greatest = std::max(cell.greatest, value);
    if (value < cell.lower)
      ++counts[0];
    else if (value > cell.upper)
      ++counts[bins_ + 1];
    else
      ++counts[1 + static_cast<std::size_t>(std::min((value - cell.lower) * cell.scale, last))];
  }
}

SampledShares EnsembleStatistics::shares(std::size_t time, std::size_t output) const {
  const std::size_t index = time * outputs_ + output;
  const Cell& cell = cells_[index];
  SampledShares shares;
  if (cell.count == 0) return shares;
  const std::uint32_t* counts = counts_.data() + index * (bins_ + 2);
  const auto add = [&](double value, double below) {
    shares.value.push_back(value);
    shares.below.push_back(below / cell.count);
  };
  if (cell.scale == 0) {
    add(cell.lower, counts[0]);
    if (cell.upper > cell.lower) add(cell.upper, cell.count - counts[bins_ + 1]);
    return shares;
  }
  double below = 0;
  for (std::size_t bin = 0; bin <= bins_; ++bin) {
    below += counts[bin];
    add(bin == bins_ ? cell.upper : cell.lower + static_cast<double>(bin) / cell.scale, below);
  }
  return shares;
}

Envelope EnsembleStatistics::envelopeOf(std::size_t level, std::size_t times) const {
  Envelope result(times_, outputs_);
  for (std::size_t i = 0; i < times * outputs_; ++i) {
    const auto begin = static_cast<std::ptrdiff_t>(i * (levels_ + 1) + level),
               end = static_cast<std::ptrdiff_t>((i + 1) * (levels_ + 1));
    const double least = *std::min_element(least_.begin() + begin, least_.begin() + end);
    if (least == infinity) continue;
    result.lower.data[i] = least;
    result.upper.data[i] = *std::max_element(greatest_.begin() + begin, greatest_.begin() + end);
  }
  return result;
}

Envelope EnsembleStatistics::envelope(std::size_t times) const { return envelopeOf(0, times); }

std::vector<Envelope> EnsembleStatistics::innerCuts(std::size_t times) const {
  std::vector<Envelope> cuts;
  for (std::size_t level = 0; level < levels_; ++level) cuts.push_back(envelopeOf(level + 1, times));
  return cuts;
}

/// Quantiles by linear interpolation between order statistics (Hyndman & Fan, Am. Stat. 50, 1996, definition 7). An
/// order statistic is taken from where its rank stands in its bin: it is as far off as the bin is wide at most, and so
/// is what lies between two of them. Bins and their ends are themselves rounded: (value - lower) * scale is off by
/// 3 * 2^-53 of at most 4096 bins, an end by an ulp of the greatest magnitude.
void EnsembleStatistics::quantilesOf(std::size_t index, Statistics& result) const {
  const Cell& cell = cells_[index];
  if (cell.count == 0) return;
  const std::uint32_t* counts = counts_.data() + index * (bins_ + 2);
  const double width =
      cell.scale > 0 ? (cell.upper - cell.lower) / static_cast<double>(bins_) : cell.upper - cell.lower;
  double resolution = 0, before = counts[0];
  std::size_t bin = 0;  // the ranks below `before` are in bins 0 … bin
  const auto orderStatistic = [&](double rank) {
    if (rank == 0) return cell.least;
    if (rank == cell.count - 1) return cell.greatest;
    while (before <= rank && bin <= bins_) before += counts[++bin];
    const double low = bin == 0 ? cell.least : cell.lower + static_cast<double>(bin - 1) * width;
    const double high = bin == 0 ? cell.lower : bin > bins_ ? cell.greatest : low + width;
    resolution = std::max(resolution, high - low);
    const double within = (rank - (before - counts[bin]) + 0.5) / counts[bin];
    return std::clamp(low + within * (high - low), cell.least, cell.greatest);
  };
  for (std::size_t q = 0; q < result.probabilities.size(); ++q) {
    const double position = result.probabilities[q] * (cell.count - 1), rank = std::floor(position);
    const double low = orderStatistic(rank);
    double& quantile = result.quantiles[q].data[index];
    quantile = low;
    if (rank + 1 >= cell.count) continue;
    const std::size_t binOfRank = bin;
    const double beforeOfRank = before, high = orderStatistic(rank + 1);
    quantile = std::clamp(low + (position - rank) * (high - low), low, high);
    bin = binOfRank;  // the next probability may have the same rank
    before = beforeOfRank;
  }
  const double magnitude =
      std::max({std::abs(cell.lower), std::abs(cell.upper), std::abs(cell.least), std::abs(cell.greatest)});
  result.resolution.data[index] = resolution * (1 + 0x1p-32) + 2 * ulpOf(magnitude);
}

Statistics EnsembleStatistics::statistics(std::size_t times, const std::vector<double>& probabilities) const {
  checkRising(probabilities);
  Statistics result;
  result.mean = Table(times_, outputs_);
  result.deviation = result.mean;
  result.resolution = result.mean;
  result.probabilities = probabilities;
  result.quantiles.assign(probabilities.size(), result.mean);
  for (std::size_t i = 0; i < times * outputs_; ++i) {
    const Cell& cell = cells_[i];
    if (cell.count == 0) continue;
    result.mean.data[i] = cell.lower + cell.mean;
    if (cell.count > 1) result.deviation.data[i] = std::sqrt(cell.squares / (cell.count - 1));
    quantilesOf(i, result);
  }
  return result;
}

}  // namespace gamut
