// The parts of Interval that need no elementary function: construction errors, measures, sets, algebraic functions.
#include "scalars/interval.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace gamut {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();

/// -0, of which some rounding modes make more than others, becomes 0.
double withPositiveZero(double x) { return x == 0 ? 0.0 : x; }

/// A function that never decreases and whose values are doubles, exactly: the range is between those at the endpoints.
Interval step(double (*f)(double), const Interval& x) {
  if (isEmpty(x)) return x;
  return {withPositiveZero(f(x.lower())), withPositiveZero(f(x.upper()))};
}

double signOf(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// As std::round, which compilers replace by a sum that is right in one rounding mode only. What trunc cuts off is
/// exact, and so is the next integer, for a double with a fraction has |x| < 2^52.
double roundedAwayFromZero(double x) {
  const double whole = std::trunc(x);
  return std::abs(x - whole) >= 0.5 ? whole + std::copysign(1.0, x) : whole;
}

/// Where x lies half-way, x - trunc(x) = +-1/2 exactly, and twice the integer nearest to x / 2 is the even neighbour:
/// x / 2 is then a quarter or three quarters away from the next integers.
double roundedToEven(double x) {
  return std::abs(x - std::trunc(x)) == 0.5 ? 2 * roundedAwayFromZero(0.5 * x) : roundedAwayFromZero(x);
}

/// The double nearest to (a + b) / 2, ties to even, in every rounding mode.
double middleOf(double a, double b) {
  // Halves of large numbers are exact; what a small one may lose lies far below the large one's last bit.
  if (std::max(std::abs(a), std::abs(b)) >= 0x1p1000) return addNearest(0.5 * a, 0.5 * b);
  const double sum = addNearest(a, b), half = 0.5 * sum;
  const bool isOdd = (std::bit_cast<std::uint64_t>(half) & 1) != 0;
  return withPositiveZero(2 * half != sum && isOdd ? sum - half : half);  // a tie of two subnormals: their even one
}

}  // namespace

void detail::throwInvalidInterval(double lower, double upper) {
  char text[128];
  std::snprintf(text, sizeof text, "not an interval: [%.17g, %.17g] (needs lower <= upper and a real number between)",
                lower, upper);
  throw std::invalid_argument(text);
}

void detail::throwExponentOutOfRange() {
  throw std::out_of_range("the exponent of an integer power has more than 63 bits");
}

void detail::throwNoText() { throw std::invalid_argument("not an interval: a null pointer to text"); }

bool isInterior(const Interval& x, const Interval& y) {
  if (isEmpty(x)) return true;
  return (y.lower() < x.lower() || y.lower() == -infinity) && (x.upper() < y.upper() || y.upper() == infinity);
}

double midpoint(const Interval& x) {
  const double lower = x.lower(), upper = x.upper();
  if (isEmpty(x)) return lower;
  if (lower == -infinity) return upper == infinity ? 0 : std::min(upper, -largest);
  if (upper == infinity) return std::max(lower, largest);
  const double middle = middleOf(lower, upper);
  return std::clamp(middle, lower, upper);  // rounding, of subnormals above all, may not leave x
}

double radius(const Interval& x) {
  const double middle = midpoint(x);
  if (std::isnan(middle)) return middle;
  return std::max(subUp(middle, x.lower()), subUp(x.upper(), middle));
}

Interval hull(const Interval& x, const Interval& y) {
  if (isEmpty(x)) return y;
  if (isEmpty(y)) return x;
  return {std::min(x.lower(), y.lower()), std::max(x.upper(), y.upper())};
}

Interval intersection(const Interval& x, const Interval& y) {
  if (isEmpty(x) || isEmpty(y) || isDisjoint(x, y)) return Interval::empty();
  return {std::max(x.lower(), y.lower()), std::min(x.upper(), y.upper())};
}

Halves bisect(const Interval& x) {
  if (isEmpty(x)) return {x, x};
  const double cut = midpoint(x);
  return {{x.lower(), cut}, {cut, x.upper()}};
}

Interval sqr(const Interval& x) {
  if (isEmpty(x)) return x;
  const detail::Pair squares = detail::square(detail::Pair{x.lower(), x.upper()});
  return {squares[0], squares[1]};
}

Interval sqrt(const Interval& x) {
  if (!(x.upper() >= 0)) return Interval::empty();
  const detail::Pair roots = detail::squareRoot(detail::Pair{std::max(x.lower(), 0.0), x.upper()});
  return {roots[0], roots[1]};
}

Interval abs(const Interval& x) {
  if (isEmpty(x)) return x;
  return {mignitude(x), magnitude(x)};
}

Interval min(const Interval& x, const Interval& y) {
  if (isEmpty(x) || isEmpty(y)) return Interval::empty();
  return {std::min(x.lower(), y.lower()), std::min(x.upper(), y.upper())};
}

Interval max(const Interval& x, const Interval& y) {
  if (isEmpty(x) || isEmpty(y)) return Interval::empty();
  return {std::max(x.lower(), y.lower()), std::max(x.upper(), y.upper())};
}

Interval sign(const Interval& x) { return step(signOf, x); }
Interval floor(const Interval& x) { return step(std::floor, x); }
Interval ceil(const Interval& x) { return step(std::ceil, x); }
Interval trunc(const Interval& x) { return step(std::trunc, x); }
Interval round(const Interval& x) { return step(roundedAwayFromZero, x); }
Interval roundEven(const Interval& x) { return step(roundedToEven, x); }

}  // namespace gamut
