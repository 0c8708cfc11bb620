// What commands say of results on standard output: one JSON object for programs, or lines and tables for people.
#pragma once

#include <limits>
#include <string>

#include "studies/results/results.hpp"

namespace gamut {

/// Where the run's files lie; empty if there is none.
struct ResultFiles {
  std::string results, report;
  double reportCpu = std::numeric_limits<double>::quiet_NaN();  ///< s: of drawing the page and writing it
};

/// One JSON object on one line; keys: docs/json.md. Numbers are the shortest decimals that give the same double back;
/// what is not finite is null, and so is an empty verdict.
std::string jsonSummary(const Results& results, const std::string& verdict, const ResultFiles& files = {});

/// A table of the outputs at the last time reached, and what it cost; several lines, the last one ended.
std::string textSummary(const Results& results);

/// Where results come from and what was found; several lines, the last one ended.
std::string infoText(const Results& results);

/// "normal (mean 0.8, deviation 0.01)", "triangular": the distribution or membership function of an uncertain quantity
/// and its numbers; the support only where it is not the interval, a table without its points.
std::string shapeText(const Results& results, const UncertainInfo& uncertain, const std::string& shape);

/// Every field that a file of these results holds, as they describe it; several lines, the last one ended.
std::string contentText(const Results& results);

}  // namespace gamut
