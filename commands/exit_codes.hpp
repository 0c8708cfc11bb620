// What the program returns to its caller, and how it says so to people.
#pragma once

#include "reports/verdict.hpp"

namespace gamut {

enum ExitCode { done = 0, refuted = 1, badInput = 2, endedEarly = 3, failed = 4 };

/// The same in words, for help.
inline constexpr const char* exitCodesText =
    "Exit codes:\n"
    "  0  done, and every sample lies inside its enclosure\n"
    "  1  a sample left its enclosure, or stayed unresolved; with `gamut check --requirements` also: a requirement\n"
    "     is violated; `gamut compare`: the results contradict each other, or the second is worse\n"
    "  2  bad input or usage\n"
    "  3  an analysis ended before its horizon, was interrupted or reached a limit of time or memory, a bound is\n"
    "     infinite, a sample differs from itself by other equations ([witness]) by more than errors explain, or\n"
    "     `gamut check` found nothing to compare; with --requirements also: one is neither proved nor refuted; what\n"
    "     was proved is kept and reported. Any command that was interrupted, but view\n"
    "  4  an internal failure, or something could not be written; results whose page could not be drawn are kept";

/// Throws std::invalid_argument for a verdict whose word has no exit code.
ExitCode exitCode(const Verdict& verdict);

}  // namespace gamut
