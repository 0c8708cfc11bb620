// Helps with names that a user misspelt: the nearest known one, and the sentence to say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gamut {

/// The candidate with the fewest insertions, deletions, replacements and swaps of neighbours away from `word`, capitals
/// ignored; the first of equals; empty if there are no candidates.
std::string nearestName(std::string_view word, const std::vector<std::string>& candidates);

/// "unknown KIND 'WORD'; did you mean 'NEAREST'?", or, without candidates, "unknown KIND 'WORD': there is none yet".
std::string unknownName(std::string_view kind, std::string_view word, const std::vector<std::string>& candidates);

}  // namespace gamut
