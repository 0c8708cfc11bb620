// What the flow knows of an elementary function of programs, in a file of its name in this folder: the recursion of its
// coefficients, what that leaves out and rounds, and what follows for its value. What it is for every scalar stands in
// scalars/operations. Notation as in docs/flow.md and polynomial_series_errors.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/series/grade_kernels.hpp"
#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/flow/series/thin.hpp"
#include "scalars/operations/all.hpp"

namespace gamut {

/// The function of op, v = f(u): besides what is below and in what it derives from it has, of node x on node a,
///
///     void products(x, a, b, add)    add(left, right, target, isSlope) for the products that its series is made of
///     void putLeading(s, x)          order 0 in time of the coefficient of 1
///     void series(s, x)                 and of all monomials
///     void order(s, x, i)            order i > 0, of all monomials
///     void thinOrder(v, x, i, cur)   order i > 0 of the coefficient of 1 alone (kernels.hpp)
///     void lane(s, x, i, q)          order i of the monomials of grade q that are carried on together
///     SeriesError ownErrors(s, x)         what it adds to the error of u: e0 + e1 (σ/θ)^m
///     bool bound(s, x, of)           ρ0 and ρ1, from these and those of u; false: not proved
///
/// The first of twins, at x, does so for both, but for `bound`.
template <Op op>
struct FlowFunction;

/// What a function is unless it says otherwise.
struct AnyFlowFunction {
  using Series = PolynomialSeries;
  using Operands = Series::Operands;
  using Thin = kernels::ThinNode;
  static constexpr int lanes = kernels::lanes;

  static constexpr std::string_view edge = "a number that may become too large";
  static constexpr bool isConvex = true;           ///< its bounds are, in those of u
  static constexpr bool dividesByLeading = false;  ///< by a polynomial, the order 0 of its denominator
  static constexpr bool measuresResidual = false;  ///< so that the series of u is needed
  static void products(int, int, int, const auto&) {}
  static void lane(Series&, int, int, int) {}

 protected:
  static const SeriesNode& plan(const Series& s, int x) { return s.plan_[x]; }
  static double coefficient(const Series& s, const SeriesNode& v, int g, int i = 0) { return s.series(v, g)[i]; }
  static void setLanes(double* to, const auto& value) {
    for (int l = 0; l < lanes; ++l) to[l] = value(l);
  }

  /// f at the constant coefficient of u, with its error: the enclosure's ends are neighbours, and c is one of them: the
  /// error is at most its width.
  template <Op op>
  static void putPoint(Series& s, int x) {
    const double u = coefficient(s, plan(s, plan(s, x).a), 0);
    Interval first = Interval::empty(), second = Interval::empty();
    if (std::isfinite(u)) FlowFunction<op>::values(Interval(u), first, second);
    const auto put = [&s](int node, const Interval& value) {
      s.put(plan(s, node), 0, 0, isEmpty(value) ? std::nan("") : midpoint(value));
      s.pointError_[node] = isEmpty(value) ? std::nan("") : width(value);
    };
    put(x, first);
    if constexpr (hasTwin(op)) put(x + 1, second);
  }
};

/// v' w = u', where w is node b: a quotient of slopes.
template <Op op>
struct SlopeQuotient : AnyFlowFunction {
  static constexpr bool dividesByLeading = true, measuresResidual = true;
  static void products(int x, int, int b, const auto& add) { add(x, b, x, true); }
  static void values(const Interval& u, Interval& v, Interval& twin) { evaluate(Function<op>(), u, v, twin); }
  static void putLeading(Series& s, int x) { putPoint<op>(s, x); }

  /// l_g = (u_g - Σ grade(p) l_p w_r / grade(g)) / w_0
  static void series(Series& s, int x) {
    const SeriesNode &v = plan(s, x), &a = plan(s, v.a), &w = plan(s, v.b);
    putPoint<op>(s, x);
    const double w0 = coefficient(s, w, 0);
    for (int g = 1; g < v.count; ++g) {
      const double sum = s.sumOverPairs(g, [&](int p, int r) {
        return r == 0 ? 0.0 : s.plan_.monomials->grade(p) * coefficient(s, v, p) * coefficient(s, w, r);
      });
      s.put(v, g, 0, (coefficient(s, a, g) - sum / s.plan_.monomials->grade(g)) / w0);
    }
    for (int g = 0; g < v.count; ++g) s.slopes(v, g)[0] = 0.0;
    s.invertLeading(x, w);
  }
  /// l_i = (u_i - Σ_{1≤j<i} j l_j w_{i-j} / i) / w_0
  static void order(Series& s, int x, int i) {
    const SeriesNode &v = plan(s, x), &a = plan(s, v.a);
    s.putQuotient<true>(x, i, s.slopes(v), plan(s, v.b),
                        [&](int g, double sum) { return coefficient(s, a, g, i) - sum / i; });
  }
  GAMUT_INLINE static void thinOrder(const Thin* v, int x, int i, double* cur) {
    const Thin &n = v[x], &w = v[n.b];
    cur[x] = (cur[n.a] - kernels::thinDot(n.derivative, w.reversed, i) / i) / w.forward[0];
  }
  static void lane(Series& s, int x, int i, int q) {
    const SeriesNode& v = plan(s, x);
    double* out = s.lane(x, i);
    const double *of = s.lane(v.a, i), inverse = 1 / s.series(v.b)[0];
    if (i == 0) return setLanes(out, [&](int l) { return (of[l] - out[l] / q) * inverse; });
    kernels::convolveLanes(s.slope(x), 1, i, s.lane(v.b, 0), i, out);
    kernels::convolveLanes(s.series(v.b), 1, i - 1, s.slopeLane(x), i, out);
    setLanes(out, [&](int l) { return (of[l] - out[l] / i) * inverse; });
  }

