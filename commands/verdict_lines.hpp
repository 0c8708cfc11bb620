// The verdict as commands print it.
#pragma once

#include <cstdio>

#include "reports/verdict.hpp"

namespace gamut {

/// The sentence, then its notes, a line each.
void printVerdict(std::FILE* stream, const Verdict& verdict);

}  // namespace gamut
