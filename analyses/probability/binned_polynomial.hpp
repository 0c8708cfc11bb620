// A polynomial at the edges of bins, and bounds of it between any two of these.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "analyses/flow/series/error_bounds.hpp"

namespace gamut {

class BinnedPolynomial {
 public:
  /// Σ f[n] η^n, n > 0, on [-1,1] in so many bins. Horner's scheme is off by 2 n u Σ|c|, an η of the grid by one
  /// rounding more; between its values f leaves its chord by (2/count)²/8 |f''|.
  BinnedPolynomial(const std::vector<double>& f, long count) {
    double size = 0, bend = 0, slope = 0;  // Σ|c|; |f''| and |f'| at most
    for (std::size_t n = 1; n < f.size(); ++n) {
      size += std::fabs(f[n]);
      slope += static_cast<double>(n) * std::fabs(f[n]);
      bend += static_cast<double>(n * (n - 1)) * std::fabs(f[n]);
    }
    const double rounding = (2 * static_cast<double>(f.size() + 2) * size + 4 * slope) * bounds::unit * bounds::up;
    const double sag = 0.5 * bend / (static_cast<double>(count) * static_cast<double>(count)) * bounds::up;
    error_ = (rounding + sag) * bounds::up;
    for (long i = 0; i <= count; ++i) {
      const double eta = -1 + 2 * (static_cast<double>(i) / static_cast<double>(count));
      double sum = 0;
      for (std::size_t n = f.size(); n-- > 1;) sum = (sum + f[n]) * eta;
      value_.push_back(sum);
    }
  }

  /// By so much are all bounds off.
  double error() const { return error_; }
  long count() const { return static_cast<long>(value_.size()) - 1; }
  double at(long edge) const { return value_[edge]; }
  /// Over a bin.
  std::pair<double, double> over(long bin) const { return std::minmax(at(bin), at(bin + 1)); }
  /// From edge to edge. Needs tables.
  std::pair<double, double> over(long from, long until) const {
    const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(until);
    std::size_t level = 0;
    while ((std::size_t{2} << level) <= b - a + 1) ++level;
    const std::size_t last = b + 1 - (std::size_t{1} << level);
    return {std::min(least_[level][a], least_[level][last]), std::max(greatest_[level][a], greatest_[level][last])};
  }
  std::pair<double, double> all() const {
    const auto [least, greatest] = std::ranges::minmax(value_);
    return {least, greatest};
  }

  void makeTables() {
    least_.push_back(value_), greatest_.push_back(value_);
    for (std::size_t by = 1; 2 * by <= value_.size(); by *= 2) {  // of 2 by neighbours
      std::vector<double> low, high;
      for (std::size_t i = 0; i + 2 * by <= value_.size(); ++i) {
        low.push_back(std::min(least_.back()[i], least_.back()[i + by]));
        high.push_back(std::max(greatest_.back()[i], greatest_.back()[i + by]));
      }
      least_.push_back(std::move(low)), greatest_.push_back(std::move(high));
    }
  }

 private:
  double error_ = 0;
  std::vector<double> value_;
  std::vector<std::vector<double>> least_, greatest_;  // [level]: of 2^level neighbours
};

}  // namespace gamut
