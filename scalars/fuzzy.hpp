// Fuzzy: a fuzzy number as a stack of nested alpha-cuts. Level 0 is the support (what is possible at all), the last
// level the core (membership 1), and cut j of the result of an operation is that operation on the operands' cuts j
// (Zadeh's extension principle; Nguyen 1978), enclosed by interval arithmetic.
//
//   Fuzzy angle = Fuzzy::triangular(2.2, 2.3, 2.5, 11);            // eleven cuts, each rounded outward
//   Fuzzy height = 0.4 * sin(angle);                               // each cut holds the exact cut of the sine
//   Interval risk = possibility(height, Interval("[0.32, inf]"));  // that it is 0.32 or more: at most risk.upper()
//   Interval trust = necessity(height, Interval("[0.2, 0.4]"));    // at least trust.lower()
#pragma once

#include <concepts>
#include <iosfwd>
#include <span>
#include <utility>
#include <vector>

#include "scalars/membership.hpp"
#include "scalars/traits.hpp"

namespace gamut {

class Fuzzy {
 public:
  /// The crisp 0.
  Fuzzy() : Fuzzy(Interval()) {}

  /// Crisp: every alpha-cut is that value or interval; combines with any number of levels.
  Fuzzy(double value) : Fuzzy(Interval(value)) {}  // NOLINT(google-explicit-*): implicit on purpose
  Fuzzy(const Interval& cut) : cuts_(1, cut) {}    // NOLINT(google-explicit-*): implicit on purpose

  /// Alpha-cuts from support to core. Throws std::invalid_argument for none, or where one leaves the cut before it.
  explicit Fuzzy(std::vector<Interval> cuts);

  /// The cuts of a membership function at alpha(0) … alpha(levels - 1). Throws std::invalid_argument for levels < 2.
  Fuzzy(const Membership& membership, std::size_t levels);

  // The shapes of Membership at so many levels; they throw as it does.
  static Fuzzy triangular(double lower, double apex, double upper, std::size_t levels) {
    return {Membership::triangular(lower, apex, upper), levels};
  }
  static Fuzzy trapezoidal(double lower, double left, double right, double upper, std::size_t levels) {
    return {Membership::trapezoidal(lower, left, right, upper), levels};
  }
  static Fuzzy gaussian(const Interval& support, double centre, double deviation, std::size_t levels) {
    return {Membership::gaussian(support, centre, deviation), levels};
  }
  static Fuzzy table(std::vector<Membership::Point> points, std::size_t levels) {
    return {Membership::table(std::move(points)), levels};
  }

  /// The number of alpha-cuts; 1 for a crisp quantity.
  std::size_t levels() const { return cuts_.size(); }
  /// The alpha-cut at a level, std::out_of_range from levels() on; a crisp quantity has the same at every level.
  const Interval& cut(std::size_t level) const {
    if (level >= cuts_.size() && cuts_.size() > 1) throwNoSuchLevel(level);
    return cuts_.size() == 1 ? cuts_.front() : cuts_[level];
  }
  /// The membership of a level: the double nearest to level / (levels() - 1); 1 for a crisp quantity.
  double alpha(std::size_t level) const;
  const Interval& support() const { return cuts_.front(); }
  const Interval& core() const { return cuts_.back(); }
  std::span<const Interval> cuts() const { return cuts_; }

  // Numbers of different levels do not combine: std::invalid_argument, unless one is crisp.
  Fuzzy& operator+=(const Fuzzy& other) { return *this = *this + other; }
  Fuzzy& operator-=(const Fuzzy& other) { return *this = *this - other; }
  Fuzzy& operator*=(const Fuzzy& other) { return *this = *this * other; }
  Fuzzy& operator/=(const Fuzzy& other) { return *this = *this / other; }

  friend Fuzzy operator+(const Fuzzy& x, const Fuzzy& y);
  friend Fuzzy operator-(const Fuzzy& x, const Fuzzy& y);
  friend Fuzzy operator*(const Fuzzy& x, const Fuzzy& y);
  friend Fuzzy operator/(const Fuzzy& x, const Fuzzy& y);
  friend Fuzzy operator+(const Fuzzy& x) { return x; }
  friend Fuzzy operator-(const Fuzzy& x);

 private:
  [[noreturn]] void throwNoSuchLevel(std::size_t level) const;

