// The nearest names by the distance of Damerau and Levenshtein, restricted to swaps of neighbours.
#include "mechanics/description/names.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

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

/// Those that a few typos lead to, the nearest first, equals in their order. (A long word is no typo of a short one,
/// nor worth the time to compare.)
std::vector<std::string> nearNames(std::string_view word, const std::vector<std::string>& candidates) {
  std::vector<std::pair<std::size_t, std::string>> near;
  const std::size_t most = std::max<std::size_t>(2, word.size() / 3);
  for (const std::string& candidate : candidates) {
    if (word.size() > 2 * candidate.size() + 8) continue;
    const std::size_t d = distance(word, candidate);
    if (d <= most) near.emplace_back(d, candidate);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (auto& [d, name] : near) names.push_back(std::move(name));
  return names;
}

/// "a.bc" holds the parts "a" and "bc"; those of one letter, as a component's, say little.
bool shareAPart(std::string_view a, std::string_view b) {
  const std::string other = "." + std::string(b) + ".";
  for (std::size_t begin = 0; begin <= a.size();) {
    const std::size_t end = std::min(a.find('.', begin), a.size());
    const std::string part(a.substr(begin, end - begin));
    if (part.size() > 1 && other.find("." + part + ".") != std::string::npos) return true;
    begin = end + 1;
  }
  return false;
}

constexpr std::size_t mostNear = 3;

/// "'a', 'b' or 'c'" of the first three.
std::string alternatives(const std::vector<std::string>& names) {
  const std::size_t n = std::min(names.size(), mostNear);
  std::string text = inQuotes(names[0]);
  for (std::size_t i = 1; i < n; ++i) text += (i + 1 < n ? ", " : " or ") + inQuotes(names[i]);
  return text;
}

}  // namespace

std::string inQuotes(const std::string& name) { return "'" + name + "'"; }

std::string nearestName(std::string_view word, const std::vector<std::string>& candidates) {
  const std::vector<std::string> near = nearNames(word, candidates);
  return near.empty() ? "" : near.front();
}

std::string expectedName(std::string_view word, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return "one that was defined before; there is none yet";
  std::vector<std::string> names = nearNames(word, candidates);
  if (names.empty()) {
    const std::string element = std::string(word.substr(0, word.find('.'))) + ".";
    std::vector<std::string> own;
    std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(own),
                 [&](const std::string& candidate) { return candidate.starts_with(element); });
    if (own.size() > mostNear) return oneOf(own);
    std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(names),
                 [&](const std::string& candidate) { return shareAPart(word, candidate); });
  }
  if (const std::size_t end = word.find('.'); end != std::string_view::npos)  // of what is named first, before others
    std::stable_partition(names.begin(), names.end(),
                          [&](const std::string& candidate) { return candidate.starts_with(word.substr(0, end + 1)); });
  if (candidates.size() == 1) names = candidates;
  return names.empty() ? oneOf(candidates) : alternatives(names);
}

std::string oneOf(const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  if (names.size() == 1) return names[0];
  std::string text = "one of: ";
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i > 0 ? ", " : "") + names[i];
  if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
  return text;
}

std::string unknownName(std::string_view kind, std::string_view word, const std::vector<std::string>& candidates) {
  const std::string start = "unknown " + std::string(kind) + " '" + std::string(word) + "'";
  if (candidates.empty()) return start + ": there is none yet";
  const std::string nearest = nearestName(word, candidates);
  return nearest.empty() ? start : start + "; did you mean '" + nearest + "'?";
}

namespace {

std::string inParentheses(const std::string& remark) { return remark.empty() ? "" : " (" + remark + ")"; }

}  // namespace

UnknownName::UnknownName(const std::string& kind, const std::string& word, const std::vector<std::string>& candidates,
                         const std::string& remark, std::string number)
    : Refusal(unknownName(kind, word, candidates) + inParentheses(remark), "unknown " + kind + " " + inQuotes(word),
              expectedName(word, candidates) + inParentheses(remark)),
      word_(word),
      number_(std::move(number)) {}

WrongUnit::WrongUnit(const std::string& kind, const std::string& parameter, const std::string& unit,
                     const std::string& use, const std::string& wanted)
    : WrongUnit(
          "the " + kind + " " + inQuotes(parameter) + " is in " + unit + ", but " + inQuotes(use) + " is in " + wanted,
          parameter, "a " + kind + " in " + wanted) {}

WrongUnit::WrongUnit(const std::string& problem, const std::string& parameter, const std::string& expected)
    : Refusal(problem, problem, expected), parameter_(parameter) {}

}  // namespace gamut
