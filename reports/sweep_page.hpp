// The page of a sweep: the requirements' three answers over what was varied, as curves of one number, as maps of two,
// and map by map of more.
#pragma once

#include <string>

#include "studies/sweeps/sweep_results.hpp"

namespace gamut {

/// The page as HTML (UTF-8), a single file as of a study's report.
std::string renderSweep(const SweepResults& sweep);

}  // namespace gamut
