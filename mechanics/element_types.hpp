// The types of elements that there are; each has its own header in elements/.
#pragma once

#include <vector>

#include "mechanics/description/described.hpp"

namespace gamut {

/// An empty description of each, in the order of the documentation, for visitors to fill in.
std::vector<Described> elementTypes();

}  // namespace gamut
