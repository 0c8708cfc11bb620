// A turn that all solutions make in a step: what is known of it. docs/flow.md, section 7, "Turns".
#pragma once

#include <cstddef>
#include <vector>

#include "analyses/flow/series/bounded_polynomial.hpp"
#include "analyses/flow/step/jumps.hpp"
#include "analyses/flow/step/turn.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// release: a jump lets go solutions that it held; arrival: it comes to hold them; passage: they pass it, or a kink.
enum class TurnKind : char { release, arrival, passage };
/// In this step all solutions turn, to one side or from one: D is added to each of them from m(ξ) on.
struct StepTurn {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::size_t jump;  // of f; none: a kink
  double side;       // from which they arrive; else to which they go
  TurnKind kind;
  int own;  // jump, of the stepper's motion; -1: of those held
  FlowTurn* of;
  Interval moments;                         // s, of m(ξ) and of solutions themselves
  std::vector<char> heldBefore, heldAfter;  // of each jump of f
  std::vector<Interval> signs;              // of f, before; 0 of those held
  const RestingJumps* lifts = nullptr;      // the pair that is released, of which `jump` is the speed's
  const LinearForm* form = nullptr;
  BoundedPolynomial when{};                         // m(ξ), in units of σ
  double needed = 0;                                // s, so long a step holds all m(ξ)
  double away = 0;                                  // how far these are from each other at most
  double beyond = 0;                                // the guard at the start, if above zero
  std::vector<std::vector<BoundedPolynomial>> D{};  // of each state, by orders of σ
  // Where solutions are to be stopped: x̃ + D, by orders of σ - m(ξ), and up to where, in units of σ, from `away`
  // before m(ξ) on.
  std::vector<std::vector<BoundedPolynomial>> fromMoment{};
  double span = 0;
  std::vector<double> most{}, twist{};         // |D| and its third derivative at most
  std::vector<double> gap{}, slope{}, bend{};  // |D|, |Ḋ| and |D̈| at m(ξ)
  std::vector<BoundedPolynomial> slopeOf{};    // Ḋ there
  std::vector<double> extent{};                // |D| when the last turns, about: what errors are compared with
  double rest = 0, steepness = 0;              // of the guard there, along x̃ alone; its slope, at least
  // The guard by states, where Ḋ is not zero at m(ξ); Ḋ over the guard's slope there, about, and at most beside that.
  std::vector<double> ofGuard{}, leap{}, besideLeap{};
  std::vector<double> before{};  // like e1_, until then
  // What turns of the frame from m(ξ) on, 1/s, and of each state, of what the set's remainder is; ∂f_a/∂x, about.
  std::vector<double> K{}, turned{}, J{};
  std::vector<double> saltation{};  // likewise at once, in the middle of ξ
  std::vector<double> leapt{};      // |S (r + Γs)|; of all ξ where solutions are stopped
  std::vector<double> jolt{};       // what chords from the step's start miss
  double lag = 0;                   // s from m(ξ) on, by when all have turned
  // |z| by then, with S as polynomials: d of every state, and at most beside that; S, none: constant.
  std::vector<double> soon{}, besideLeapOf{};
  std::vector<BoundedPolynomial> leapOf{}, saltationOf{};
  Interval growth{0.0};                       // of the argument's rate, of those let go, towards that side
  Interval argument{0.0}, soonArgument{0.0};  // at the step's end, and as long after m(ξ) as `lag`
  std::vector<Interval> besides{};            // likewise of own jumps; none: nothing is known
  SignCases during(const Interval& seconds) const;
  Interval gone(double seconds) const;
  Interval gone(const Interval& shortest, const Interval& longest) const;
  bool releases() const { return kind == TurnKind::release; }
  bool arrives() const { return kind == TurnKind::arrival; }
  bool stops() const { return !fromMoment.empty(); }
  bool passesJump() const { return kind == TurnKind::passage && jump != none; }
  /// |D| at most, up to so many seconds from m(ξ), before or after.
  double within(std::size_t state, double seconds) const;
};

}  // namespace gamut
