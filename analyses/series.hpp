// What distribution functions by series have in common: sums of positive terms, of which what is left is at most
// geometric.
#pragma once

#include <limits>

#include "scalars/elementary/special_functions.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// |d/dx log Γ(x)| ≤ |log x| + 1/x (Abramowitz and Stegun 6.3.21: log x - 1/x < ψ(x) < log x), which counts where x is
/// no single number.
inline Interval logGamma(const Interval& x) {
  const Interval slope = abs(log(x)) + Interval(1.0) / x;
  const detail::Bounds first = detail::boundLogGamma(x.lower());
  return Interval(first.down, first.up) + slope * (x - Interval(x.lower())) * Interval(-1.0, 1.0);
}

/// 1 + r_0 + r_0 r_1 + …, all ratios positive, as bounded by `atMost(n)` from r_n on. Where that stays at 1 or above,
/// the sum is not known.
template <class Ratio, class AtMost>
Interval sumOfSeries(const Ratio& ratio, const AtMost& atMost) {
  constexpr int most = 100000;
  constexpr double enough = 0x1p-60;
  Interval sum(1.0), term(1.0);
  for (int n = 0; n < most; ++n) {
    const double bound = atMost(n);
    if (bound < 1) {
      const Interval rest = term * Interval(0.0, bound) / (Interval(1.0) - Interval(bound));
      if (rest.upper() <= enough * sum.lower()) return sum + rest;
    }
    term = term * ratio(n);
    sum = sum + term;
  }
  return {sum.lower(), std::numeric_limits<double>::infinity()};
}

}  // namespace gamut
