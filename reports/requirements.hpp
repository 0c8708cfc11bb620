// What was found of requirements, in words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/results/results.hpp"

namespace gamut {

struct RequirementWords {
  std::string name, demand;  ///< "clearance", "always tip.position.z > 0.2 m, from 0 s to 1 s"
  std::string word;          ///< "met", "violated", "partly", "open", as RequirementResult; "simulated": violated so
  std::string verdict;       ///< in words: "met", "violated for some values", "violated in simulation, not proved"
  std::string guaranteed, probable, possible;  ///< a sentence each, without markup; empty where not asked for
  std::string estimated;  ///< likewise, of what is open where the proof ends before the window; empty elsewhere
};

/// One a requirement.
std::vector<RequirementWords> wordsOfRequirements(const Results& results);

/// Which of them a page shows, rising: all, or, where they are more than 200, the worst: violated ones, then those
/// violated in simulation, open ones, met ones; of equals the first.
std::vector<std::size_t> shownRequirements(const Results& results);

/// "and 35 more in the results file"; empty where all are shown.
std::string unshownRequirements(const Results& results);

/// By how much the violation that is known misses the limit, in the margin's unit and in that in which the limit is
/// stated: "0.273 mm", "0.25 rad (14.3 deg)".
std::string missOf(const Results& results, const RequirementResult& requirement);

/// By how much the worst sample does.
std::string sampledMissOf(const Results& results, const RequirementResult& requirement);

/// "at least 0.9991", "0.974 to 0.984": the probability that it is met, as independent samples let it be estimated,
/// with 95 % confidence; empty where they do not, or need not since it is decided.
std::string estimateOf(const RequirementResult& requirement);

/// What they are together: met if all are, violated if one is, for some values at least, otherwise open.
Decision wordOfRequirements(const Results& results);

/// One sentence about all of them; empty without requirements.
std::string sentenceOfRequirements(const Results& results);

/// Whether it is a course in time, not a number: of it a violation holds the number that chooses the course.
bool variesInTime(const UncertainInfo& quantity);

}  // namespace gamut
