// The ranks among which this program was started, by mpirun or srun: those of one run of a study.
#pragma once

#include <exception>
#include <functional>
#include <stdexcept>
#include <string>

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

/// Does what has to succeed on all ranks before they go on together: where it fails on one, it does on all. The first
/// throws what `task` does there, else, in the words of the first that failed and with its number, UsageError where
/// that refused something, or RankFailed. All others throw UsageError.
void onAllRanks(const std::function<void()>& task);

/// Another rank could not go on, for no fault of the input.
struct RankFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Whether bad input or usage is what it complains of.
bool isRefusal(const std::exception& error);

/// From now on this rank says nothing on its standard streams. Throws std::system_error.
void fallSilent();
/// On what was standard error before that, with the rank's number where there are several: for a rank that ends at
/// once, and all others with it. Unless it is the first it leaves that one two seconds to say so itself.
void sayLast(const std::string& line);

}  // namespace gamut
