// One page about one study: what was asked, the verdict in words, the figures, the motion of every output, and where
// the numbers come from. A single HTML file that opens from disk without a network, prints, and reads without a script.
#pragma once

#include <string>

#include "studies/results/results.hpp"

namespace gamut {

struct Verdict;

/// The page as HTML (UTF-8). Works from the results alone; an analysis that is absent is left out.
/// Throws std::invalid_argument if a grid's shape does not fit times and outputs. `verdict`: what judge() said of them.
std::string renderReport(const Results& results, const Verdict& verdict);
std::string renderReport(const Results& results);

/// The sentences that lead the page.
std::string leadOf(const Results& results, const Verdict& verdict);

/// Renders and writes the page: beside its place first, then renamed into it, so that nobody sees half a page.
/// Throws std::runtime_error, naming the path, if it cannot be written.
void writeReport(const Results& results, const std::string& path);

}  // namespace gamut
