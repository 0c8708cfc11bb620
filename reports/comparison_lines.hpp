// The comparison of two results as people read it. "A" is the first of them, "B" the second.
#pragma once

#include <string>

#include "studies/comparing/difference.hpp"

namespace gamut {

/// Whether both answer the same question, in a sentence.
std::string comparisonQuestion(const Difference& difference);

/// Whether they contradict each other, or the second is worse, in a sentence.
std::string comparisonSentence(const Difference& difference);

/// What contradicts, what is worse, what only one of them has and what is not compared: a line each, indented by two
/// blanks.
std::string comparisonNotes(const Difference& difference, const Results& first, const Results& second);

/// All of that, and tables of widths and of the rest; several lines, the last one ended.
std::string comparisonText(const Difference& difference, const Results& first, const Results& second,
                           const Both<std::string>& files);

}  // namespace gamut