  std::vector<Interval> cuts_;  // nested, from support to core; one for a crisp quantity
};

// The functions of Interval, cut by cut: cut j holds f of all elements of the operand's cut j. So a value outside of it
// has a membership below alpha(j); or, where f jumps (the step functions; atan2 on the negative x-axis), alpha(j)
// itself at most, which the operand's memberships can then approach without attaining it.
Fuzzy sqr(const Fuzzy& x);
Fuzzy sqrt(const Fuzzy& x);
Fuzzy cbrt(const Fuzzy& x);
Fuzzy abs(const Fuzzy& x);
Fuzzy sign(const Fuzzy& x);
Fuzzy floor(const Fuzzy& x);
Fuzzy ceil(const Fuzzy& x);
Fuzzy trunc(const Fuzzy& x);
Fuzzy round(const Fuzzy& x);
Fuzzy roundEven(const Fuzzy& x);
Fuzzy exp(const Fuzzy& x);
Fuzzy exp2(const Fuzzy& x);
Fuzzy exp10(const Fuzzy& x);
Fuzzy expm1(const Fuzzy& x);
Fuzzy log(const Fuzzy& x);
Fuzzy log2(const Fuzzy& x);
Fuzzy log10(const Fuzzy& x);
Fuzzy log1p(const Fuzzy& x);
Fuzzy sin(const Fuzzy& x);
Fuzzy cos(const Fuzzy& x);
Fuzzy tan(const Fuzzy& x);
Fuzzy asin(const Fuzzy& x);
Fuzzy acos(const Fuzzy& x);
Fuzzy atan(const Fuzzy& x);
Fuzzy sinh(const Fuzzy& x);
Fuzzy cosh(const Fuzzy& x);
Fuzzy tanh(const Fuzzy& x);
Fuzzy asinh(const Fuzzy& x);
Fuzzy acosh(const Fuzzy& x);
Fuzzy atanh(const Fuzzy& x);
Fuzzy rootn(const Fuzzy& x, int n);
Fuzzy atan2(const Fuzzy& y, const Fuzzy& x);
Fuzzy hypot(const Fuzzy& x, const Fuzzy& y);
Fuzzy min(const Fuzzy& x, const Fuzzy& y);
Fuzzy max(const Fuzzy& x, const Fuzzy& y);
Fuzzy pow(const Fuzzy& x, long n);
template <std::integral N>
Fuzzy pow(const Fuzzy& x, N n) {
  if (!std::in_range<long>(n)) detail::throwExponentOutOfRange();
  return pow(x, static_cast<long>(n));
}
Fuzzy pow(const Fuzzy& x, double y);
Fuzzy pow(const Fuzzy& x, const Fuzzy& y);

// ---- What a fuzzy number says ---------------------------------------------------------------------------------------

// The cuts of a result are enclosures: they prove that a value is not possible to some degree, never that it is. What
// follows is proved for every fuzzy number that reaches membership 1 in the core of x and has a membership of at most
// alpha outside the cut of each alpha. An event is an interval of values: Interval("[0.3, inf]") is "at least 0.3".
// Source: Dubois & Prade 1988, Possibility Theory, chapter 1.

/// Encloses the possibility of an event, the greatest membership of its values. The upper bound is the least alpha
/// whose cut misses the event (0 if the support does), and 1 if none does. The lower bound is 1 where the event holds
/// the whole core, since some value there has membership 1, and 0 otherwise: outer cuts know no better.
Interval possibility(const Fuzzy& x, const Interval& event);

/// Encloses the necessity of an event: 1 - the possibility of its complement. The lower bound is 1 - the least alpha
/// whose cut lies in the event, and 0 if none does; the upper bound is 0 where the event misses the core, and 1
/// otherwise.
Interval necessity(const Fuzzy& x, const Interval& event);

/// Defuzzification: encloses the centroid ∫ v m(v) dv / ∫ m(v) dv of the membership function m that has these very cuts
/// at equally spaced levels and is straight between them: the whole shape of a triangle or a trapezoid. A summary of
/// the stack, no bound for the number that it encloses, of whose centroid no more is proved than that it lies in the
/// support. Empty where the support is empty or unbounded; cuts that are empty are left out.
Interval centroid(const Fuzzy& x);

/// "{support, ..., core}".
std::ostream& operator<<(std::ostream& stream, const Fuzzy& x);

template <>
struct ScalarTraits<Fuzzy> {
  static Fuzzy constant(const Interval& enclosure) { return enclosure; }
};

static_assert(Scalar<Fuzzy>);

}  // namespace gamut
