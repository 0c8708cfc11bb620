// How uncertain quantities hang together, where they are not independent.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scalars/interval.hpp"

namespace gamut {

/// Quantities with a Gaussian copula: each is a quantile of its own distribution at Φ(z), all z normally distributed
/// with correlations r = 2 sin(π ρ/6) of the rank correlations ρ (Spearman's; K. Pearson 1907).
class GaussianCopula {
 public:
  /// ρ: row by row. Throws std::invalid_argument, saying where, for what is not symmetric, has no ones in its diagonal,
  /// or is not certainly positive definite.
  GaussianCopula(std::vector<std::size_t> quantities, std::vector<std::vector<Interval>> rankCorrelation);

  const std::vector<std::size_t>& quantities() const { return quantities_; }
  /// ρ, as it was given.
  const std::vector<std::vector<Interval>>& rank() const { return rank_; }
  /// Quantity q is the place[q]th from now on.
  void renumber(const std::vector<std::size_t>& place) {
    for (std::size_t& q : quantities_) q = place[q];
  }
  /// z = root·w, w independent: of Cholesky's decomposition, a lower triangle.
  const std::vector<std::vector<Interval>>& root() const { return root_; }

  /// Of independent numbers in [0,1], one an uncertain quantity, makes those of its own dependent, in doubles: for
  /// samples. What is nearer to an end than 2^-60 or 2^-53 is taken for that far.
  void correlate(std::span<double> point) const;

 private:
  std::vector<std::size_t> quantities_;
  std::vector<std::vector<Interval>> rank_, root_;
};

/// All that is not independent: no quantity is in it twice.
struct QuantityDependence {
  std::vector<GaussianCopula> copulas;
  std::vector<std::vector<std::size_t>> unknown;  ///< groups of quantities of which nothing is known but their own
                                                  ///< distributions
  bool isNone() const { return copulas.empty() && unknown.empty(); }
};

}  // namespace gamut
