// What was found of the answers, in words.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studies/results/verdict.hpp"

namespace gamut {

/// A finding and what people are told of it.
struct Verdict : Finding {
  std::string sentence;            ///< without markup
  std::vector<std::string> notes;  ///< one sentence each: disputed samples, why an analysis ended, what was missing
  /// Of samples that seemed outside and were found inside: one sentence each, the nearest to its bound first.
  std::vector<std::string> settled;
  std::int64_t settledNote = -1;  ///< number of the note that these belong to; -1: there is none
};

/// Finds the verdict and words it. Where the stored word disagrees, what is found wins and the sentence says so. Throws
/// as findVerdict does.
Verdict judge(const Results& results);

}  // namespace gamut
