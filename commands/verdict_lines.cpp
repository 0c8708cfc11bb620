// Sentence and notes.
#include "commands/verdict_lines.hpp"

#include <fmt/format.h>

namespace gamut {

void printVerdict(std::FILE* stream, const Verdict& verdict) {
  fmt::print(stream, "{}\n", verdict.sentence);
  for (const std::string& note : verdict.notes) fmt::print(stream, "  {}\n", note);
}

}  // namespace gamut
