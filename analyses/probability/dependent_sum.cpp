// With P(X < x_a) <= a and P(Y < y_b) <= b, P(X + Y < x_a + y_b) <= a + b, for all a + b = u: the greatest of these
// sums is a quantile that the sum's u-quantile is not below. Upper ones follow likewise from P(X > x_a) <= 1 - a.
#include "analyses/probability/dependent_sum.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"

namespace gamut {
namespace {

constexpr std::size_t levelCount = 2048;

/// [i]: the least value at which the distribution function is i/levelCount or more; the last where rounding hides it.
std::vector<long> quantilesOf(const GridMasses& variable) {
  std::vector<long> quantiles;
  double sum = variable.mass.front();
  std::size_t at = 0;
  for (std::size_t i = 0; i <= levelCount; ++i) {
    const double level = static_cast<double>(i) / levelCount;
    while (sum < level && at + 1 < variable.mass.size()) sum += variable.mass[++at];
    quantiles.push_back(variable.first + static_cast<long>(at));
  }
  return quantiles;
}

std::vector<long> leastOf(const std::vector<long>& x, const std::vector<long>& y) {
  std::vector<long> sum(levelCount + 1, std::numeric_limits<long>::min());
  for (std::size_t i = 0; i <= levelCount; ++i)
    for (std::size_t j = 0; j <= i; ++j) sum[i] = std::max(sum[i], x[j] + y[i - j]);
  return sum;
}

std::vector<long> greatestOf(const std::vector<long>& x, const std::vector<long>& y) {
  std::vector<long> sum(levelCount + 1, std::numeric_limits<long>::max());
  for (std::size_t i = 0; i <= levelCount; ++i)
    for (std::size_t j = i; j <= levelCount; ++j) sum[i] = std::min(sum[i], x[j] + y[levelCount + i - j]);
  return sum;
}

/// Each as probable as the others.
GridMasses massesOf(std::vector<long>::const_iterator begin) {
  const auto [least, greatest] = std::ranges::minmax(std::span(begin, levelCount));
  GridMasses masses{least, std::vector<double>(static_cast<std::size_t>(greatest - least + 1), 0.0)};
  for (std::size_t i = 0; i < levelCount; ++i) masses.mass[begin[static_cast<long>(i)] - least] += 1.0 / levelCount;
  return masses;
}

}  // namespace

GridSum dependentSumOf(const std::vector<GridBounds>& parts) {
  std::vector<long> low = quantilesOf(parts.front().below), high = quantilesOf(parts.front().above);
  double roundings = static_cast<double>(parts.front().below.mass.size() + parts.front().above.mass.size());
  for (std::size_t i = 1; i < parts.size(); ++i) {
    Work::count(Work::transformed, 0.5 * levelCount * levelCount);
    low = leastOf(low, quantilesOf(parts[i].below));
    high = greatestOf(high, quantilesOf(parts[i].above));
    roundings += static_cast<double>(parts[i].below.mass.size() + parts[i].above.mass.size());
  }
  // The values of a level begin at its lower end, and end at its upper one.
  return {{massesOf(low.begin()), massesOf(high.begin() + 1)}, roundings * bounds::unit * bounds::up};
}

}  // namespace gamut
