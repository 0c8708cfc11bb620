// What a piece of the box is at one time, and the ways to rewrite it without losing a solution. docs/flow.md,
// section 1.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "analyses/flow/series/bounded_polynomial.hpp"
#include "analyses/flow/series/embedded.hpp"
#include "analyses/flow/series/monomials.hpp"
#include "analyses/flow/series/polynomial_series.hpp"

namespace gamut {

/// For every ξ in [-1,1]^k there are |r| ≤ R, |s_j| ≤ 1, |w| ≤ W with x(t; ξ) = p(ξ) + C (r + Σ_j Γ_j(ξ) s_j) + w.
/// Every step's local error becomes generators Γ_j of its own: boxes would wrap, zonotopes do not. So does what inputs
/// do.
struct FlowSet {
  double t = 0;
  std::vector<double> p;    // [state][monomial]
  std::vector<double> low;  // second doubles of p, of sets without symbols; empty: all are 0
  std::vector<double> C;    // [row][column]
  std::vector<double> R, W;
  std::size_t powers = 1;                       // monomials of generators, the first ones
  std::vector<double> generators;               // [monomial][generator][row], oldest first
  std::vector<double> inputs;                   // likewise, of what varies in time: [part of a step][input][row]
  std::vector<std::vector<double>> inputsOfXi;  // what of them is linear in each symbol, likewise; none: nothing is
  std::vector<Embedded> parameters;
  std::vector<double> centre, half;    // ξ of the study = centre + half·ξ of this piece (exact: dyadic)
  std::vector<int> units;              // FlowGrowth's, of the last step
  std::vector<double> first, largest;  // size of each state over the first step, and the greatest so far
  std::vector<Interval> arguments;     // of jumps, what is known of them besides (FlowJumps); none: nothing is
  // Solutions are in the set at times of their own, each at t + ahead(ξ), s, no sooner than t; none: at t.
  BoundedPolynomial ahead = {};
  double unsettledUntil = 0;  // s: until then solutions may be `unsettled` from the set (Settling)
  std::vector<double> unsettled;
  double slideStep = 0;               // s, of the last step, if solutions came to be held or left in it
  bool hasSlid = false;               // in any step so far: then a round is not given up
  double nextStep = 0, freeStep = 0;  // s, a guess; what it was before jumps made steps shorter
  double dampedStep = 0;              // s, where damping limits steps: how long the next may be, about
  double caution = 1;                 // factor on the step that the last coefficients suggest
};

/// Generators diag(size), constant in ξ, the newest.
void appendBox(FlowSet& set, const std::vector<double>& size);
/// Boxes in place of generators, of those that lose least by it, until `most` are left.
void mergeGenerators(FlowSet& set, const Monomials& monomials, std::size_t most);

/// R + Σ_j |Γ_j| for all ξ, rounded up; of errors alone, without what inputs did.
void totalRadius(const FlowSet& set, std::vector<double>& total);
void errorRadius(const FlowSet& set, std::vector<double>& total);
/// += Σ |columns|, in round-to-nearest.
void addColumnSizes(const std::vector<double>& columns, std::vector<double>& total);
/// Where there are more than `most` numbers, generators of two successive parts become their sum, in the older half:
/// as + bs' = (a + b)u + (a - b)v with |u|, |v| ≤ 1. The differences join the errors' generators. `count`: inputs.
void mergeInputs(FlowSet& set, std::size_t count, std::size_t most);

/// W_i + Σ_j |C_ij| total_j: what the polynomial of state i leaves over, but for roundings.
double remainderOf(const FlowSet& set, int state, const std::vector<double>& total);

/// An upper bound of ‖QᵀQ - I‖∞, infinite if Q is not finite; then |Q⁻¹w| ≤ |Qᵀw| + φ/(1-φ) ‖Qᵀw‖∞ for every w, because
/// Q⁻¹ = Σ (I - QᵀQ)^k Qᵀ.
double orthogonalityDefect(const Eigen::MatrixXd& Q);

/// Σ over grades in (above, below] of |p|, for each state, relative to Σ|p|; the largest of the states.
double relativeMass(const FlowSet& set, const Monomials& monomials, int above, int below);

/// Rewrites a set for monomials of another degree in the same symbols; what does not fit goes into W. Generators are of
/// degree `frameDegree` from then on.
void changeDegree(FlowSet& set, const Monomials& from, const Monomials& to, int frameDegree);

/// Turns the remainder into n fresh symbols, one a principal axis of the zonotope: `to` has the symbols of `from` and n
/// more behind them. From then on it is kept to higher order than the first.
/// False, and nothing changed, if no axes are found.
bool expandRemainder(FlowSet& set, const Monomials& from, const Monomials& to, int frameDegree);

}  // namespace gamut
