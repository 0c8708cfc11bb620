// Interval: a closed set of reals [lower, upper], possibly empty or unbounded, whose operations enclose the exact
// results: for x in X and y in Y, x op y lies in X op Y. Storage, policies and the rare cases are Boost.Interval's; the
// arithmetic (interval_arithmetic.hpp) and its rounding (elementary/rounding.hpp) are ours: the tightest enclosures,
// the same in whatever rounding mode the caller left, and about ten times faster than switching it. Semantics of empty,
// unbounded and partly undefined operations: IEEE 1788-2015, set-based flavour.
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
#include <compare>
#include <concepts>
#include <cstddef>
#include <iosfwd>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scalars/interval_arithmetic.hpp"

namespace gamut {

namespace detail {

/// What Boost.Interval's products and quotients need of its rounding concept, without a rounding mode: there is no
/// state to save, hence nothing to unprotect.
struct ErrorFreeRounding {
  using unprotected_rounding = ErrorFreeRounding;
  static double mul_down(double x, double y) { return mulDown(x, y); }
  static double mul_up(double x, double y) { return mulUp(x, y); }
  static double div_down(double x, double y) { return divDown(x, y); }
  static double div_up(double x, double y) { return divUp(x, y); }
};

/// checking_base allows the empty interval and marks it by NaN endpoints.
using IntervalPolicies =
    boost::numeric::interval_lib::policies<ErrorFreeRounding, boost::numeric::interval_lib::checking_base<double>>;

[[noreturn]] void throwInvalidInterval(double lower, double upper);
[[noreturn]] void throwExponentOutOfRange();
[[noreturn]] void throwNoText();

inline std::string_view textOf(std::string_view text) { return text; }
inline std::string_view textOf(const char* text) {
  if (text == nullptr) throwNoText();
  return text;
}

}  // namespace detail

/// What the compiler shows, as the type of a deleted operator, to whoever compares intervals with == or <: such a
/// question has no yes-or-no answer, the predicates named here and below have.
class NoYesOrNo_use_isEqual_isSubset_isDisjoint_certainlyLess;

class Interval {
 public:
  using Storage = boost::numeric::interval<double, detail::IntervalPolicies>;

  /// [0, 0].
  Interval() = default;

  /// The thin interval [value, value]. Throws std::invalid_argument unless value is finite.
  Interval(double value) : Interval(value, value) {}  // NOLINT(google-explicit-*): so that 2 * x is an interval

  /// A whole number of 64 bits, enclosed where it lies between two doubles.
  template <std::integral N>
  requires(std::numeric_limits<N>::digits > 53) Interval(N n)  // NOLINT(google-explicit-*): as other numbers are
      : Interval(Interval(static_cast<double>(n >> 32) * 0x1p32) + Interval(static_cast<double>(n & 0xffffffff))) {}

  /// [lower, upper]; lower may be -inf and upper +inf.
  /// Throws std::invalid_argument, naming both, for NaN, lower > upper, lower = +inf or upper = -inf.
  Interval(double lower, double upper) : storage_(lower, upper, true) {
    constexpr double largest = std::numeric_limits<double>::max();
    if (!(lower <= upper && lower <= largest && upper >= -largest)) detail::throwInvalidInterval(lower, upper);
  }

  /// Text read outward, see parse(): Interval("0.1"), Interval("[0.1, 0.2]"), Interval("0.1 +- 0.02").
  /// (A constrained template, so that Interval(0) is no null pointer to text.)
  template <std::convertible_to<std::string_view> Text>
  explicit Interval(const Text& text) : Interval(parse(detail::textOf(text))) {}
  template <std::same_as<std::nullptr_t> Null>
  Interval(Null) = delete;

  /// The tightest interval around what the text says; the forms are listed under "Text" below. A number that is a
  /// double gives a thin interval. Throws std::invalid_argument, naming malformed text and what is accepted.
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
  friend Interval operator-(const Interval& x) { return wrap(detail::negate(x.bounds())); }
  friend Interval operator+(const Interval& x, const Interval& y) { return wrap(detail::add(x.bounds(), y.bounds())); }
  friend Interval operator-(const Interval& x, const Interval& y) {
    return wrap(detail::subtract(x.bounds(), y.bounds()));
  }
  friend Interval operator*(const Interval& x, const Interval& y) {
    return wrap(detail::multiply(x.bounds(), y.bounds()));
  }

  /// Division is by the nonzero elements of y: the whole line when zero lies inside y, a half-line when zero is an
  /// endpoint of y and x does not change sign, [0, 0] when x = [0, 0], empty when y = [0, 0].
  friend Interval operator/(const Interval& x, const Interval& y) {
    return wrap(detail::divide(x.bounds(), y.bounds()));
  }

