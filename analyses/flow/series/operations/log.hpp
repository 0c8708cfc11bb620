// l = log u: l' u = u'.
#pragma once

#include "analyses/flow/series/operations/flow_function.hpp"

namespace gamut {

template <>
struct FlowFunction<Op::log> : SlopeQuotient<Op::log> {
  static constexpr std::string_view edge = "the logarithm of what may be zero or negative";

  /// The defect over min|ũ|, and |log u - log ũ| ≤ ρ_u / min|u|.
  static bool bound(Series& s, int x, const Operands& of) {
    const int a = plan(s, x).a;
    const double below = (s.minimum(a) - of.r(a) * bounds::up) * bounds::down;
    if (!(below > 0)) return false;
    return s.setBounds(x, {s.pointError_[x] + (s.own_[x].e0 + of.r0(a)) / below, (s.own_[x].e1 + of.r1(a)) / below});
  }
};

}  // namespace gamut
