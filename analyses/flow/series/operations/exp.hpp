// e = exp u: e' = u' e.
#pragma once

#include "analyses/flow/series/operations/flow_function.hpp"

namespace gamut {

template <>
struct FlowFunction<Op::exp> : SlopeProducts<Op::exp, SlopeEquation<0, 0, 1>> {
  static constexpr std::string_view edge = "an exponential that may become too large";

  static SeriesError ownErrors(Series& s, int x) {
    SeriesError e = s.differentialErrors(plan(s, x).a, x, plan(s, x).degree);
    e.e0 += s.pointError_[x];
    return e;
  }
  /// ẽ' = ũ'ẽ + defect grows by at most e^{osc}, osc ≤ 2 Σ_{(i,α)≠0}|u_{iα}|θ^i; e^{u} - e^{ũ}: (e^ρ-1) ≤ e^ρ ρ.
  static bool bound(Series& s, int x, const Operands& of) {
    const int a = plan(s, x).a;
    const double own0 = s.own_[x].e0, own1 = s.own_[x].e1, r = of.r(a), way = s.rest(a);
    if (!(way < 300 && r < 300)) return false;
    const double growth = exp(Interval(2 * way * bounds::up)).upper();
    const double tilt = (s.norm_[x] + (own0 + own1) * growth) * exp(Interval(r * bounds::up)).upper();
    return s.setBounds(x, {own0 * growth + tilt * of.r0(a), own1 * growth + tilt * of.r1(a)});
  }
};

}  // namespace gamut
