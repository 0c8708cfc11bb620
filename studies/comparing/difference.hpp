// The comparison of two results: whether they contradict each other, and whether the second is worse than is tolerated.
#pragma once

#include <string>
#include <vector>

#include "studies/comparing/changes.hpp"
#include "studies/comparing/contradictions.hpp"
#include "studies/comparing/relation.hpp"
#include "studies/comparing/shared.hpp"
#include "studies/tolerances.hpp"

namespace gamut {

/// A change for the worse that is beyond what is tolerated.
struct Excess {
  enum class Of { enclosure, alphaCuts, overestimation, gap, reached, requirement, verdict, cpu };

  Of of = Of::enclosure;
  std::string name;            ///< of the output, of the requirement, of the answer; empty otherwise
  double is = 0, allowed = 0;  ///< ratios; of gaps their difference, of times the part that is missing
  double time = 0;             ///< s: of widths, and where an analysis ends
  Both<std::string> words{};   ///< of a requirement and of the verdict
};

struct Difference {
  Shared shared;
  Relation relation;
  Contradictions contradictions;
  Changes changes;
  std::vector<Excess> excesses;

  /// "error": both answer the same question, and one of them is wrong; "incompatible": they contradict each other, but
  /// of different questions; "worse": the second is worse than is tolerated; "agree": none of these.
  std::string word;
};

/// Throws NotComparable where both have nothing in common, std::invalid_argument as findVerdict does.
Difference compareResults(const Results& first, const Results& second, const Tolerances& tolerances = {});

}  // namespace gamut
