// The box in cells, on each of which a requirement is proved to be met or to be violated, or neither is known.
#pragma once

#include <cstddef>
#include <vector>

#include "analyses/requirements/requirement.hpp"

namespace gamut {

struct DecidedCell {
  FlowPart part;  ///< in the symbols of the models
  Cell::Verdict verdict = Cell::Verdict::open;
};

/// Together they are the box, and overlap in faces alone; `options.mostCells` of them at most. The largest that is open
/// is bisected first, until none is left, or so many are reached, or the work or the memory that options allow.
std::vector<DecidedCell> decidedCells(const FlowModels& models, const CellQuestion& question,
                                      const std::vector<CellQuantity>& quantities, const RequirementOptions& options);

}  // namespace gamut
