#include "analyses/probability/joint_masses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "analyses/flow/error_bounds.hpp"
#include "analyses/normal_distribution.hpp"
#include "analyses/probability/dependent_sum.hpp"
#include "analyses/probability/quantity_masses.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr double boundless = std::numeric_limits<double>::infinity();

/// A polynomial at the edges of a part's bins, and bounds of it between any two of these.
class Course {
 public:
  /// Horner's scheme is off by 2 n u Σ|c|, an η of the grid by one rounding more; between its values f leaves its chord
  /// by (2/count)²/8 |f''|.
  Course(const std::vector<double>& f, long count, bool overlap) {
    double size = 0, bend = 0, slope = 0;  // Σ|c|; |f''| and |f'| at most
    for (std::size_t n = 1; n < f.size(); ++n) {
      size += std::fabs(f[n]);
      slope += static_cast<double>(n) * std::fabs(f[n]);
      bend += static_cast<double>(n * (n - 1)) * std::fabs(f[n]);
    }
    const double rounding = (2 * static_cast<double>(f.size() + 2) * size + 4 * slope) * bounds::unit * bounds::up;
    const double sag = 0.5 * bend / (static_cast<double>(count) * static_cast<double>(count)) * bounds::up;
    error_ = (rounding + sag) * bounds::up;
    for (long i = 0; i <= count; ++i) {
      const double eta = -1 + 2 * (static_cast<double>(i) / static_cast<double>(count));
      double sum = 0;
      for (std::size_t n = f.size(); n-- > 1;) sum = (sum + f[n]) * eta;
      value_.push_back(sum);
    }
    if (!overlap) return;
    least_.push_back(value_), greatest_.push_back(value_);
    for (std::size_t by = 1; 2 * by <= value_.size(); by *= 2) {  // of 2 by neighbours
      std::vector<double> low, high;
      for (std::size_t i = 0; i + 2 * by <= value_.size(); ++i) {
        low.push_back(std::min(least_.back()[i], least_.back()[i + by]));
        high.push_back(std::max(greatest_.back()[i], greatest_.back()[i + by]));
      }
      least_.push_back(std::move(low)), greatest_.push_back(std::move(high));
    }
  }

  double error() const { return error_; }
  /// From edge to edge; without tables only to the next.
  std::pair<double, double> over(long from, long until) const {
    const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(until);
    if (b == a + 1) return std::minmax(value_[a], value_[b]);
    std::size_t level = 0;
    while ((std::size_t{2} << level) <= b - a + 1) ++level;
    const std::size_t last = b + 1 - (std::size_t{1} << level);
    return {std::min(least_[level][a], least_[level][last]), std::max(greatest_[level][a], greatest_[level][last])};
  }
  std::pair<double, double> all() const {
    const auto [least, greatest] = std::ranges::minmax(value_);
    return {least, greatest};
  }

 private:
  double error_ = 0;
  std::vector<double> value_;
  std::vector<std::vector<double>> least_, greatest_;  // [level]: of 2^level neighbours
};

constexpr long bins = QuantityMasses::bins;

}  // namespace

// ---- Elements -------------------------------------------------------------------------------------------------------

/// A quantity of distribution F is F⁻¹(u), u uniform: above an edge e where F(e) < u, not above it where u <= F(e).
/// Between neighbours among all bounds of F at edges, which edges these are does not change.
void JointMasses::addBox(Group& group, const std::vector<Interval>& below) {
  std::vector<double> levels{0, 1};
  for (const Interval& f : below) levels.insert(levels.end(), {f.lower(), f.upper()});
  std::ranges::sort(levels);
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  std::size_t from = 0, until = 1;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    while (from + 1 < below.size() && below[from + 1].upper() <= levels[i]) ++from;
    while (until + 1 < below.size() && below[until].lower() < levels[i + 1]) ++until;
    group.from.push_back(static_cast<std::uint16_t>(std::min(from, until - 1)));
    group.until.push_back(static_cast<std::uint16_t>(until));
    group.mass.push_back(levels[i + 1] - levels[i]);
    error_ += bounds::unit;
  }
}

