// How probable the values of a quantity are. Each distribution has a file in distributions/: its words, its checks, its
// distribution function with bounds, its inverse, and what of it grows with its parameters.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "scalars/shape_fields.hpp"

namespace gamut {

/// Of a Dempster-Shafer structure: a value in this interval, nobody knows which, has this share of the probability.
struct FocalInterval {
  Interval values;
  Interval mass{1.0};
};

/// Of a density: an upper bound, and one of how much it rises and falls in all, from zero and back to zero.
/// Infinite where there is none, or where more than one distribution is possible.
struct DensityBound {
  double most, variation;
};

/// A distribution: described, and then settled. Most are a Family or Pieces.
class DistributionLaw {
 public:
  virtual ~DistributionLaw() = default;

  /// Its word in files.
  virtual std::string_view name() const = 0;
  /// Half a sentence.
  virtual std::string_view summary() const = 0;
  virtual void describe(ShapeFields& fields) = 0;
  /// Once all is filled in. Throws std::invalid_argument, naming the number, for what is no distribution.
  virtual void settle() = 0;

  virtual Interval support() const = 0;
  virtual std::vector<ShapeNumber> numbers() const = 0;

  // Of these Distribution says what they are.
  virtual bool isPrecise() const = 0;
  virtual const std::vector<FocalInterval>& focal() const;
  virtual double cutOff() const { return 0; }
  virtual DensityBound densityBound() const = 0;
  virtual Interval enclosedBelow(const Interval& value) const = 0;
  /// Of 0 < u < 1, where the support holds more than one value.
  virtual double quantile(double u) const = 0;
  /// Of what is precise, for values in the support.
  virtual bool isMonotone(const Interval& values) const = 0;
  /// Whether bounds take exponentials and powers of MPFR, or series of many terms.
  virtual bool isSlow() const { return false; }
};

/// Makes one that is not filled in.
using DistributionType = std::unique_ptr<DistributionLaw> (*)();
/// Those of distributions/, in the order of messages and of the guide.
std::vector<DistributionType> distributionTypes();

/// A distribution on a bounded support; or, where a parameter is an interval or evidence is about intervals, all those
/// that this allows (p-boxes and Dempster-Shafer structures: S. Ferson et al., Constructing probability boxes and
/// Dempster-Shafer structures, Sandia National Laboratories 2003).
class Distribution {
 public:
  using DensityBound = gamut::DensityBound;

  /// Uniform on [0, 0].
  Distribution();
  /// Settles it, and throws as that does.
  explicit Distribution(std::unique_ptr<DistributionLaw> law);

  // What programs state without a file; each throws std::invalid_argument, naming the number, for an unbounded support
  // or impossible parameters. Of parameters that are no single numbers, samples have the middles.

  static Distribution uniform(const Interval& support);
  static Distribution triangular(const Interval& support, const Interval& mode);
  static Distribution normal(const Interval& support, const Interval& mean, const Interval& deviation);
  static Distribution beta(const Interval& support, const Interval& a, const Interval& b);
  static Distribution lognormal(const Interval& support, const Interval& logMean, const Interval& logDeviation);
  static Distribution weibull(const Interval& support, const Interval& shape, const Interval& scale);
  static Distribution gamma(const Interval& support, const Interval& shape, const Interval& scale);
  static Distribution exponential(const Interval& support, const Interval& mean);
  /// Evenly distributed between neighbours among these values (at least two, which do not fall), with probabilities
  /// proportional to the weights (one fewer, not negative, some positive).
  static Distribution histogram(std::vector<double> values, std::vector<double> weights);
  /// Of measurements, at least two, in any order.
  static Distribution empirical(std::vector<double> values);
  /// Masses are not negative, some positive, and count by their share of the sum.
  static Distribution evidence(std::vector<FocalInterval> focal);

  /// Whether it is one distribution; else what follows is of the one that samples have, but for what says more.
  bool isPrecise() const { return law_->isPrecise(); }
  /// Of evidence; else empty.
  const std::vector<FocalInterval>& focal() const { return law_->focal(); }

  /// The value below which the quantity lies with probability u (0 … 1): 0 and 1 give the support's ends exactly, and
  /// every result lies in the support. Throws std::invalid_argument for another u.
  double quantile(double u) const;

  /// The probability that the quantity is not above a number that lies in `value`: a proved enclosure, of all
  /// distributions that it may have.
  Interval enclosedBelow(const Interval& value) const { return law_->enclosedBelow(value); }

  /// Whether the density certainly rises or falls all over `values`, where it is positive: then the distribution
  /// function bends to one side there. Of what is not precise: not inside its support.
  bool isMonotone(const Interval& values) const;

  DensityBound densityBound() const { return law_->densityBound(); }

  const Interval& support() const { return support_; }
  /// The probability that truncation to the support cut off; 0 of what is bounded by itself.
  double cutOff() const { return law_->cutOff(); }
  /// Whether its bounds take longer than most.
  bool isSlow() const { return law_->isSlow(); }
  /// Its word in files: "uniform", …
  std::string_view name() const { return law_->name(); }
  /// "lower" and "upper", the support; then what it is made of, and "cut_off" of what is truncated.
  std::vector<ShapeNumber> numbers() const { return law_->numbers(); }

 private:
  std::shared_ptr<const DistributionLaw> law_;
  Interval support_;
};

// For laws:

/// The function of a value that does not fall, over an interval.
template <class F>
Interval rising(const F& f, const Interval& x) {
  return hull(f(x.lower()), f(x.upper()));
}

/// Throws std::invalid_argument.
void requireShape(bool good, const std::string& what);
/// Throws ShapeRefusal, of what is stated by `key`.
void requirePositive(const char* key, const Interval& value, const char* what);
/// Throws std::invalid_argument.
void requireNotNegative(const Interval& support, const char* what);
/// Of a parameter: "2", or "[1, 2]".
std::string shownNumber(const Interval& value);

}  // namespace gamut
