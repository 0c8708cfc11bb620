// Functions that jump, one smooth piece at a time. Where u in sign u is not zero, f is that of one side; where
// solutions of ẋ = f are driven to u = 0 from both sides they are held there, and follow the mean of both sides' rates
// of which u stays zero (Filippov, Differential Equations with Discontinuous Righthand Sides, 1988, §4).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scalars/program/program.hpp"

namespace gamut {

/// Of one jump: its sign is -1, 0, 1, or what keeps its argument as it is, or as ever.
enum class Side : signed char { below = -1, between = 0, above = 1, held = 2, open = 3 };

/// The nodes of `program` that jump, in their order: its signs.
std::vector<int> jumpsOf(const Program& program);

/// f with |a||u| for |a u| where no state is in a: where u is zero, a has no part in it.
Program withBareKinks(const Program& f);
/// f with sign a sign u for sign (a u) where no state is in a: a surface is known, and held, whatever scales it.
Program withBareSigns(const Program& f);

/// f with u sign u for |u| where a sign of f jumps at u = 0 as well: what happens at a surface is one jump. f itself if
/// that alone would make it depend on signs by more than sums and products with what does not.
Program withJumpingKinks(const Program& f);
/// Likewise functions g of the states and parameters of f; none if they have no such kinks.
std::optional<Program> withJumpingKinks(const Program& f, const Program& g);

/// f with one sign for all arguments that are multiples of each other: at a surface they are one. Constant factors are
/// taken off arguments: 0.1 v is as positive as v.
Program withOneSignASurface(const Program& f);

/// f with its K signs s_1 … s_K as parameters behind its own. Outputs: f's n, the signs' arguments u_1 … u_K, and their
/// rates ∂u/∂t + ∂u/∂x f. f has as many outputs as states.
Program withSignsGiven(const Program& f);

/// Likewise, of f that is affine in its signs, where of those held (one a sign) the parameter is v = φ s if s is in one
/// product φ s only: what holds them does not depend on φ then, which is often a coefficient that is not known. Further
/// outputs of each sign held: φ, and by v the derivatives of f's n and of all K rates.
Program withHeldGiven(const Program& f, std::span<const char> held);

/// Whether f depends on its signs by sums and by products with what does not: then a mean of f over values of signs is
/// f at their mean. A sign of what does not depend on states (time, parameters) counts as a number.
bool isAffineInSigns(const Program& f);

/// f with its one sign s to the first power: (1 + s)/2 of f on one side and (1 - s)/2 of f on the other, which has the
/// same Filippov solutions. f itself where it is affine in its signs, has several, or depends on one by more than sums
/// and products.
Program affineInSign(const Program& f);

/// f on these sides, one a jump. Outputs: f's n, the arguments u_1 … u_K, the signs s_1 … s_K. A held argument counts
/// as zero. Where f is not affine in its signs, the rates are those of one side and what each other side of one held
/// adds alone, times (1 + s)/2; where one is open it has to be. Where no value holds, outputs are not finite. Throws
/// std::domain_error if a held argument's rate is the same whatever its sign, std::invalid_argument if one is open
/// where a sign decides about a sign.
Program onSides(const Program& f, std::span<const Side> sides);

/// Functions g of the states and parameters of f where f is on these sides: signs of states that are signs of f's
/// surfaces are as they are there, of a held one what holds it (a force of dry friction at standstill is what keeps
/// still); other signs stay. Throws as onSides.
Program outputsOnSides(const Program& f, const Program& g, std::span<const Side> sides);

/// Likewise, with the signs that are open as parameters behind those of g, one a jump of f. Where f jumps in states,
/// the other signs of states are, in intervals, anything from -1 to 1 where their arguments may be zero: these may be
/// surfaces of f that are written otherwise.
Program outputsWithOpenSignsGiven(const Program& f, const Program& g, std::span<const Side> sides);

/// g with those signs as parameters behind its own, one a jump of f; other signs as in outputsWithOpenSignsGiven.
Program withSignsGiven(const Program& f, const Program& g);

/// The arguments of f's signs, with all signs of f as parameters behind its own.
Program argumentsOfSigns(const Program& f);

}  // namespace gamut