void JointMasses::addEvidence(Group& group, const FlowSymbol& symbol, const Distribution& distribution) {
  const auto valueAt = [&](long i) {
    return Interval(symbol.centre) + Interval(symbol.half) * (-1 + 2 * (static_cast<double>(i) / bins));
  };
  Interval all(0.0);
  for (const FocalInterval& focal : distribution.focal()) all = all + focal.mass;
  for (const FocalInterval& focal : distribution.focal()) {
    const auto guess = [&](double value) {
      const double place = ((value - symbol.centre) / symbol.half + 1) * static_cast<double>(bins) / 2;
      return static_cast<long>(std::clamp(place, 0.0, static_cast<double>(bins)));
    };
    long from = guess(focal.values.lower()), until = guess(focal.values.upper());
    while (from > 0 && valueAt(from).upper() > focal.values.lower()) --from;
    while (until < bins && valueAt(until).lower() < focal.values.upper()) ++until;
    if (until <= from) from = std::min(from, bins - 1), until = from + 1;
    const Interval share = focal.mass / all;
    group.from.push_back(static_cast<std::uint16_t>(from));
    group.until.push_back(static_cast<std::uint16_t>(until));
    group.mass.push_back(midpoint(share));
    error_ += width(share);
  }
}

/// Boxes of independent normal numbers w (√2 wider than equally probable ones: the sum of mass times width is least),
/// and where the quantities are for these: at F⁻¹(Φ(z)), z = root·w. F(e) < Φ(z) where z > a with Φ(a) >= F(e), and
/// Φ(z) <= F(e) where z <= b with Φ(b) <= F(e).
void JointMasses::addCopula(Group& group, const GaussianCopula& copula, const std::vector<std::size_t>& rows,
                            const std::vector<std::vector<Interval>>& below) {
  const std::size_t axes = rows.back() + 1;
  constexpr double most = 1 << 18;
  const auto cells = static_cast<std::size_t>(std::floor(std::pow(most, 1.0 / static_cast<double>(axes)) + 1e-9));
  std::vector<Interval> w;
  std::vector<double> mass;
  double error = 0, end = -boundless;
  for (std::size_t i = 0; i < cells; ++i) {
    const double next =
        i + 1 == cells ? boundless
                       : std::sqrt(2.0) * aboutNormalQuantile(static_cast<double>(i + 1) / static_cast<double>(cells));
    const Interval share = (i + 1 == cells ? Interval(1.0) : normalBelow(Interval(next))) -
                           (i == 0 ? Interval(0.0) : normalBelow(Interval(end)));
    w.emplace_back(end, next);
    mass.push_back(midpoint(share));
    error += width(share);
    end = next;
  }
  // Products of k of them: off by (1 + e)^k - 1 in all, and by k roundings each.
  const double k = static_cast<double>(axes);
  error_ += 2 * k * (error + 4 * bounds::unit);
  std::vector<std::vector<double>> above, notAbove;  // [symbol][edge]: a and b
  for (const std::vector<Interval>& f : below) {
    std::vector<double>&a = above.emplace_back(), &b = notAbove.emplace_back();
    const auto place = [](double p, int side) {
      if (p <= 0) return -boundless;
      if (p >= 1) return boundless;
      const double z = aboutNormalQuantile(p);
      for (double by = 1e-14 * (1 + std::fabs(z)); by < 100; by *= 4) {
        const Interval at = normalBelow(Interval(z + side * by));
        if (side > 0 ? at.lower() >= p : at.upper() <= p) return z + side * by;
      }
      return side * boundless;
    };
    for (const Interval& p : f) a.push_back(place(p.upper(), 1)), b.push_back(place(p.lower(), -1));
    // Rising, as those of which they are bounds.
    for (std::size_t i = 1; i < a.size(); ++i) a[i] = std::max(a[i], a[i - 1]);
    for (std::size_t i = b.size() - 1; i-- > 0;) b[i] = std::min(b[i], b[i + 1]);
  }
  std::vector<std::size_t> number(axes, 0);
  for (bool isMore = true; isMore;) {
    double probability = 1;
    for (const std::size_t i : number) probability *= mass[i];
    for (std::size_t s = 0; s < rows.size(); ++s) {
      Interval z(0.0);
      for (std::size_t j = 0; j <= rows[s]; ++j) z = z + copula.root()[rows[s]][j] * w[number[j]];
      // The last edge that it is above, the first that it is not above.
      const auto from = std::ranges::lower_bound(above[s], z.lower()) - above[s].begin();
      const auto until = std::ranges::lower_bound(notAbove[s], z.upper()) - notAbove[s].begin();
      const long first = std::clamp<long>(from - 1, 0, bins - 1);
      group.from.push_back(static_cast<std::uint16_t>(first));
      group.until.push_back(static_cast<std::uint16_t>(std::clamp<long>(until, first + 1, bins)));
    }
    group.mass.push_back(probability);
    std::size_t j = 0;
    while (j < axes && ++number[j] == cells) number[j++] = 0;
    isMore = j < axes;
  }
}

