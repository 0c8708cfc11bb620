// What results tell of a study's margins: what is limited, and where.
#pragma once

#include <vector>

#include "studies/results/requirements.hpp"
#include "studies/study.hpp"

namespace gamut {

/// Of all requirements, one after the other.
std::vector<MarginInfo> marginsOf(const Study& study);

}  // namespace gamut
