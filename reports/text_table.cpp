// A byte that goes on with a code point has 10 as its first bits.
#include "reports/text_table.hpp"

#include <algorithm>

namespace gamut {
namespace {

bool isBegin(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

std::size_t length(const std::string& text) { return static_cast<std::size_t>(std::ranges::count_if(text, isBegin)); }

/// Where to break it to have so many columns at most: at the last blank that leaves no more, or at the first of all;
/// npos: nowhere.
std::size_t breakOf(const std::string& text, std::size_t columns) {
  std::size_t found = std::string::npos, before = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == ' ' && i > 0 && (before <= columns || found == std::string::npos)) found = i;
    if (before > columns && found != std::string::npos) break;
    before += isBegin(text[i]) ? 1 : 0;
  }
  return found;
}

}  // namespace

std::string textTable(const std::vector<std::vector<std::string>>& rows, std::size_t left) {
  std::vector<std::size_t> widths(rows.empty() ? 0 : rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], length(row[i]));
  std::string result;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - length(row[i]), ' ');
      line += (i == 0 ? "" : "  ") + (i < left ? row[i] + padding : padding + row[i]);
    }
    result += "  " + line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return result;
}

std::vector<std::string> wrapped(const std::string& text, std::size_t indent, std::size_t columns) {
  std::vector<std::string> rows;
  std::string rest = text;
  std::size_t margin = indent;
  while (columns > 0 && margin + length(rest) > columns) {
    const std::size_t end = breakOf(rest, columns > margin ? columns - margin : 0),
                      next = rest.find_first_not_of(' ', end);
    if (next == std::string::npos) break;
    rows.push_back(std::string(margin, ' ') + rest.substr(0, end));
    rest.erase(0, next);
    margin = indent + 2;
  }
  rows.push_back(std::string(margin, ' ') + rest);
  return rows;
}

}  // namespace gamut