  // Comparisons of intervals have no yes-or-no answer. Of these two, ==, !=, <, <=, > and >= would be made.
  friend NoYesOrNo_use_isEqual_isSubset_isDisjoint_certainlyLess operator==(const Interval&, const Interval&) = delete;
  friend NoYesOrNo_use_isEqual_isSubset_isDisjoint_certainlyLess operator<=>(const Interval&, const Interval&) = delete;

 private:
  static Interval wrap(const Storage& storage) {
    Interval x;
    x.storage_ = storage;
    return x;
  }
  static Interval wrap(detail::Pair bounds) { return wrap(Storage(bounds[0], bounds[1], true)); }
  detail::Pair bounds() const { return detail::Pair{lower(), upper()}; }

  Storage storage_;
};

/// A product of intervals, one a coordinate.
using Box = std::vector<Interval>;

// ---- Predicates -----------------------------------------------------------------------------------------------------

// An empty interval is a subset of every set and disjoint from every set.

inline bool isEmpty(const Interval& x) { return !(x.lower() <= x.upper()); }
/// x holds one number only (a singleton).
inline bool isThin(const Interval& x) { return x.lower() == x.upper(); }
inline bool isEntire(const Interval& x) { return std::isinf(x.lower()) && std::isinf(x.upper()); }
/// Both endpoints are finite. True for the empty interval too, see isCommon().
inline bool isBounded(const Interval& x) { return !std::isinf(x.lower()) && !std::isinf(x.upper()); }
/// Bounded and not empty: what IEEE 1788 calls a common interval.
inline bool isCommon(const Interval& x) { return isBounded(x) && !isEmpty(x); }
/// The same set. -0 and 0 are one number.
inline bool isEqual(const Interval& x, const Interval& y) {
  return (x.lower() == y.lower() && x.upper() == y.upper()) || (isEmpty(x) && isEmpty(y));
}
/// x is a subset of y.
inline bool isSubset(const Interval& x, const Interval& y) {
  return isEmpty(x) || (y.lower() <= x.lower() && x.upper() <= y.upper());
}
/// x lies in the topological interior of y; the whole line is its own interior.
bool isInterior(const Interval& x, const Interval& y);
inline bool isDisjoint(const Interval& x, const Interval& y) {
  return !(x.lower() <= y.upper() && y.lower() <= x.upper());
}
/// value is a member of x. False for infinities and NaN, which no interval holds.
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

/// upper - lower, the least double that is not below it; +inf if unbounded.
inline double width(const Interval& x) { return isEmpty(x) ? x.lower() : subUp(x.upper(), x.lower()); }
/// The double nearest to the middle, an element of x; 0 for the whole line, for a half-line its finite element farthest
/// from the endpoint (so +-1.8e308, or the endpoint itself where nothing finite lies beyond).
double midpoint(const Interval& x);
/// The least double r with x inside [midpoint(x) - r, midpoint(x) + r]; +inf if unbounded.
double radius(const Interval& x);
/// The greatest |value| in x; +inf if unbounded.
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

/// The least interval that holds both; an empty one adds nothing.
Interval hull(const Interval& x, const Interval& y);
/// What both have in common; empty if that is nothing.
Interval intersection(const Interval& x, const Interval& y);

/// The two parts of an interval that is cut in two: their union is the interval, their only common element the cut.
struct Halves {
  Interval lower, upper;
};
/// x cut at midpoint(x). A thin x gives x twice, the empty interval two empty ones, the whole line [-inf, 0] and
/// [0, inf]; a half-line is cut at its largest finite element, so one part is bounded: cut that one further.
Halves bisect(const Interval& x);

// ---- Functions ------------------------------------------------------------------------------------------------------

// Each gives the tightest enclosure of the range over the part of x in the domain: no doubles lie closer to it. Outside
// of the domain there is nothing: the result is empty when x misses the domain, or is itself empty. Where a function
// tends to infinity at the end of its domain the result is unbounded.

/// x^2: non-negative, unlike x * x for an interval around zero.
Interval sqr(const Interval& x);
inline double sqr(double x) { return x * x; }
/// Domain x >= 0.
Interval sqrt(const Interval& x);
/// The cube root, of negative numbers too: cbrt(-8) = -2.
Interval cbrt(const Interval& x);
/// The n-th root: domain x >= 0 if n is even, all x if n is odd. Throws std::invalid_argument unless n >= 1.
Interval rootn(const Interval& x, int n);
/// sqrt(x^2 + y^2), without overflow on the way.
Interval hypot(const Interval& x, const Interval& y);

Interval abs(const Interval& x);
/// Elementwise minimum / maximum: { min(a, b) : a in x, b in y }.
Interval min(const Interval& x, const Interval& y);
Interval max(const Interval& x, const Interval& y);

// Step functions: the result holds every value between those that are taken.

/// -1 for negative elements, 0 for 0, 1 for positive ones: sign([-2, 3]) = [-1, 1].
Interval sign(const Interval& x);
/// The greatest integer not above / the least not below / the next one towards zero.
Interval floor(const Interval& x);
Interval ceil(const Interval& x);
Interval trunc(const Interval& x);
/// The nearest integer; half-way cases away from zero / to the even one.
Interval round(const Interval& x);
Interval roundEven(const Interval& x);

/// e^x, 2^x, 10^x, and e^x - 1 without cancellation near 0.
Interval exp(const Interval& x);
Interval exp2(const Interval& x);
Interval exp10(const Interval& x);
Interval expm1(const Interval& x);
/// Logarithms to base e, 2, 10: domain x > 0; log([0, 1]) = [-inf, 0].
Interval log(const Interval& x);
Interval log2(const Interval& x);
Interval log10(const Interval& x);
/// log(1 + x) without cancellation near 0: domain x > -1.
Interval log1p(const Interval& x);

/// Radians. Multiples of pi / 2 between the endpoints are counted rigorously, for huge arguments too.
Interval sin(const Interval& x);
Interval cos(const Interval& x);
/// The whole line when x holds a pole pi / 2 + k pi (between its endpoints: no double is a pole).
Interval tan(const Interval& x);
/// Domain [-1, 1].
Interval asin(const Interval& x);
Interval acos(const Interval& x);
Interval atan(const Interval& x);
/// The angle of the point (x, y), in (-pi, pi], as std::atan2: undefined at (0, 0) alone. Boxes that meet the negative
/// x-axis and reach below it hold angles near -pi and pi itself: the result is [-pi, pi].
Interval atan2(const Interval& y, const Interval& x);

Interval sinh(const Interval& x);
Interval cosh(const Interval& x);
Interval tanh(const Interval& x);
Interval asinh(const Interval& x);
/// Domain x >= 1.
Interval acosh(const Interval& x);
/// Domain -1 < x < 1.
Interval atanh(const Interval& x);

/// x^n for every x, with x^0 = 1 (0^0 too); for n < 0 zero is outside of the domain, as for division.
Interval pow(const Interval& x, long n);
template <std::integral N>
Interval pow(const Interval& x, N n) {
  if (!std::in_range<long>(n)) detail::throwExponentOutOfRange();
  return pow(x, static_cast<long>(n));
}
/// x^y on the domain x > 0, or x = 0 with y > 0: negative bases have no real powers, even where y is an integer.
Interval pow(const Interval& x, const Interval& y);
/// x^n where y is a whole number n, for negative bases too; elsewhere x^[y, y].
Interval pow(const Interval& x, double y);

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

// Interval::parse reads, blanks around it, the comma, the sign ± and inside brackets allowed, words in either case:
//
//   0.1  -1.5e3  1/3  0x1.8p3     the tightest interval around that number; hexadecimal needs its exponent p
//   [0.1, 0.2]  [0.1]             between two numbers, around one
//   [1, inf]  [-inf, 3]  [1,]  [,3]  [,]  [entire]      unbounded: a missing endpoint is an infinity
//   []  [empty]
//   0.1 ± 0.02   0.1 +- 0.02      midpoint and radius
//   1.5?  1.5?2  1.5?2e3          IEEE 1788: plus or minus half a unit, or two, of the last digit (then times 10^3);
//   1.5?u  1.5?2d  1.5??          upwards or downwards only; ?? is unbounded
//
// All are exact rational arithmetic, rounded outward once.

/// "[lower, upper]" in decimals rounded outward to so many significant digits (at least 1), so that the printed
/// interval holds x; "[empty]" and "[entire]" for those two. Read back, endpoints of 17 digits lie at most one double
/// further out.
std::string toString(const Interval& x, int digits = 17);
/// The same with so many digits after the point (at least 0): "[0.25, 0.34]".
std::string toFixedString(const Interval& x, int decimals);
/// Hexadecimal, "[0x1.8p+0, 0x1p+1]": exact, so Interval::parse gives x again.
std::string toExactString(const Interval& x);
/// One double, "-0x1.8p+0" or "inf": exact, but for the sign of zero.
std::string toExactString(double x);
std::ostream& operator<<(std::ostream& stream, const Interval& x);

/// The shortest decimal that is read back as this double: "0.1", "1e-09", "inf".
std::string toString(double x);

}  // namespace gamut
