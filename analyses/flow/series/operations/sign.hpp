// The sign of u: a number in outputs of jumps, by polynomials in none.
#pragma once

#include "analyses/flow/series/operations/flow_function.hpp"

namespace gamut {

template <>
struct FlowFunction<Op::sign> : AnyFlowFunction {
  static constexpr bool isConvex = false;

  static void putLeading(Series& s, int x) { s.put(plan(s, x), 0, 0, s.signOf(x)); }
  static void row(Series& s, int x) {
    order(s, x, 0);
    putLeading(s, x);
  }
  static void order(Series& s, int x, int i) {
    const Plan& v = plan(s, x);
    for (int g = 0; g < s.countOf(v, i); ++g) s.put(v, g, i, 0.0);
  }
  GAMUT_INLINE static void thinOrder(const Thin*, int x, int, double* cur) { cur[x] = 0; }

  static Errors ownErrors(Series&, int) { return {}; }
  static bool bound(Series& s, int x, const Operands&) {
    s.boundSign(x);
    return true;
  }
};

}  // namespace gamut
