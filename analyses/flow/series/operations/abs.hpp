// |u|, by a chord over what u reaches at first: ±u where that is on one side.
#pragma once

#include "analyses/flow/series/operations/flow_function.hpp"

namespace gamut {

template <>
struct FlowFunction<Op::abs> : AnyFlowFunction {
  static constexpr bool isConvex = false;

  static void putLeading(Series& s, int x) {
    const int a = plan(s, x).a;
    const SeriesKinks::Chord chord = s.kinks_[x].chord = s.chordOf(a);
    s.put(plan(s, x), 0, 0, chord.slope * coefficient(s, plan(s, a), 0) + chord.middle);
  }
  static void series(Series& s, int x) {
    s.kinks_[x].chord = s.chordOf(plan(s, x).a);
    order(s, x, 0);
  }
  static void order(Series& s, int x, int i) {
    const SeriesNode &v = plan(s, x), &a = plan(s, v.a);
    const auto [slope, middle] = s.kinks_[x].chord;
    for (int g = 0; g < s.plan_.countOf(v, i); ++g)
      s.put(v, g, i, slope * coefficient(s, a, g, i) + (g + i == 0 ? middle : 0.0));
  }
  GAMUT_INLINE static void thinOrder(const Thin* v, int x, int, double* cur) { cur[x] = *v[x].slope * cur[v[x].a]; }

  /// Of a product and, of the constant, a sum.
  static SeriesError ownErrors(Series& s, int x) {
    const SeriesNode& v = plan(s, x);
    return {(s.kinks_[x].chord.isExact() ? 0.0 : 2 * bounds::unit * (s.norm_[x] + s.norm_[v.a])) +
                (s.isGraded() ? s.dropped(v.a, v.degree) : 0.0),
            0};
  }
  /// |u| - (slope u + middle) is greatest at an end of what u reaches, or where it is zero; the rest is slope (u - ũ).
  static bool bound(Series& s, int x, const Operands&) {
    const int u = plan(s, x).a;
    SeriesKinks::Kink& kink = s.kinks_[x];
    const auto [slope, middle] = kink.chord;
    const SeriesError& rho = s.rho_[u];
    double off = 0;
    const bool isReckonedApart = s.isAlong_ && kink.isApart;
    kink.isSided = kink.chord.isExact();
    if (!isReckonedApart && s.kinks_.argument(u).side == 0 && (s.mayCross(u) || !kink.chord.isExact())) {
      kink.isSided = false;
      const double centre = s.series(u)[0], size = (s.rest(u) + rho.e0 + rho.e1) * bounds::up;
      off = middle;
      for (const double end : {centre - size, centre + size})
        off = std::max(off, std::fabs(std::fabs(end) - (slope * end + middle)));
      off += 8 * bounds::unit * (std::fabs(centre) + size + middle);  // of centre ± size, the chord and the differences
    }
    return s.setBounds(x, {off + s.own_[x].e0 + std::fabs(slope) * rho.e0, std::fabs(slope) * rho.e1});
  }
};

}  // namespace gamut
