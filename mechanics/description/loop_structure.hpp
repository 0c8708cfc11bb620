// What of a closure holds by how its loop is built, whatever the joints do and whatever numbers are uncertain: rows of
// it that follow from the others for that reason. Directions are followed from one end of the closure along the joints
// of the loop to the other, exactly: turns keep what is parallel to their axis, slides keep all directions.
//
//   all turns about n                              axes along n stay parallel
//   and slides across n, offsets along n add to 0  the points stay together along n
//   and all offsets, and slides, along n           the points stay together across n
//   no slides, no offsets                          the points stay together, about whatever axes joints turn
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mechanics/description/fields.hpp"

namespace gamut {

class Mechanism;

/// What holds already of `wanted` between these points; `restsOn`: parameters by whose nominal values alone it does.
struct HoldsAnyway {
  bool along = false, across = false, parallel = false;
  Axis axis = axisZ;  ///< along which, in the first frame
  std::set<std::string> restsOn;
};

/// Throws Refusal where points or axes of the closure called `name` are apart whatever the joints do.
HoldsAnyway holdsAnyway(const Mechanism& mechanism, const std::string& name, const FixedPoint& from,
                        const FixedPoint& to, const HeldRows& wanted);

}  // namespace gamut
