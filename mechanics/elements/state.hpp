// A state of its own, with an expression for its rate: controller, actuator, or a plain differential equation.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct State {
  static constexpr const char* type = "state";
  static constexpr int order = 290;  ///< in the documentation
  static constexpr const char* summary =
      "a quantity with a rate of its own, of the element's name: a controller, an actuator, or a plain differential "
      "equation";

  std::string name;
  Expression initial = 0.0;  ///< whose unit is the state's
  Expression rate = 0.0;     ///< in that unit per second

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
