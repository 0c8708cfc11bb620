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

/// The first word of its card: "met", "violated", "violated in simulation", "open".
std::string stateOf(const RequirementResult& requirement);

/// How bad what is known of one is, 0 the worst: violated, violated for some values, violated in simulation, open, met.
int severityOf(const RequirementResult& requirement);

/// Which of them a page shows, 200 at most, the worst first: of those that some values violate the one of which that
/// may be likeliest, of equals the first.
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

/// " It is met in every case if all tolerances shrink to 58.3 % of what is stated."; empty of one that is met, or where
/// nothing is known of it.
std::string shrinkSentence(const RequirementResult& requirement);

/// "± 2.1 %", "± 0.3 deg", "[19.9, 20.1] kN/m": the interval of a quantity that deviates so many times less, in the
/// form in which the study states it, rounded inward.
std::string narrowedText(const UncertainInfo& quantity, double factor);

/// "if all tolerances shrink to 58.3 % of what is stated, or damper alone from ± 5 % to ± 1.2 %": where it is proved to
/// be met in every case; empty of one that is met, or where nothing is known.
std::string holdsText(const Results& results, const RequirementResult& requirement);

/// " One tolerance alone would do: damper at ± 1.2 % instead of ± 5 %.", or that none would; empty where neither is
/// proved, of one that is met, and of a single quantity.
std::string aloneSentence(const Results& results, const RequirementResult& requirement);

/// "0.0694 to 0.0773", "0.002 at most": the probability that it is violated, proved, rounded outward.
std::string violationProbability(const RequirementResult& requirement);

/// The same as a share of all cases: "6.9 to 7.8 %".
std::string violationShare(const RequirementResult& requirement);

/// Of shares, rounded outward: "6.9 to 7.8 %".
std::string percentRange(double least, double most);

/// "58.3 %", rounded down.
std::string percentText(double share);

/// Whether it is a course in time, not a number: of it a violation holds the number that chooses the course.
bool variesInTime(const UncertainInfo& quantity);

}  // namespace gamut
