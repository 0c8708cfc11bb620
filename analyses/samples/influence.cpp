// Sums over corners with the sign of their ends: of an orthogonal array of corners they are main effects too.
#include "analyses/samples/influence.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace gamut {

InfluenceMeasures::InfluenceMeasures(const Sampling& sampling, std::vector<double> alpha, std::vector<std::size_t> rows,
                                     std::size_t outputs)
    : sampling_(sampling),
      alpha_(std::move(alpha)),
      rows_(std::move(rows)),
      outputs_(outputs),
      sums_(sampling.boxes().size() * rows_.size() * outputs * sampling.quantities(), 0.0) {}

void InfluenceMeasures::include(const SampleBlock& block) {
  const std::size_t first = sampling_.samples() + sampling_.corners(), quantities = sampling_.quantities();
  for (std::size_t i = 0; i < block.size(); ++i) {
    const std::size_t number = block.first() + i;
    if (number < first || number >= sampling_.centre()) continue;
    const std::size_t level = (number - first) / (sampling_.boxCorners() / sampling_.boxes().size());
    const Box& cut = sampling_.boxes()[level];
    const std::span<const double> values = block.values(i);
    double* sum = sums_.data() + level * rows_.size() * outputs_ * quantities;
    for (const std::size_t row : rows_)
      for (std::size_t output = 0; output < outputs_; ++output)
        for (std::size_t q = 0; q < quantities; ++q, ++sum)
          *sum += values[q] > midpoint(cut[q]) ? block(i, row, output) : -block(i, row, output);
  }
}

/// Half of a cut's corners have either end: η (b - a) = 2/corners Σ ± y. A quantity of a membership with a core has
/// width at the highest level too, one with an apex has not: sums over the levels would favour the former, means do
/// not.
std::vector<double> InfluenceMeasures::shares(std::size_t at, std::size_t output) const {
  const std::size_t quantities = sampling_.quantities(), levels = sampling_.boxes().size();
  std::vector<double> influence(quantities, 0.0), weights(quantities, 0.0);
  for (std::size_t level = 0; level < levels; ++level)
    for (std::size_t q = 0; q < quantities; ++q) {
      const Interval& cut = sampling_.boxes()[level][q];
      if (!(width(cut) > 0)) continue;
      const double sum = sums_[((level * rows_.size() + at) * outputs_ + output) * quantities + q];
      const double mean = 2 * sum * static_cast<double>(levels) / static_cast<double>(sampling_.boxCorners());
      influence[q] += alpha_[level] * std::fabs(mean * (cut.lower() + cut.upper()) / width(cut));
      weights[q] += alpha_[level];
    }
  for (std::size_t q = 0; q < quantities; ++q)
    if (weights[q] > 0) influence[q] /= weights[q];
  const double all = std::accumulate(influence.begin(), influence.end(), 0.0);
  for (double& each : influence) each = all > 0 ? each / all : std::numeric_limits<double>::quiet_NaN();
  return influence;
}

}  // namespace gamut
