// How a box is written in symbols ξ ∈ [-1,1]^k: which components get one, and which part of [-1,1] a sub-box covers.
#pragma once

#include <string>
#include <vector>

#include "analyses/flow/polynomial_series.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// Which box components get a symbol, and how a component is written in it.
struct Embedding {
  std::vector<Embedded> components;  ///< one a box component
  int symbols = 0;
  double widest = 0;  ///< greatest half-width relative to its centre, at most 1

  explicit Embedding(const Box& box);
};

/// The part of [-1,1] of each symbol that a sub-box covers on a piece ξ_study = centre + half·ξ; false if none.
bool restrictTo(const Box& level, const Embedding& embedding, const std::vector<double>& centre,
                const std::vector<double>& half, Box& xi);

/// The degrees that a flow may use for so many symbols: higher ones only as needed, and no more monomials than pay.
std::vector<int> degreeLadder(int symbols);
int automaticFrameDegree(int symbols, int degree);

/// range + [-radius, radius]; the whole line for a radius that is infinite or no number.
Interval inflated(const Interval& range, double radius);

/// Throws std::invalid_argument unless the condition holds.
void requireThat(bool condition, const std::string& what);
/// Throws std::invalid_argument unless the box is bounded and every level lies in the one before, the first in the box.
void requireNested(const Box& box, const std::vector<Box>& levels);
/// Throws std::runtime_error unless this thread rounds to nearest and keeps subnormal numbers, as the flow's bounds
/// ask.
void requireNearest();

}  // namespace gamut
