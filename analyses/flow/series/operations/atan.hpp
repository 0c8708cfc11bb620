// v = atan u: v' w = u', w = 1 + u².
#pragma once

#include "analyses/flow/series/operations/flow_function.hpp"

namespace gamut {

template <>
struct FlowFunction<Op::atan> : SlopeQuotient<Op::atan> {
  /// 1 + ũ² ≥ 1; w̃ is off 1 + ũ² by its own bound and by u² - ũ²; |atan u - atan ũ| ≤ ρ_u.
  static bool bound(Series& s, int x, const Operands& of) {
    const SeriesNode& v = plan(s, x);
    const double r = of.r(v.a), offW = of.r(v.b) + (2 * s.norm_[v.a] + r) * r;
    return s.setBounds(x,
                       {s.pointError_[x] + s.own_[x].e0 + s.norm_[x] * offW + of.r0(v.a), s.own_[x].e1 + of.r1(v.a)});
  }
};

}  // namespace gamut
