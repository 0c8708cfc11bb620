// Interval: a closed set of reals [lower, upper], possibly empty or unbounded, whose operations enclose the exact
// results: for x in X and y in Y, x op y lies in X op Y. Case logic and storage are Boost.Interval's; the rounding is
// ours (rounding.hpp), so enclosures are the tightest for + - * / sqrt and need no rounding mode.
// Semantics of empty, unbounded and partly undefined operations: IEEE 1788-2015, set-based flavour.
//
//   Interval mass("0.1");                  // contains one tenth; Interval(0.1) is the double nearest to it
//   Interval period = twoPi() * sqrt(Interval(0.5, 0.6) / 9.81);
//
// There is no operator< and no operator==: whether one interval is less than another has three answers. Use
// certainlyLess, isSubset, isEqual, ... ; algorithms that branch on values (pivoting) therefore do not compile.
#pragma once

#include <boost/numeric/interval/arith.hpp>
#include <boost/numeric/interval/checking.hpp>
#include <boost/numeric/interval/interval.hpp>
#include <boost/numeric/interval/policies.hpp>
#include <boost/numeric/interval/utility.hpp>
#include <cmath>
#include <concepts>
#include <iosfwd>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "scalars/rounding.hpp"

namespace gamut {

namespace detail {

/// Boost.Interval's rounding concept in round-to-nearest: there is no state to save, hence nothing to unprotect.
struct ErrorFreeRounding {
  using unprotected_rounding = ErrorFreeRounding;
  static double conv_down(double x) { return x; }
  static double conv_up(double x) { return x; }
  static double add_down(double x, double y) { return addDown(x, y); }
  static double add_up(double x, double y) { return addUp(x, y); }
  static double sub_down(double x, double y) { return subDown(x, y); }
  static double sub_up(double x, double y) { return subUp(x, y); }
  static double mul_down(double x, double y) { return mulDown(x, y); }
  static double mul_up(double x, double y) { return mulUp(x, y); }
  static double div_down(double x, double y) { return divDown(x, y); }
  static double div_up(double x, double y) { return divUp(x, y); }
  static double sqrt_down(double x) { return sqrtDown(x); }
  static double sqrt_up(double x) { return sqrtUp(x); }
  static double int_down(double x) { return std::floor(x); }
  static double int_up(double x) { return std::ceil(x); }
  static double median(double x, double y) { return 0.5 * x + 0.5 * y; }
};

/// checking_base allows the empty interval and marks it by NaN endpoints.
using IntervalPolicies =
    boost::numeric::interval_lib::policies<ErrorFreeRounding, boost::numeric::interval_lib::checking_base<double>>;

[[noreturn]] void throwInvalidInterval(double lower, double upper);

}  // namespace detail

class Interval {
 public:
  using Storage = boost::numeric::interval<double, detail::IntervalPolicies>;

  /// [0, 0].
  Interval() = default;

  /// The thin interval [value, value]. Throws std::invalid_argument unless value is finite.
  Interval(double value) : Interval(value, value) {}  // NOLINT: implicit on purpose, so that 2 * x is an interval

  /// [lower, upper]; lower may be -inf and upper +inf.
  /// Throws std::invalid_argument, naming both, for NaN, lower > upper, lower = +inf or upper = -inf.
  Interval(double lower, double upper) : storage_(lower, upper, true) {
    constexpr double largest = std::numeric_limits<double>::max();
    if (!(lower <= upper && lower <= largest && upper >= -largest)) detail::throwInvalidInterval(lower, upper);
  }

  /// Decimal text read outward, see parse().
  /// (A constrained template, so that Interval(0) is no null pointer to text.)
  template <std::convertible_to<std::string_view> Text>
  explicit Interval(const Text& text) : Interval(parse(text)) {}

  /// The tightest interval around decimal text: "0.1", "-1.5e3", "[0.1, 0.2]", "[-inf, 3]", "[empty]", "[entire]".
  /// A decimal that is a double gives a thin interval. Throws std::invalid_argument, naming malformed text.
  static Interval parse(std::string_view text);

  static Interval empty() { return wrap(Storage::empty()); }
  static Interval entire() { return wrap(Storage::whole()); }

