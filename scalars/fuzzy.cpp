// Fuzzy: makers and levelwise arithmetic. A cut is intersected with the cut before it: the exact result of a level lies
// in both, since it is a subset of the exact result one level down.
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

Fuzzy Fuzzy::triangular(double lower, double apex, double upper, std::size_t levels) {
  return trapezoidal(lower, apex, apex, upper, levels);
}

Fuzzy Fuzzy::trapezoidal(double lower, double coreLower, double coreUpper, double upper, std::size_t levels) {
  if (levels < 2) throw std::invalid_argument("a fuzzy number has at least two levels, its support and its core");
  const Interval support(lower, upper), core(coreLower, coreUpper);
  if (!isSubset(core, support) || !isBounded(support)) {
    throw std::invalid_argument("the core " + toString(core) + " of a fuzzy number must lie in its support " +
                                toString(support) + ", and that be bounded");
  }
  return nested(levels, [&](std::size_t level) {
    if (level == 0) return support;
    if (level + 1 == levels) return core;
    const Interval alpha = Interval(static_cast<double>(level)) / static_cast<double>(levels - 1);
    const Interval left = lower + (Interval(coreLower) - lower) * alpha;
    const Interval right = upper + (Interval(coreUpper) - upper) * alpha;
    return hull(core, {std::min(left.lower(), coreLower), std::max(right.upper(), coreUpper)});
  });
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
Fuzzy abs(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(abs)); }
Fuzzy exp(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(exp)); }
Fuzzy log(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(log)); }
Fuzzy sin(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(sin)); }
Fuzzy cos(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(cos)); }
Fuzzy tan(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(tan)); }
Fuzzy asin(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(asin)); }
Fuzzy acos(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(acos)); }
Fuzzy atan(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(atan)); }
Fuzzy sinh(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(sinh)); }
Fuzzy cosh(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(cosh)); }
Fuzzy tanh(const Fuzzy& x) { return mapped(x, static_cast<OfOne>(tanh)); }
Fuzzy min(const Fuzzy& x, const Fuzzy& y) { return combined(x, y, static_cast<OfTwo>(min)); }
Fuzzy max(const Fuzzy& x, const Fuzzy& y) { return combined(x, y, static_cast<OfTwo>(max)); }
Fuzzy pow(const Fuzzy& x, int n) {
  return mapped(x, [n](const Interval& a) { return pow(a, n); });
}
Fuzzy pow(const Fuzzy& x, double y) {
  return mapped(x, [y](const Interval& a) { return pow(a, y); });
}
Fuzzy pow(const Fuzzy& x, const Fuzzy& y) { return combined(x, y, static_cast<OfTwo>(pow)); }

std::ostream& operator<<(std::ostream& stream, const Fuzzy& x) {
  const char* separator = "{";
  for (const Interval& cut : x.cuts()) {
    stream << separator << cut;
    separator = ", ";
  }
  return stream << "}";
}

}  // namespace gamut
