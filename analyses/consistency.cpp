// Cuts against tails.
#include "analyses/consistency.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace gamut {
namespace {

constexpr int levels = 256;

/// P(X < value) at most.
double belowAtMost(const Distribution& distribution, double value) {
  return value <= distribution.support().lower() ? 0 : distribution.enclosedBelow(Interval(value)).upper();
}
/// P(X > value) at most.
double aboveAtMost(const Distribution& distribution, double value) {
  return (Interval(1.0) - distribution.enclosedBelow(Interval(value))).upper();
}

}  // namespace

/// The line through the points of two levels lies, between them, outside the point of the next level: it has there at
/// least the degree that the tail beyond asks for.
Membership membershipOf(const Distribution& distribution, double centre) {
  const Interval& support = distribution.support();
  if (isThin(support)) return Membership::triangular(support.lower(), support.lower(), support.upper());
  const double left = std::clamp(midpoint(distribution.enclosedBelow(Interval(centre))), 0.0, 1.0), right = 1 - left;
  std::vector<Membership::Point> rising{{support.lower(), 0}}, falling{{support.upper(), 0}};
  for (int k = 0; k < levels; ++k) {
    const double tail = static_cast<double>(k) / levels, degree = static_cast<double>(k + 1) / levels;
    const double below = (Interval(left) * Interval(tail)).lower(), above = (Interval(right) * Interval(tail)).lower();
    double low = rising.back().value, high = falling.back().value;
    for (const double less : {0x1p-44, 0x1p-30, 0x1p-16}) {  // quantiles are rounded
      const double lower = std::min(distribution.quantile(below * (1 - less)), centre),
                   upper = std::max(distribution.quantile(1 - above * (1 - less)), centre);
      if (belowAtMost(distribution, lower) <= below) low = std::max(low, lower);
      if (aboveAtMost(distribution, upper) <= above) high = std::min(high, upper);
      if (low == lower && high == upper) break;
    }
    rising.push_back({low, degree});
    falling.push_back({high, degree});
  }
  rising.insert(rising.end(), falling.rbegin(), falling.rend());
  return Membership::table(rising);
}

/// The greatest levels are ever closer to each other, since a cut that is one value gives its share to that value
/// alone; of a share below 2^-38 the next wider one takes it instead.
Distribution distributionOf(const Membership& membership) {
  const Interval& support = membership.support();
  if (isThin(support)) return Distribution::uniform(support);
  std::vector<double> ends;  // of levels
  for (int k = 1; k < levels; ++k) ends.push_back(static_cast<double>(k) / levels);
  for (int j = 1; j <= 32; ++j) ends.push_back(1 - std::ldexp(1.0 / levels, -j));
  ends.push_back(1);
  std::vector<Interval> cuts;
  std::vector<double> shares, values{support.lower(), support.upper()};
  double before = 0, alone = 0;  // `alone`: the share of a single value
  for (const double end : ends) {
    const double share = end - std::exchange(before, end);
    const Interval cut = membership.cut(end);
    if (isThin(cut)) {
      alone += share;
      continue;
    }
    cuts.push_back(cut);
    shares.push_back(share);
    values.insert(values.end(), {cut.lower(), cut.upper()});
  }
  if (alone < 0x1p-38 && !shares.empty()) shares.back() += std::exchange(alone, 0.0);
  if (alone > 0) values.push_back(membership.core().lower());
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (alone > 0) values.insert(std::ranges::find(values, membership.core().lower()), membership.core().lower());
  std::vector<double> weights(values.size() - 1, 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double length = values[i + 1] - values[i];
    if (length == 0) weights[i] = alone;
    for (std::size_t k = 0; k < cuts.size(); ++k)
      if (cuts[k].lower() <= values[i] && values[i + 1] <= cuts[k].upper())
        weights[i] += shares[k] * length / (cuts[k].upper() - cuts[k].lower());
  }
  return Distribution::histogram(values, weights);
}

/// For α between two levels, 1 - α is at most that of the lower one, and P(cut) at least that of the upper one.
double inconsistency(const Distribution& distribution, const Membership& membership) {
  double greatest = 0;
  for (int k = 0; k < levels; ++k) {
    const Interval cut = membership.cut(static_cast<double>(k + 1) / levels);
    const Interval inside = Interval(1.0) - Interval(belowAtMost(distribution, cut.lower())) -
                            Interval(aboveAtMost(distribution, cut.upper()));
    const Interval missing = Interval(1.0) - Interval(static_cast<double>(k) / levels) - inside;
    greatest = std::max(greatest, missing.upper());
  }
  return greatest;
}

}  // namespace gamut