  /// Endpoints; NaN when empty.
  double lower() const { return storage_.lower(); }
  double upper() const { return storage_.upper(); }

  Interval& operator+=(const Interval& other) { return *this = *this + other; }
  Interval& operator-=(const Interval& other) { return *this = *this - other; }
  Interval& operator*=(const Interval& other) { return *this = *this * other; }
  Interval& operator/=(const Interval& other) { return *this = *this / other; }

  friend Interval operator+(const Interval& x) { return x; }
  friend Interval operator-(const Interval& x) { return wrap(-x.storage_); }
  friend Interval operator+(const Interval& x, const Interval& y) { return wrap(x.storage_ + y.storage_); }
  friend Interval operator-(const Interval& x, const Interval& y) { return wrap(x.storage_ - y.storage_); }
  friend Interval operator*(const Interval& x, const Interval& y) { return wrap(x.storage_ * y.storage_); }

  /// Division is by the nonzero elements of y: the whole line when zero lies inside y, a half-line when zero is an
  /// endpoint of y and x does not change sign, [0, 0] when x = [0, 0], empty when y = [0, 0].
  /// (Boost takes x <= 0 that reaches zero for one of both signs; its negative is taken tightly.)
  friend Interval operator/(const Interval& x, const Interval& y) {
    return wrap(x.upper() == 0 ? -(-x.storage_ / y.storage_) : x.storage_ / y.storage_);
  }

  // Comparisons of intervals have no yes-or-no answer: use isEqual, isSubset, certainlyLess, isDisjoint, ...
  friend bool operator==(const Interval&, const Interval&) = delete;
  friend bool operator!=(const Interval&, const Interval&) = delete;
  friend bool operator<(const Interval&, const Interval&) = delete;
  friend bool operator>(const Interval&, const Interval&) = delete;
  friend bool operator<=(const Interval&, const Interval&) = delete;
  friend bool operator>=(const Interval&, const Interval&) = delete;

 private:
  static Interval wrap(const Storage& storage) {
    Interval x;
    x.storage_ = storage;
    return x;
  }

