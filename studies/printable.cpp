// Control characters are the bytes below 0x20, 0x7f, and 0xc2 followed by 0x80 to 0x9f; the others of two to four
// bytes.
#include "studies/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace gamut {
namespace {

struct Found {
  int code = -1;           ///< -1: no control character
  std::size_t length = 1;  ///< in bytes
};

/// First and last code of what is not seen, beyond Unicode's category Cc: formats (Cf) and separators (Zl, Zp), but for
/// the joiners U+200C and U+200D.
constexpr std::array<std::array<int, 2>, 14> unseen{{{0xad, 0xad},
                                                     {0x61c, 0x61c},
                                                     {0x180e, 0x180e},
                                                     {0x200b, 0x200b},
                                                     {0x200e, 0x200f},
                                                     {0x2028, 0x202e},
                                                     {0x2060, 0x206f},
                                                     {0xfeff, 0xfeff},
                                                     {0xfff9, 0xfffb},
                                                     {0x110bd, 0x110bd},
                                                     {0x13430, 0x1343f},
                                                     {0x1bca0, 0x1bca3},
                                                     {0x1d173, 0x1d17a},
                                                     {0xe0001, 0xe007f}}};

/// The control character that the text starts with.
Found controlAt(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(text[i])); };
  if (text.empty()) return {};
  const unsigned first = byte(0);
  if (first < 0x20 || first == 0x7f) return {static_cast<int>(first), 1};
  const std::size_t length = first < 0xc0 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
  if (length == 1 || text.size() < length) return {};
  unsigned code = first & (0xffU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fU);
  }
  const auto number = static_cast<int>(code);
  const bool isUnseen = (number >= 0x80 && number < 0xa0) || std::ranges::any_of(unseen, [&](const auto& range) {
                          return range[0] <= number && number <= range[1];
                        });
  return isUnseen ? Found{number, length} : Found{};
}

std::string escaped(std::string_view text, bool keepsLines) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto [code, length] = controlAt(text.substr(i));
    const bool isLayout = code == '\n' || code == '\t';
    if (code < 0 || (isLayout && keepsLines)) {
      result += text[i];
    } else if (isLayout) {
      result += code == '\n' ? "\\n" : "\\t";
    } else {
      result += code <= 0xffff ? fmt::format("\\u{:04x}", code) : fmt::format("\\U{:08x}", code);
    }
    i += length;
  }
  return result;
}

}  // namespace

bool hasControlCharacters(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (controlAt(text.substr(i)).code >= 0) return true;
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

std::string printable(std::string_view text) { return escaped(text, false); }
std::string printableLines(std::string_view text) { return escaped(text, true); }

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  const auto isInside = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80; };
  std::size_t begin = most - most / 4, end = text.size() - most / 4;
  while (begin > 0 && isInside(begin)) --begin;
  while (end < text.size() && isInside(end)) ++end;
  return fmt::format("{} \u2026 ({} characters) \u2026 {}", text.substr(0, begin), text.size(), text.substr(end));
}

std::string withoutSemicolons(std::string sentence) {
  std::ranges::replace(sentence, ';', ',');
  return sentence;
}

std::string complaintAt(std::string_view place, std::string_view what, std::string_view expected) {
  constexpr std::size_t most = 600, mostExpected = 1500;
  return printable(fmt::format("{}: {}; expected {}", place, shortened(what, most), shortened(expected, mostExpected)));
}

}  // namespace gamut