JointMasses::JointMasses(int symbols, const std::vector<FlowSymbol>& quantities,
                         const std::vector<const Uncertain*>& uncertain, const QuantityDependence& dependence)
    : symbols_(symbols), groupOf_(at(symbols), -1), isPlain_(dependence.isNone()) {
  constexpr std::size_t mostTogether = 9;
  std::vector<std::vector<std::size_t>> unknown = dependence.unknown;
  const auto belowOf = [&](std::size_t q) { return edgesOf(quantities[q], uncertain[q]->distribution); };
  for (const GaussianCopula& copula : dependence.copulas) {
    if (copula.quantities().size() > mostTogether) {
      unknown.push_back(copula.quantities());
      continue;
    }
    Group group;
    std::vector<std::size_t> rows;
    std::vector<std::vector<Interval>> below;
    for (std::size_t i = 0; i < copula.quantities().size(); ++i) {
      const std::size_t q = copula.quantities()[i];
      if (quantities[q].symbol < 0) continue;
      rows.push_back(i);
      group.symbols.push_back(quantities[q].symbol);
      groupOf_[at(quantities[q].symbol)] = static_cast<int>(groups_.size());
      below.push_back(belowOf(q));
    }
    if (rows.empty()) continue;
    addCopula(group, copula, rows, below);
    blocks_.push_back({groups_.size()});
    groups_.push_back(std::move(group));
  }
  for (std::size_t q = 0; q < uncertain.size(); ++q) {
    const Distribution& distribution = uncertain[q]->distribution;
    isPlain_ = isPlain_ && distribution.isPrecise();
    if (quantities[q].symbol < 0 || groupOf_[at(quantities[q].symbol)] >= 0) continue;
    Group group;
    group.symbols = {quantities[q].symbol};
    groupOf_[at(quantities[q].symbol)] = static_cast<int>(groups_.size());
    if (!distribution.focal().empty())
      addEvidence(group, quantities[q], distribution);
    else if (const std::vector<Interval> below = belowOf(q);
             !distribution.isPrecise() ||
             // A value of its own probability is, as far as is known, on either side of an edge.
             std::ranges::any_of(below, [](const Interval& f) { return width(f) > 1e-9; }))
      addBox(group, below);
    else {
      BinMasses known = massesBetween(below);
      group.mass = std::move(known.mass);
      error_ += known.error;
    }
    groups_.push_back(std::move(group));
  }
  std::vector<char> isPlaced(groups_.size(), 0);
  for (const std::vector<std::size_t>& block : blocks_) isPlaced[block[0]] = 1;
  for (const std::vector<std::size_t>& together : unknown) {
    std::vector<std::size_t> block;
    for (const std::size_t q : together)
      if (quantities[q].symbol >= 0) block.push_back(at(groupOf_[at(quantities[q].symbol)]));
    for (const std::size_t g : block) isPlaced[g] = 1;
    if (!block.empty()) blocks_.push_back(std::move(block));
  }
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (isPlaced[g] == 0) blocks_.push_back({g});
  error_ *= bounds::up;
}

// ---- Parts ----------------------------------------------------------------------------------------------------------

JointMasses::Part JointMasses::whole() const {
  return {std::vector<long>(at(symbols_), 0), std::vector<long>(at(symbols_), bins),
          std::vector<std::shared_ptr<const std::vector<std::uint32_t>>>(groups_.size())};
}

FlowPart JointMasses::boxOf(const Part& part) {
  FlowPart box;
  for (std::size_t l = 0; l < part.first.size(); ++l) {
    box.centre.push_back(-1 + static_cast<double>(2 * part.first[l] + part.count[l]) / bins);
    box.half.push_back(static_cast<double>(part.count[l]) / bins);
  }
  return box;
}

/// Whether its group is independent of all others.
bool JointMasses::isAlone(int symbol) const {
  const int group = groupOf_[at(symbol)];
  return group >= 0 && std::ranges::any_of(blocks_, [&](const auto& b) { return b.size() == 1 && b[0] == at(group); });
}

