// Friction in a joint: Coulomb's, which jumps where the motion turns round, or one that is smoothed about there.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

/// Q = −F sign(q̇) − d q̇.
struct JointFriction {
  static constexpr const char* type = "joint-friction";
  static constexpr int order = 180;  ///< in the documentation
  static constexpr const char* summary =
      "Coulomb and viscous friction on a joint; where it holds the joint, it holds it fast, with what force that "
      "takes. In a loop that one coordinate moves, friction in any of its joints turns round, and holds, with that "
      "coordinate: each then bears the same share of what it can";

  std::string name, joint;
  Expression coulomb = 0.0, viscous = 0.0;  ///< N m or N, N m s/rad or N s/m

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

/// Q = −F tanh(q̇/v) − d q̇.
struct SmoothedJointFriction {
  static constexpr const char* type = "smoothed-joint-friction";
  static constexpr int order = 190;  ///< in the documentation
  static constexpr const char* summary =
      "Coulomb friction smoothed about standstill, and viscous friction: a joint under load creeps where it would "
      "stick";

  std::string name, joint;
  Expression coulomb = 0.0, viscous = 0.0, slipRate = 0.0;  ///< N m or N, N m s/rad or N s/m, rad/s or m/s

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

}  // namespace gamut
