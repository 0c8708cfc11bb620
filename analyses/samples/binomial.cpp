#include "analyses/samples/binomial.hpp"

#include <boost/math/special_functions/beta.hpp>

namespace gamut {

Interval confidenceOfShare(std::int64_t hits, std::int64_t count, double confidence) {
  const auto k = static_cast<double>(hits), n = static_cast<double>(count);
  const double tail = 0.5 * (1 - confidence);
  return {hits > 0 ? boost::math::ibeta_inv(k, n - k + 1, tail) : 0.0,
          hits < count ? boost::math::ibeta_inv(k + 1, n - k, 1 - tail) : 1.0};
}

}  // namespace gamut
