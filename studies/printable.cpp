// Control characters are the bytes below 0x20, 0x7f, and 0xc2 followed by 0x80 to 0x9f.
#include "studies/printable.hpp"

#include <fmt/format.h>

namespace gamut {
namespace {

/// The code of the control character that `text` starts with, or -1.
int controlCode(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (text.empty()) return -1;
  if (byte(0) < 0x20 || byte(0) == 0x7f) return byte(0);
  return text.size() > 1 && byte(0) == 0xc2 && byte(1) >= 0x80 && byte(1) < 0xa0 ? byte(1) : -1;
}

}  // namespace

bool hasControlCharacters(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (controlCode(text.substr(i)) >= 0) return true;
  return false;
}

bool isUtf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t at) { return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U; };
    const unsigned first = byte(i);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xc2 ? 0
                               : first < 0xe0 ? 2
                               : first < 0xf0 ? 3
                               : first < 0xf5 ? 4
                                              : 0;
    for (std::size_t k = 1; k < length; ++k)
      if ((byte(i + k) & 0xc0U) != 0x80) return false;
    const unsigned second = byte(i + 1);
    if (length == 0 || (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||  // too long, surrogates
        (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f))                   // beyond U+10FFFF
      return false;
    i += length;
  }
  return true;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int code = controlCode(text.substr(i));
    if (code < 0) {
      result += text[i];
    } else if (code == '\n' || code == '\t') {
      result += code == '\n' ? "\\n" : "\\t";
    } else {
      result += fmt::format("\\u{:04x}", code);
    }
    if (code >= 0x80) ++i;
  }
  return result;
}

}  // namespace gamut
