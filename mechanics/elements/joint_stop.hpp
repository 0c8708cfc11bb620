// Stops at the ends of a joint's travel.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

/// With p = max(0, q − upper) and p = max(0, lower − q): k p (1 + d ṗ) back inside (K. H. Hunt, F. R. E. Crossley,
/// J. Appl. Mech. 42, 1975, with exponent 1), which does not jump at contact.
struct JointStop {
  static constexpr const char* type = "joint-stop";
  static constexpr int order = 200;  ///< in the documentation
  static constexpr const char* summary =
      "elastic stops at both ends of a joint's travel: `stiffness` times depth times (1 + `damping` times the speed of "
      "entering); what leaves faster than 1/`damping` is held back";

  std::string name, joint;
  Expression lower = 0.0, upper = 0.0, stiffness = 0.0, damping = 0.0;  ///< rad or m, N m/rad or N/m, s/rad or s/m

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

}  // namespace gamut
