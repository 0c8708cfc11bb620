#include "reports/page/decided_map.hpp"

#include <algorithm>
#include <cmath>

namespace gamut {
namespace {

/// How many cells lie over each place: ups and downs at corners, which sums make numbers of.
class Counts {
 public:
  explicit Counts(int size)
      : side_(size + 1), counts_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)) {}

  void add(int left, int right, int bottom, int top) {
    ++at(left, bottom), ++at(right, top);
    --at(right, bottom), --at(left, top);
  }
  void sum() {
    for (int y = 0; y < side_; ++y)
      for (int x = 1; x < side_; ++x) at(x, y) += at(x - 1, y);
    for (int y = 1; y < side_; ++y)
      for (int x = 0; x < side_; ++x) at(x, y) += at(x, y - 1);
  }
  int& at(int x, int y) {
    return counts_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(x)];
  }

 private:
  int side_;
  std::vector<int> counts_;
};

/// Runs of rows, those that lie upon each other joined.
template <class IsThere>
std::vector<DecidedMap::Rectangle> rectangles(int size, const IsThere& isThere) {
  std::vector<DecidedMap::Rectangle> found;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      if (!isThere(x, y)) continue;
      int end = x;
      while (end < size && isThere(end, y)) ++end;
      const auto below = std::ranges::find_if(found, [&](const DecidedMap::Rectangle& other) {
        return other[0] == x && other[2] == end - x && other[1] + other[3] == y;
      });
      if (below != found.end())
        ++(*below)[3];
      else
        found.push_back({x, y, end - x, 1});
      x = end;
    }
  return found;
}

}  // namespace

DecidedMap decidedMap(const std::vector<const RequirementCell*>& cells, std::size_t across, std::size_t upward,
                      int size) {
  Counts met(size), violated(size), open(size);
  const auto before = [&](double end) {
    return std::clamp(static_cast<int>(std::floor(0.5 * (end + 1) * size)), 0, size);
  };
  const auto behind = [&](double end) {
    return std::clamp(static_cast<int>(std::ceil(0.5 * (end + 1) * size)), 0, size);
  };
  for (const RequirementCell* cell : cells) {
    Counts& counts = cell->word == Decision::met ? met : cell->word == Decision::violated ? violated : open;
    counts.add(before(cell->lower[across]), behind(cell->upper[across]), before(cell->lower[upward]),
               behind(cell->upper[upward]));
  }
  for (Counts* counts : {&met, &violated, &open}) counts->sum();
  const auto isAll = [&](Counts& of, Counts& other) {
    return rectangles(size, [&](int x, int y) { return of.at(x, y) > 0 && other.at(x, y) == 0 && open.at(x, y) == 0; });
  };
  return {isAll(met, violated), isAll(violated, met)};
}

}  // namespace gamut
