// Families of distributions with parameters, of which each may be an interval: a p-box.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "analyses/distribution.hpp"

namespace gamut {

/// Densities that rise to one mode and fall, or are nowhere bounded. Bounds are of all members of the family: those of
/// distribution functions are above all others, or below them, where parameters are at the ends that their trends tell;
/// parameters without a trend are divided into parts.
class Family : public DistributionLaw {
 public:
  Interval on{0.0};  ///< the support

  void settle() final;
  Interval support() const final { return on; }
  std::vector<ShapeNumber> numbers() const override;
  bool isPrecise() const final;
  DensityBound densityBound() const final;
  Interval enclosedBelow(const Interval& value) const final;

 protected:
  virtual std::unique_ptr<Family> copy() const = 0;
  /// Throws std::invalid_argument, naming the number, for parameters or a support that cannot be.
  virtual void check() const {}
  /// Computes what its functions need of the parameters, whichever of their intervals these are.
  virtual void prepare() {}

  // Once prepared, with parameters of which those that have a trend are single numbers:

  /// F(v), for v in the support.
  virtual Interval enclosed(const Interval& v) const = 0;
  /// The greatest density, on a support of more than one value; no bound: all that is positive.
  virtual Interval densest() const = 0;
  /// Whether truncation leaves a probability to the support.
  virtual bool hasMass() const { return true; }
  /// Of F, at most, what truncation cuts off, where parameters may be anything in their intervals; of what is not
  /// truncated more.
  virtual double hidden() const { return 1; }

  static Interval anyDensity();

 private:
  using Parameters = std::vector<std::pair<Interval*, Trend>>;
  Parameters parameters();
  std::vector<std::shared_ptr<const Family>> members(bool low) const;

  bool isPrecise_ = true;
  std::vector<std::shared_ptr<const Family>> least_, greatest_;  // F above all others', and below them
};

/// What is truncated to its support: F(v) = (P(v) - P(lower))/(P(upper) - P(lower)), so that its density is P's over
/// what is in the support.
class Truncated : public Family {
 public:
  std::vector<ShapeNumber> numbers() const final;
  double cutOff() const final { return below(on.lower()) + above(on.upper()); }
  double quantile(double u) const final;

 protected:
  void prepare() override;
  Interval enclosed(const Interval& v) const final;
  bool hasMass() const final;
  double hidden() const final;

  /// P, with bounds.
  virtual Interval enclosedAll(const Interval& value) const = 0;
  // P and 1 - P, and their inverses, in doubles, of the middles of parameters.
  virtual double below(double value) const = 0;
  virtual double above(double value) const = 0;
  virtual double whereBelow(double probability) const = 0;
  virtual double whereAbove(double probability) const = 0;

  /// P(upper) - P(lower).
  const Interval& inSupport() const { return all_; }

 private:
  Interval cut_{0.0}, all_{1.0};
};

/// Whether a mode in `mode` lies beside these values.
inline bool isBeside(const Interval& mode, const Interval& values) {
  return mode.upper() <= values.lower() || mode.lower() >= values.upper();
}

}  // namespace gamut
