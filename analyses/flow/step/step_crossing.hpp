// A jump or kink that all solutions pass in a step: what is known of it. docs/flow.md, section 7.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "analyses/flow/series/bounded_polynomial.hpp"
#include "analyses/flow/step/jump_rates.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// In this step all solutions go from one side of a jump or kink to the other: at moment(ξ) - c·C(r + Γs)/rate ±
/// off.
struct StepCrossing {
  const LinearForm* form;
  int node;                  // the sign, or |u|
  int jump, kink;            // one of these; -1: not
  double before;             // the sign until then
  bool arrives = false;      // at a jump, which holds them
  BoundedPolynomial moment;  // s
  double off = 0;
  Interval moments;               // of all solutions
  double rate = 0;                // of the argument, about
  double remainder = 0;           // |c·C(r + Γs)|
  std::vector<double> curvature;  // K of docs/flow.md; of a kink, |B u̇| at most
  // Of a kink: ∂f/∂|u|, about; the integral of ũ from the moment on, by orders of σ; how fast ũ moves at most, and
  // how far moments are from those of ξ.
  std::vector<double> push = {};
  std::vector<BoundedPolynomial> area = {};
  double fastest = 0, away = 0;
  double apart = 0;                 // u from the ũ + c·Ψ̃(r + Γs) that D is made of, at most
  const AlongStep* held = nullptr;  // what holds those that arrive
  /// Of what is added to f from the moment on: times what; f's sign, or -2 before.
  double change() const { return arrives ? 1 : -2 * before; }
  double drift(std::size_t i) const { return push.empty() ? 0.0 : std::fabs(push[i]) * apart; }
};

}  // namespace gamut
