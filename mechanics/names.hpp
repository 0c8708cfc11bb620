// Helps with names that a user misspelt: the nearest known one, and the sentence to say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gamut {

/// The candidate with the fewest insertions, deletions, replacements and swaps of neighbours away from `word`, capitals
/// ignored; the first of equals. Empty if none is within two of them or, for a long word, a third of its length.
std::string nearestName(std::string_view word, const std::vector<std::string>& candidates);

/// "unknown KIND 'WORD'; did you mean 'NEAREST'?", without the question where no candidate is near, or, without
/// candidates, "unknown KIND 'WORD': there is none yet".
std::string unknownName(std::string_view kind, std::string_view word, const std::vector<std::string>& candidates);

}  // namespace gamut
