// Numbers in symbols.
#include "analyses/flow/series/embedded.hpp"

#include <limits>

#include "scalars/index.hpp"

namespace gamut {

using detail::at;

Interval inflated(const Interval& range, double radius) {
  if (!(radius < std::numeric_limits<double>::infinity())) return Interval::entire();
  return range + Interval(-radius, radius);
}

Interval rangeOf(const Embedded& value) {
  return inflated(inflated(Interval(value.centre), std::fabs(value.half)), value.coarseRadius());
}

Box rangesOf(const std::vector<Embedded>& values) {
  Box ranges;
  for (const Embedded& value : values) ranges.push_back(rangeOf(value));
  return ranges;
}

void halve(std::vector<Embedded>& values, int symbol, double middle) {
  for (Embedded& value : values) {
    if (value.symbol != symbol) continue;
    const double centre = value.centre + value.half * middle;  // the product is exact: a power of two
    value.radius = (value.radius + bounds::unit * std::fabs(centre)) * bounds::up + bounds::tiny;
    value.centre = centre;
    value.half *= 0.5;
  }
}

void halve(std::vector<double>& centre, std::vector<double>& half, int symbol, double middle) {
  if (at(symbol) >= half.size()) return;  // one of a remainder's own
  centre[symbol] += half[symbol] * middle;
  half[symbol] *= 0.5;
}

}  // namespace gamut
