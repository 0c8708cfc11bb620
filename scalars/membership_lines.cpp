#include "scalars/membership_lines.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gamut {
namespace {

using Point = Membership::Point;

/// Where the straight line from `low` to `high` reaches alpha, low.degree < alpha < high.degree. Reckoned from both
/// ends: each is accurate near its own. Every operation, being directed, is monotone in alpha, so that cuts stay
/// nested.
Interval crossing(const Point& low, const Point& high, double alpha) {
  const Interval span = Interval(high.value) - low.value, rise = Interval(high.degree) - low.degree;
  const Interval fromLow = low.value + span * ((Interval(alpha) - low.degree) / rise);
  const Interval fromHigh = high.value - span * ((Interval(high.degree) - alpha) / rise);
  const Interval between(std::min(low.value, high.value), std::max(low.value, high.value));
  return intersection(intersection(fromLow, fromHigh), between);
}

/// The degree at a value from a.value to b.value, a.value < b.value, rounded downward.
double degreeBetween(const Point& a, const Point& b, double value) {
  const Interval share = (Interval(value) - a.value) / (Interval(b.value) - a.value);
  const Interval degree = a.degree + (Interval(b.degree) - a.degree) * share;
  return std::clamp(degree.lower(), std::min(a.degree, b.degree), std::max(a.degree, b.degree));
}

}  // namespace

std::string writtenEnds(const Interval& x) {
  return isThin(x) ? toString(x.lower()) : "[" + toString(x.lower()) + ", " + toString(x.upper()) + "]";
}

Interval betweenEnds(const std::string& name, double lower, double upper) {
  if (!(std::isfinite(lower) && std::isfinite(upper) && lower <= upper))
    throw std::invalid_argument("a membership function's " + name + " must be a bounded interval, not from " +
                                toString(lower) + " to " + toString(upper));
  return {lower, upper};
}

std::vector<Point> trapezoid(const Interval& support, const Interval& core) {
  if (!isSubset(core, support))
    throw std::invalid_argument("the core " + writtenEnds(core) +
                                " of a membership function lies outside its support " + writtenEnds(support));
  return {{support.lower(), 0}, {core.lower(), 1}, {core.upper(), 1}, {support.upper(), 0}};
}

Interval MembershipLines::core() const {
  const auto isOne = [](const Point& p) { return p.degree == 1; };
  return {std::find_if(points_.begin(), points_.end(), isOne)->value,
          std::find_if(points_.rbegin(), points_.rend(), isOne)->value};
}

/// From the first and the last point that reach alpha, and the flank before and after: absent where the table begins or
/// ends that high.
Interval MembershipLines::cut(double alpha) const {
  const auto reaches = [alpha](const Point& p) { return p.degree >= alpha; };
  const auto first = std::find_if(points_.begin(), points_.end(), reaches);
  const auto last = std::find_if(points_.rbegin(), points_.rend(), reaches);
  const bool leftFlank = first != points_.begin() && first->degree > alpha;
  const bool rightFlank = last != points_.rbegin() && last->degree > alpha;
  return {leftFlank ? crossing(first[-1], *first, alpha).lower() : first->value,
          rightFlank ? crossing(last[-1], *last, alpha).upper() : last->value};
}

/// Of points with equal values the one nearest to the core counts: the last on the rising flank, the first on the
/// falling one.
double MembershipLines::degree(double value, bool isBelowCore) const {
  if (isBelowCore) {
    const auto right =
        std::upper_bound(points_.begin(), points_.end(), value, [](double v, const Point& p) { return v < p.value; });
    return degreeBetween(right[-1], *right, value);
  }
  const auto right =
      std::lower_bound(points_.begin(), points_.end(), value, [](const Point& p, double v) { return p.value < v; });
  return degreeBetween(right[-1], *right, value);
}

}  // namespace gamut
