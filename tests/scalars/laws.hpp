// What the laws of numbers (laws_test.cpp) are stated in: for every scalar an adaptor Laws<S>, the table of operations,
// and random operands. A new scalar needs one adaptor, its place among `Operation::Functions` and its line in
// laws_test.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "scalars/evaluation/evaluate.hpp"
#include "scalars/fuzzy.hpp"
#include "scalars/interval.hpp"
#include "scalars/recorded.hpp"
#include "scalars/samples.hpp"
#include "tests/scalars/high_precision.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::testing {

using Real = HighPrecision;

/// What an operand is made of: four doubles in ascending order.
using Corners = std::array<double, 4>;

// ---- What the suite must know of a scalar ---------------------------------------------------------------------------

/// Every adaptor has
///   name                          of the scalar
///   make(corners)                 an operand: a number is corners[1], a set reaches from the first corner to the last
///   range(x)                      the least interval with everything that x holds
///   isSame(x, y)                  equal in every respect
///   isInside(x, y)                x is the same number as y, or a subset of the set y
///   holds(x, k, real, tolerance)  x holds the real number that came of the operands' corners k: a set contains it, a
///                                 number is not farther from it than the tolerance; true where x claims nothing of k
///   slack                         the tolerance of a number after one operation, in units of max(1, |real|)
/// and, by inheritance from Direct or Laws<RecordedAs>,
///   evaluate(f, x...)             f of values of any one scalar, as this one computes it
///   Number                        what f computes with: S or Recorded
template <class S>
struct Laws;

template <class S>
struct Direct {
  using Value = S;
  using Number = S;
  template <class F, class V, class... Vs>
  static V evaluate(const F& f, const V& x, const Vs&... more) {
    return f(x, more...);
  }
};

template <>
struct Laws<double> : Direct<double> {
  static std::string name() { return "Double"; }
  static constexpr double slack = 0x1p-51;
  static double make(const Corners& corners) { return corners[1]; }
  static Interval range(double x) { return x; }
  static bool isSame(double x, double y) { return x == y; }
  static bool isInside(double x, double y) { return x == y; }
  static bool holds(double x, int k, const Real& real, const Real& tolerance) {
    return k != 1 || abs(x - real) <= tolerance;
  }
};

template <>
struct Laws<HighPrecision> : Direct<HighPrecision> {
  static std::string name() { return "HighPrecision"; }
  static constexpr double slack = 1e-45;
  static HighPrecision make(const Corners& corners) { return corners[1]; }
  static Interval range(const HighPrecision& x) {
    const double nearest = x.convert_to<double>();
    return {x < nearest ? std::nextafter(nearest, -infinity) : nearest,
            x > nearest ? std::nextafter(nearest, infinity) : nearest};
  }
  static bool isSame(const HighPrecision& x, const HighPrecision& y) { return x == y; }
  static bool isInside(const HighPrecision& x, const HighPrecision& y) { return x == y; }
  static bool holds(const HighPrecision& x, int k, const Real& real, const Real& tolerance) {
    return k != 1 || abs(x - real) <= tolerance;
  }
};

template <>
struct Laws<Interval> : Direct<Interval> {
  static std::string name() { return "Interval"; }
  static constexpr double slack = 0;
  static Interval make(const Corners& corners) { return {corners[0], corners[3]}; }
  static Interval range(const Interval& x) { return x; }
  static bool isSame(const Interval& x, const Interval& y) { return isEqual(x, y); }
  static bool isInside(const Interval& x, const Interval& y) { return isSubset(x, y); }
  /// A thin x is one number: the reference has 50 digits of it.
  static bool holds(const Interval& x, int, const Real& real, const Real&) {
    if (isThin(x)) return abs(real - x.lower()) <= 1e-40 * (1 + abs(real));
    return Real(x.lower()) <= real && real <= Real(x.upper());
  }
};

template <>
struct Laws<Samples> : Direct<Samples> {
  static std::string name() { return "Samples"; }
  static constexpr double slack = 0x1p-50;
  static Samples make(const Corners& corners) { return Samples(std::vector<double>(corners.begin(), corners.end())); }
  static Interval range(const Samples& x) { return {x.minimum(), x.maximum()}; }
  static bool isSame(const Samples& x, const Samples& y) {
    for (std::size_t k = 0; k < 4; ++k)
      if (sample(x, k) != sample(y, k)) return false;
    return true;
  }
  static bool isInside(const Samples& x, const Samples& y) { return isSame(x, y); }
  static bool holds(const Samples& x, int k, const Real& real, const Real& tolerance) {
    return abs(sample(x, static_cast<std::size_t>(k)) - real) <= tolerance;
  }

