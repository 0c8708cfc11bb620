// What the tests of pages look for in their text.
#pragma once

#include <cstddef>
#include <string>

namespace gamut {

/// How often `part` occurs.
inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace gamut
