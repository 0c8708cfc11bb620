// s = sin u, c = cos u: s' = u' c, c' = -u' s.
#pragma once

#include "analyses/flow/series/operations/flow_function.hpp"

namespace gamut {

template <>
struct FlowFunction<Op::sin> : SlopeProducts<Op::sin, SlopeEquation<0, 1, 1>, SlopeEquation<1, 0, -1>> {
  /// Both from one skew system. The error's Euclidean norm grows by no more than both defects; what crosses from one to
  /// the other is turned by u', of which rest(u) is the integral.
  static SeriesError ownErrors(Series& s, int x) {
    const SeriesNode& v = plan(s, x);
    SeriesError sine = s.differentialErrors(v.a, x + 1, v.degree), cosine = s.differentialErrors(v.a, x, v.degree);
    sine.e0 += s.pointError_[x];
    cosine.e0 += s.pointError_[x + 1];
    const double turned = s.rest(v.a), both0 = sine.e0 + cosine.e0, both1 = sine.e1 + cosine.e1;
    s.own_[x + 1] =
        SeriesError{std::min(both0, cosine.e0 + turned * both0), std::min(both1, cosine.e1 + turned * both1)}.up();
    return {std::min(both0, sine.e0 + turned * both0), std::min(both1, sine.e1 + turned * both1)};
  }
  static bool bound(Series& s, int x, const Operands& of) {
    const int a = plan(s, x).a;
    return s.setBounds(x, {s.own_[x].e0 + of.r0(a), s.own_[x].e1 + of.r1(a)});
  }
};

/// All but `bound` with its sine.
template <>
struct FlowFunction<Op::cos> : FlowFunction<Op::sin> {};

}  // namespace gamut
