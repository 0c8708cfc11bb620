// Surfaces of jumps that no linear form of the states tells: u(t, x, p) = 0. What is not linear counts as an interval
// where a motion meets it. As a state of its own, σ = u with σ̇ = ∂u/∂t + ∂u/∂x f, it is: every solution x of
// ẋ = f (Filippov's too, by the same choice of signs) is one of both, from σ(0) = u(0, x(0), p).
#pragma once

#include <memory>
#include <optional>

#include "analyses/flow/formulation.hpp"
#include "analyses/flow/series/monomials.hpp"
#include "analyses/flow/step/set.hpp"

namespace gamut {

/// With a state in place of each argument u of a sign in f that depends on states, not linearly with exact
/// coefficients, and holds neither signs nor absolute values itself; none if there are no such arguments, or more of
/// them than states and four. Of formulations without inputs.
std::optional<FlowFormulation> withSurfaces(const FlowFormulation& of);

/// A set at time 0, its states' polynomials in ξ as they are known: those of the last states, which `starts` (a program
/// of all states and the parameters) gives as functions of the others. False, and nothing changed, where these are not
/// defined for every ξ, or could not be bounded.
bool placeSurfaces(FlowSet& set, const Program& starts, const std::shared_ptr<const Monomials>& monomials);

}  // namespace gamut
