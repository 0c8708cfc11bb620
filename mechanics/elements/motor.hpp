// A motor behind a gear.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Motor {
  static constexpr const char* type = "motor";
  static constexpr int order = 230;  ///< in the documentation
  static constexpr const char* summary =
      "a motor that turns a joint by an ideal gear: its moment times `ratio`, and its rotor's inertia times `ratio` "
      "squared; gyroscopic moments of the rotor are not modelled, and its mass belongs to the body that carries it";

  std::string name, joint;
  Expression moment = 0.0, ratio = 1.0, inertia = 0.0, friction = 0.0;  ///< N m, 1 or rad/m, kg m², N m s/rad

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> faults(const RangeOf& rangeOf) const;
};

}  // namespace gamut
