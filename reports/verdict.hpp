// Do the answers agree? The verdict is found again from the stored numbers alone, so that it can be checked long after
// the study ran: every sampled motion must lie inside what is guaranteed, at every output time, for every output.
//
// There is no tolerance: a sample that seemed outside and was settled inside is stored with its refined motion, which
// lies inside exactly. Only a sample that could not be decided, or was not because of an interrupt, refutes nothing.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "studies/results/results.hpp"

namespace gamut {

/// What a study's answers say about each other.
struct Verdict {
  /// "inside"      every sample lies in the enclosure, over the whole horizon;
  /// "outside"     at least one does not;
  /// "unresolved"  at least one may or may not;
  /// "incomplete"  inside as far as was computed, but the horizon was not reached or nothing could be compared.
  std::string word;
  double reached = 0;    ///< s: compared up to here
  double excursion = 0;  ///< the farthest any sample lies outside, in its output's unit; 0 inside
  double overestimation = std::numeric_limits<double>::quiet_NaN();  ///< the greatest found; NaN where none was
  std::string sentence;                                              ///< for people, without markup
  std::vector<std::string> notes;  ///< one sentence each: disputed samples, why an analysis ended, what was missing
};

/// Judges the results from their grids. Where the stored verdict disagrees, the finding here wins and the sentence says
/// so. Never throws for missing analyses; throws std::invalid_argument if the shape of a grid, or of a disputed sample,
/// does not fit times and outputs.
Verdict judge(const Results& results);

}  // namespace gamut
