// r = 1/u.
#pragma once

#include "analyses/flow/series/operations/flow_function.hpp"

namespace gamut {

template <>
struct FlowFunction<Op::recip> : AnyFlowFunction {
  static constexpr std::string_view edge = "a division by what may be zero";
  static constexpr bool dividesByLeading = true;
  static void products(int x, int a, int, const auto& add) { add(x, a, x); }

  static void putLeading(Series& s, int x) { s.put(plan(s, x), 0, 0, 1.0 / coefficient(s, plan(s, plan(s, x).a), 0)); }
  static void series(Series& s, int x) {
    const SeriesNode& v = plan(s, x);
    const double* inverse = s.invertLeading(x, plan(s, v.a));
    for (int g = 0; g < v.count; ++g) s.put(v, g, 0, inverse[g]);
  }
  /// r_i = -(Σ_{j<i} r_j u_{i-j}) / u_0
  static void order(Series& s, int x, int i) {
    const SeriesNode& v = plan(s, x);
    s.putQuotient<false>(x, i, s.series(v), plan(s, v.a), [](int, double sum) { return -sum; });
  }
  GAMUT_INLINE static void thinOrder(const Thin* v, int x, int i, double* cur) {
    const Thin &n = v[x], &a = v[n.a];
    cur[x] = -(kernels::thinDot(n.forward, a.reversed, i) + n.forward[0] * cur[n.a]) * n.forward[0];
  }
  static void lane(Series& s, int x, int i, int) {
    const SeriesNode& v = plan(s, x);
    double* out = s.lane(x, i);
    const double inverse = s.series(x)[0];
    kernels::convolveLanes(s.series(x), 0, i, s.lane(v.a, 0), i, out);
    kernels::convolveLanes(s.series(v.a), 1, i, s.lane(x, 0), i, out);
    setLanes(out, [&](int l) { return -out[l] * inverse; });
  }

  static SeriesError ownErrors(Series& s, int x) {
    const SeriesNode& v = plan(s, x);
    return {s.productResidual(x, v.a, -1) + (s.isGraded() ? s.tailDegree(x, v.a, v.degree, 0) : 0.0),
            s.tailTime(x, v.a)};
  }
  /// |1 - r̃u| ≤ η < 1 proves u ≠ 0, and |1/u - r̃| = |1 - r̃u|/|u| ≤ η‖r̃‖/(1-η)
  static bool bound(Series& s, int x, const Operands& of) {
    const double norm = s.norm_[x];
    const int a = plan(s, x).a;
    const double eta0 = s.own_[x].e0 + norm * of.r0(a), eta1 = s.own_[x].e1 + norm * of.r1(a);
    const double eta = (eta0 + eta1) * bounds::up;
    if (!(eta < 0.99)) return false;
    const double factor = norm / (1 - eta);
    return s.setBounds(x, {eta0 * factor, eta1 * factor});
  }
};

}  // namespace gamut
