// In which form equations of motion of three speeds and more are recorded; fewer are eliminated in either.
#pragma once

namespace gamut {

enum class Formulation {
  articulated,  ///< joint by joint (articulated_bodies.hpp): the fewest operations, for samples
  sparse,       ///< cut at the joints (sparse_equations.hpp): the tightest bounds, for enclosures; scalars that do not
                ///< record solve with the inertia matrix instead
  bordered,     ///< the same, and of what closes on itself the multipliers too, which reactions need
};

}  // namespace gamut
