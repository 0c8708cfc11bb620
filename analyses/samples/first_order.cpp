#include "analyses/samples/first_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyses/samples/sampling.hpp"

namespace gamut {
namespace {

constexpr std::size_t points = 16384;

double scaled(const Uncertain& quantity, double value) {
  const double half = 0.5 * width(quantity.range);
  return half > 0 ? (value - quantity.nominal) / half : 0;
}

}  // namespace

FirstOrder::FirstOrder(const std::vector<Uncertain>& uncertain)
    : uncertain_(&uncertain),
      row_(uncertain.size() + 1, 1.0),
      products_(row_.size() * row_.size(), 0.0),
      right_(row_.size(), 0.0) {}

void FirstOrder::include(std::span<const double> values, double number) {
  if (std::isnan(number)) return;
  for (std::size_t q = 0; q < uncertain_->size(); ++q) row_[q + 1] = scaled((*uncertain_)[q], values[q]);
  const std::size_t n = row_.size();
  for (std::size_t i = 0; i < n; ++i) {
    right_[i] += row_[i] * number;
    for (std::size_t j = 0; j <= i; ++j) products_[i * n + j] += row_[i] * row_[j];
  }
  ++count_;
}

/// By the factors L of products = L Lᵀ.
std::vector<double> FirstOrder::coefficients() const {
  const std::size_t n = row_.size();
  constexpr double singular = 1e-10;  // of what a column was before those ahead of it were taken off
  if (count_ < 2 * n) return {};
  std::vector<double> factor = products_, solution = right_;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = factor[i * n + j];
      for (std::size_t k = 0; k < j; ++k) sum -= factor[i * n + k] * factor[j * n + k];
      if (j < i) {
        factor[i * n + j] = sum / factor[j * n + j];
      } else {
        if (!(sum > singular * products_[i * n + i])) return {};
        factor[i * n + i] = std::sqrt(sum);
      }
    }
    for (std::size_t k = 0; k < i; ++k) solution[i] -= factor[i * n + k] * solution[k];
    solution[i] /= factor[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) solution[i] -= factor[k * n + i] * solution[k];
    solution[i] /= factor[i * n + i];
  }
  return solution;
}

std::vector<double> sharesAboveZero(const std::vector<std::vector<double>>& coefficients,
                                    const std::vector<char>& atZero, const std::vector<Uncertain>& uncertain,
                                    const QuantityDependence& dependence, std::uint64_t seed) {
  std::vector<double> shares;
  for (const std::vector<double>& each : coefficients)
    shares.push_back(each.empty() ? std::numeric_limits<double>::quiet_NaN() : 0.0);
  if (std::ranges::all_of(coefficients, [](const auto& each) { return each.empty(); })) return shares;
  Sampling sampling(uncertain.size() <= mostQuantities(Plan::sobol) ? Plan::sobol : Plan::random, uncertain.size(),
                    points, seed);
  sampling.correlate(dependence.copulas);
  for (std::size_t point = 0; point < sampling.samples(); ++point) {
    const std::vector<double> values = sampling.values(point, uncertain);
    for (std::size_t f = 0; f < coefficients.size(); ++f) {
      if (coefficients[f].empty()) continue;
      double number = coefficients[f][0];
      for (std::size_t q = 0; q < uncertain.size(); ++q)
        number += coefficients[f][q + 1] * scaled(uncertain[q], values[q]);
      if (number > 0 || (number == 0 && atZero[f] != 0)) shares[f] += 1.0 / static_cast<double>(sampling.samples());
    }
  }
  for (double& share : shares) share = std::min(share, 1.0);
  return shares;
}

}  // namespace gamut
