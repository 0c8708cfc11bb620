// One uncertain quantity, three views: an interval (what is guaranteed), a distribution (what is probable) and a
// membership function (what is possible). Both supports lie inside the interval, so a sample or an alpha-cut that
// leaves an enclosure of the interval is an error of the program, never bad luck.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/membership.hpp"

namespace gamut {

/// Of a Dempster-Shafer structure: a value in this interval, nobody knows which, has this share of the probability.
struct FocalInterval {
  Interval values;
  Interval mass{1.0};
};

/// How probable the values of a quantity are: a distribution on a bounded support; or, where a parameter is an interval
/// or evidence is about intervals, all those that this allows (p-boxes and Dempster-Shafer structures: S. Ferson et
/// al., Constructing probability boxes and Dempster-Shafer structures, Sandia National Laboratories 2003).
class Distribution {
 public:
  /// Uniform on [0, 0].
  Distribution();

  // Each throws std::invalid_argument, naming the number, for an unbounded support or impossible parameters. Of
  // parameters that are no single numbers, samples have the middles.
  static Distribution uniform(const Interval& support);
  /// Density rising from the support's lower end to `mode` and falling to its upper end.
  static Distribution triangular(const Interval& support, const Interval& mode);
  /// Normal, truncated to the support.
  static Distribution normal(const Interval& support, const Interval& mean, const Interval& deviation);
  /// Density proportional to v^(a-1) (1-v)^(b-1), v running from 0 to 1 over the support.
  static Distribution beta(const Interval& support, const Interval& a, const Interval& b);
  /// The logarithm is normal with `logMean` and `logDeviation`; truncated to the support, which is not negative.
  static Distribution lognormal(const Interval& support, const Interval& logMean, const Interval& logDeviation);
  /// These three on a support that is not negative, to which they are truncated. P(v) = 1 - exp(-(v/scale)^shape):
  static Distribution weibull(const Interval& support, const Interval& shape, const Interval& scale);
  /// Density proportional to v^(shape-1) exp(-v/scale).
  static Distribution gamma(const Interval& support, const Interval& shape, const Interval& scale);
  /// Density proportional to exp(-v/mean).
  static Distribution exponential(const Interval& support, const Interval& mean);

  /// As of a histogram: evenly distributed between neighbours among these values (at least two, which do not fall),
  /// with probabilities proportional to the weights (one fewer, not negative, some positive). Between equal values a
  /// weight is the probability of that value itself.
  static Distribution histogram(const std::vector<double>& values, const std::vector<double>& weights);
  /// As of measurements: equally probable between neighbours among these values (at least two, in any order).
  static Distribution empirical(std::vector<double> values);

  /// As of a Dempster-Shafer structure: masses are not negative, some positive, and count by their share of the sum.
  /// Samples are evenly distributed in every interval.
  static Distribution evidence(std::vector<FocalInterval> focal);

  /// Whether it is one distribution; else what follows is of the one that samples have, but for what says more.
  bool isPrecise() const;
  /// Of evidence; else empty.
  const std::vector<FocalInterval>& focal() const { return focal_; }

  /// The value below which the quantity lies with probability u (0 … 1): 0 and 1 give the support's ends exactly, and
  /// every result lies in the support. Throws std::invalid_argument for another u.
  double quantile(double u) const;

  /// The probability that the quantity is not above a number that lies in `value`: a proved enclosure, of all
  /// distributions that it may have.
  Interval enclosedBelow(const Interval& value) const;

  /// Whether the density certainly rises or falls all over `values`, where it is positive: then the distribution
  /// function bends to one side there. Of what is not precise: not inside its support.
  bool isMonotone(const Interval& values) const;

  /// Of its density: an upper bound, and one of how much it rises and falls in all, from zero and back to zero.
  /// Infinite where there is none, or where more than one distribution is possible.
  struct DensityBound {
    double most, variation;
  };
  DensityBound densityBound() const;

  const Interval& support() const { return support_; }
  /// The probability that truncation to the support cut off; 0 of what is bounded by itself.
  double cutOff() const;
  /// "uniform", "triangular", "normal", "beta", "lognormal", "weibull", "gamma", "exponential", "histogram",
  /// "empirical" or "evidence".
  std::string_view name() const;
  /// "lower" and "upper", the support; then "mode", "mean" and "deviation", "a" and "b", "log_mean" and
  /// "log_deviation", "shape" and "scale", or "mean"; and "cut_off" of what is truncated. Of a histogram "value 1",
  /// "weight 1", "value 2", ...; of measurements how many there are, "count", and those between the ends, "value 2",
  /// ... Of a parameter that is an interval both ends, such as "mean" and "mean, at most". Of evidence "lower 1",
  /// "upper 1", "mass 1", "lower 2", ...
  std::vector<ShapeNumber> numbers() const;

 private:
  enum class Shape {
    uniform,
    triangular,
    normal,
    beta,
    lognormal,
    weibull,
    gamma,
    exponential,
    histogram,
    empirical,
    evidence
  };
  Distribution(Shape shape, const Interval& support, const Interval& first, const Interval& second);
  bool isTruncated() const;
  bool hasPieces() const { return shape_ >= Shape::histogram; }
  Interval belowOf(double value) const;
  std::size_t pieceAt(double value) const;
  bool hasSingleValues() const;
  // Of what is truncated, before it is: the probability below a value and above it, and the values of these.
  double below(double value) const;
  double above(double value) const;
  double whereBelow(double probability) const;
  double whereAbove(double probability) const;
  /// With these parameters: before truncation, and that of what truncation leaves below the support and in it.
  struct Member {
    Interval first, second, cut{0.0}, all{1.0};
    Interval logFactor{0.0};  // of Γ or B
  };
  Interval boundBelow(const Interval& value, const Member& member) const;
  Interval boundOf(const Interval& value, const Member& member) const;
  Interval densest(const Member& member) const;
  std::vector<Member> members(bool low) const;
  Interval believedBelow(const Interval& value) const;

  Shape shape_ = Shape::uniform;
  Interval support_;
  Interval firstRange_{0.0};              // mode, mean, a or shape; of the logarithm if that is normal
  Interval secondRange_{0.0};             // deviation, b or scale, likewise
  double first_ = 0, second_ = 0;         // their middles
  std::vector<Member> least_, greatest_;  // whose distribution functions are above all others', and below them
  /// Of a histogram and of measurements: its end and weight, and the probability not above the end.
  struct Piece {
    double end, weight;
    Interval below;
  };
  std::vector<Piece> pieces_;  // behind the support's lower end
  std::vector<FocalInterval> focal_;
};

/// An uncertain quantity.
struct Uncertain {
  std::string name;
  Interval range;
  double nominal = 0;
  Distribution distribution;
  Membership membership;

  double blur = 0;  ///< how wide the nominal value itself is known, as of a formula
  /// Values that certainly are what is meant, where the ends of `range` were rounded outward from decimals and the
  /// nominal value: away from these by 32 roundings of the greatest number in it and four times `blur`. Empty of a
  /// range no wider.
  Interval inside() const;

  /// Throws std::invalid_argument, naming the quantity, unless the nominal value and both supports lie in the range.
  void check() const;
};

}  // namespace gamut
