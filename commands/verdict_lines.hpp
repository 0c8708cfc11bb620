// The verdict as commands print it.
#pragma once

#include <cstdio>

#include "reports/verdict.hpp"

namespace gamut {

/// The requirements, if there are any: a sentence, then each with its three answers.
void printRequirements(std::FILE* stream, const Results& results);

/// The sentence, then its notes, a line each.
void printVerdict(std::FILE* stream, const Verdict& verdict);

}  // namespace gamut
