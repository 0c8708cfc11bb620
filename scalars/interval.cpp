// The parts of Interval that need no elementary function: construction errors, measures, sets, algebraic functions.
#include "scalars/interval.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

namespace gamut {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();

}  // namespace

void detail::throwInvalidInterval(double lower, double upper) {
  char text[128];
  std::snprintf(text, sizeof text, "not an interval: [%.17g, %.17g] (needs lower <= upper and a real number between)",
                lower, upper);
  throw std::invalid_argument(text);
}

bool isInterior(const Interval& x, const Interval& y) {
  if (isEmpty(x)) return true;
  return (y.lower() < x.lower() || y.lower() == -infinity) && (x.upper() < y.upper() || y.upper() == infinity);
}

double midpoint(const Interval& x) {
  const double lower = x.lower(), upper = x.upper();
  if (isEmpty(x)) return lower;
  if (lower == -infinity) return upper == infinity ? 0 : std::min(upper, -largest);
  if (upper == infinity) return std::max(lower, largest);
  const double sum = lower + upper;
  const double middle = std::isinf(sum) ? 0.5 * lower + 0.5 * upper : 0.5 * sum;
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

Interval sqr(const Interval& x) {
  if (isEmpty(x)) return x;
  const double least = mignitude(x), greatest = magnitude(x);
  return {mulDown(least, least), mulUp(greatest, greatest)};
}

Interval sqrt(const Interval& x) {
  if (!(x.upper() >= 0)) return Interval::empty();
  return {sqrtDown(std::max(x.lower(), 0.0)), sqrtUp(x.upper())};
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

}  // namespace gamut
