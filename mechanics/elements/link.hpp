// Rigid link, rod or offset, with fixed rotations: they follow the offset, each about an axis of the frame that the one
// before has reached.
#pragma once

#include <array>

#include "mechanics/description/described.hpp"

namespace gamut {

struct Link {
  static constexpr const char* type = "link";
  static constexpr int order = 130;  ///< in the documentation
  static constexpr std::array urdf = {"fixed"};
  static constexpr const char* summary = "a rigid rod: `to` lies at a place of `from`, turned by fixed rotations";

  std::string name, from, to;
  ExpressionVector vector = {0.0, 0.0, 0.0};  ///< the place of `to` in `from` [m]
  std::vector<FixedRotation> rotation = {};

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
  std::vector<Fault> doubts(const RangeOf& nominal, const RangeOf& range) const;
};

}  // namespace gamut
