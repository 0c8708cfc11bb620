// The truth that enclosures are judged by: solutions of a recorded program in 128-bit arithmetic, by Taylor series of
// order 30 whose truncation error in a step is below 1e-33 of the state. Comparisons are exact: a double is exact as a
// Precise.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "analyses/samples/arbiter.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/evaluation/series.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"
#include "scalars/recorded.hpp"

namespace gamut::testing {

using Vector = std::vector<Precise>;

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// 128-bit value in interval, without any tolerance.
inline bool encloses(const Interval& interval, const Precise& value) {
  return !isEmpty(interval) && Precise(interval.lower()) <= value && value <= Precise(interval.upper());
}

/// log2 |x|, -inf of zero: as a double, in whose range x itself need not be.
inline double log2Of(const Precise& x) {
  long exponent = 0;
  const double mantissa = mpfr_get_d_2exp(&exponent, x.backend().data(), MPFR_RNDN);
  return std::log2(std::fabs(mantissa)) + static_cast<double>(exponent);
}

/// Of the first `states` nodes: Σ c_i τ^i, i = 0 … order.
inline Vector sumsOf(Series<Precise>& series, int states, int order, const Precise& tau) {
  Vector x;
  for (int s = 0; s < states; ++s) {
    x.push_back(series.at(s, order));
    for (int i = order - 1; i >= 0; --i) (x.back() *= tau) += series.at(s, i);
  }
  return x;
}

/// Where f, above zero at `low`, is so no more, f(τ) <= 0: at most 2^-116 behind a place where it is. Secants, led back
/// to the middle as far as they would need more values of f than one more than bisection does (ITP, with κ2 = 2: I.
/// Oliveira & R. Takahashi, ACM Transactions on Mathematical Software 47 (2020)).
template <class F>
Precise behindRoot(F&& f, Precise low, Precise high) {
  const Precise whole = high - low, tolerance(0x1p-117);
  Precise atLow = f(low), atHigh = f(high), most = tolerance;  // from the middle: what bisection would still have left
  while (2 * most < whole) most *= 2;
  for (; high - low > 2 * tolerance; most /= 2) {
    const Precise width = high - low, middle = low + width / 2;
    Precise next = middle;
    if (atLow > 0 && atHigh <= 0) {
      const Precise secant = low + width * (atLow / (atLow - atHigh)), off = middle - secant;
      const Precise beyond = std::min(Precise(width * width / (5 * whole)), Precise(abs(off)));
      next = off > 0 ? secant + beyond : secant - beyond;
      const Precise reach = 2 * most - width / 2;
      if (abs(next - middle) > reach) next = off > 0 ? middle - reach : middle + reach;
    }
    const Precise atNext = f(next);
    const bool isBefore = atNext > 0;
    (isBefore ? low : high) = next;
    (isBefore ? atLow : atHigh) = atNext;
  }
  return high;
}

MATCHER_P(Encloses, value, "encloses " + value.str(40)) { return encloses(arg, value); }

/// Integrates ẋ = f(t, x, p).
class Reference {
 public:
  explicit Reference(const Program& f, int order = 30) : f_(f), order_(order), series_(f_, order) {}

  /// States at `times` (rising, from 0 on). `start`: initial values, then parameters.
  std::vector<Vector> operator()(const Vector& start, const std::vector<double>& times) {
    const auto n = static_cast<std::size_t>(f_.states());
    Vector x(start.begin(), start.begin() + static_cast<std::ptrdiff_t>(n));
    const Vector p(start.begin() + static_cast<std::ptrdiff_t>(n), start.end());
    series_.setParameters(p);
    std::vector<Vector> result;
    Precise t(0.0);
    for (;;) {
      series_.solve(t, x);
      const Precise h = reach();
      while (result.size() < times.size() && Precise(times[result.size()]) <= t + h)
        result.push_back(after(Precise(times[result.size()]) - t));
      if (result.size() == times.size()) return result;
      x = after(h);
      t += h;
    }
  }

 protected:
  /// Where the last orders are 1e-34 of the states, by doubles: a step's length may be any.
  Precise reach() {
    Precise largest(0.0);
    double h = 996;  // log2
    int first = -1;  // relative to the state, or to how it begins to move where it is at rest
    while (largest == 0 && ++first < order_ / 2)
      for (int s = 0; s < f_.states(); ++s) largest = std::max(largest, Precise(abs(series_.at(s, first))));
    if (largest == 0) return Precise(std::exp2(h));
    for (int s = 0; s < f_.states(); ++s) {
      // One that vanishes beside the others is followed relative to itself a while longer.
      const Precise own = abs(series_.at(s, 0));
      const bool vanishes = own > 0 && own < largest * 1e-20;
      const double size = log2Of(vanishes ? std::max(own, Precise(largest * 1e-40)) : largest);
      for (int i = order_ / 2; i <= order_; ++i)  // single orders may vanish
        h = std::min(h, std::log2(1e-34) / order_ + (size - log2Of(series_.at(s, i))) / (i - std::max(first, 0)));
    }
    return Precise(std::exp2(h));
  }
  Vector after(const Precise& tau) { return sumsOf(series_, f_.states(), order_, tau); }

