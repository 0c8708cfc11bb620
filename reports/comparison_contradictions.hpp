// What of two results contradicts, as people read it. "A" is the first of them, "B" the second.
#pragma once

#include <string>
#include <vector>

#include "studies/comparing/contradictions.hpp"

namespace gamut {

/// A line for each output or requirement, indented by two blanks: of what comes first all, of the rest its name.
/// `moves`: there is time.
std::string contradictionsText(const std::vector<Contradiction>& found, bool moves);

}  // namespace gamut
