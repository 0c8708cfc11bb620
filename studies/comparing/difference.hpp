// The comparison of two results: whether they contradict each other, and whether the second is worse than is tolerated.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "studies/comparing/changes.hpp"
#include "studies/comparing/contradictions.hpp"
#include "studies/comparing/relation.hpp"
#include "studies/comparing/shared.hpp"
#include "studies/tolerances.hpp"

namespace gamut {

/// A change for the worse that is beyond what is tolerated.
struct Excess {
  enum class Of : unsigned char { enclosure, alphaCuts, overestimation, gap, reached, requirement, verdict, cpu };

  Of of = Of::enclosure;
  std::string name;            ///< of the output, of the requirement, of the answer; empty otherwise
  double is = 0, allowed = 0;  ///< ratios; of gaps their difference, of times the part that is missing
  double time = 0;             ///< s: of widths, and where an analysis ends
  Both<std::string> words{};   ///< of a requirement and of the verdict
};

/// As files of tolerances have them.
template <>
inline constexpr std::array<std::string_view, 8> words<Excess::Of>{
    "wider", "alpha_cuts_wider", "overestimation", "gap", "shorter", "requirement", "verdict", "cpu"};

struct Difference {
  enum class Word : unsigned char {
    agree,
    worse,         ///< the second is worse than is tolerated
    incompatible,  ///< they contradict each other, but of different questions
    error          ///< both answer the same question, and one of them is wrong
  };

  Shared shared;
  Relation relation;
  Contradictions contradictions;
  Changes changes;
  std::vector<Excess> excesses;
  Word word = Word::agree;
};
template <>
inline constexpr std::array<std::string_view, 4> words<Difference::Word>{"agree", "worse", "incompatible", "error"};

/// In the units of the first. Throws NotComparable where both have nothing in common, std::invalid_argument as
/// findVerdict does.
Difference compareResults(const Results& first, const Results& second, const Tolerances& tolerances = {});

}  // namespace gamut
