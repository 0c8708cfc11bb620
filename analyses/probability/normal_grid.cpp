#include "analyses/probability/normal_grid.hpp"

#include <cmath>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/normal_distribution.hpp"

namespace gamut {
namespace {

/// Φ at the nodes, to multiples of 2^-52, so that differences are exact; the first is 0, the last 1. Two cells share a
/// node's error, and two nodes are alike; what is beyond the ends is theirs.
struct NormalNodes {
  std::vector<double> below = std::vector<double>(NormalGrid::count + std::size_t{1}, 0.0);
  double error = 0;

  NormalNodes() {
    constexpr double grain = 0x1p-52;
    for (std::size_t i = 0; i <= NormalGrid::count / 2; ++i) {
      const Interval known = normalBelow(Interval(NormalGrid::at(i)));
      const double p = i == 0 ? 0 : std::round(midpoint(known) / grain) * grain;
      below[i] = p, below[NormalGrid::count - i] = 1 - p;
      error += 4 * magnitude(known - p);
    }
    error *= bounds::up;
  }
};

const NormalNodes& normalNodes() {
  static const NormalNodes nodes;
  return nodes;
}

}  // namespace

const std::vector<double>& NormalGrid::below() { return normalNodes().below; }

double NormalGrid::error() { return normalNodes().error; }

}  // namespace gamut
