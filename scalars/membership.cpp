// Membership functions in intervals. Triangles, trapezoids and tables are one thing: straight lines between points.
#include "scalars/membership.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace gamut {
namespace {

using Point = Membership::Point;

void require(bool good, const std::string& what) {
  if (!good) throw std::invalid_argument(what);
}

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

/// "2", or "[1, 3]" with bounds that are read back as these doubles.
std::string written(const Interval& x) {
  return isThin(x) ? toString(x.lower()) : "[" + toString(x.lower()) + ", " + toString(x.upper()) + "]";
}

/// The interval from one end to the other of what `name` is called.
Interval betweenEnds(const std::string& name, double lower, double upper) {
  require(std::isfinite(lower) && std::isfinite(upper) && lower <= upper,
          "a membership function's " + name + " must be a bounded interval, not from " + toString(lower) + " to " +
              toString(upper));
  return {lower, upper};
}

/// Throws std::invalid_argument, naming the first wrong point, unless the degrees rise to 1 and fall.
void requireOnePeak(const std::vector<Point>& points) {
  require(!points.empty(), "a membership table needs at least one point");
  std::size_t i = 0;
  const auto requireHere = [&](bool good, const char* problem) {
    if (!good) throw Membership::BadPoint(points, i, problem);
  };
  bool falls = false;
  for (; i < points.size(); ++i) {
    const auto [value, degree] = points[i];
    requireHere(std::isfinite(value), "is not finite");
    requireHere(degree >= 0 && degree <= 1, "has a degree outside [0, 1]");
    if (i == 0) continue;
    const Point& before = points[i - 1];
    requireHere(value >= before.value, "lies left of the point before it");
    if (degree > before.degree) requireHere(!falls, "rises again after the table has fallen");
    if (degree < before.degree) {
      requireHere(falls || before.degree == 1, "falls although the table has not reached 1");
      falls = true;
    }
  }
  i = points.size() - 1;
  requireHere(falls || points.back().degree == 1, "ends it although the table has not reached 1");
}

}  // namespace

Membership::BadPoint::BadPoint(const std::vector<Point>& points, std::size_t at, std::string wrong)
    : std::invalid_argument("point " + std::to_string(at + 1) + ", (" + toString(points[at].value) + ", " +
                            toString(points[at].degree) + "), of a membership table " + wrong),
      index(at),
      problem(std::move(wrong)) {}

Membership::Membership(Shape shape, std::vector<Point> points) : shape_(shape), points_(std::move(points)) {
  support_ = {points_.front().value, points_.back().value};
  const auto isOne = [](const Point& p) { return p.degree == 1; };
  core_ = {std::find_if(points_.begin(), points_.end(), isOne)->value,
           std::find_if(points_.rbegin(), points_.rend(), isOne)->value};
}

Membership::Membership(const Interval& support, double centre, double deviation)
    : shape_(Shape::gaussian), deviation_(deviation), support_(support), core_(centre) {}

Membership Membership::triangular(double lower, double apex, double upper) {
  Membership result = trapezoidal(lower, apex, apex, upper);
  result.shape_ = Shape::triangular;
  return result;
}

Membership Membership::trapezoidal(double lower, double left, double right, double upper) {
  const Interval support = betweenEnds("support", lower, upper), core = betweenEnds("core", left, right);
  require(isSubset(core, support),
          "the core " + written(core) + " of a membership function lies outside its support " + written(support));
  return {Shape::trapezoidal, {{lower, 0}, {left, 1}, {right, 1}, {upper, 0}}};
}

Membership Membership::gaussian(const Interval& support, double centre, double deviation) {
  require(!isEmpty(support) && isBounded(support),
          "a membership function needs a bounded support, not " + toString(support));
  require(deviation > 0 && std::isfinite(deviation),
          "the deviation of a membership function must be positive, not " + toString(deviation));
  require(contains(support, centre),
          "the centre " + toString(centre) + " of a membership function lies outside its support " + written(support));
  return {support, centre, deviation};
}

Membership Membership::table(std::vector<Point> points) {
  requireOnePeak(points);
  const auto isPositive = [](const Point& p) { return p.degree > 0; };
  const auto rising = std::find_if(points.begin(), points.end(), isPositive);
  const auto falling = std::find_if(points.rbegin(), points.rend(), isPositive).base();
  if (falling != points.end()) points.erase(falling + 1, points.end());  // of several zeros the one nearest to the core
  if (rising != points.begin()) points.erase(points.begin(), rising - 1);
  return {Shape::table, std::move(points)};
}

std::string_view Membership::name() const {
  switch (shape_) {
    case Shape::triangular:
      return "triangular";
    case Shape::trapezoidal:
      return "trapezoidal";
    case Shape::gaussian:
      return "gaussian";
    case Shape::table:
      return "table";
  }
  return {};
}

std::vector<ShapeNumber> Membership::numbers() const {
  std::vector<ShapeNumber> numbers{{"lower", support_.lower()}, {"upper", support_.upper()}};
  switch (shape_) {
    case Shape::triangular:
      numbers.push_back({"apex", core_.lower()});
      break;
    case Shape::trapezoidal:
      numbers.insert(numbers.end(), {{"left", core_.lower()}, {"right", core_.upper()}});
      break;
    case Shape::gaussian:
      numbers.insert(numbers.end(), {{"centre", core_.lower()}, {"deviation", deviation_}});
      break;
    case Shape::table:
      for (std::size_t i = 0; i < points_.size(); ++i) {
        numbers.push_back({"value " + std::to_string(i + 1), points_[i].value});
        numbers.push_back({"membership " + std::to_string(i + 1), points_[i].degree, false});
      }
  }
  return numbers;
}

Interval Membership::cut(double alpha) const {
  require(alpha >= 0 && alpha <= 1, "an alpha level lies between 0 and 1, not at " + toString(alpha));
  if (alpha == 0) return support_;
  if (alpha == 1) return core_;
  if (shape_ == Shape::gaussian) {
    const Interval reach = deviation_ * sqrt(-2.0 * log(Interval(alpha)));  // solves exp(-(reach/deviation)²/2) = alpha
    return intersection({(core_ - reach).lower(), (core_ + reach).upper()}, support_);
  }
  // The first and the last point that reach alpha, and the flank before and after: absent where the table begins or
  // ends that high.
  const auto reaches = [alpha](const Point& p) { return p.degree >= alpha; };
  const auto first = std::find_if(points_.begin(), points_.end(), reaches);
  const auto last = std::find_if(points_.rbegin(), points_.rend(), reaches);
  const bool leftFlank = first != points_.begin() && first->degree > alpha;
  const bool rightFlank = last != points_.rbegin() && last->degree > alpha;
  return {leftFlank ? crossing(first[-1], *first, alpha).lower() : first->value,
          rightFlank ? crossing(last[-1], *last, alpha).upper() : last->value};
}

double Membership::operator()(double value) const {
  if (!contains(support_, value)) return 0;
  if (contains(core_, value)) return 1;
  if (shape_ == Shape::gaussian) return exp(-0.5 * sqr((Interval(value) - core_) / deviation_)).lower();
  // Of points with equal values the one nearest to the core counts: the last on the rising flank, the first on the
  // falling one.
  if (value < core_.lower()) {
    const auto right =
        std::upper_bound(points_.begin(), points_.end(), value, [](double v, const Point& p) { return v < p.value; });
    return degreeBetween(right[-1], *right, value);
  }
  const auto right =
      std::lower_bound(points_.begin(), points_.end(), value, [](const Point& p, double v) { return p.value < v; });
  return degreeBetween(right[-1], *right, value);
}

}  // namespace gamut
