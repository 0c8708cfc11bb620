// The double pendulum once more, independent of everything else here: the published equations, Taylor series written by
// hand, in quadruple precision (113 bits). Nothing of the flow's, the recorder's or the mechanics' code takes part.
#pragma once

#include <array>
#include <vector>

namespace gamut::campaigns {

__extension__ typedef __float128 Quad;

/// Point masses m1, m2 on massless rods l1, l2 under gravity g; the second angle is relative to the first, angles count
/// from the downward vertical.
struct PendulumData {
  Quad l1, l2, m1, m2, g;
  std::array<Quad, 4> start;  ///< ψ1, ψ2 [rad], their rates [rad/s]
};

/// The states at `times` (rising, s). `order` of the Taylor series; the truncation of a step is below 1e-31 of the
/// state.
std::vector<std::array<Quad, 4>> quadrupleTrajectory(const PendulumData& data, const std::vector<double>& times,
                                                     int order = 26);

}  // namespace gamut::campaigns
