// Jumps that hold their arguments at zero together, by signs that depend on each other: what these are along a step,
// and whether no other signs are possible. docs/flow.md, section 7, "Held together".
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "analyses/flow/step/jump_rates.hpp"

namespace gamut {

/// Where u = 0, u̇ = r - G s for the signs s of those held; s* = G⁻¹ r keeps them there. Holds the workspace: one a
/// stepper.
class HeldSigns : public AlongStep {
 public:
  /// `held`: of each jump. Signs are parameters behind f's, those of the jumps held are not used. Others as for
  /// AlongStep.
  HeldSigns(const FlowJumps& jumps, const std::vector<char>& held, std::shared_ptr<const Monomials> monomials,
            int order, double length, double resolution, const std::atomic<bool>* cancelled);

  /// s* of a jump that is held, from σ = `from` to `to`.
  Interval sign(std::size_t jump, double from, double to) const { return over(output(jump), from, to); }
  int output(std::size_t jump) const { return place_[jump]; }
  /// The symbol that decides most about s* there; -1 if none does.
  int worstSymbol(std::size_t jump, double sigma) const;
  /// Whether every solution is held as long as all s* lie between -1 and 1: constants W > 0 are found with W G
  /// diag(G)⁻¹ positive definite, in its symmetric part.
  bool decides(double from, double to) const;

 private:
  int count_ = 0;
  std::vector<int> place_;  // of each jump, among those held
};

}  // namespace gamut
