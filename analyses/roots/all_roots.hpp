// All roots x of equations F(x; p) = 0 in a box, for all parameters p of a box at once, with proof.
//
// Branch and prune: a cell X × Q of states and parameters loses what holds no root, by hull consistency and by Newton's
// method; what is left is cut, where F varies most. What is lost holds no root for any p of Q:
//
//   F(x, p) = F(m, q) + J (x - m) + K (p - q)       with J, K in the ranges of ∂F/∂x and ∂F/∂p over X × Q,
//
// the mean value theorem about the middles m, q, row by row; times Y ≈ J⁻¹ it is solved for one x_i after the other
// (Gauss and Seidel; E. Hansen & S. Sengupta, BIT 21, 1981). It needs F to be defined and without jumps over X × Q.
//
// A root is proved about an approximate one, c, for q, that moves by about S (p - q) (or S = 0, where that is enough):
// with x = c + S (p - q) + δ, by R. Krawczyk's map (Computing 4, 1969). For all |δ| <= r
//
//   δ - Y F(x, p) lies in -Y F(c, q) - Y (K + J S)(Q - q) + (I - Y J')[-r, r]
//
// with J, K over c + S (Q - q) and J' over D × Q, for a box D that holds c + S (Q - q) + [-r, r].
// Where the right side is in the interior of [-r, r] there is a root for each p (Brouwer, 1911). Two roots of one p in
// D would have x - x' = (I - Y J')(x - x'): there is one only where Σ_j |I - Y J'|_ij w_j < w_i for some w > 0, which
// makes |x - x'| / w zero. That is tried with larger and larger boxes D: `alone` is the largest, and none of it is
// looked at again for any p of Q. Where S ≠ 0 second derivatives tell more of both: with V = (S; I), u = p - q, H those
// of Y F by x and p over D × Q, Taylor's theorem along the course and the mean value theorem for the derivatives give
//
//   Y F(c + S u, p) in Y F(c, q) + Y (J S + K)(c, q) u + ½ uᵀ (Vᵀ H V) u,    Y J' in Y J(c, q) + H (V u + δ).
//
// Where Q is too wide for a proof it is cut. Roots of parts are continuous functions of p on them (a unique root in a
// compact box). Those of two parts that share a p are one where they are one for a single such p, different where they
// are different there: the set where they are the same is closed, and open, for a root stays in the interior of the
// other's box in which it is alone. So each two parts are compared at one p, where roots are thin; those that are one
// make a branch. If its parts cover the box of parameters, it is a family: one root for every p.
//
// Of a family that has several parts `alone` is what they have in common, if that holds its roots; else a part of the
// region in which, as the whole search shows, roots of no other branch are, nor undecided ones.
//
// What cannot be settled is told: double roots (where the parameters let two roots meet), what work or resolution leave
// open, and families that may leave the region for some p. Angles are numbers: those equal mod 2π are different.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// For each of these parameters there is one root in `root`, and no other in `alone`, which holds `root`. Both may
/// reach beyond the region.
struct RootPart {
  Box parameters, root, alone;
};

/// Roots of parts of the parameters that are one function of them.
struct RootBranch {
  Box root;                     ///< all of them
  Box alone;                    ///< as in RootPart, for all of the parameters; empty where only parts have such boxes
  std::vector<RootPart> parts;  ///< at least one
};

/// Roots may be here that are in no branch.
struct UndecidedRoots {
  enum class Why {
    narrow,    ///< cells as small as the resolution, or as roundings let them be told apart
    work,      ///< as many cells were looked at as were allowed
    cancelled  ///< `cancelled` was set
  };
  Box states, parameters;
  Why why;
};

struct AllRoots {
  std::vector<RootBranch> families;  ///< for every p exactly one root, which is in the region; never the same one
  std::vector<RootBranch> border;    ///< root boxes reach beyond the region: for some p the root may be outside
  std::vector<RootBranch> partial;   ///< in the region, but for a part of the parameters only
  std::vector<UndecidedRoots> undecided;
  std::size_t cells = 0;  ///< looked at; proofs count as as many as they evaluated

  /// For every p the region's roots are those of the families.
  bool isComplete() const { return border.empty() && partial.empty() && undecided.empty(); }
};

struct RootSearch {
  std::size_t mostCells = 2000000;
  double resolution = 0x1p-40;           ///< of the region's widths: narrower cells are not cut
  double parameterResolution = 0x1p-10;  ///< of the parameters' widths, likewise
  Interval time = 0.0;                   ///< for all t of it
  const Program* also = nullptr;  ///< of the same unknowns and parameters: roots are meant where all of it is zero;
                                  ///< it takes what is searched, not what is proved, so that others may be found too
  /// A box in which there is a root for each of these parameters, a part of all: of a family that is proved already.
  /// Where it is alone is found, and not looked at again; empty: none is known.
  std::function<Box(const Box& parameters)> known = {};
  const std::atomic<bool>* cancelled = nullptr;
};

/// `f` has as many outputs as states. The region and the parameters are bounded; parameters may be thin. Throws
/// std::invalid_argument, saying what does not fit.
AllRoots allRoots(const Program& f, const Box& region, const Box& parameters, const RootSearch& search = {});

}  // namespace gamut
