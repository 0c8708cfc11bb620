// Sentence and notes.
#include "commands/verdict_lines.hpp"

#include <fmt/format.h>

#include "reports/requirements.hpp"

namespace gamut {

void printRequirements(std::FILE* stream, const Results& results) {
  if (results.requirements.empty()) return;
  fmt::print(stream, "{}\n", sentenceOfRequirements(results));
  for (const RequirementWords& words : wordsOfRequirements(results)) {
    if (words.demand.ends_with(" " + words.name))  // named by itself
      fmt::print(stream, "  {}: {}\n", words.demand, words.verdict);
    else
      fmt::print(stream, "  {}: {} ({})\n", words.name, words.verdict, words.demand);
    const auto print = [&](const char* title, const std::string& text) {
      if (!text.empty()) fmt::print(stream, "    {:<11} {}\n", title, text);
    };
    print("guaranteed", words.guaranteed);
    print("probable", words.probable);
    print("estimated", words.estimated);
    print("possible", words.possible);
  }
}

void printVerdict(std::FILE* stream, const Verdict& verdict) {
  fmt::print(stream, "{}\n", verdict.sentence);
  for (const std::string& note : verdict.notes) fmt::print(stream, "  {}\n", note);
}

}  // namespace gamut
