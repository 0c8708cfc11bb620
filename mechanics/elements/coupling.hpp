// A coupling: gear, belt, linkage or mimic joint between two joints.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Coupling {
  static constexpr const char* type = "coupling";
  static constexpr int order = 280;  ///< in the documentation
  static constexpr const char* summary =
      "a gear between two joints: one coordinate is `ratio` times another plus `offset`, and hands its force on to it; "
      "what teeth, belts or ropes do to bearings besides is not modelled";

  std::string name, joint, to;
  Expression ratio = 1.0, offset = 0.0;  ///< in units of the first per unit of the second; rad or m

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
