// Helps with names that a user misspelt: the nearest known ones, and the sentence to say.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mechanics/description/refusal.hpp"

namespace gamut {

/// In single quotes.
std::string inQuotes(const std::string& name);

/// The candidate with the fewest insertions, deletions, replacements and swaps of neighbours away from `word`, capitals
/// ignored; the first of equals. Empty if none is within two of them or, for a long word, a third of its length.
std::string nearestName(std::string_view word, const std::vector<std::string>& candidates);

/// What would do instead of `word`: up to three nearest names, as "'a', 'b' or 'c'"; else, if more than three begin
/// with the same part before a dot, those; else up to three that share a part with it; else oneOf all.
std::string expectedName(std::string_view word, const std::vector<std::string>& candidates);

/// "one of: a, b", of many the first twelve; "a" of one.
std::string oneOf(const std::vector<std::string>& names);

/// "unknown KIND 'WORD'; did you mean 'NEAREST'?", without the question where no candidate is near, or, without
/// candidates, "unknown KIND 'WORD': there is none yet".
std::string unknownName(std::string_view kind, std::string_view word, const std::vector<std::string>& candidates);

/// A name was used that nothing has: "unknown KIND 'WORD'"; expected is expectedName, and a remark in parentheses.
/// what() is unknownName's sentence, and the remark.
class UnknownName : public Refusal {
 public:
  UnknownName(const std::string& kind, const std::string& word, const std::vector<std::string>& candidates,
              const std::string& remark = "", std::string number = "");

  const std::string& word() const { return word_; }
  /// The number, "spring.stiffness", in whose formula it stands; empty if in none.
  const std::string& number() const { return number_; }

 private:
  std::string word_, number_;
};

/// A parameter, or another quantity, stands where a number of another unit than its own is needed; what() is the
/// problem alone.
class WrongUnit : public Refusal {
 public:
  /// `kind`: "parameter" or "quantity".
  WrongUnit(const std::string& kind, const std::string& parameter, const std::string& unit, const std::string& use,
            const std::string& wanted);

  const std::string& parameter() const { return parameter_; }

 private:
  WrongUnit(const std::string& problem, const std::string& parameter, const std::string& expected);

  std::string parameter_;
};

}  // namespace gamut
