// Which inertia tensors a body can have.
#pragma once

#include <array>
#include <string>

#include "scalars/interval.hpp"

namespace gamut {

/// What no body has in a tensor xx, yy, zz, xy, yz, zx within these bounds, about any point of the body: "has a
/// negative principal moment", or "has a principal moment above the sum of the other two". Empty if a body may have one
/// of them.
std::string impossibilityOf(const std::array<Interval, 6>& tensor);

}  // namespace gamut
