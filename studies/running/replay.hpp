// One sample of a study again, from what its results say of the run: bit for bit as it went into the statistics.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analyses/table.hpp"
#include "studies/machine.hpp"
#include "studies/results/results.hpp"

namespace gamut {

struct ReplayedSample {
  std::vector<double> values;  ///< of the uncertain quantities, in the study's order
  Table trajectory;            ///< times x outputs; NaN beyond the last time reached
  std::size_t times = 0;       ///< number of output times reached
  double reached = 0;          ///< s
  std::string why;             ///< why that is not all; empty if it is
  /// It seemed to leave what is proved and was integrated again, as said in DisputedSample::decided; empty if not.
  std::string decided;
};

/// Sample `number`, from 0: the plan's samples, then the corners, those of the alpha-cuts, the centre, the points
/// inside the cuts. `machine` is that of results.studyText. Limits and threads of the run play no part: a sample that a
/// limit of time ended comes to its end here. One that seemed to leave what is proved is settled as in the run. Throws
/// std::invalid_argument for results without samples and for a number that no sample has.
ReplayedSample replay(const Machine& machine, const Results& results, std::size_t number);

/// A motion that violates a requirement: of the values for which that is proved, or of the sample that violates it in
/// simulation. What varies in time keeps to the course of its nominal value where any will do. Throws
/// std::invalid_argument where no such motion is known.
ReplayedSample replayViolation(const Machine& machine, const Results& results, const RequirementResult& requirement);

}  // namespace gamut
