// What commands say of results to people: lines and tables.
#pragma once

#include <cstddef>
#include <string>

#include "reports/verdict.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// A table of the outputs at the last time reached, and what it cost; several lines, the last one ended.
std::string textSummary(const Results& results);

/// How much of what was found is told, and how wide.
struct SummaryStyle {
  bool isVerbose = false;   ///< everything
  std::size_t columns = 0;  ///< in which sentences are wrapped; 0: a line each
  std::size_t rows = 20;    ///< at most, unless it is verbose: then the last one says how many more there are
};

/// What a run has found, the most important first: what leads, each requirement in the sentence of its card on the
/// page, the worst first, the verdict and its notes, what outputs do, and all else. `lead`: as of leadOf(), or empty.
/// Lines, the last one ended.
std::string runSummary(const Results& results, const Verdict& verdict, const std::string& lead,
                       const SummaryStyle& style);

/// Of that what leads, the requirements, the verdict and its notes.
std::string verdictSummary(const Results& results, const Verdict& verdict, const std::string& lead,
                           const SummaryStyle& style);

/// Where results come from, what was found, this verdict, and every field that they hold.
std::string shortInfo(const Results& results, const std::string& verdict, const SummaryStyle& style);

/// Where results come from and what was found; several lines, the last one ended.
std::string infoText(const Results& results);

/// "normal (mean 0.8, deviation 0.01)", "triangular": the distribution or membership function of an uncertain quantity
/// and its numbers; the support only where it is not the interval, a table without its points.
std::string shapeText(const Results& results, const UncertainInfo& uncertain, ShapeKind shape);

/// Every field that a file of these results holds, as they describe it; several lines, the last one ended.
std::string contentText(const Results& results);

}  // namespace gamut
