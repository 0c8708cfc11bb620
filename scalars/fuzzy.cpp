// Fuzzy: makers, levelwise arithmetic, possibility and centroid. A cut is intersected with the cut before it: the exact
// result of a level lies in both, since it is a subset of the exact result one level down.
#include "scalars/fuzzy.hpp"

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <string>

namespace gamut {
namespace {

/// The stack cut(0), cut(1), ... made nested.
template <class Cut>
Fuzzy nested(std::size_t levels, Cut cut) {
  std::vector<Interval> cuts;
  cuts.reserve(levels);
  for (std::size_t level = 0; level < levels; ++level) {
    const Interval next = cut(level);
    cuts.push_back(level == 0 ? next : intersection(next, cuts.back()));
  }
  return Fuzzy(std::move(cuts));
}

template <class Function>
Fuzzy mapped(const Fuzzy& x, Function function) {
  return nested(x.levels(), [&](std::size_t level) { return function(x.cut(level)); });
}

template <class Function>
Fuzzy combined(const Fuzzy& x, const Fuzzy& y, Function function) {
  if (x.levels() != y.levels() && x.levels() != 1 && y.levels() != 1) {
    throw std::invalid_argument("fuzzy numbers of " + std::to_string(x.levels()) + " and " +
                                std::to_string(y.levels()) + " levels do not combine");
  }
  return nested(std::max(x.levels(), y.levels()),
                [&](std::size_t level) { return function(x.cut(level), y.cut(level)); });
}

}  // namespace

Fuzzy::Fuzzy(std::vector<Interval> cuts) : cuts_(std::move(cuts)) {
  if (cuts_.empty()) throw std::invalid_argument("a fuzzy number needs at least one alpha-cut");
  for (std::size_t level = 1; level < cuts_.size(); ++level) {
    if (isSubset(cuts_[level], cuts_[level - 1])) continue;
    throw std::invalid_argument("alpha-cut " + toString(cuts_[level]) + " leaves the one below it, " +
                                toString(cuts_[level - 1]));
  }
}

Fuzzy::Fuzzy(const Membership& membership, std::size_t levels) {
  if (levels < 2) throw std::invalid_argument("a fuzzy number has at least two levels, its support and its core");
  cuts_.resize(levels);
  for (std::size_t level = 0; level < levels; ++level) cuts_[level] = membership.cut(alpha(level));
}

void Fuzzy::throwNoSuchLevel(std::size_t level) const {
  throw std::out_of_range("level " + std::to_string(level) + " of a fuzzy number of " + std::to_string(levels()) +
                          " levels, counted from 0");
}

double Fuzzy::alpha(std::size_t level) const {
  if (levels() == 1) return 1;
  return static_cast<double>(level) / static_cast<double>(levels() - 1);
}

Fuzzy operator+(const Fuzzy& x, const Fuzzy& y) {
  return combined(x, y, [](const Interval& a, const Interval& b) { return a + b; });
}
Fuzzy operator-(const Fuzzy& x, const Fuzzy& y) {
  return combined(x, y, [](const Interval& a, const Interval& b) { return a - b; });
}
Fuzzy operator*(const Fuzzy& x, const Fuzzy& y) {
  return combined(x, y, [](const Interval& a, const Interval& b) { return a * b; });
}
Fuzzy operator/(const Fuzzy& x, const Fuzzy& y) {
  return combined(x, y, [](const Interval& a, const Interval& b) { return a / b; });
}
Fuzzy operator-(const Fuzzy& x) {
  return mapped(x, [](const Interval& a) { return -a; });
}

using OfOne = Interval (*)(const Interval&);
using OfTwo = Interval (*)(const Interval&, const Interval&);

Fuzzy sqr(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(sqr)); }
Fuzzy sqrt(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(sqrt)); }
Fuzzy cbrt(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(cbrt)); }
Fuzzy abs(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(abs)); }
Fuzzy sign(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(sign)); }
Fuzzy floor(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(floor)); }
Fuzzy ceil(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(ceil)); }
Fuzzy trunc(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(trunc)); }
Fuzzy round(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(round)); }
Fuzzy roundEven(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(roundEven)); }
Fuzzy exp(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(exp)); }
Fuzzy exp2(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(exp2)); }
Fuzzy exp10(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(exp10)); }
Fuzzy expm1(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(expm1)); }
Fuzzy log(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(log)); }
Fuzzy log2(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(log2)); }
Fuzzy log10(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(log10)); }
Fuzzy log1p(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(log1p)); }
Fuzzy sin(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(sin)); }
Fuzzy cos(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(cos)); }
Fuzzy tan(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(tan)); }
Fuzzy asin(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(asin)); }
Fuzzy acos(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(acos)); }
Fuzzy atan(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(atan)); }
Fuzzy sinh(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(sinh)); }
Fuzzy cosh(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(cosh)); }
Fuzzy tanh(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(tanh)); }
Fuzzy asinh(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(asinh)); }
Fuzzy acosh(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(acosh)); }
Fuzzy atanh(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(atanh)); }
Fuzzy rootn(const Fuzzy& x, int n) {
  return mapped(x, [n](const Interval& a) { return rootn(a, n); });
}
Fuzzy atan2(const Fuzzy& y, const Fuzzy& x) { return combined(y, x, static_cast<OfTwo>(atan2)); }
Fuzzy hypot(const Fuzzy& x, const Fuzzy& y) { return combined(x, y, static_cast<OfTwo>(hypot)); }
Fuzzy min(const Fuzzy& x, const Fuzzy& y) { return combined(x, y, static_cast<OfTwo>(min)); }
Fuzzy max(const Fuzzy& x, const Fuzzy& y) { return combined(x, y, static_cast<OfTwo>(max)); }
Fuzzy pow(const Fuzzy& x, long n) {
  return mapped(x, [n](const Interval& a) { return pow(a, n); });
}
Fuzzy pow(const Fuzzy& x, double y) {
  return mapped(x, [y](const Interval& a) { return pow(a, y); });
}
Fuzzy pow(const Fuzzy& x, const Fuzzy& y) { return combined(x, y, static_cast<OfTwo>(pow)); }

