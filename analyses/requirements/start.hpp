// Margins that are zero at the start and rise from there: what the polynomials of a step cannot tell, since they are
// known to some roundings.
#pragma once

#include <memory>
#include <vector>

#include "analyses/flow/models.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// The same models with narrower bounds at the start, and along the first chords: of the outputs of g that the models
/// hold first. `box`: initial values, then parameters, as of the flow that the models are of, ẋ = f(t, x, p)
/// with constant p.
std::shared_ptr<const FlowModels> sharpenedAtStart(const std::shared_ptr<const FlowModels>& models, const Program& f,
                                                   const Program& g, const std::vector<int>& outputs, const Box& box);

}  // namespace gamut
