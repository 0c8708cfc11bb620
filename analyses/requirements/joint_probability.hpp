// How probable it is that a requirement is met, where the quantities depend on each other or their distributions are
// not known.
#pragma once

#include <atomic>

#include "analyses/probability/joint_masses.hpp"
#include "analyses/requirements/cells.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// Encloses the probabilities that all joint distributions give; from cells with less than `gap` left to be decided, or
/// some thousand, or as many as so much work (work.hpp) allows.
Interval probabilityOf(Cells& cells, const JointMasses& masses, double gap, double mostWork,
                       const std::atomic<bool>* cancelled);

}  // namespace gamut