namespace {

/// The least alpha of a cut that `isOut`, 0 if the support is; 1 if none is.
template <class IsOut>
double leastAlpha(const Fuzzy& x, IsOut isOut) {
  if (isOut(x.support())) return 0;
  for (std::size_t level = 1; level < x.levels(); ++level)
    if (isOut(x.cut(level))) return x.alpha(level);
  return 1;
}

}  // namespace

Interval possibility(const Fuzzy& x, const Interval& event) {
  // A value outside the cut of alpha has a membership below alpha.
  const double most = leastAlpha(x, [&](const Interval& cut) { return isDisjoint(cut, event); });
  return {!isEmpty(x.core()) && isSubset(x.core(), event) ? 1.0 : 0.0, most};
}

Interval necessity(const Fuzzy& x, const Interval& event) {
  // 1 - possibility of the complement, which misses a cut where the event holds it, and holds one that the event
  // misses.
  const double most = leastAlpha(x, [&](const Interval& cut) { return isSubset(cut, event); });
  return 1 - Interval(!isEmpty(x.core()) && isDisjoint(x.core(), event) ? 1.0 : 0.0, most);
}

Interval centroid(const Fuzzy& x) {
  if (isEmpty(x.support()) || !isBounded(x.support())) return Interval::empty();
  if (isThin(x.support())) return x.support();
  std::size_t top = x.levels() - 1;
  while (isEmpty(x.cut(top))) --top;
  // With ends l(a), u(a) at membership a, ∫ m dv = ∫ (u - l) da and ∫ v m dv = ∫ (u² - l²) / 2 da. Between two levels
  // both ends are straight: the mean of u is (u0 + u1) / 2, that of u² is (u0² + u0 u1 + u1²) / 3. Distances from a
  // place in the core instead of values keep the digits of a narrow number. The area is positive: the support's width
  // is.
  const double origin = midpoint(x.cut(top));
  const auto squares = [&](double end0, double end1) {
    const Interval a = Interval(end0) - origin, b = Interval(end1) - origin;
    return sqr(a) + a * b + sqr(b);
  };
  Interval widths, moments;  // twice the area and six times the moment, each divided by the distance of two levels
  for (std::size_t level = 0; level == 0 || level < top; ++level) {
    const Interval& outer = x.cut(level);
    const Interval& inner = x.cut(std::min(level + 1, top));
    widths += (Interval(outer.upper()) - outer.lower()) + (Interval(inner.upper()) - inner.lower());
    moments += squares(outer.upper(), inner.upper()) - squares(outer.lower(), inner.lower());
  }
  return intersection(origin + moments / (3 * widths), x.support());
}

std::ostream& operator<<(std::ostream& stream, const Fuzzy& x) {
  const char* separator = "{";
  for (const Interval& cut : x.cuts()) {
    stream << separator << cut;
    separator = ", ";
  }
  return stream << "}";
}

}  // namespace gamut
