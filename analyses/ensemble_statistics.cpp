// What an ensemble says: envelope, moments, quantiles and inner alpha-cuts.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analyses/ensemble.hpp"

namespace gamut {
namespace {

/// Mean and standard deviation by two passes.
void moments(const std::vector<double>& column, double& mean, double& deviation) {
  const double n = static_cast<double>(column.size());
  double sum = 0, squares = 0;
  for (double value : column) sum += value;
  mean = sum / n;
  for (double value : column) squares += (value - mean) * (value - mean);
  if (column.size() > 1) deviation = std::sqrt(squares / (n - 1));
}

/// The order statistic at rank, after those before `from` have been put in place.
double orderStatistic(std::vector<double>& column, std::size_t from, std::size_t rank) {
  const auto at = [&](std::size_t i) { return column.begin() + static_cast<std::ptrdiff_t>(i); };
  if (rank >= from) std::nth_element(at(from), at(rank), column.end());
  return column[rank];
}

/// Quantiles by linear interpolation between order statistics (Hyndman & Fan, Am. Stat. 50, 1996, definition 7).
/// Probabilities rise; the column is reordered.
void quantilesOf(std::vector<double>& column, const std::vector<double>& probabilities, std::vector<double>& quantile) {
  std::size_t placed = 0;
  for (std::size_t q = 0; q < probabilities.size(); ++q) {
    const double position = probabilities[q] * static_cast<double>(column.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const double low = orderStatistic(column, placed, below);
    placed = std::max(placed, below + 1);
    quantile[q] = low;
    if (below + 1 < column.size()) {
      const double high = orderStatistic(column, placed, below + 1);
      placed = std::max(placed, below + 2);
      quantile[q] = std::clamp(low + (position - static_cast<double>(below)) * (high - low), low, high);
    }
  }
}

}  // namespace

void Envelope::include(std::size_t time, std::size_t output, double value) {
  if (!std::isfinite(value)) return;
  double& low = lower(time, output);
  double& high = upper(time, output);
  if (!(low <= value)) low = value;  // also where there was none, NaN
  if (!(high >= value)) high = value;
}

Envelope Ensemble::envelope() const {
  Envelope result(times.size(), outputs);
  for (std::size_t i = 0; i < size(); ++i)
    for (std::size_t t = 0; t < times.size(); ++t)
      for (std::size_t o = 0; o < outputs; ++o) result.include(t, o, (*this)(i, t, o));
  return result;
}

Statistics statistics(const Ensemble& e, const std::vector<double>& probabilities) {
  for (std::size_t q = 0; q < probabilities.size(); ++q)
    if (!(probabilities[q] >= 0 && probabilities[q] <= 1) || (q > 0 && probabilities[q] < probabilities[q - 1]))
      throw std::invalid_argument("the probabilities of quantiles rise from 0 to 1");
  Statistics result;
  result.mean = Table(e.times.size(), e.outputs);
  result.deviation = result.mean;
  result.probabilities = probabilities;
  result.quantiles.assign(probabilities.size(), result.mean);
  std::vector<std::vector<double>> columns(e.outputs);
  std::vector<double> quantile(probabilities.size());
  for (std::size_t t = 0; t < e.times.size(); ++t) {
    for (std::vector<double>& column : columns) column.clear();
    for (std::size_t i = 0; i < e.samples; ++i)  // all outputs of a time at once: they lie together
      for (std::size_t o = 0; o < e.outputs; ++o)
        if (std::isfinite(e(i, t, o))) columns[o].push_back(e(i, t, o));
    for (std::size_t o = 0; o < e.outputs; ++o) {
      if (columns[o].empty()) continue;
      moments(columns[o], result.mean(t, o), result.deviation(t, o));
      quantilesOf(columns[o], probabilities, quantile);
      for (std::size_t q = 0; q < quantile.size(); ++q) result.quantiles[q](t, o) = quantile[q];
    }
  }
  return result;
}

std::vector<Envelope> innerCuts(const Ensemble& e, const std::vector<Uncertain>& uncertain,
                                const std::vector<double>& alpha) {
  if (uncertain.size() != e.quantities) throw std::invalid_argument("the ensemble is of another number of quantities");
  std::vector<Envelope> cuts(alpha.size(), Envelope(e.times.size(), e.outputs));
  for (std::size_t i = 0; i < e.size(); ++i) {
    double degree = 1;
    for (std::size_t j = 0; j < e.quantities; ++j) {
      const Membership& membership = uncertain[j].membership;
      const double value = e.valuesOf(i)[j];
      degree = contains(membership.support(), value) ? std::min(degree, membership(value)) : -1;  // to no level at all
      if (degree < 0) break;
    }
    for (std::size_t level = 0; level < alpha.size(); ++level) {
      if (degree < alpha[level]) continue;
      for (std::size_t t = 0; t < e.times.size(); ++t)
        for (std::size_t o = 0; o < e.outputs; ++o) cuts[level].include(t, o, e(i, t, o));
    }
  }
  return cuts;
}

}  // namespace gamut
