// Two are transformed at once, as real and imaginary part: both sides of a part, or two parts whose sides are one.
#include "analyses/probability/convolution.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <utility>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/interval.hpp"

namespace gamut {
namespace {

/// Complex numbers, real and imaginary parts apart.
struct Numbers {
  std::vector<double> re, im;
};

/// Cooley and Tukey's transform of 2^t numbers. Roots of unity are the middles of enclosures, off by `rootError` at
/// most.
class Transform {
 public:
  explicit Transform(std::size_t size) : size_(size) {
    for (std::size_t half = 1; half < size; half *= 2)
      for (std::size_t i = 0; i < half; ++i) {
        const Interval angle = -pi() * Interval(static_cast<double>(i) / static_cast<double>(half));
        const Interval c = cos(angle), sine = sin(angle);
        root_.re.push_back(midpoint(c));
        root_.im.push_back(midpoint(sine));
        rootError_ = std::max(rootError_, width(c) + width(sine));  // twice what halves of the widths allow
      }
    for (std::size_t i = 1, j = 0; i < size; ++i) {
      std::size_t bit = size >> 1;
      for (; (j & bit) != 0; bit >>= 1) j ^= bit;
      j ^= bit;
      if (i < j) swapped_.emplace_back(i, j);
    }
  }

  double rootError() const { return rootError_; }

  void operator()(Numbers& x) const {
    Work::count(Work::transformed, static_cast<double>(size_) * (std::bit_width(size_) + 1));
    for (const auto& [i, j] : swapped_) std::swap(x.re[i], x.re[j]), std::swap(x.im[i], x.im[j]);
    for (std::size_t half = 1; half < size_; half *= 2)
      for (std::size_t block = 0; block < size_; block += 2 * half)
        join(x.re.data() + block, x.im.data() + block, root_.re.data() + half - 1, root_.im.data() + half - 1, half);
  }

 private:
  static void join(double* __restrict re, double* __restrict im, const double* __restrict c, const double* __restrict s,
                   std::size_t half) {
    double* const __restrict oddRe = re + half;
    double* const __restrict oddIm = im + half;
    for (std::size_t i = 0; i < half; ++i) {
      const double a = c[i] * oddRe[i] - s[i] * oddIm[i], b = c[i] * oddIm[i] + s[i] * oddRe[i];
      const double evenRe = re[i], evenIm = im[i];
      re[i] = evenRe + a;
      im[i] = evenIm + b;
      oddRe[i] = evenRe - a;
      oddIm[i] = evenIm - b;
    }
  }

  std::size_t size_;
  double rootError_ = 0;
  Numbers root_;  // of every level, one behind the other
  std::vector<std::pair<std::size_t, std::size_t>> swapped_;
};

const Transform& transformOf(std::size_t size) {
  thread_local std::map<std::size_t, Transform> known;
  return known.try_emplace(size, size).first->second;
}

void multiply(Numbers& into, std::size_t i, const std::pair<double, double>& by) {
  const auto [re, im] = by;
  const double real = into.re[i] * re - into.im[i] * im;
  into.im[i] = into.re[i] * im + into.im[i] * re;
  into.re[i] = real;
}

/// Where the sum begins, on both sides; returns how long it is.
std::size_t startSum(const std::vector<GridBounds>& parts, const std::vector<GridMasses>& exact, GridBounds& sum) {
  std::size_t length = 1;
  for (const GridBounds& part : parts) {
    sum.below.first += part.below.first;
    sum.above.first += part.above.first;
    length += std::max(part.below.mass.size(), part.above.mass.size()) - 1;
  }
  for (const GridMasses& part : exact) {
    sum.below.first += part.first;
    sum.above.first += part.first;
    length += part.mass.size() - 1;
  }
  return length;
}

}  // namespace

/// A transform is off by no more than ε = t η / (1 - t η) of its 2-norm, η <= μ + γ4 (√2 + μ) < μ + 6 u with roots off
/// by μ (N. J. Higham, Accuracy and Stability of Numerical Algorithms, theorem 24.2). Spectra of masses are at most 1,
/// those of both sides together have a 2-norm of √(2n) at most; so the product of k is off by k √(2n) (ε + 3 u), for
/// both sides twice that, and the sum, by the inverse transform, by (3 k + 2) (ε + 3 u) in the 2-norm, and √n times
/// that in the 1-norm.
GridSum sumOf(const std::vector<GridBounds>& parts, const std::vector<GridMasses>& exact) {
  GridSum result;
  const std::size_t length = startSum(parts, exact, result.sum);
  if (parts.size() == 1 && exact.empty()) return {parts.front(), 0};
  std::size_t size = 1;
  int t = 0;
  while (size < length) size *= 2, ++t;
  const Transform& transform = transformOf(size);
  const auto ofSize = [&](double value) {
    return Numbers{std::vector<double>(size, value), std::vector<double>(size, 0.0)};
  };
  Numbers below = ofSize(1.0), above = ofSize(1.0), x = ofSize(0.0);
  const auto transformed = [&](const std::vector<double>& re, const std::vector<double>& im) {
    x = ofSize(0.0);
    std::ranges::copy(re, x.re.begin());
    std::ranges::copy(im, x.im.begin());
    transform(x);
  };
  const auto realAt = [&](std::size_t i, std::size_t j) {
    return std::pair(0.5 * (x.re[i] + x.re[j]), 0.5 * (x.im[i] - x.im[j]));
  };
  const auto imaginaryAt = [&](std::size_t i, std::size_t j) {
    return std::pair(0.5 * (x.im[i] + x.im[j]), 0.5 * (x.re[j] - x.re[i]));
  };
  for (const GridBounds& part : parts) {
    transformed(part.below.mass, part.above.mass);
    for (std::size_t i = 0; i < size; ++i) {
      multiply(below, i, realAt(i, (size - i) % size));
      multiply(above, i, imaginaryAt(i, (size - i) % size));
    }
  }
  static const std::vector<double> one{1.0};  // the number zero, for certain
  for (std::size_t k = 0; k < exact.size(); k += 2) {
    transformed(exact[k].mass, k + 1 < exact.size() ? exact[k + 1].mass : one);
    for (std::size_t i = 0; i < size; ++i)
      for (Numbers* side : {&below, &above}) {
        multiply(*side, i, realAt(i, (size - i) % size));
        multiply(*side, i, imaginaryAt(i, (size - i) % size));
      }
  }
  // The inverse transform of z is the conjugate of that of z's, divided by n.
  for (std::size_t i = 0; i < size; ++i) {
    x.re[i] = below.re[i] - above.im[i];
    x.im[i] = -(below.im[i] + above.re[i]);
  }
  transform(x);
  const double scale = 1 / static_cast<double>(size);
  for (std::size_t i = 0; i < length; ++i) {
    result.sum.below.mass.push_back(scale * x.re[i]);
    result.sum.above.mass.push_back(-scale * x.im[i]);
  }
  const double k = static_cast<double>(parts.size() + exact.size() + exact.size() % 2);
  result.error = std::sqrt(static_cast<double>(size)) * (3 * k + 2) *
                 (t * (transform.rootError() + 6 * bounds::unit) + 6 * bounds::unit) * (1 + 1e-3);
  return result;
}

}  // namespace gamut