template <class Take>
void JointMasses::forEach(const Part& part, std::size_t group, const Take& take) const {
  if (part.elements[group]) {
    for (const std::uint32_t i : *part.elements[group]) take(i);
  } else {
    for (std::uint32_t i = 0; i < groups_[group].mass.size(); ++i) take(i);
  }
}

/// Those elements alone, and where they lie.
JointMasses::Part JointMasses::with(const Part& part, std::size_t group, std::vector<std::uint32_t> elements) const {
  Part found = part;
  const Group& g = groups_[group];
  const std::size_t symbols = g.symbols.size();
  for (std::size_t s = 0; s < symbols; ++s) {
    long from = bins, until = 0;
    for (const std::uint32_t i : elements) {
      from = std::min<long>(from, g.from[i * symbols + s]);
      until = std::max<long>(until, g.until[i * symbols + s]);
    }
    found.first[at(g.symbols[s])] = from;
    found.count[at(g.symbols[s])] = until - from;
  }
  found.elements[group] = std::make_shared<const std::vector<std::uint32_t>>(std::move(elements));
  return found;
}

/// Elements apart by the side, 0 to 2, that their first bin and the one behind their last are on.
template <class Side>
std::vector<JointMasses::Part> JointMasses::apart(const Part& part, int symbol, const Side& sideOf) const {
  const std::size_t number = at(groupOf_[at(symbol)]);
  const Group& group = groups_[number];
  const std::size_t symbols = group.symbols.size();
  const auto s = static_cast<std::size_t>(std::ranges::find(group.symbols, symbol) - group.symbols.begin());
  std::vector<std::uint32_t> sides[3];
  forEach(part, number, [&](std::uint32_t i) {
    sides[sideOf(long{group.from[i * symbols + s]}, long{group.until[i * symbols + s]})].push_back(i);
  });
  std::vector<Part> parts;
  for (std::vector<std::uint32_t>& side : sides)
    if (!side.empty()) parts.push_back(with(part, number, std::move(side)));
  return parts.size() > 1 ? parts : std::vector<Part>{part};
}

std::vector<JointMasses::Part> JointMasses::cut(const Part& part, int symbol, long edge) const {
  const long first = part.first[at(symbol)], until = first + part.count[at(symbol)];
  if (!isAlone(symbol) || edge <= first || edge >= until) return {part};
  if (!groups_[at(groupOf_[at(symbol)])].from.empty())
    return apart(part, symbol, [&](long from, long end) { return end <= edge ? 0 : from >= edge ? 1 : 2; });
  std::vector<Part> both(2, part);
  both[0].count[at(symbol)] = edge - first;
  both[1].first[at(symbol)] = edge;
  both[1].count[at(symbol)] = until - edge;
  return both;
}

std::vector<JointMasses::Part> JointMasses::halves(const Part& part, int symbol) const {
  const long first = part.first[at(symbol)], count = part.count[at(symbol)];
  if (!isAlone(symbol) || count < 2) return {part};
  if (groups_[at(groupOf_[at(symbol)])].from.empty()) return cut(part, symbol, first + count / 2);
  const std::vector<Part> halves = apart(part, symbol, [&](long from, long until) {
    return 2 * (until - from) > count ? 2 : from + until > 2 * first + count ? 1 : 0;
  });
  if (halves.size() > 1) return halves;
  // All are wide, or on one side: those that begin first, and the others.
  return apart(part, symbol, [&](long from, long) { return from == first ? 0 : 1; });
}

double JointMasses::massOf(const Part& part, std::size_t group) const {
  const Group& g = groups_[group];
  if (g.from.empty()) {
    const auto begin = g.mass.begin() + part.first[at(g.symbols[0])];
    return std::accumulate(begin, begin + part.count[at(g.symbols[0])], 0.0);
  }
  double mass = 0;
  forEach(part, group, [&](std::uint32_t i) { mass += g.mass[i]; });
  return mass;
}

double JointMasses::massOf(const Part& part) const {
  double mass = 1;
  for (std::size_t g = 0; g < groups_.size(); ++g) mass *= massOf(part, g);
  return mass;
}

/// Of each group's masses, which are 1 in all, a sum is off by no more than their number; twice, for products of sums.
double JointMasses::roundings() const {
  double count = 64;
  for (const Group& group : groups_) count += 2 * static_cast<double>(group.mass.size());
  return count * bounds::unit;
}

// ---- Sums -----------------------------------------------------------------------------------------------------------