  Storage storage_;
};

/// A product of intervals, one a coordinate.
using Box = std::vector<Interval>;

// ---- Predicates -----------------------------------------------------------------------------------------------------

// An empty interval is a subset of every set and disjoint from every set.

inline bool isEmpty(const Interval& x) { return !(x.lower() <= x.upper()); }
inline bool isThin(const Interval& x) { return x.lower() == x.upper(); }
inline bool isEntire(const Interval& x) { return std::isinf(x.lower()) && std::isinf(x.upper()); }
/// True for the empty interval too.
inline bool isBounded(const Interval& x) { return !std::isinf(x.lower()) && !std::isinf(x.upper()); }
inline bool isEqual(const Interval& x, const Interval& y) {
  return (x.lower() == y.lower() && x.upper() == y.upper()) || (isEmpty(x) && isEmpty(y));
}
/// x is a subset of y.
inline bool isSubset(const Interval& x, const Interval& y) {
  return isEmpty(x) || (y.lower() <= x.lower() && x.upper() <= y.upper());
}
/// x lies in the topological interior of y.
bool isInterior(const Interval& x, const Interval& y);
inline bool isDisjoint(const Interval& x, const Interval& y) {
  return !(x.lower() <= y.upper() && y.lower() <= x.upper());
}
/// False for infinite and NaN values.
inline bool contains(const Interval& x, double value) {
  return x.lower() <= value && value <= x.upper() && std::isfinite(value);
}

// What 'certainly' claims holds for every element, and is never claimed of an empty interval.
inline bool certainlyLess(const Interval& x, const Interval& y) { return x.upper() < y.lower(); }
inline bool certainlyLessOrEqual(const Interval& x, const Interval& y) {
  return x.upper() <= y.lower() && !isEmpty(x) && !isEmpty(y);
}
inline bool certainlyGreater(const Interval& x, const Interval& y) { return certainlyLess(y, x); }
inline bool certainlyGreaterOrEqual(const Interval& x, const Interval& y) { return certainlyLessOrEqual(y, x); }
inline bool certainlyPositive(const Interval& x) { return x.lower() > 0; }
inline bool certainlyNegative(const Interval& x) { return x.upper() < 0; }
inline bool certainlyNonnegative(const Interval& x) { return x.lower() >= 0; }
inline bool certainlyNonpositive(const Interval& x) { return x.upper() <= 0; }
inline bool certainlyNonzero(const Interval& x) { return certainlyPositive(x) || certainlyNegative(x); }

// ---- Measures (NaN for the empty interval) --------------------------------------------------------------------------

/// upper - lower, rounded up.
inline double width(const Interval& x) { return isEmpty(x) ? x.lower() : subUp(x.upper(), x.lower()); }
/// A finite element near the middle; 0 for the whole line, the largest finite element of a half-line.
double midpoint(const Interval& x);
/// The least double r with x inside [midpoint(x) - r, midpoint(x) + r].
double radius(const Interval& x);
/// The greatest |value| in x.
inline double magnitude(const Interval& x) {
  const double lower = std::abs(x.lower()), upper = std::abs(x.upper());
  return lower < upper ? upper : lower;
}
/// The least |value| in x.
inline double mignitude(const Interval& x) {
  if (x.lower() <= 0 && x.upper() >= 0) return 0;
  const double lower = std::abs(x.lower()), upper = std::abs(x.upper());
  return lower < upper ? lower : upper;
}

// ---- Sets -----------------------------------------------------------------------------------------------------------

/// The least interval that holds both.
Interval hull(const Interval& x, const Interval& y);
Interval intersection(const Interval& x, const Interval& y);

// ---- Functions ------------------------------------------------------------------------------------------------------

// The range over the part of x in the domain; empty when x misses the domain. All are the tightest enclosures:
// endpoints are exact values rounded outward.

/// x^2: non-negative, unlike x * x for an interval around zero.
Interval sqr(const Interval& x);
Interval sqrt(const Interval& x);
Interval abs(const Interval& x);
/// Elementwise minimum / maximum: { min(a, b) : a in x, b in y }.
Interval min(const Interval& x, const Interval& y);
Interval max(const Interval& x, const Interval& y);
Interval exp(const Interval& x);
Interval log(const Interval& x);
Interval sin(const Interval& x);
Interval cos(const Interval& x);
/// The whole line when x holds a pole.
Interval tan(const Interval& x);
Interval asin(const Interval& x);
Interval acos(const Interval& x);
Interval atan(const Interval& x);
Interval sinh(const Interval& x);
Interval cosh(const Interval& x);
Interval tanh(const Interval& x);
/// x^n, with x^0 = 1 for every x; for n < 0 as division treats zero.
Interval pow(const Interval& x, int n);
/// x^y on the domain x > 0, or x = 0 with y > 0.
Interval pow(const Interval& x, const Interval& y);
inline Interval pow(const Interval& x, double y) { return pow(x, Interval(y)); }

/// Both at once, for little more than the price of one.
struct SinCos {
  Interval sin, cos;
};
SinCos sinCos(const Interval& x);

// ---- Constants: the tightest enclosures -----------------------------------------------------------------------------

/// pi = 3.14159265358979323846..., 0x1.921fb54442d18p+1 = 3.14159265358979311...
inline Interval pi() { return {0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1}; }
inline Interval halfPi() { return {0x1.921fb54442d18p+0, 0x1.921fb54442d19p+0}; }
inline Interval twoPi() { return {0x1.921fb54442d18p+2, 0x1.921fb54442d19p+2}; }

// ---- Text -----------------------------------------------------------------------------------------------------------

/// "[lower, upper]" in decimals rounded outward to so many significant digits (at least 1), so that the printed
/// interval holds x; "[empty]" and "[entire]" for those two.
std::string toString(const Interval& x, int digits = 17);
/// The same with so many digits after the point (at least 0): "[0.25, 0.34]".
std::string toFixedString(const Interval& x, int decimals);
std::ostream& operator<<(std::ostream& stream, const Interval& x);

/// The shortest decimal that is read back as this double: "0.1", "1e-09", "inf".
std::string toString(double x);

}  // namespace gamut
