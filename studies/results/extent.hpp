// How much results hold, beside others.
#pragma once

#include "studies/results/results.hpp"

namespace gamut {

/// Whether each answer of `other` is there in `one`, as far in time and as tight, with as many samples, and no less was
/// proved of requirements, probabilities and derivatives. Of different studies both shares of the horizon count.
bool holdsAsMuch(const Results& one, const Results& other);

/// The same study and samples, asked by the same version: where one holds as much as the other, nothing in the other is
/// missed.
bool asksTheSame(const Results& one, const Results& other);

}  // namespace gamut
