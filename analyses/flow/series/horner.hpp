// Horner's scheme for many polynomials at one place.
#pragma once

#include <array>
#include <cstddef>

namespace gamut {

/// Of `count` polynomials, whose coefficients lie `stride` apart, Σ_{first ≤ i ≤ last} weight(i) c_i x^(i - first) from
/// the highest order down: visit(number, value), rising. Eight go side by side, since each waits for itself.
template <class Weight, class Visit>
void hornerRows(const double* c, int count, int stride, int first, int last, double x, const Weight& weight,
                const Visit& visit) {
  constexpr int together = 8;
  std::array<double, together> sum;
  for (int g = 0; g < count; g += together) {
    const int rows = count - g < together ? count - g : together;
    const double* const own = c + static_cast<std::size_t>(g) * static_cast<std::size_t>(stride);
    sum.fill(0.0);
    if (rows == together) {
      for (int i = last; i >= first; --i)
        for (int k = 0; k < together; ++k) sum[k] = sum[k] * x + weight(i, own[k * stride + i]);
    } else {
      for (int i = last; i >= first; --i)
        for (int k = 0; k < rows; ++k) sum[k] = sum[k] * x + weight(i, own[k * stride + i]);
    }
    for (int k = 0; k < rows; ++k) visit(g + k, sum[k]);
  }
}

}  // namespace gamut
