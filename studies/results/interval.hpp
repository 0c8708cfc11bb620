// What is guaranteed.
#pragma once

#include <cstdint>
#include <vector>

#include "analyses/table.hpp"
#include "studies/results/answer.hpp"

namespace gamut {

struct IntervalResult : Answer {
  Envelope at;              ///< at the output times
  Envelope over;            ///< row i: over the whole output interval [time(i-1), time(i)] (row 0: at time 0)
  Envelope direct;          ///< kinematics only: the assembly moved by plain intervals, without polynomials
  std::int64_t pieces = 0;  ///< sub-boxes at the end
  std::int64_t steps = 0;
};

/// Adds the group of this part.
void describe(IntervalResult& interval, std::vector<Group>& groups);

}  // namespace gamut
