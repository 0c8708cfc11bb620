// What ranks that run something together do at its begin and its end; without a communicator there is nothing to do.
#pragma once

#include <string>

#include "studies/running/run.hpp"

namespace gamut {

class Communicator;

/// With it a run ends, on all ranks.
struct LastOfRanks {
  Communicator* communicator;
  explicit LastOfRanks(Communicator* ranks) : communicator(ranks) {}
  ~LastOfRanks();
  LastOfRanks(const LastOfRanks&) = delete;
  LastOfRanks& operator=(const LastOfRanks&) = delete;
};

/// What the last digits of a rank's numbers depend on: `own`, its program and its processor. Throws
/// std::invalid_argument on all of them unless they are the same on all; `what`: these, in words.
void checkRanks(Communicator* communicator, const std::string& own, const std::string& what);

/// Likewise with the machine, as it was read and assembled, and `own` of a rank.
void checkRanks(const Machine& machine, const RunOptions& options, const std::string& own = "");

/// The first rank's: of memory others may have more or less.
Limits agreedLimits(Limits limits, Communicator* communicator);

/// CPU time, s, is that of all ranks, memory, bytes, that of the one which took most.
void addCostsOfRanks(Communicator* communicator, double& cpu, double& memory);

}  // namespace gamut