  const Program f_;
  int order_;
  Series<Precise> series_;
};

/// Corners and random points of a box.
class Points {
 public:
  explicit Points(unsigned seed = 1) : engine_(seed) {}
  double uniform(double lower, double upper) { return std::uniform_real_distribution<>(lower, upper)(engine_); }
  int integer(int lower, int upper) { return std::uniform_int_distribution<>(lower, upper)(engine_); }

  Vector corner(const Box& box) {
    Vector x;
    for (const Interval& side : box) x.push_back(integer(0, 1) == 0 ? side.lower() : side.upper());
    return x;
  }
  Vector inside(const Box& box) {
    Vector x;
    for (const Interval& side : box) {
      const double part = uniform(0, 1);
      x.push_back(std::clamp(side.lower() * (1 - part) + side.upper() * part, side.lower(), side.upper()));
    }
    return x;
  }
  /// A double between -1 and 1, one in three of them an end.
  double signedUnit() {
    const int choice = integer(0, 5);
    return choice == 0 ? -1.0 : choice == 1 ? 1.0 : uniform(-1, 1);
  }

 private:
  std::mt19937_64 engine_;
};

/// A recorded value and roughly what it is, so that random programs stay inside the domains of their functions.
struct Guarded {
  Recorded value;
  double nominal = 0;
};

/// The functions that random expressions are made of; each is tested on its own as well.
inline const std::vector<std::string>& elementaryNames() {
  static const std::vector<std::string> names = {"add", "sub", "neg", "mul",  "div",  "sqr",  "sqrt", "exp",  "log",
                                                 "sin", "cos", "tan", "atan", "asin", "acos", "tanh", "sinh", "pow"};
  return names;
}

/// One function applied to a (and b), with a shifted or scaled into its domain where need be.
inline Guarded apply(const std::string& name, Guarded a, Guarded b) {
  const auto positive = [](const Guarded& x) {
    const double shift = 2.0 - std::min(x.nominal, 0.0);
    return Guarded{x.value + shift, x.nominal + shift};
  };
  const auto small = [](const Guarded& x) {  // below one half
    const double scale = 0.4 / std::max(1.0, std::fabs(x.nominal));
    return Guarded{scale * x.value, scale * x.nominal};
  };
  if (name == "add") return {a.value + b.value, a.nominal + b.nominal};
  if (name == "sub") return {a.value - b.value, a.nominal - b.nominal};
  if (name == "neg") return {-a.value, -a.nominal};
  if (name == "mul") return {a.value * b.value, a.nominal * b.nominal};
  if (name == "div") return b = positive(b), Guarded{a.value / b.value, a.nominal / b.nominal};
  if (name == "sqr") return {sqr(a.value), a.nominal * a.nominal};
  if (name == "sqrt") return a = positive(a), Guarded{sqrt(a.value), std::sqrt(a.nominal)};
  if (name == "exp") return a = small(a), Guarded{exp(a.value), std::exp(a.nominal)};
  if (name == "log") return a = positive(a), Guarded{log(a.value), std::log(a.nominal)};
  if (name == "sin") return {sin(a.value), std::sin(a.nominal)};
  if (name == "cos") return {cos(a.value), std::cos(a.nominal)};
  if (name == "tan") return a = small(a), Guarded{tan(a.value), std::tan(a.nominal)};
  if (name == "atan") return {atan(a.value), std::atan(a.nominal)};
  if (name == "asin") return a = small(a), Guarded{asin(a.value), std::asin(a.nominal)};
  if (name == "acos") return a = small(a), Guarded{acos(a.value), std::acos(a.nominal)};
  if (name == "tanh") return {tanh(a.value), std::tanh(a.nominal)};
  if (name == "sinh") return a = small(a), Guarded{sinh(a.value), std::sinh(a.nominal)};
  return a = positive(a), Guarded{pow(a.value, -1.5), std::pow(a.nominal, -1.5)};
}

/// A random expression of `length` functions in time (near 0), states and parameters (near their nominal values).
class RandomExpressions {
 public:
  RandomExpressions(Points& points, std::vector<double> nominal) : points_(points), nominal_(std::move(nominal)) {}

  template <class States>
  void operator()(const Recorded& t, const States& x, const States& p, std::vector<Recorded>& y, int length) {
    std::vector<Guarded> pool{{t, 0.0}, {Recorded(points_.uniform(-2, 2)), 1.0}};
    for (std::size_t i = 0; i < x.size(); ++i) pool.push_back({x[i], nominal_[i]});
    for (std::size_t i = 0; i < p.size(); ++i) pool.push_back({p[i], nominal_[x.size() + i]});
    const auto& names = elementaryNames();
    for (int i = 0; i < length; ++i) {
      const std::string& name = names[static_cast<std::size_t>(points_.integer(0, static_cast<int>(names.size()) - 1))];
      Guarded next = apply(name, pick(pool), pick(pool));
      if (std::fabs(next.nominal) > 4) next = {next.value * 0.125, next.nominal * 0.125};
      pool.push_back(next);
    }
    for (Recorded& value : y) value = 0.5 * pick(pool, 3).value - 0.25 * pick(pool, 3).value;
  }

 private:
  Guarded pick(const std::vector<Guarded>& pool, int last = 0) {
    const int from = last > 0 ? std::max(0, static_cast<int>(pool.size()) - last) : 0;
    return pool[static_cast<std::size_t>(points_.integer(from, static_cast<int>(pool.size()) - 1))];
  }
  Points& points_;
  std::vector<double> nominal_;
};

}  // namespace gamut::testing
