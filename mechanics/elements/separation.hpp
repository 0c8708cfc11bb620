// How far two shapes are from each other: a measurement.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Separation {
  static constexpr const char* type = "separation";
  static constexpr int order = 350;  ///< in the documentation
  static constexpr const char* summary =
      "measures how far two shapes are from each other, at their nearest points. A frame that is no shape counts as a "
      "point, its origin. Of two boxes or hulls that turn about different directions all edges are compared, which "
      "takes a hundred times what capsules do. Where several points are nearest, as of parallel faces, or centres, "
      "segments or solids overlap, bounds of the points hold all of them, and a sample has one. Of an output "
      "`NAME.distance` the closest approach is told: between which bounds it lies, when it comes, and, where its "
      "points "
      "are outputs too, where";

  std::string name, from, to;

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
