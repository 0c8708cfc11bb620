// The sign of u: a number in outputs of jumps, by polynomials in none.
#pragma once

#include "analyses/flow/series/operations/flow_function.hpp"

namespace gamut {

template <>
struct FlowFunction<Op::sign> : AnyFlowFunction {
  static constexpr bool isConvex = false;

  static void putLeading(Series& s, int x) { s.put(plan(s, x), 0, 0, s.signOf(x)); }
  static void series(Series& s, int x) {
    order(s, x, 0);
    putLeading(s, x);
  }
  static void order(Series& s, int x, int i) {
    const SeriesNode& v = plan(s, x);
    for (int g = 0; g < s.plan_.countOf(v, i); ++g) s.put(v, g, i, 0.0);
  }
  GAMUT_INLINE static void thinOrder(const Thin*, int x, int, double* cur) { cur[x] = 0; }

  static SeriesError ownErrors(Series&, int) { return {}; }
  /// Exact on one side, else anything between -1 and 1.
  static bool bound(Series& s, int x, const Operands&) {
    const int u = plan(s, x).a;
    const SeriesKinks::Kink& kink = s.kinks_[x];
    const double value = s.series(x)[0];
    double radius = 0;
    if (s.isAlong_ && kink.isApart) {
    } else if (kink.given) {
      s.mayCross(u);  // for what it reaches
      radius = magnitude(*kink.given - Interval(value));
    } else {
      const bool isOnOneSide = s.kinks_.argument(u).side != 0;
      if (!isOnOneSide && (s.mayCross(u) || std::fabs(value) != 1)) radius = 1 + std::fabs(value);
      if (plan(s, x).primary) radius = s.kinks_.widenJump(x, radius);
    }
    s.rho_[x] = {radius * bounds::up, 0};
    return true;
  }
};

}  // namespace gamut
