// The page's tables, as HTML: the uncertain quantities, the figures of every output, the cost, the provenance.
#pragma once

#include <string>

#include "reports/verdict.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// One row an uncertain quantity: its interval, nominal value, distribution and membership.
std::string uncertainTable(const Results& results);

/// One row an output: what is guaranteed, sampled and most possible at the last time all analyses reached, and the
/// overestimation. Guaranteed and possible bounds are printed outward.
std::string figuresTable(const Results& results, const Verdict& verdict);

/// One row an analysis: CPU time and what it bought.
std::string costTable(const Results& results);

/// Version, machine, date, seed, study file, libraries.
std::string provenanceTable(const Results& results);

}  // namespace gamut
