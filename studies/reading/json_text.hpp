// A study that is written in JSON, as the same words in TOML: one reader serves both.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gamut {

/// Where something stands in a text: line and column, in characters, from 1.
struct TextPlace {
  std::size_t line = 1, column = 1;
  friend auto operator<=>(const TextPlace&, const TextPlace&) = default;
};

struct TomlOfJson {
  std::string text;
  /// Where each value and each key of `text` begins, and where it stands in the JSON; rising.
  struct Pair {
    TextPlace toml, json;
  };
  std::vector<Pair> places;
  /// Of what stands there in `text`: that of the value or key that begins there, or last before.
  TextPlace inJson(const TextPlace& toml) const;
  /// What is wrong, in words, and where in the JSON; empty if nothing is.
  std::string fault, expected;
  TextPlace faultAt;
};

/// Whether it begins as JSON does and no TOML can.
bool looksLikeJson(std::string_view text);

/// Numbers stay as they are written. What TOML has not, as null, is a fault.
TomlOfJson tomlOfJson(const std::string& text);

}  // namespace gamut
