// r = √u: r r = u.
#pragma once

#include "analyses/flow/series/operations/flow_function.hpp"

namespace gamut {

template <>
struct FlowFunction<Op::sqrt> : AnyFlowFunction {
  static constexpr std::string_view edge = "the square root of what may be zero or negative";
  static constexpr bool dividesByLeading = true, measuresResidual = true;
  static void products(int x, int, int, const auto& add) { add(x, x, x); }

  static void putLeading(Series& s, int x) {
    s.put(plan(s, x), 0, 0, std::sqrt(coefficient(s, plan(s, plan(s, x).a), 0)));
  }
  static void series(Series& s, int x) {
    const SeriesNode &v = plan(s, x), &a = plan(s, v.a);
    const double root = std::sqrt(coefficient(s, a, 0));
    s.put(v, 0, 0, root);
    for (int g = 1; g < v.count; ++g) {
      const double sum =
          s.sumOverPairs(g, [&](int p, int r) { return r == 0 ? 0.0 : coefficient(s, v, p) * coefficient(s, v, r); });
      s.put(v, g, 0, (coefficient(s, a, g) - sum) / (2 * root));
    }
    s.invertLeading(x, v);
  }
  /// r_i = (u_i - Σ_{0<j<i} r_j r_{i-j}) / (2 r_0)
  static void order(Series& s, int x, int i) {
    const SeriesNode &v = plan(s, x), &a = plan(s, v.a);
    s.putQuotient<false>(x, i, s.series(v), v,
                         [&](int g, double sum) { return 0.5 * (coefficient(s, a, g, i) - sum); });
  }
  GAMUT_INLINE static void thinOrder(const Thin* v, int x, int i, double* cur) {
    const Thin& n = v[x];
    cur[x] = 0.5 * (cur[n.a] - kernels::thinDot(n.forward, n.reversed, i)) / n.forward[0];
  }
  static void lane(Series& s, int x, int i, int) {
    double *out = s.lane(x, i), sum[lanes] = {};
    const double *of = s.lane(plan(s, x).a, i), half = 0.5 / s.series(x)[0];
    kernels::convolveLanes(s.series(x), 1, i, s.lane(x, 0), i, sum);
    setLanes(out, [&](int l) { return (of[l] - out[l] - 2 * sum[l]) * half; });
  }

  static SeriesError ownErrors(Series& s, int x) {
    const SeriesNode& v = plan(s, x);
    const double left = s.isGraded() ? s.tailDegree(x, x, v.degree, 0) + s.dropped(v.a, v.degree) : 0.0;
    return {s.productResidual(x, x, v.a) + left, s.tailTime(x, x)};
  }
  /// |√u - r̃| = |u - r̃²|/(√u + r̃)
  static bool bound(Series& s, int x, const Operands& of) {
    const int a = plan(s, x).a;
    const double least = s.minimum(a) - of.r(a) * bounds::up, own = s.minimum(x);
    if (!(least > 0 && own > 0)) return false;
    const double below = (own + std::sqrt(least)) * bounds::down;
    return s.setBounds(x, {(s.own_[x].e0 + of.r0(a)) / below, (s.own_[x].e1 + of.r1(a)) / below});
  }
};

}  // namespace gamut