GridBounds JointMasses::boundsOf(const Part& part, std::size_t group, const std::vector<std::vector<double>>& f,
                                 const Interval& rest, double step) const {
  const Group& g = groups_[group];
  const std::size_t symbols = g.symbols.size();
  std::vector<Course> courses;
  double error = 0, least = 0, greatest = 0, reach = 0;
  for (const int l : g.symbols) {
    courses.emplace_back(f[at(l)], part.count[at(l)], !g.from.empty());
    error += courses.back().error();
    const auto [low, high] = courses.back().all();
    least += low, greatest += high;
    reach += std::max(std::fabs(low), std::fabs(high));
  }
  error = (error + static_cast<double>(symbols) * bounds::unit * reach) * bounds::up;  // of sums of values
  const double down = subDown(rest.lower(), error), up = addUp(rest.upper(), error);
  const auto floorOf = [&](double x) { return static_cast<long>(std::floor(addDown(x, down) / step)); };
  const auto ceilOf = [&](double x) { return static_cast<long>(std::ceil(addUp(x, up) / step)); };
  GridMasses below{floorOf(least), {}}, above{ceilOf(least), {}};
  below.mass.assign(static_cast<std::size_t>(floorOf(greatest) - below.first + 1), 0.0);
  above.mass.assign(static_cast<std::size_t>(ceilOf(greatest) - above.first + 1), 0.0);
  const auto put = [&](double low, double high, double mass) {
    below.mass[static_cast<std::size_t>(floorOf(low) - below.first)] += mass;
    above.mass[static_cast<std::size_t>(ceilOf(high) - above.first)] += mass;
  };
  if (g.from.empty()) {
    const long first = part.first[at(g.symbols[0])], count = part.count[at(g.symbols[0])];
    for (long i = 0; i < count; ++i) {
      const auto [low, high] = courses[0].over(i, i + 1);
      put(low, high, g.mass[static_cast<std::size_t>(first + i)]);
    }
  } else {
    forEach(part, group, [&](std::uint32_t i) {
      double low = 0, high = 0;
      for (std::size_t s = 0; s < symbols; ++s) {
        const long first = part.first[at(g.symbols[s])];
        const auto [a, b] = courses[s].over(g.from[i * symbols + s] - first, g.until[i * symbols + s] - first);
        low += a, high += b;
      }
      put(low, high, g.mass[i]);
    });
  }
  return {std::move(below), std::move(above)};
}

/// Probabilities of the groups that are off by e in all make those of sums be off by no more than Σ e.
GridSum JointMasses::sumOf(const Part& part, const std::vector<std::vector<double>>& f, Interval rest,
                           double step) const {
  const auto sizeOf = [&](int symbol) {
    double size = 0;
    for (const double c : f[at(symbol)]) size += std::fabs(c);
    return size;
  };
  // What hardly varies counts as error.
  double scale = 1, beside = 0;
  std::vector<const std::vector<std::size_t>*> varying;
  for (const std::vector<std::size_t>& block : blocks_) {
    double size = 0;
    for (const std::size_t g : block)
      for (const int l : groups_[g].symbols) size += sizeOf(l);
    if (size > 0.05 * step) {
      varying.push_back(&block);
    } else {
      beside += size;
      for (const std::size_t g : block) scale *= massOf(part, g);
    }
  }
  for (int l = 0; l < symbols_; ++l)
    if (groupOf_[at(l)] < 0) beside += sizeOf(l);
  beside *= bounds::up;
  rest = Interval(subDown(rest.lower(), beside), addUp(rest.upper(), beside));
  double error = error_;
  std::vector<GridBounds> parts;
  for (const std::vector<std::size_t>* block : varying) {
    std::vector<GridBounds> together;
    for (const std::size_t g : *block) {
      together.push_back(boundsOf(part, g, f, rest, step));
      rest = Interval(0.0);
    }
    if (together.size() == 1) {
      parts.push_back(std::move(together[0]));
      continue;
    }
    GridSum sum = dependentSumOf(together);
    error += sum.error;
    parts.push_back(std::move(sum.sum));
  }
  if (parts.empty())
    parts.push_back({{static_cast<long>(std::floor(rest.lower() / step)), {1.0}},
                     {static_cast<long>(std::ceil(rest.upper() / step)), {1.0}}});
  GridSum result = gamut::sumOf(parts);
  for (GridMasses* side : {&result.sum.below, &result.sum.above})
    for (double& mass : side->mass) mass *= scale;
  result.error += roundings() + error;
  return result;
}

}  // namespace gamut
