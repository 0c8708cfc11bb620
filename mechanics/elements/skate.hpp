// Skate: `to` moves along a plane where it points, but never sideways.
#pragma once

#include <string>

#include "mechanics/description/described.hpp"

namespace gamut {

struct Skate {
  static constexpr const char* type = "skate";
  static constexpr int order = 80;  ///< in the documentation
  static constexpr const char* summary =
      "an edge that glides: `to` moves in the plane of x and y of `from` along its own x and turns about z, but never "
      "slips sideways: a skate, or a cart on an axle with two wheels, which turns about the middle of that axle";

  std::string name, from, to;
  /// Initial values: place [m], direction [rad], path [m], and the rates of the last two [rad/s, m/s].
  Expression x = 0.0, y = 0.0, angle = 0.0, angleRate = 0.0, path = 0.0, pathRate = 0.0;

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
