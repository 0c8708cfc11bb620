// In which unit people are told of a number: the one in which the study states it. All that is computed, and the
// results file, keep the unit of what it is, that of SI for an uncertain quantity.
#pragma once

#include <string>
#include <utility>

#include "scalars/interval.hpp"
#include "studies/results/origin.hpp"

namespace gamut {

/// A unit, and how much one of it is.
class Told {
 public:
  /// `stated` in place of the unit `own`; that where `stated` is empty or no unit of its kind.
  Told(const std::string& own, const std::string& stated);
  explicit Told(const UncertainInfo& quantity) : Told(quantity.unit, quantity.told) {}

  /// "deg"; "1" or empty without one.
  const std::string& unit() const { return unit_; }
  /// Of what changes by so much in a second: "deg/s".
  std::string rateUnit() const;

  /// A number of the own unit, to nearest but for a rounding.
  double of(double x) const { return isOwn_ ? x : x / midpoint(one_); }
  Interval of(const Interval& x) const { return isOwn_ ? x : x / one_; }

  using Bounds = std::pair<double, double>;  ///< lower and upper
  /// Bounds of the own unit, outward; what is no interval of numbers stays as it is.
  Bounds of(double lower, double upper) const;
  /// Likewise, of what a change of one in this unit does where one of the own unit does so much: "per deg" of "per
  /// rad".
  Bounds perOne(double lower, double upper) const;

 private:
  std::string unit_;
  Interval one_;  // of it, in the own unit
  bool isOwn_;
};

}  // namespace gamut
