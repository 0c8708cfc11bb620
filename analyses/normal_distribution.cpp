#include "analyses/normal_distribution.hpp"

#include <gsl/gsl_cdf.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "scalars/elementary/special_functions.hpp"

namespace gamut {
namespace {

Interval byErfc(const Interval& z) {
  const Interval x = -z / sqrt(Interval(2.0));
  return 0.5 * Interval(detail::boundErfc(x.upper()).down, detail::boundErfc(x.lower()).up);
}

/// Φ(z₀ + h) for |h| <= 1/32 + 2^-40: Φ(z₀) + φ(z₀) ∫₀ʰ u, u(t) = exp(-z₀ t - t²/2), u' = -(z₀ + t) u, so that of its
/// series (n+1) u_{n+1} = -z₀ u_n - u_{n-1}. On |t| = 1 |u| <= exp(|z₀| + ½), which bounds all |u_n| (Cauchy): what
/// follows the first N terms of ∫u is at most that times |h|^(N+1)/(N+1)/(1 - |h|).
class ShortWay {
 public:
  static constexpr int perUnit = 16, most = 8;  // |z₀|

  explicit ShortWay(double from) : from_(from), below_(byErfc(from)) {
    const Interval z(from), dense = exp(-0.5 * sqr(z)) / sqrt(2.0 * pi());
    Interval last(0.0), u(1.0);
    for (int n = 0; n < terms; ++n) {
      const double power = n + 1;
      part_[n] = dense * u / power;
      const Interval next = -(z * u + last) / power;
      last = u, u = next;
    }
    constexpr double farthest = 0x1p-5 * (1 + 0x1p-30);
    rest_ = (dense * exp(abs(z) + 0.5) * pow(Interval(farthest), terms + 1) / (terms + 1.0) / (1 - farthest)).upper();
  }

  Interval operator()(const Interval& z) const {
    const Interval h = z - from_;
    Interval sum = part_.back();
    for (std::size_t n = part_.size() - 1; n-- > 0;) sum = part_[n] + h * sum;
    return below_ + (h * sum + Interval(-rest_, rest_));
  }

 private:
  static constexpr int terms = 14;
  double from_, rest_ = 0;
  Interval below_;
  std::array<Interval, terms> part_;
};

const ShortWay& shortWayTo(double z) {
  static const std::vector<ShortWay> all = [] {
    std::vector<ShortWay> made;
    constexpr int last = ShortWay::most * ShortWay::perUnit;
    for (int i = -last; i <= last; ++i) made.emplace_back(static_cast<double>(i) / ShortWay::perUnit);
    return made;
  }();
  return all[std::lround((z + ShortWay::most) * ShortWay::perUnit)];
}

}  // namespace

Interval normalBelow(const Interval& z) {
  constexpr double narrow = 0x1p-40;
  if (!(width(z) < narrow)) {  // Φ rises
    return {std::isfinite(z.lower()) ? normalBelow(z.lower()).lower() : 0,
            std::isfinite(z.upper()) ? normalBelow(z.upper()).upper() : 1};
  }
  if (!(magnitude(z) < ShortWay::most)) return byErfc(z);
  return shortWayTo(midpoint(z))(z);
}

double aboutNormalBelow(double z) { return gsl_cdf_ugaussian_P(z); }

double aboutNormalAbove(double z) { return gsl_cdf_ugaussian_Q(z); }

double aboutNormalQuantile(double probability) { return gsl_cdf_ugaussian_Pinv(probability); }

double aboutNormalUpperQuantile(double probability) { return gsl_cdf_ugaussian_Qinv(probability); }

}  // namespace gamut
