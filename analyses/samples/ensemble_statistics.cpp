// Moments by Welford's method for packs, merged pair by pair in the order of the packs (Chan, Golub & LeVeque, The
// American Statistician 37, 1983); quantiles by counting.
#include "analyses/samples/ensemble_statistics.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "analyses/workers.hpp"

namespace gamut {
namespace {

constexpr std::size_t mostBins = 4096, leastBins = 64, wantedCounts = std::size_t{1} << 25;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double confidence = 0.95;

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
    for (int k = 0; k < lanes; ++k) sums[k] += f(row[i + k]);
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

/// Convergence has two numbers for each power of two from a pack on.
double EnsembleStatistics::bytesFor(std::size_t histograms, std::size_t levels, std::size_t samples) {
  const std::size_t growth = std::bit_width(samples / packWidth);
  const double bins = static_cast<double>(Counts::bytesOf(samples) * (binsFor(histograms) + 2));
  const auto numbers = static_cast<double>(sizeof(Cell) + sizeof(double) * 2 * (levels + 1 + growth));
  return static_cast<double>(histograms) *
         (bins + numbers + BatchStatistics::cellBytes(samples, BatchStatistics::partsFor(histograms)));
}

EnsembleStatistics::EnsembleStatistics(const Envelope& expected, std::size_t levels, std::size_t samples)
    : times_(expected.lower.times),
      outputs_(expected.lower.outputs),
      levels_(levels),
      bins_(binsFor(expected.lower.data.size())),
      cells_(expected.lower.data.size()),
      least_(cells_.size() * (levels + 1), infinity),
      greatest_(cells_.size() * (levels + 1), -infinity),
      counts_(cells_.size() * (bins_ + 2), samples),
      batches_(expected, samples, BatchStatistics::partsFor(cells_.size())) {
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

void EnsembleStatistics::include(const SampleBlock& block, int jobs, std::size_t from, std::size_t to) {
  std::vector<Convergence*> growth(block.packs(), nullptr);
  first_.reserve(first_.size() + block.packs());
  for (std::size_t p = 0; p < block.packs() && block.hasWeight(); ++p)
    if (const std::size_t count = block.first() + (p + 1) * packWidth;
        (p + 1) * packWidth <= block.size() && std::has_single_bit(count))
      growth[p] = &first_.emplace_back(count, Table(times_, outputs_), Table(times_, outputs_));
  forEachIndex(jobs, to - from, nullptr, [&] {
    return [&](std::size_t number) {
      const std::size_t time = from + number;
      for (std::size_t index = time * outputs_; index < (time + 1) * outputs_; ++index)
        for (std::size_t p = 0; p < block.packs(); ++p) {
          const double* row = block.pack(p).data() + index * packWidth;
          const std::size_t first = p * packWidth;
          includeInLevels(index, row, block.levels.data() + first,
                          std::min<std::size_t>(packWidth, block.size() - first));
          if (!block.hasWeight()) continue;
          includePack(cells_[index], index, row);
          batches_.include(index, block.first() + first, row, std::min<std::size_t>(packWidth, block.size() - first));
          if (growth[p] == nullptr) continue;
          growth[p]->width.data[index] = cells_[index].greatest - cells_[index].least;
          growth[p]->meanError.data[index] = batches_.meanError(index);
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
  const std::size_t counts = index * (bins_ + 2);
  const double last = static_cast<double>(bins_ - 1);
  for (int i = 0; i < packWidth; ++i) {
    const double value = row[i];
    if (!std::isfinite(value)) continue;
    cell.least = std::min(cell.least, value);
    cell.greatest = std::max(cell.greatest, value);
    if (value < cell.lower)
      counts_.increment(counts);
    else if (value > cell.upper)
      counts_.increment(counts + bins_ + 1);
    else
      counts_.increment(counts + 1 + static_cast<std::size_t>(std::min((value - cell.lower) * cell.scale, last)));
  }
}

SampledShares EnsembleStatistics::shares(std::size_t time, std::size_t output) const {
  SampledShares shares;
  std::size_t row = time;
  if (kept_) {
    const auto place = std::ranges::lower_bound(*kept_, time);
    if (place == kept_->end() || *place != time) return shares;
    row = static_cast<std::size_t>(place - kept_->begin());
  }
  const std::size_t index = row * outputs_ + output;
  const Cell& cell = cells_[index];
  if (cell.count == 0) return shares;
  const std::size_t counts = index * (bins_ + 2);
  const auto add = [&](double value, double below) {
    shares.value.push_back(value);
    shares.below.push_back(below / cell.count);
  };
  if (cell.scale == 0) {
    add(cell.lower, counts_[counts]);
    if (cell.upper > cell.lower) add(cell.upper, cell.count - counts_[counts + bins_ + 1]);
    return shares;
  }
  double below = 0;
  for (std::size_t bin = 0; bin <= bins_; ++bin) {
    below += counts_[counts + bin];
    add(bin == bins_ ? cell.upper : cell.lower + static_cast<double>(bin) / cell.scale, below);
  }
  return shares;
}

void EnsembleStatistics::keepShares(const std::vector<std::size_t>& times) {
  std::vector<Cell> cells;
  Counts counts;
  for (const std::size_t time : times) {
    const auto begin = static_cast<std::ptrdiff_t>(time * outputs_),
               end = begin + static_cast<std::ptrdiff_t>(outputs_);
    cells.insert(cells.end(), cells_.begin() + begin, cells_.begin() + end);
    counts.append(counts_, time * outputs_ * (bins_ + 2), outputs_ * (bins_ + 2));
  }
  cells_ = std::move(cells);
  counts_ = std::move(counts);
  least_ = greatest_ = {};
  batches_ = BatchStatistics({}, 0, 1);
  first_ = {};
  kept_ = times;
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

/// The samples of one output at one time, in the order of their values, as far as a histogram knows it.
class EnsembleStatistics::SortedSamples {
 public:
  SortedSamples(const Counts& counts, std::size_t first, std::size_t bins, double lower, double width, double least,
                double greatest)
      : counts_(counts),
        first_(first),
        bins_(bins),
        before_(bins + 1),
        lower_(lower),
        width_(width),
        least_(least),
        greatest_(greatest) {
    for (std::size_t bin = 0; bin < bins; ++bin) before_[bin + 1] = before_[bin] + counts[first + bin];
  }

  double size() const { return before_.back(); }

  /// Where the order statistic of a rank, from 0, lies.
  Interval around(double rank) const {
    if (rank <= 0) return Interval(least_);
    if (rank >= size() - 1) return Interval(greatest_);
    return endsOf(binOf(rank));
  }

  /// By linear interpolation between order statistics (Hyndman & Fan, Am. Stat. 50, 1996, definition 7). One is taken
  /// from where its rank stands in its bin: it is as far off as the bin is wide at most, and so is what lies between
  /// two of them.
  double quantile(double probability, double& resolution) const {
    const double position = probability * (size() - 1), rank = std::floor(position);
    const double low = orderStatistic(rank, resolution);
    if (rank + 1 >= size()) return low;
    const double high = orderStatistic(rank + 1, resolution);
    return std::clamp(low + (position - rank) * (high - low), low, high);
  }

 private:
  std::size_t binOf(double rank) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(before_, rank) - before_.begin()) - 1;
  }
  Interval endsOf(std::size_t bin) const {
    if (bin == 0) return {least_, std::max(least_, lower_)};
    const double low = lower_ + static_cast<double>(bin - 1) * width_;
    return bin + 1 == bins_ ? Interval(std::min(low, greatest_), greatest_) : Interval(low, low + width_);
  }
  double orderStatistic(double rank, double& resolution) const {
    if (rank == 0) return least_;
    if (rank == size() - 1) return greatest_;
    const std::size_t bin = binOf(rank);
    const Interval ends = endsOf(bin);
    resolution = std::max(resolution, ends.upper() - ends.lower());
    const double within = (rank - before_[bin] + 0.5) / counts_[first_ + bin];
    return std::clamp(ends.lower() + within * (ends.upper() - ends.lower()), least_, greatest_);
  }

  const Counts& counts_;
  std::size_t first_, bins_;  // of the histogram among them, both open ends counted
  std::vector<double> before_;
  double lower_, width_, least_, greatest_;
};

EnsembleStatistics::SortedSamples EnsembleStatistics::sorted(std::size_t index) const {
  const Cell& cell = cells_[index];
  const double width = (cell.upper - cell.lower) / (cell.scale > 0 ? static_cast<double>(bins_) : 1);
  return {counts_, index * (bins_ + 2), bins_ + 2, cell.lower, width, cell.least, cell.greatest};
}

/// Bins and their ends are themselves rounded: (value - lower) * scale is off by 3 * 2^-53 of at most 4096 bins, an end
/// by an ulp of the greatest magnitude.
void EnsembleStatistics::quantilesOf(std::size_t index, Statistics& result) const {
  const Cell& cell = cells_[index];
  const SortedSamples samples = sorted(index);
  double resolution = 0;
  for (std::size_t q = 0; q < result.probabilities.size(); ++q)
    result.quantiles[q].data[index] = samples.quantile(result.probabilities[q], resolution);
  const double magnitude =
      std::max({std::abs(cell.lower), std::abs(cell.upper), std::abs(cell.least), std::abs(cell.greatest)});
  result.resolution.data[index] = resolution * (1 + 0x1p-32) + 2 * ulpOf(magnitude);
}

void EnsembleStatistics::boundQuantiles(std::size_t index, const std::vector<std::optional<Ranks>>& ranks,
                                        Statistics& result) const {
  const SortedSamples samples = sorted(index);
  for (std::size_t q = 0; q < ranks.size(); ++q) {
    if (!ranks[q]) continue;
    result.lower[q].data[index] = samples.around(static_cast<double>(ranks[q]->lower - 1)).lower();
    result.upper[q].data[index] = samples.around(static_cast<double>(ranks[q]->upper - 1)).upper();
  }
}

void EnsembleStatistics::boundQuantiles(std::size_t index, Statistics& result) const {
  const Cell& cell = cells_[index];
  const SortedSamples samples = sorted(index);
  const std::vector<double> errors = batches_.shareErrors(index);
  const auto parts = static_cast<double>(batches_.parts());
  for (std::size_t q = 0; q < result.probabilities.size(); ++q) {
    const double part = (result.quantiles[q].data[index] - cell.lower) / (cell.upper - cell.lower) * parts;
    if (!(part >= 0 && part <= parts)) continue;
    const double error = errors[std::min(part, parts - 1)];
    const double least = result.probabilities[q] - error, greatest = result.probabilities[q] + error;
    if (!(least >= 0 && greatest <= 1)) continue;
    double unused = 0;
    result.lower[q].data[index] = samples.quantile(least, unused);
    result.upper[q].data[index] = samples.quantile(greatest, unused);
  }
}

Statistics EnsembleStatistics::statistics(std::size_t times, Dependence dependence,
                                          const std::vector<double>& probabilities) const {
  checkRising(probabilities);
  Statistics result;
  for (Table* table : {&result.mean, &result.meanError, &result.deviation, &result.deviationError, &result.resolution})
    *table = Table(times_, outputs_);
  result.probabilities = probabilities;
  for (auto* tables : {&result.quantiles, &result.lower, &result.upper})
    tables->assign(probabilities.size(), result.mean);
  double ranked = 0;
  std::vector<std::optional<Ranks>> ranks(probabilities.size());
  for (std::size_t i = 0; i < times * outputs_; ++i) {
    const Cell& cell = cells_[i];
    if (cell.count == 0) continue;
    result.mean.data[i] = cell.lower + cell.mean;
    if (cell.count > 1) result.deviation.data[i] = std::sqrt(cell.squares / (cell.count - 1));
    if (dependence != Dependence::all) {
      result.meanError.data[i] = batches_.meanError(i);
      result.deviationError.data[i] = batches_.deviationError(i);
    }
    quantilesOf(i, result);
    if (dependence == Dependence::batches) boundQuantiles(i, result);
    if (dependence == Dependence::none) {
      if (cell.count != ranked) {  // mostly that of the cell before
        ranked = cell.count;
        for (std::size_t q = 0; q < probabilities.size(); ++q)
          ranks[q] = ranksAround(probabilities[q], static_cast<std::size_t>(ranked), confidence);
      }
      boundQuantiles(i, ranks, result);
    }
  }
  return result;
}

}  // namespace gamut
