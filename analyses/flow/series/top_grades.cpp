#include "analyses/flow/series/top_grades.hpp"

#include <algorithm>
#include <cmath>

#include "scalars/index.hpp"

namespace gamut {

using detail::at;

void TopGrades::add(const std::vector<double>& p, const Monomials& m) {
  const std::size_t N = at(m.count()), n = p.size() / N, k = at(m.symbols());
  variation_.resize(n), high_.resize(n), low_.resize(n), halved_.resize(n * k), quartered_.resize(n * k);
  const int highest = m.degree();
  for (std::size_t i = 0; i < n; ++i) {
    double all = 0;
    for (std::size_t g = 1; g < N; ++g) {
      const double size = std::fabs(p[i * N + g]);
      const int grade = m.grade(static_cast<int>(g));
      all += size;
      if (grade == highest - 1 || grade == highest - 2) low_[i] += size;
      if (grade < highest - 1) continue;
      high_[i] += size;
      for (std::size_t l = 0; l < k; ++l) {
        const int power = m.exponent(static_cast<int>(g), static_cast<int>(l));
        halved_[i * k + l] += std::ldexp(size, -power);
        quartered_[i * k + l] += std::ldexp(size, -2 * power);
      }
    }
    variation_[i] = std::max(variation_[i], all);
  }
}

void TopGrades::join(const TopGrades& other) {
  if (other.isEmpty()) return;
  if (isEmpty()) {
    *this = other;
    return;
  }
  for (std::size_t i = 0; i < variation_.size(); ++i) {
    variation_[i] = std::max(variation_[i], other.variation_[i]);
    high_[i] += other.high_[i], low_[i] += other.low_[i];
  }
  for (std::size_t i = 0; i < halved_.size(); ++i) {
    halved_[i] += other.halved_[i];
    quartered_[i] += other.quartered_[i];
  }
}

double TopGrades::total(const std::vector<double>& sums, std::size_t stride, std::size_t offset) const {
  double result = 0;
  for (std::size_t i = 0; i < variation_.size(); ++i)
    if (variation_[i] > 0) result += sums[i * stride + offset] / variation_[i];
  return result;
}

double TopGrades::decay() const {
  const double high = total(high_);
  return high > 0 ? std::max(1.0, total(low_) / high) : 1.0;
}

double TopGrades::gainOfHalving(int symbol, int before) const {
  if (isEmpty()) return 1;
  const std::size_t k = halved_.size() / variation_.size();
  const double halved = total(halved_, k, at(symbol));
  const double from = before == 0 ? total(high_) : halved, to = before == 0 ? halved : total(quartered_, k, at(symbol));
  return to > 0 ? std::max(1.0, from / to) : 1.0;
}

}  // namespace gamut
