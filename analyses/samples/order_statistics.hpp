// What the order of independent samples says of the distribution that they come from, whatever it is.
#pragma once

#include <cstddef>
#include <optional>

namespace gamut {

/// Numbers of two of n sorted samples, from 1.
struct Ranks {
  std::size_t lower = 0, upper = 0;
};

/// Between which samples a quantile lies with at least this confidence, as narrow as they can be with half of the rest
/// on either side; nothing where the samples are too few (H. A. David, H. N. Nagaraja, Order Statistics, section 7.1).
std::optional<Ranks> ranksAround(double probability, std::size_t samples, double confidence);

/// The share of the distribution that lies between the least and the greatest sample with this confidence
/// (S. S. Wilks, Annals of Mathematical Statistics 12, 1941): the s with 1 - n s^(n-1) + (n-1) s^n = confidence.
double coveredShare(std::size_t samples, double confidence);

}  // namespace gamut
