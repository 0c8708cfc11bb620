// Ranks that MPI joins.
#pragma once

#include <memory>

#include "analyses/communicator.hpp"

namespace gamut {

/// Of all that were started together; null where this process was started alone. `onOneMachine`: how many of them are
/// on the machine that this one is on. Throws std::runtime_error if MPI cannot be had.
std::unique_ptr<Communicator> startedByMpi(int& onOneMachine);

}  // namespace gamut
