// |u|, by a chord over what u reaches at first: ±u where that is on one side.
#pragma once

#include "analyses/flow/series/operations/flow_function.hpp"

namespace gamut {

template <>
struct FlowFunction<Op::abs> : AnyFlowFunction {
  static constexpr bool isConvex = false;

  static void putLeading(Series& s, int x) {
    const int a = plan(s, x).a;
    const Series::Chord chord = s.chords_[at(x)] = s.chordOf(a);
    s.put(plan(s, x), 0, 0, chord.slope * coefficient(s, plan(s, a), 0) + chord.middle);
  }
  static void row(Series& s, int x) {
    s.chords_[at(x)] = s.chordOf(plan(s, x).a);
    order(s, x, 0);
  }
  static void order(Series& s, int x, int i) {
    const Plan &v = plan(s, x), &a = plan(s, v.a);
    const auto [slope, middle] = s.chords_[at(x)];
    for (int g = 0; g < s.countOf(v, i); ++g)
      s.put(v, g, i, slope * coefficient(s, a, g, i) + (g + i == 0 ? middle : 0.0));
  }
  GAMUT_INLINE static void thinOrder(const Thin* v, int x, int, double* cur) { cur[x] = *v[x].slope * cur[v[x].a]; }

  /// Of a product and, of the constant, a sum.
  static Errors ownErrors(Series& s, int x) {
    const Plan& v = plan(s, x);
    return {(s.chords_[at(x)].isExact() ? 0.0 : 2 * bounds::unit * (s.norm_[at(x)] + s.norm_[at(v.a)])) +
                (s.isGraded() ? s.dropped(v.a, v.degree) : 0.0),
            0};
  }
  static bool bound(Series& s, int x, const Operands&) {
    s.boundAbs(x);
    return s.isBelowLargest(x);
  }
};

}  // namespace gamut
