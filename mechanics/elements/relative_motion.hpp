// How a frame moves as another frame sees it: place, velocity, angle between two directions: a measurement.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct RelativeMotion {
  static constexpr const char* type = "relative-motion";
  static constexpr const char* summary =
      "measures place and velocity of a frame as another one sees them, and the angle between an axis of each";

  std::string name, from, to;
  Axis axis = axisZ;  ///< of both

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
