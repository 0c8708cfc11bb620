// t = tanh u, s = sech² u: t' = u' s, s = 1 - t².
#pragma once

#include "analyses/flow/series/operations/flow_function.hpp"

namespace gamut {

template <>
struct FlowFunction<Op::tanh> : SlopeProducts<Op::tanh, SlopeEquation<0, 1, 1>> {
  using Slope = SlopeProducts<Op::tanh, SlopeEquation<0, 1, 1>>;
  static constexpr bool isConvex = false;
  static void products(int x, int a, int b, const auto& add) {
    Slope::products(x, a, b, add);
    add(x, x, x + 1);
  }

  static void values(const Interval& u, Interval& tangent, Interval& slope) {
    const double far = std::min(magnitude(u), 1e300);  // both are 0 there, but for rounding
    const Interval e = exp(Interval(-2 * far));
    tangent = tanh(u);
    slope = 4.0 * e / sqr(1.0 + e);  // not 1 - tanh²: to its own digits, however small
  }
  static void series(Series& s, int x) {
    const SeriesNode& v = plan(s, x);
    beginRow(s, x);
    for (int g = 1; g < v.count; ++g) {
      putRow(s, x, g);
      const auto product = [&](int p, int r) { return coefficient(s, v, p) * coefficient(s, v, r); };
      s.put(plan(s, x + 1), g, 0, -s.sumOverPairs<0>(g, product));
    }
  }
  /// s_i = -Σ t_j t_{i-j}
  static void order(Series& s, int x, int i) {
    const SeriesNode& v = plan(s, x);
    Slope::order(s, x, i);
    const double* sum = s.convolved(v, i, s.series(v), v);
    for (int g = 0; g < s.plan_.countOf(v, i); ++g) s.put(plan(s, x + 1), g, i, -sum[g]);
  }
  GAMUT_INLINE static void thinOrder(const Thin* v, int x, int i, double* cur) {
    Slope::thinOrder(v, x, i, cur);
    cur[x + 1] = -(kernels::thinDot(v[x].forward, v[x].reversed, i) + 2 * (v[x].forward[0] * cur[x]));
  }
  static void lane(Series& s, int x, int i, int q) {
    Slope::lane(s, x, i, q);
    double *slope = s.lane(x + 1, i), sum[lanes] = {};
    kernels::convolveLanes(s.series(x), 0, i, s.lane(x, 0), i, sum);
    setLanes(slope, [&](int l) { return -(slope[l] + 2 * sum[l]); });
  }

  /// κ = |s̃ - (1 - t̂²)|, t̂ = t̃ + tanh u_00 - t_00: the constants of both cancel but for their own errors, and the
  /// others are sums of N ≤ weights products, in which t_00 meets only what is not constant.
  static SeriesError ownErrors(Series& s, int x) {
    const SeriesNode& v = plan(s, x);
    const double weighted = s.weightedRest(x);
    const double kappa0 = s.pointError_[x + 1] + 2 * s.pointError_[x] * s.rest(x) +
                          bounds::unit * weighted * (2 * s.leading(x) + weighted) +
                          (s.isGraded() ? s.tailDegree(x, x, v.degree, 0) : 0.0);
    const double own0 = s.own_[x + 1].e0 = kappa0 * bounds::up + bounds::tiny;
    const double own1 = s.own_[x + 1].e1 = s.tailTime(x, x) * bounds::up;
    const SeriesError e = s.differentialErrors(v.a, x + 1, v.degree);
    return {e.e0 + s.rest(v.a) * own0, e.e1 + s.rest(v.a) * own1};
  }

  /// T = tanh ũ and t̂ = t̃ + tanh u_00 - t_00 are equal where the path of rest() begins; from there on e = t̂ - T obeys
  /// e' = defect + ũ'(s̃ - (1 - t̂²)) - ũ'(t̂ + T) e, the first two of which are own, and |t̂ + T| ≤ 2|T| + |e|. With V =
  /// rest(u), |T| ≤ |ũ| ≤ |u_00| + V and Δ = own·e^{2V|T|}: |e| ≤ Δ e^{2VΔ} as long as that is below 2Δ. Besides, tanh
  /// u and tanh u_00 are less than 2e^{-2a} apart, if |u| ≥ a for all u and they have one sign (a = 0: or not), and 0 <
  /// sech² u ≤ 4e^{-2a}: bounds that hold whatever the polynomials are.
  static bool bound(Series& s, int x, const Operands&) {
    const int u = plan(s, x).a, slope = x + 1;
    const auto upperExp = [](double y) { return exp(Interval(y)).upper(); };
    const double leading = s.leading(u), V = s.rest(u) * bounds::up, rho0 = s.rho_[u].e0, rho1 = s.rho_[u].e1;
    const double rho = (rho0 + rho1) * bounds::up;
    const double least = std::max(0.0, (leading - V - rho) * bounds::down - bounds::unit * leading);
    const double decay = upperExp(-2 * least), steepest = std::min(1.0, 4 * decay);
    const auto set = [&](int which, double z0, double z1, double whatever) {
      const bool isProved = z0 + z1 <= whatever;
      s.rho_[which].e0 = (isProved ? z0 : whatever) * bounds::up + bounds::tiny;
      s.rho_[which].e1 = isProved ? z1 * bounds::up : 0.0;
      return isProved;
    };
    double growth = upperExp(2 * V * std::min(1.0, leading + V) * bounds::up);
    const double own0 = s.own_[x].e0, own1 = s.own_[x].e1, delta = (own0 + own1) * growth * bounds::up;
    growth *= 2 * V * delta <= 0.69 ? upperExp(2 * V * delta * bounds::up) : HUGE_VAL;
    const double e0 = own0 * growth, e1 = own1 * growth, range = s.rest(x) + 2 * decay;
    const bool isFollowed =
        set(x, s.pointError_[x] + e0 + steepest * rho0, e1 + steepest * rho1, s.pointError_[x] + range);
    if ((isFollowed ? e0 : range) > bounds::unit) {
      // A shorter step helps: u may go where tanh is ±1 to the last digit, or about as far as the pole at ±iπ/2 lets
      // it.
      constexpr double saturated = 19;  // 2e^{-2·19} < 2^-53
      const double most = std::max(isFollowed ? 2.0 : 0.5, leading - (V - s.moved(u)) - rho - saturated);
      s.haste_ = std::max(s.haste_, s.moved(u) / most);
    }
    // 1 - t̂² - (1 - T²) = -e(2T + e), |(sech²)'| = 2|tanh| sech² < 0.77; sech² u and sech² u_00 lie in [0, steepest].
    const double twice = 2 + (e0 + e1), tilt = std::min(0.77, 2 * steepest), own = s.own_[slope].e0;
    set(slope, own + twice * e0 + tilt * rho0, s.own_[slope].e1 + twice * e1 + tilt * rho1,
        s.pointError_[slope] + s.rest(slope) + steepest);
    return s.isBelowLargest(x);
  }
};

/// All with its tanh.
template <>
struct FlowFunction<Op::sech2> : FlowFunction<Op::tanh> {
  static bool bound(Series& s, int x, const Operands&) { return s.isBelowLargest(x); }
};

}  // namespace gamut
