// By the distribution function of binomial variables, and by bisection.
#include "analyses/samples/order_statistics.hpp"

#include <gsl/gsl_cdf.h>

#include <cmath>

namespace gamut {
namespace {

/// The least k with P[at most k of n] >= wanted, each with this probability.
std::size_t binomialQuantile(double wanted, double probability, std::size_t n) {
  std::size_t low = 0, high = n;
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (gsl_cdf_binomial_P(static_cast<unsigned>(middle), probability, static_cast<unsigned>(n)) >= wanted)
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

}  // namespace

/// So many samples lie below the quantile, K, binomial: sample r does if K >= r. P[K < lower] <= rest / 2 and
/// P[K >= upper] <= rest / 2.
std::optional<Ranks> ranksAround(double probability, std::size_t samples, double confidence) {
  const double half = (1 - confidence) / 2;
  const std::size_t lower = binomialQuantile(half, probability, samples),
                    upper = binomialQuantile(1 - half, probability, samples) + 1;
  if (lower < 1 || upper > samples) return {};
  return Ranks{lower, upper};
}

double coveredShare(std::size_t samples, double confidence) {
  const double n = static_cast<double>(samples);
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double share = (low + high) / 2;
    const double power = std::pow(share, n - 1);
    (1 - n * power + (n - 1) * power * share >= confidence ? low : high) = share;
  }
  return low;
}

}  // namespace gamut
