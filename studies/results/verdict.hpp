// Do the answers agree? Found from the numbers of the results alone, so that it can be found again long after the study
// ran: every sampled motion must lie inside what is guaranteed, at every output time, for every output.
//
// There is no tolerance: a sample that seemed outside and was settled inside is stored with its refined motion, which
// lies inside exactly. Only a sample that could not be decided, or was not because of an interrupt, refutes nothing.
#pragma once

#include <cstddef>
#include <limits>
#include <string>

#include "studies/results/results.hpp"

namespace gamut {

/// Samples outside a proved bound: how far, where, and which bound it was.
struct Excursion {
  enum class Bound { enclosure, tube, plainIntervals, alphaCut, probability };

  double distance = 0;  ///< in the unit of its output; of a probability, as such
  std::size_t time = 0, output = 0;
  Bound bound = Bound::enclosure;
  std::int64_t level = -1;  ///< of the alpha-cut; -1 for all others
};

/// What the answers say about each other.
struct Finding {
  /// Why nothing more can be said than how far the samples were inside, or not even that.
  enum class Gap {
    none,
    noAnswers,    ///< samples, or what they could be compared with, were not asked for
    noSample,     ///< none was followed
    noPosition,   ///< kinematics: an analysis ended before it had anything
    undecided,    ///< a disputed sample was left when the run was interrupted
    start,        ///< an analysis ended before the first output time
    unbounded,    ///< what is guaranteed of an output is, somewhere, no finite interval
    end,          ///< the horizon was not reached, not all samples were followed, or numbers are missing
    probability,  ///< the bounds of probabilities were not found to the end
    further,      ///< what was asked for besides was not found to its end, or does not agree
    stopped       ///< a limit or an interrupt kept the run from something else
  };

  Agreement word = Agreement::incomplete;
  double reached = 0;   ///< s: compared up to here
  Excursion excursion;  ///< the farthest that led to "outside" or "unresolved"; distance 0 otherwise
  double overestimation = std::numeric_limits<double>::quiet_NaN();  ///< the greatest found; NaN where none was
  Gap gap = Gap::none;
  bool comparesEnclosure =
      false;                  ///< there were an enclosure and samples; otherwise alpha-cuts and samples, or nothing
  bool endsEarly = false;     ///< an analysis did not come as far as was asked for
  std::size_t compared = 0;   ///< so many numbers were
  std::size_t unbounded = 0;  ///< bounds that are infinite
  Excursion firstUnbounded;   ///< where; its distance says nothing
  /// Independent samples whose shares leave the proved bounds of probability farther than these scatter in 95 of 100
  /// runs, all outputs and times together; a distance of 0: none.
  Excursion unlikely;
  std::size_t missing = 0;  ///< numbers of enclosure or envelope that were not there to compare
};

/// Never throws for missing analyses; throws std::invalid_argument if the shape of a field, or the time or output of a
/// disputed sample, does not fit.
Finding findVerdict(const Results& results);

/// Of which output nothing finite is guaranteed, and when: "nothing finite is guaranteed of x between 1 s and 2 s: …".
/// Empty if there is none.
std::string unboundedText(const Results& results, const Finding& finding);

/// Why not all that was asked for is known: why the run ended, or else what of its answers is missing. Empty if
/// everything is.
std::string whyIncomplete(const Results& results, const Finding& finding);

/// It neither arrived at the horizon nor, where nothing moves, had all that it could have.
bool endsEarly(const Results& results, const Answer& answer);

}  // namespace gamut
