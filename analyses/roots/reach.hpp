// Which values y of some outputs states x of a region come to, y = f(x, p), for all parameters p of a box: a grid of
// cells of y is divided into those that are reached whatever p is, and those that are not, whatever p is, with proof.
//
// The grid is halved from the whole down to single cells. A part Y of it keeps the boxes X of states that may come to
// it: they lose what does not, by hull consistency and by the mean value theorem, which for any row u of factors says
// of F(z) = f(x, p) - y, with z = (x, y, p) and its middle m,
//
//   u·F(z) in u·F(m) + Σ_j (u·∂F/∂z_j)(z_j - m_j):
//
// where that misses zero X does not come to Y, else it bounds each x_j (Gauss and Seidel). Rows u come from Gauss's
// elimination of the middle Jacobian: the last is nearly at right angles to what outputs can do where it is nearly
// singular, as on the border of what is reached, so that what is lost there grows with the square of X. Where no X is
// left, Y is never reached.
//
// Y is always reached where as many states as there are rows, the others held in the region, have a root for each (y,
// p) of Y × P (RootEquations::prove), in the region, or anywhere in those that a whole turn leaves the same. Which
// states and about which place is tried in doubles.
//
// What neither is proved of stays unknown: cells on the border of what is reached, those that are reached for some p
// alone, and what work leaves.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

enum class Reached : std::int8_t { never = -1, unknown = 0, always = 1 };

struct ReachSearch {
  std::vector<int> cells;     ///< of each output, at least 1
  Box inner;                  ///< of each state, within the region: where proofs keep to; an empty side is a number
                              ///< somewhere in its region, for all of which they are
  std::vector<bool> turning;  ///< of each state: f is the same a whole turn on, and its side of the region is one
  std::size_t mostBoxes = 3000000;  ///< of states: behind so many none is cut
  const std::atomic<bool>* cancelled = nullptr;
};

struct Reach {
  std::vector<std::vector<double>> edges;  ///< of the cells, of each output, rising
  std::vector<Reached> cells;              ///< those of the first output in rows, of the last one beside each other
  std::size_t boxes = 0;                   ///< that were looked at
  bool isWhole = true;                     ///< nothing ended it
};

/// `f`: one value for each side of the grid, one or two, then rows that are to be zero (loops), not more in all than
/// states. Region, parameters and grid are bounded. Throws std::invalid_argument, saying what does not fit.
Reach reach(const Program& f, const Box& region, const Box& parameters, const Box& grid, const ReachSearch& search);

/// What the first so many outputs of `f` are in, over the region and the parameters: as close as some hundred parts of
/// the region tell, and then a coarse grid, of which the cells that are never reached are left out; `search` as there.
Box outputsOver(const Program& f, std::size_t outputs, const Box& region, const Box& parameters, ReachSearch search);

}  // namespace gamut
