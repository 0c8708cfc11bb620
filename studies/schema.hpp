// What a study file may hold, for editors: they complete its keys, tell what they mean and mark what is wrong.
#pragma once

#include <string>
#include <vector>

#include "mechanics/element_types.hpp"

namespace gamut {

/// A JSON Schema (draft 7) of study files whose elements are of these types.
std::string studySchema(const std::vector<Described>& types = elementTypes());

}  // namespace gamut
