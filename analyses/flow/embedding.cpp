// Boxes in symbols.
#include "analyses/flow/embedding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

Embedding::Embedding(const Box& box) {
  for (const Interval& value : box) {
    Embedded e;
    e.centre = midpoint(value);
    e.radius = isThin(value) ? 0.0 : radius(value);
    // Widths of the order of rounding are carried by the remainder; wider ones get a symbol.
    if (e.radius > 1e-13 * std::fabs(e.centre)) {
      e.half = e.radius;
      e.radius = 0;
      e.symbol = symbols++;
      widest = std::max(widest, e.half < std::fabs(e.centre) ? e.half / std::fabs(e.centre) : 1.0);
    }
    components.push_back(e);
  }
}

bool restrictTo(const Box& level, const Embedding& embedding, const std::vector<double>& centre,
                const std::vector<double>& half, Box& xi) {
  for (std::size_t i = 0; i < level.size(); ++i) {
    const Embedded& e = embedding.components[i];
    if (e.symbol < 0) continue;
    const Interval study = (level[i] - Interval(e.centre)) / Interval(e.half);
    const Interval own = (study - Interval(centre[at(e.symbol)])) / Interval(half[at(e.symbol)]);
    const Interval part = intersection(own, Interval(-1.0, 1.0));
    if (isEmpty(part)) return false;
    xi[at(e.symbol)] = part;
  }
  return true;
}

std::vector<int> degreeLadder(int symbols) {
  if (symbols == 0) return {0};
  static constexpr int highest[] = {0, 16, 10, 8, 6, 6, 6, 4, 4, 3, 3, 3, 3};
  const int last = symbols < 13 ? highest[symbols] : symbols <= 60 ? 2 : 1;  // (k+1)(k+2)/2 monomials of degree 2
  std::vector<int> ladder;
  for (int degree : {2, 4, 6, 8, 12, 16})
    if (degree < last) ladder.push_back(degree);
  ladder.push_back(last);
  return ladder;
}

int automaticFrameDegree(int symbols, int degree) {
  return std::min(degree, symbols == 1 ? 4 : symbols <= 3 ? 2 : symbols <= 8 ? 3 : 1);
}

Interval inflated(const Interval& range, double radius) {
  if (!(radius < std::numeric_limits<double>::infinity())) return Interval::entire();
  return range + Interval(-radius, radius);
}

void requireThat(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument(what);
}

void requireNested(const Box& box, const std::vector<Box>& levels) {
  for (const Interval& value : box)
    requireThat(!isEmpty(value) && isBounded(value), "every interval of the box must be bounded");
  const Box* outer = &box;
  for (const Box& level : levels) {
    requireThat(level.size() == box.size(), "a sub-box needs as many components as the box");
    for (std::size_t i = 0; i < level.size(); ++i)
      requireThat(!isEmpty(level[i]) && isSubset(level[i], (*outer)[i]),
                  "sub-boxes must lie inside the box, each inside the one before");
    outer = &level;
  }
}

void requireNearest() {
  if (!detail::isArithmeticNearest())
    throw std::runtime_error(
        "the flow's bounds need rounding to nearest and subnormal numbers: restore the floating-point environment");
}

}  // namespace gamut
