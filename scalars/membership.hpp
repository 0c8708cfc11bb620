// Membership: how possible each value of a quantity is, from 0 outside the support to 1 on the core (Zadeh 1978). Each
// shape has a file in memberships/: its words, its checks and its cuts. Alpha-cuts are proved enclosures, and nested;
// Fuzzy is a stack of them.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "scalars/shape_fields.hpp"

namespace gamut {

/// A shape: described, and then settled. What it says of values holds of those in its support.
class MembershipLaw {
 public:
  virtual ~MembershipLaw() = default;

  /// Its word in files.
  virtual std::string_view name() const = 0;
  /// Half a sentence.
  virtual std::string_view summary() const = 0;
  virtual void describe(ShapeFields& fields) = 0;
  /// Once all is filled in. Throws std::invalid_argument, naming the number, for what is no membership function.
  virtual void settle() = 0;
  virtual std::unique_ptr<MembershipLaw> copy() const = 0;

  virtual Interval support() const = 0;
  virtual Interval core() const = 0;
  /// Of 0 < alpha < 1; see Membership::cut.
  virtual Interval cut(double alpha) const = 0;
  /// Of a value outside the core, rounded downward.
  virtual double degree(double value, bool isBelowCore) const = 0;
};

/// Makes one that is not filled in.
using MembershipType = std::unique_ptr<MembershipLaw> (*)();
/// Those of memberships/, in the order of messages and of the guide.
std::vector<MembershipType> membershipTypes();

class Membership {
 public:
  /// One corner of a table: `degree` (0 … 1) at `value`.
  using Point = ShapeFields::Point;

  /// Refuses a table: what() names its first wrong point, counted from 1, and its problem, as a sentence on it goes on:
  /// "falls although the table has not reached 1".
  struct BadPoint : ShapeRefusal {
    BadPoint(const std::vector<Point>& points, std::size_t at, const std::string& wrong);
  };

  /// 1 at 0 only.
  Membership();
  /// Settles it, and throws as that does.
  explicit Membership(std::unique_ptr<MembershipLaw> law);

  // What programs state without a file; each throws std::invalid_argument, naming the number, for values out of order
  // or not finite.

  /// Rises linearly from 0 at `lower` to 1 at `apex` and falls to 0 at `upper`.
  static Membership triangular(double lower, double apex, double upper);
  /// 1 from `left` to `right`.
  static Membership trapezoidal(double lower, double left, double right, double upper);
  static Membership gaussian(const Interval& support, double centre, double deviation);
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
  /// Its word in files: "triangular", …
  std::string_view name() const { return law_->name(); }
  std::vector<ShapeNumber> numbers() const;

 private:
  std::shared_ptr<const MembershipLaw> law_;
  Interval support_, core_;
};

}  // namespace gamut
