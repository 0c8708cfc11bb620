// A number of each sample, as a linear function of the uncertain quantities: an estimate, of which nothing is proved.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "analyses/dependence.hpp"
#include "analyses/uncertainty.hpp"

namespace gamut {

class Archive;

/// The least-squares fit c_0 + Σ c_q (v_q - nominal_q) / h_q, h_q half the width of quantity q's interval, of numbers
/// that belong to samples' values v: gathered sample by sample, none is kept.
class FirstOrder {
 public:
  /// `uncertain` must outlive it.
  explicit FirstOrder(const std::vector<Uncertain>& uncertain);

  /// One value a quantity; a number that is NaN does not count.
  void include(std::span<const double> values, double number);
  std::size_t count() const { return count_; }
  /// c_0, c_1, …; empty while samples are fewer than twice as many as these, or leave one of them open.
  std::vector<double> coefficients() const;
  /// What was included.
  void archive(Archive& all);

 private:
  const std::vector<Uncertain>* uncertain_;
  std::vector<double> row_;               // 1, then the quantities' scaled deviations
  std::vector<double> products_, right_;  // Σ row rowᵀ, Σ row number
  std::size_t count_ = 0;
};

/// The share of the joint distribution in which each of these functions is above zero (at zero too, where `atZero` says
/// so), by 16384 points of it that follow from `seed`; NaN of one without coefficients.
std::vector<double> sharesAboveZero(const std::vector<std::vector<double>>& coefficients,
                                    const std::vector<char>& atZero, const std::vector<Uncertain>& uncertain,
                                    const QuantityDependence& dependence, std::uint64_t seed);

}  // namespace gamut
