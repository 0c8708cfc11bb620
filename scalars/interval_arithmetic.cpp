// Intervals' products and quotients off the fast path: Boost.Interval's case logic over the directed rounding of
// doubles, for huge, tiny, infinite and empty operands and for division by zero; and the kernels without FMA.
#include "scalars/interval_arithmetic.hpp"

#include "scalars/interval.hpp"

namespace gamut::detail {
namespace {

using Storage = Interval::Storage;

Storage stored(Pair x) { return {x[0], x[1], true}; }
Pair bounds(const Storage& x) { return withPositiveZeros(Pair{x.lower(), x.upper()}); }

}  // namespace

Pair multiplySlow(Pair x, Pair y) noexcept { return bounds(stored(x) * stored(y)); }

/// Division is by the nonzero elements of y: the whole line when zero lies inside y, a half-line when zero is an
/// endpoint of y and x does not change sign, [0, 0] when x = [0, 0], empty when y = [0, 0].
/// (Boost takes x <= 0 that reaches zero for one of both signs; its negative is taken tightly.)
Pair divideSlow(Pair x, Pair y) noexcept {
  return bounds(x[1] == 0 ? -(-stored(x) / stored(y)) : stored(x) / stored(y));
}

Pair squareSlow(Pair ends) noexcept { return Pair{mulDown(ends[0], ends[0]), mulUp(ends[1], ends[1])}; }
Pair squareRootSlow(Pair x) noexcept { return Pair{sqrtDown(x[0]), sqrtUp(x[1])}; }

Pair multiplySplit(Pair x, Pair y) noexcept { return multiply<SplitPairs>(x, y); }
Pair divideSplit(Pair x, Pair y) noexcept { return divide<SplitPairs>(x, y); }

}  // namespace gamut::detail