  static SeriesError ownErrors(Series& s, int x) {
    const SeriesNode& v = plan(s, x);
    double e0 = s.quotientResidual(x);
    if (s.isGraded()) e0 += s.tailDegree(x, v.b, v.degree, 1) + s.tailRow(x, v.b, v.degree) + s.dropped(v.a, v.degree);
    return {e0, s.tailTime(x, v.b)};
  }
};

/// v' = sign u' w: v is node x + target, w node x + factor.
template <int toTarget, int toFactor, int itsSign>
struct SlopeEquation {
  static constexpr int target = toTarget, factor = toFactor, sign = itsSign;
};

/// These equations, of twins for each; or, of tanh, for the first alone.
template <Op op, class... Equations>
struct SlopeProducts : AnyFlowFunction {
  static void products(int x, int a, int, const auto& add) {
    (add(a, x + Equations::factor, x + Equations::target, true), ...);
  }
  static void values(const Interval& u, Interval& v, Interval& twin) { evaluate(Function<op>(), u, v, twin); }
  static void putLeading(Series& s, int x) { putPoint<op>(s, x); }

  static void series(Series& s, int x) {
    beginRow(s, x);
    for (int g = 1; g < plan(s, x).count; ++g) putRow(s, x, g);
  }
  /// v_i = Σ_{j≥1} j u_j w_{i-j} / i
  static void order(Series& s, int x, int i) {
    const SeriesNode& v = plan(s, x);
    s.clearOrder(v, i);
    if (hasTwin(op)) s.clearOrder(plan(s, x + 1), i);
    const double* slope = s.putSlope(plan(s, v.a), i);
    const auto put = [&](auto e) {
      const double* sum = s.convolved(v, i, slope, plan(s, x + e.factor));
      for (int g = 0; g < s.plan_.countOf(v, i); ++g) s.put(plan(s, x + e.target), g, i, e.sign * sum[g] / i);
    };
    (put(Equations()), ...);
  }
  GAMUT_INLINE static void thinOrder(const Thin* v, int x, int i, double* cur) {
    const Thin& a = v[v[x].a];
    const double slope = i * cur[v[x].a];
    const auto put = [&](auto e) __attribute__((always_inline)) {
      const Thin& w = v[x + e.factor];
      cur[x + e.target] = e.sign * (kernels::thinDot(a.derivative, w.reversed, i) + slope * w.forward[0]) / i;
    };
    (put(Equations()), ...);
  }
  static void lane(Series& s, int x, int i, int q) {
    const int a = plan(s, x).a;
    const double* of = s.lane(a, i);
    const auto put = [&](auto e) {
      double* out = s.lane(x + e.target, i);
      const double* w = s.series(x + e.factor);
      if (i == 0) return setLanes(out, [&](int l) { return e.sign * (out[l] / q + of[l] * w[0]); });
      kernels::convolveLanes(s.slope(a), 1, i, s.lane(x + e.factor, 0), i, out);
      kernels::convolveLanes(w, 0, i - 1, s.slopeLane(a), i, out);
      setLanes(out, [&](int l) { return e.sign * out[l] / i; });
    };
    (put(Equations()), ...);
  }

 protected:
  /// The coefficient of 1, and none of u'.
  static void beginRow(Series& s, int x) {
    const SeriesNode& a = plan(s, plan(s, x).a);
    putPoint<op>(s, x);
    for (int g = 0; g < a.count; ++g) s.slopes(a, g)[0] = 0.0;
  }
  /// Monomial g > 0 of v, the integral of u' w along ξ: Σ grade(p) u_p w_r / grade(g).
  static void putRow(Series& s, int x, int g) {
    const SeriesNode& a = plan(s, plan(s, x).a);
    const auto put = [&](auto e) {
      const double sum = s.sumOverPairs(g, [&](int p, int r) {
        return s.plan_.monomials->grade(p) * coefficient(s, a, p) * coefficient(s, plan(s, x + e.factor), r);
      });
      s.put(plan(s, x + e.target), g, 0, e.sign * sum / s.plan_.monomials->grade(g));
    };
    (put(Equations()), ...);
  }
};

}  // namespace gamut
