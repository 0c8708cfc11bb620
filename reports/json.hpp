// What commands say of results to programs: one JSON object.
#pragma once

#include <limits>
#include <string>

#include "studies/results/verdict.hpp"

namespace gamut {

/// Where the run's files lie; empty if there is none.
struct ResultFiles {
  std::string results, report;
  double reportCpu = std::numeric_limits<double>::quiet_NaN();  ///< s: of drawing the page and writing it
};

/// One JSON object on one line; keys: docs/json.md. Numbers are the shortest decimals that give the same double back;
/// what is not finite is null. `finding`: what findVerdict() said of the results.
std::string jsonSummary(const Results& results, const Finding& finding, const ResultFiles& files = {});

}  // namespace gamut
