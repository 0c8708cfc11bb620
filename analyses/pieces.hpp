// Distributions that are even between neighbours among some values.
#pragma once

#include <vector>

#include "analyses/distribution.hpp"

namespace gamut {

class Pieces : public DistributionLaw {
 public:
  Interval support() const final { return support_; }
  bool isPrecise() const override { return true; }
  DensityBound densityBound() const override;
  Interval enclosedBelow(const Interval& value) const override;
  double quantile(double u) const final;
  bool isMonotone(const Interval& values) const override;

 protected:
  /// With probabilities proportional to the weights between values that do not fall. Throws std::invalid_argument.
  void fill(const std::vector<double>& values, const std::vector<double>& weights);

 private:
  /// Its end and weight, and the probability not above the end.
  struct Piece {
    double end, weight;
    Interval below;
  };
  Interval belowOf(double value) const;
  std::size_t pieceAt(double value) const;
  bool hasSingleValues() const;

  Interval support_;
  std::vector<Piece> pieces_;  // behind the support's lower end
};

}  // namespace gamut
