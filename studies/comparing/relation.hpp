// Whether two results answer the same question: what is proved of one motion says something of the other where both are
// the same motion, and their uncertain quantities may have the same values.
#pragma once

#include <string>
#include <vector>

#include "studies/comparing/shared.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// What is not known is false.
struct Relation {
  bool isSameText = false;  ///< both studies are the same, word for word, with the files that they name
  /// The same equations of motion with the same numbers, but for those that are uncertain in one of them at least.
  bool isSameMotion = false;
  std::vector<char> isSameOutput;        ///< one a shared output: of the same motion, and the same function of it
  std::vector<std::string> differences;  ///< of the motions, in words: "gravity.z: -9.81 m/s^2 in A, -9.5 m/s^2 in B"
  std::string why;                       ///< why that cannot be told; empty if it can
  // Of the same motion: whether all values that the uncertain quantities may have in one they may have in the other,
  // and whether there are some that they may have in both.
  bool isFirstInSecond = false, isSecondInFirst = false, areShared = false;
  bool hasSameDistributions = false, hasSameMemberships = false;  ///< and the same intervals

  bool isSameQuestion() const { return isSameMotion && isFirstInSecond && isSecondInFirst; }
};

Relation relationOf(const Results& first, const Results& second, const Shared& shared);

}  // namespace gamut
