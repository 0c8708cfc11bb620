// What a node computes, known again where it is written elsewhere.
#pragma once

#include "scalars/program/program.hpp"

namespace gamut {

/// Whether node `a` of f and node `b` of g are the same operations on the same states, parameters (by their numbers)
/// and constants, whatever the order of a sum's or a product's operands. Constants that are no doubles count as one
/// number if their enclosures are the same.
bool isSameExpression(const Program& f, int a, const Program& g, int b);

}  // namespace gamut
