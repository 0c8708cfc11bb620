// The equations of motion as a sparse linear system. Every chain is cut at each joint: the accelerations ω̇', a' of the
// frame that the joint moves and the force f', τ' that acts on it are unknowns beside q̈. doMotion gives the first from
// those of the cut before, doForce the second from those behind and from the bodies' inertia, and Q = 0 closes the
// system; where loops close, their multipliers are unknowns too, and their rows equations. Its entries hold the
// geometry of one joint each, so that little is multiplied up along a chain, and errors of a solution are bounded by
// what single joints leave over: seven-joint arm, free fall of 0.5 s from a thin start: width 3e-10, with the inertia
// matrix 7e-10; chain of ten links: reached 2 s, with the inertia matrix 0.4 s.
#pragma once

#include <vector>

#include "mechanics/equations/system.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

/// q̈ at the present positions and rates, recorded as a solution of this system, or of what is left of it when unknowns
/// that merely copy or add others are eliminated (LinearReduction).
std::vector<Recorded> sparseAccelerations(System<Recorded>& system);

}  // namespace gamut
