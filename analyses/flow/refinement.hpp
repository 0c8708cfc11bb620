// A run of the flow, repeated until it is as tight as was asked for. docs/flow.md, section 4.
#pragma once

#include <vector>

#include "analyses/flow/task.hpp"

namespace gamut {

/// Loosely first, then as the remainder's share of the widths asks; every run is proved, so that the results are
/// intersected. `looseness`: that share, of the last run.
Tube refine(const FlowQuestion& question, const Box& box, const std::vector<Box>& levels, double& looseness);

}  // namespace gamut
