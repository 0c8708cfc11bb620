// The ranks among which this program was started, by mpirun or srun: those of one run of a study.
#pragma once

#include <exception>
#include <functional>

#include "analyses/communicator.hpp"
#include "commands/options.hpp"

namespace gamut {

/// Null where it was started alone.
Communicator* ranks();
/// Of the whole program, before any command.
void setRanks(Communicator* communicator);
inline bool isFirstRank() { return ranks() == nullptr || ranks()->isFirst(); }

/// Which of how many this process is, as whoever started it says in its environment; 0 of 1: alone.
struct StartedAs {
  int rank = 0, count = 1;
};
StartedAs startedAs();

/// Does what has to succeed on all ranks before they go on together: where it fails on one, it does on all, with that
/// one's words. Throws what `task` does, or UsageError.
void onAllRanks(const std::function<void()>& task);

}  // namespace gamut
