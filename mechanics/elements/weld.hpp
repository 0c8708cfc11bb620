// A weld: `to` is `from` by another name, or turned against it for good.
#pragma once

#include "mechanics/description/described.hpp"

namespace gamut {

struct Weld {
  static constexpr const char* type = "weld";
  static constexpr int order = 120;  ///< in the documentation
  static constexpr const char* summary =
      "a fixed connection: `to` stands where `from` stands, turned by fixed rotations";

  std::string name, from, to;
  std::vector<FixedRotation> rotation = {};

  void describe(Fields& f);
  template <class S>
  void assemble(Assembler<S>& a) const;
};

}  // namespace gamut
