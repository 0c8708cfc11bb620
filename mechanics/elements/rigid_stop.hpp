// A rigid end of a joint's travel.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

/// q̇⁺ = −e q̇⁻ where q = at (Newton's law of impact), by an impulse that works on q alone; equations/unfolding.hpp.
struct RigidStop {
  static constexpr const char* type = "rigid-stop";
  static constexpr int order = 210;  ///< in the documentation
  static constexpr const char* summary =
      "a rigid end of a joint's travel, which the joint strikes and leaves at `restitution` times its speed (Newton's "
      "law of impact); all other joints get what the impulse at the joint gives them. By ever smaller impacts it comes "
      "to rest there, until it is drawn off, in machines with one such end or two. Measured forces and accelerations "
      "hold neither impulses nor what presses the joint to the end at rest. Not for a joint with dry friction of its "
      "own: smooth it, or take an elastic end";

  std::string name, joint;
  Expression at = 0.0, restitution = 1.0;  ///< rad or m, 1
  std::string end = "lower";
  Start start = {};

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

}  // namespace gamut
