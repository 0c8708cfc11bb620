// The nearest name by the distance of Damerau and Levenshtein, restricted to swaps of neighbours.
#include "mechanics/names.hpp"

#include <algorithm>
#include <cctype>
#include <limits>

namespace gamut {
namespace {

bool same(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Optimal string alignment distance; rows of the table before last, last and present.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1)});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearestName(std::string_view word, const std::vector<std::string>& candidates) {
  std::string nearest;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : candidates) {
    const std::size_t d = distance(word, candidate);
    if (d < least && d <= std::max<std::size_t>(2, word.size() / 3)) {
      least = d;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string unknownName(std::string_view kind, std::string_view word, const std::vector<std::string>& candidates) {
  const std::string start = "unknown " + std::string(kind) + " '" + std::string(word) + "'";
  if (candidates.empty()) return start + ": there is none yet";
  const std::string nearest = nearestName(word, candidates);
  return nearest.empty() ? start : start + "; did you mean '" + nearest + "'?";
}

}  // namespace gamut
