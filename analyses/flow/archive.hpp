// What of a flow is kept in archives, beside what says so itself.
#pragma once

#include <memory>

#include "analyses/flow/cause.hpp"
#include "analyses/flow/journey.hpp"
#include "analyses/flow/models.hpp"
#include "analyses/flow/series/bounded_polynomial.hpp"
#include "analyses/flow/series/monomials.hpp"
#include "analyses/flow/step/set.hpp"
#include "scalars/archive.hpp"

namespace gamut {

void archive(Archive& all, Monomials& monomials);
std::shared_ptr<Monomials> archived(Archive& all, const Monomials* kind);
void archive(Archive& all, BoundedPolynomial& polynomial);
void archive(Archive& all, FlowCause& cause);
void archive(Archive& all, FlowPart& part);
void archive(Archive& all, OutputModel& model);
void archive(Archive& all, FlowSnapshot& snapshot);
void archive(Archive& all, FlowChord& chord);
void archive(Archive& all, FlowSymbol& symbol);
void archive(Archive& all, FlowModels& models);
void archive(Archive& all, OutputExtremes& extremes);
void archive(Archive& all, FlowSet& set);
void archive(Archive& all, FlowPiece::Known& known);
void archive(Archive& all, FlowPiece& piece);
void archive(Archive& all, FlowCollected& collected);

}  // namespace gamut
