// What is possible.
#pragma once

#include <vector>

#include "analyses/table.hpp"
#include "studies/results/answer.hpp"

namespace gamut {

/// Alpha-cuts, level 0 the widest.
struct FuzzyResult : Answer {
  std::vector<double> alpha;
  std::vector<Envelope> outer;  ///< proved, one a level
  std::vector<Envelope> inner;  ///< of the samples with at least this membership, one a level (empty without samples)
};

/// Adds the group of this part.
void describe(FuzzyResult& fuzzy, std::vector<Group>& groups);

}  // namespace gamut
