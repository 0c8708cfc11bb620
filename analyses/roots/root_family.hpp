// Roots of equations that depend on parameters, for all parameters in a box at once: proved to be there, and alone.
//
// Newton's map about a centre c(p), φ(δ; p) = δ − J(c)⁻¹ g(c + δ), has the roots c + δ as its fixed points. Where it
// maps a box D about 0 into its interior for every p, there is one (L. E. J. Brouwer, 1911); where besides Σ_j
// |∂φ_i/∂δ_j| r_j < r_i for the half-widths r of D, φ contracts in the norm that r weighs, and there is no other (R.
// Krawczyk, Computing 4, 1969, about a centre that follows the parameters).
#pragma once

#include <functional>
#include <optional>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

struct RootFamily {
  Box remainder;            ///< δ of all roots; empty unless they are proved for the whole box
  Box alone;                ///< in which there is no other for any of the parameters
  std::optional<Box> open;  ///< a part of the box for which nothing is proved
};

/// `newton`: φ, whose n states are δ and whose n outputs its image, with the parameters p. Of these the first
/// `quantities` (-1: all) are; others are narrow, as remainders of other roots are. Parts of the box are tried until
/// δ is at most `enough`, while that costs little. `goesOn` is told which share of the box is proved, often, and ends
/// it by false: what is not proved then stays open.
RootFamily proveRoots(const Program& newton, const Box& parameters, int quantities = -1, double enough = 1e-9,
                      const std::function<bool(double done)>& goesOn = {});

/// c(p): polynomials near to what Newton's steps, a program of parameters, come to. These steps follow where a root
/// goes, but each lets errors of polynomials grow that bound it.
/// `share`: of the monomials that degreeFor has.
Program approximated(const Program& steps, const Box& parameters, double share = 1);

/// The degree of polynomials in the quantities of a box of which there are some hundred monomials, or a share of these.
int degreeFor(const Box& parameters, double share = 1);

/// The same by one `step` over and over, of n states and of parameters, from states of zero: a step that finds one more
/// power of the parameters each time, as Newton's with the slopes of the middle does.
Program approached(const Program& step, const Box& parameters);

}  // namespace gamut
