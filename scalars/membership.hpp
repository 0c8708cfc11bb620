// Membership: how possible each value of a quantity is, from 0 outside the support to 1 on the core (Zadeh 1978). Four
// shapes: triangular, trapezoidal, a Gaussian cut off at its support, and a table of points. Alpha-cuts are proved
// enclosures, and nested; Fuzzy is a stack of them.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "scalars/interval.hpp"

namespace gamut {

/// One of the numbers that a membership function or a distribution is made of.
struct ShapeNumber {
  std::string name;  ///< "lower", "apex", …
  double value = 0;
  bool isOfQuantity = true;  ///< a value of the quantity, or a distance of two; otherwise without unit
};

class Membership {
 public:
  /// One corner of a table: `degree` (0 … 1) at `value`.
  struct Point {
    double value, degree;
  };

  /// Refuses a table: what() names its first wrong point, counted from 1, and its problem.
  struct BadPoint : std::invalid_argument {
    BadPoint(const std::vector<Point>& points, std::size_t index, std::string wrong);
    std::size_t index;    // of that point, from 0
    std::string problem;  // as a sentence on it goes on: "falls although the table has not reached 1"
  };

  /// 1 at 0 only.
  Membership() = default;

  // Each throws std::invalid_argument, naming the number, for values out of order or not finite.

  /// Rises linearly from 0 at `lower` to 1 at `apex` and falls to 0 at `upper`.
  static Membership triangular(double lower, double apex, double upper);
  /// 1 from `left` to `right`.
  static Membership trapezoidal(double lower, double left, double right, double upper);
  /// exp(-((v - centre) / deviation)² / 2) on the bounded support, which contains the centre; 0 outside. So at either
  /// end of the support the degree is still that of the Gaussian, and drops to 0 beyond.
  static Membership gaussian(const Interval& support, double centre, double deviation);
  /// Straight lines between the points, whose values must not fall and whose degrees rise to 1, stay there for one
  /// point or more, and then fall: a fuzzy number has one peak or plateau; BadPoint otherwise. Outside the points the
  /// degree is 0; where several have the same value, the greatest degree of them. The support begins where the degree
  /// first rises from 0 and ends where it has fallen to it.
  static Membership table(std::vector<Point> points);

  /// Contains every value with membership at least `alpha` (0 … 1); for alpha = 0 the support, for alpha = 1 the core,
  /// both exact. Rounded outward but never beyond the support; nested: a greater alpha gives a subset.
  Interval cut(double alpha) const;
  /// Rounded downward, so that a value with (*this)(value) >= alpha > 0 lies in cut(alpha).
  double operator()(double value) const;

  /// The values that are possible at all; outside it the degree is 0.
  const Interval& support() const { return support_; }
  /// The values of membership 1.
  const Interval& core() const { return core_; }
  /// "triangular", "trapezoidal", "gaussian" or "table".
  std::string_view name() const;
  /// "lower" and "upper", the support; then "apex"; "left" and "right"; "centre" and "deviation"; or of a table's
  /// points "value 1", "membership 1", "value 2", …
  std::vector<ShapeNumber> numbers() const;

 private:
  enum class Shape { triangular, trapezoidal, gaussian, table };
  Membership(Shape shape, std::vector<Point> points);
  Membership(const Interval& support, double centre, double deviation);

  Shape shape_ = Shape::triangular;
  std::vector<Point> points_ = {{0, 1}};  // of every shape but the Gaussian
  double deviation_ = 0;                  // of the Gaussian
  Interval support_, core_;
};

}  // namespace gamut