 private:
  static double sample(const Samples& x, std::size_t k) { return x[x.isConstant() ? 0 : k]; }
};

template <>
struct Laws<Fuzzy> : Direct<Fuzzy> {
  static std::string name() { return "Fuzzy"; }
  static constexpr double slack = 0;
  static constexpr std::size_t levels = 3;
  static Fuzzy make(const Corners& c) { return Fuzzy::trapezoidal(c[0], c[1], c[2], c[3], levels); }
  static Interval range(const Fuzzy& x) { return x.support(); }
  static bool isSame(const Fuzzy& x, const Fuzzy& y) { return isInside(x, y) && isInside(y, x); }
  static bool isInside(const Fuzzy& x, const Fuzzy& y) {
    for (std::size_t level = 0; level < levels; ++level)
      if (!isSubset(x.cut(level), y.cut(level))) return false;
    return true;
  }
  static bool holds(const Fuzzy& x, int k, const Real& real, const Real& tolerance) {
    return Laws<Interval>::holds(k == 1 || k == 2 ? x.core() : x.support(), k, real, tolerance);
  }
};

/// A scalar whose every expression is first recorded as a program, which is then evaluated with S.
template <class S>
struct RecordedAs {};

template <class S>
struct Laws<RecordedAs<S>> : Laws<S> {
  static std::string name() { return "RecordedAs" + Laws<S>::name(); }
  static constexpr double slack = 0x1p10 * Laws<S>::slack;  // formulas that compose functions lose digits
  using Number = Recorded;
  template <class F, class V, class... Vs>
  static V evaluate(const F& f, const V& x, const Vs&... more) {
    constexpr int n = 1 + sizeof...(Vs);
    const Program program = record<n>([&](const std::array<Recorded, n>& v) { return std::apply(f, v); });
    return gamut::evaluate<V>(program, {x, more...}).front();
  }
};

// ---- Operations -----------------------------------------------------------------------------------------------------

/// An operation on two numbers of one type, of which one operand may be ignored, on domains whose ends are multiples of
/// 1/64: whatever the scalar, it is called as operation(x, y).
struct Operation {
  template <class S>
  using Function = S (*)(const S&, const S&);
  using Functions = std::tuple<Function<double>, Function<HighPrecision>, Function<Interval>, Function<Samples>,
                               Function<Fuzzy>, Function<Recorded>>;

  const char* name;
  Interval x, y;
  Functions functions;  ///< null for a type that has no such operation; HighPrecision, the reference, has all

  template <class S>
  bool isOf() const {
    return std::get<Function<S>>(functions) != nullptr;
  }
  template <class S>
  S operator()(const S& a, const S& b) const {
    return std::get<Function<S>>(functions)(a, b);
  }
};

/// + - * / and what is made of them and the square root only: in doubles each step is rounded correctly.
const std::vector<Operation>& arithmetic();
/// These and all functions.
const std::vector<Operation>& everyOperation();

// ---- Operands -------------------------------------------------------------------------------------------------------

/// Four doubles of any bits.
inline Corners anyCorners(RandomDoubles& random, const Interval& domain) {
  const Interval within = random.intervalIn(domain.lower(), domain.upper());
  Corners corners;
  for (double& corner : corners) corner = random.elementOf(within);
  std::ranges::sort(corners);
  return corners;
}

/// Four multiples of 1/64 in a domain of at most 9: sums and products of three such operands are doubles, and so are
/// the alpha-cuts in the middle. Where arithmetic is exact, laws are judged without rounding.
inline Corners shortCorners(RandomDoubles& random, const Interval& domain) {
  Corners corners;
  for (double& corner : corners)
    corner = random.integer(static_cast<int>(64 * domain.lower()), static_cast<int>(64 * domain.upper())) / 64.0;
  std::ranges::sort(corners);
  return corners;
}

/// Each of the four moved outward: what is made of them holds what is made of `inner`.
inline Corners outerCorners(RandomDoubles& random, const Corners& inner, const Interval& domain) {
  Corners corners = shortCorners(random, domain);
  for (std::size_t k = 0; k < 2; ++k) corners[k] = std::min(corners[k], inner[k]);
  for (std::size_t k = 2; k < 4; ++k) corners[k] = std::max(corners[k], inner[k]);
  return corners;
}

/// The tolerance of a number after one operation.
template <class S>
Real toleranceOf(const Real& real) {
  return Laws<S>::slack * std::max(Real(1), Real(abs(real)));
}

}  // namespace gamut::testing
