// The samples' shares beside the proved bounds of the outputs' distribution functions.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

/// Of one output at one time, as DistributionResult holds them.
struct ProvedDistribution {
  std::span<const double> value, lower, upper;
};

/// The samples' shares at the values; between two ends of bins about as if evenly spread.
void putShares(const SampledShares& shares, std::span<const double> values, std::span<double> sampled) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    while (next < shares.value.size() && shares.value[next] < values[i]) ++next;
    double share = next == 0 ? 0 : 1;
    if (next > 0 && next < shares.value.size()) {
      const double part = (values[i] - shares.value[next - 1]) / (shares.value[next] - shares.value[next - 1]);
      share = shares.below[next - 1] + part * (shares.below[next] - shares.below[next - 1]);
    }
    sampled[i] = values[i] == values.back() ? 1 : share;
  }
}

/// By how much shares leave the bounds. Samples of a value are off by the measured error of their integration. At the
/// ends of bins shares are exact: those below v are not fewer than lower(v') of v' < v, nor more than upper(v).
double excessOf(const SampledShares& shares, const ProvedDistribution& proved, double error) {
  double excess = 0;
  for (std::size_t i = 0; i < shares.value.size(); ++i) {
    const auto below = std::ranges::lower_bound(proved.value, shares.value[i] - error) - proved.value.begin();
    const auto above = std::ranges::lower_bound(proved.value, shares.value[i] + error) - proved.value.begin();
    const double least = below == 0 ? 0 : proved.lower[below - 1];
    const double most = above == std::ssize(proved.value) ? 1 : proved.upper[above];
    excess = std::max({excess, least - shares.below[i], shares.below[i] - most});
  }
  return excess;
}

/// Where the samples are independent, and all arrived.
double bandOf(const Study& study, const StochasticResult& stochastic) {
  if (study.ensemble.plan != Plan::random || stochastic.samples == 0 || stochastic.integrated < stochastic.planned() ||
      !stochastic.why.empty())
    return 0;
  return std::sqrt(std::log(2 / 0.05) / (2.0 * static_cast<double>(stochastic.samples)));
}

}  // namespace

void compareShares(const Study& study, const SampledMotion& samples, Results& results) {
  DistributionResult& result = results.distribution;
  if (!result.present) return;
  const std::size_t outputs = study.outputs.size();
  result.sampled = Grid(result.value.extents);
  result.excess = Grid(result.gaps.extents);
  result.band = bandOf(study, results.stochastic);
  if (!samples.ensemble) return;
  const Table& errors = results.stochastic.error;
  for (std::size_t cell = 0; cell < result.gaps.data.size(); ++cell) {
    const std::size_t at = cell / outputs, output = cell % outputs;
    const std::span<const double> values = result.values(at, output);
    const std::size_t row = rowOf(study.times, result.time[at]);
    const SampledShares shares = samples.ensemble->shares(row, output);
    if (values.empty() || shares.value.empty()) continue;
    const ProvedDistribution proved{values, result.lower.row(at, output).first(values.size()),
                                    result.upper.row(at, output).first(values.size())};
    putShares(shares, proved.value, result.sampled.row(at, output).first(values.size()));
    const double error = errors.empty() || !(errors(row, output) >= 0) ? 0 : errors(row, output);
    result.excess(at, output) = excessOf(shares, proved, error);
  }
}

}  // namespace gamut
