// A text of a study with one thing said otherwise.
#pragma once

#include <stdexcept>
#include <string>

namespace gamut {

/// `text` with `by` instead of its first `old`, which it has to hold.
inline std::string replaced(std::string text, const std::string& old, const std::string& by) {
  const std::size_t at = text.find(old);
  if (at == std::string::npos) throw std::invalid_argument("there is no '" + old + "' in: " + text);
  return text.replace(at, old.size(), by);
}

}  // namespace gamut
