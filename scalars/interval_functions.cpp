// sin, cos, tan, exp, log and the inverse functions of intervals, from their bounds at doubles
// (elementary/elementary.hpp). Monotone functions are taken at the endpoints; sin, cos and tan count the multiples of
// pi / 2 between them rigorously. No rounding of the processor's enters but one subtraction, whose direction does not
// matter.
#include <algorithm>

#include "scalars/elementary/elementary.hpp"
#include "scalars/interval.hpp"

namespace gamut {
namespace {

using detail::Bounds, detail::SinCosTurn, detail::TanTurn;

template <Bounds bounds(double)>
Interval increasing(const Interval& x) {
  const Bounds low = bounds(x.lower()), high = isThin(x) ? low : bounds(x.upper());
  return {low.down, high.up};
}

template <Bounds bounds(double)>
Interval decreasing(const Interval& x) {
  const Bounds high = bounds(x.lower()), low = isThin(x) ? high : bounds(x.upper());
  return {low.down, high.up};
}

/// The multiples m pi / 2 in (lower, upper], from floor(2 x / pi) modulo 8 of the endpoints: they are the m from the
/// first floor plus one to the last, and their number is known modulo 8.
class Multiples {
 public:
  /// For endpoints less than 10.9 < 7 pi / 2 apart, so at most 7 multiples; -1 stands for unknown, then none is ruled
  /// out.
  Multiples(int first, int last) : first_(first), number_(first < 0 || last < 0 ? 8 : (last - first) & 7) {}
  /// Whether some m with m modulo 4 = residue is among them.
  bool have(int residue) const { return ((residue - first_ - 1) & 3) < number_; }

 private:
  int first_, number_;
};

/// Whether x is too wide to miss any value of sin, cos and tan (2 pi < 10), or unbounded. In any rounding mode the
/// difference errs by less than 2^-50 of it, so what passes is less than 10.9 wide.
bool isWholeTurn(const Interval& x) { return !(x.upper() - x.lower() < 10); }

/// The range of sin or cos, from its values at the endpoints and whether a maximum or minimum lies between.
Interval range(const Bounds& a, const Bounds& b, bool maximum, bool minimum) {
  return {minimum ? -1.0 : std::min(a.down, b.down), maximum ? 1.0 : std::max(a.up, b.up)};
}

/// sin and cos of an x that is not thin: sin has maxima at m = 1 and minima at m = 3 modulo 4, cos at 0 and 2. They do
/// not coincide with a double, but for cos 0 = 1: its value at the endpoint says so.
SinCos sinCosBetween(const Interval& x) {
  if (isWholeTurn(x)) return {{-1, 1}, {-1, 1}};
  const SinCosTurn a = detail::sinCosTurn(x.lower()), b = detail::sinCosTurn(x.upper());
  const Multiples multiples(a.quadrant, b.quadrant);
  return {range(a.value.sin, b.value.sin, multiples.have(1), multiples.have(3)),
          range(a.value.cos, b.value.cos, multiples.have(0), multiples.have(2))};
}

}  // namespace

Interval exp(const Interval& x) { return isEmpty(x) ? x : increasing<detail::expBounds>(x); }
Interval atan(const Interval& x) { return isEmpty(x) ? x : increasing<detail::atanBounds>(x); }

Interval log(const Interval& x) {
  if (!(x.upper() > 0)) return Interval::empty();
  return increasing<detail::logBounds>({std::max(x.lower(), 0.0), x.upper()});
}

Interval asin(const Interval& x) {
  const Interval domain = intersection(x, {-1, 1});
  return isEmpty(domain) ? domain : increasing<detail::asinBounds>(domain);
}

Interval acos(const Interval& x) {
  const Interval domain = intersection(x, {-1, 1});
  return isEmpty(domain) ? domain : decreasing<detail::acosBounds>(domain);
}

SinCos sinCos(const Interval& x) {
  if (isEmpty(x)) return {x, x};
  if (!isThin(x)) return sinCosBetween(x);
  const auto [sine, cosine] = detail::sinCosBounds(x.lower());
  return {{sine.down, sine.up}, {cosine.down, cosine.up}};
}

Interval sin(const Interval& x) { return sinCos(x).sin; }
Interval cos(const Interval& x) { return sinCos(x).cos; }

/// Increasing between its poles, the odd multiples of pi / 2, which are no doubles.
Interval tan(const Interval& x) {
  if (isEmpty(x)) return x;
  if (isThin(x)) {
    const Bounds value = detail::tanBounds(x.lower());
    return {value.down, value.up};
  }
  if (isWholeTurn(x)) return Interval::entire();
  const TanTurn a = detail::tanTurn(x.lower()), b = detail::tanTurn(x.upper());
  const Multiples multiples(a.quadrant, b.quadrant);
  if (multiples.have(1) || multiples.have(3)) return Interval::entire();
  return {a.value.down, b.value.up};
}

}  // namespace gamut
