// f turns into another one where solutions come to be held by a jump, or are let go by it: what that adds to f along a
// step, and when it does. docs/flow.md, section 7, "Turns".
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "analyses/flow/step/jump_rates.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {

/// ẋ = f_b until the guard, which rises, is zero, and ẋ = f_a from then on.
class FlowTurn : public AlongStep {
 public:
  /// `along`: the outputs below. Others as for AlongStep.
  FlowTurn(const Program& along, std::shared_ptr<const Monomials> monomials, int order, double length,
           double resolution, const std::atomic<bool>* cancelled);

  int guard() const { return 0; }
  int growth() const { return 1; }          ///< the guard's rate while ẋ = f_b
  int isAhead() const { return 2; }         ///< above zero: solutions do not turn back
  int isAttracted() const { return 3; }     ///< above zero: from the other side as well
  int after(int i) const { return 4 + i; }  ///< of f_a

  /// f_a alone, with outputs of its own.
  AlongStep& following() { return following_; }
  /// ∂f_a/∂x, by row, wherever time and states are within these.
  std::vector<Interval> derivatives(const Interval& time, const Box& states, const Box& parameters);
  /// f_a, then these, along a step.
  AlongStep& alongDerivatives();

 private:
  int states_;
  AlongStep following_;
  Program slopes_;  // f_a, then ∂f_a/∂x
  Evaluator<Interval> derivatives_;
  std::function<std::unique_ptr<AlongStep>()> makeAlong_;
  std::unique_ptr<AlongStep> alongDerivatives_;  // once needed
};

/// `jump`, one of those `held`, lets go to `side` (1, -1); the others hold on. The guard is how fast its argument moves
/// to that side with the side's own sign; as fast as that rises of those let go, solutions are ahead. Throws
/// std::logic_error where these do not decide about themselves. Signs are parameters behind f's.
Program releaseOf(const FlowJumps& jumps, const std::vector<char>& held, std::size_t jump, double side);
/// A pair that rests, of which `speed` is the second jump, lifts off as Q comes to zero (RestingPair): the guard is -Q.
/// Throws as releaseOf.
Program liftOf(const FlowJumps& jumps, const std::vector<char>& held, std::size_t speed);
/// Solutions on this side of a jump come to be held by it: the guard is the argument, and solutions are ahead and
/// attracted as fast as it comes to zero from either side.
Program arrivalOf(const FlowJumps& jumps, std::size_t jump, double side);
/// Solutions on this side of a jump pass it: its sign is `side` until then, and -side from then on. The guard is -side
/// u, and solutions are ahead as fast as that rises.
Program passageOf(const FlowJumps& jumps, std::size_t jump, double side);
/// f (the first outputs, one a state) has a kink in u, which solutions pass: |u| = side u until then, and -side u from
/// then on. The guard is -side u, and solutions are ahead as fast as that rises.
Program passageOf(const Program& f, const KinkArgument& u, double side);

}  // namespace gamut
