// In which form equations of motion of three variables and more are recorded; fewer are eliminated in either.
#pragma once

namespace gamut {

enum class Formulation {
  compact,  ///< M q̈ = Q with the inertia matrix: the fewest operations, for samples
  sparse,   ///< cut at the joints (sparse_equations.hpp): the tightest bounds, for enclosures
};

}  // namespace gamut
