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
      "takes a hundred times what capsules do";

  std::string name, from, to;

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
