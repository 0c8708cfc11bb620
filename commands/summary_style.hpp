// What was found, as commands print it.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "reports/summary.hpp"

namespace gamut {

/// --verbose, which every command has that sums up.
void addVerbose(CLI::App& command, bool& isVerbose);

/// Everything if it is verbose, otherwise twenty lines with those that the command adds; on a terminal sentences are
/// wrapped.
SummaryStyle summaryStyle(std::FILE* stream, bool isVerbose, std::size_t added = 0);

}  // namespace gamut
