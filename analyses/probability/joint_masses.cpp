#include "analyses/probability/joint_masses.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/probability/binned_polynomial.hpp"
#include "analyses/probability/dependent_sum.hpp"
#include "analyses/probability/quantity_masses.hpp"
#include "analyses/probability/swapped.hpp"
#include "analyses/work.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr long bins = QuantityMasses::bins;
constexpr std::size_t mostBoxes = 1 << 18;  // of a part

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

JointMasses::JointMasses(int symbols, const std::vector<FlowSymbol>& quantities,
                         const std::vector<const Uncertain*>& uncertain, const QuantityDependence& dependence)
    : symbols_(symbols), groupOf_(at(symbols), -1), isPlain_(dependence.isNone()) {
  const auto belowOf = [&](std::size_t q) { return edgesOf(quantities[q], uncertain[q]->distribution); };
  for (const GaussianCopula& copula : dependence.copulas) {
    Group group;
    std::vector<std::size_t> rows;
    std::vector<std::vector<Interval>> below;
    for (std::size_t i = 0; i < copula.quantities().size(); ++i) {
      const std::size_t q = copula.quantities()[i];
      if (quantities[q].symbol < 0) continue;
      rows.push_back(i);
      group.symbols.push_back(quantities[q].symbol);
      groupOf_[quantities[q].symbol] = static_cast<int>(groups_.size());
      below.push_back(belowOf(q));
    }
    if (rows.empty()) continue;
    group.copula.emplace(copula, rows, below);
    error_ += group.copula->error();
    blocks_.push_back({groups_.size()});
    groups_.push_back(std::move(group));
  }
  for (std::size_t q = 0; q < uncertain.size(); ++q) {
    const Distribution& distribution = uncertain[q]->distribution;
    isPlain_ = isPlain_ && distribution.isPrecise();
    if (quantities[q].symbol < 0 || groupOf_[quantities[q].symbol] >= 0) continue;
    Group group;
    group.symbols = {quantities[q].symbol};
    groupOf_[quantities[q].symbol] = static_cast<int>(groups_.size());
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
      group.error = known.error;
      group.lean = leansOf(quantities[q], distribution, group.mass);
      const auto [most, variation] = distribution.densityBound();
      group.density = {most * quantities[q].half * bounds::up, variation * quantities[q].half * bounds::up};
      error_ += known.error;
    }
    groups_.push_back(std::move(group));
  }
  std::vector<char> isPlaced(groups_.size(), 0);
  for (const std::vector<std::size_t>& block : blocks_) isPlaced[block[0]] = 1;
  for (const std::vector<std::size_t>& together : dependence.unknown) {
    std::vector<std::size_t> block;
    for (const std::size_t q : together)
      if (quantities[q].symbol >= 0) block.push_back(at(groupOf_[quantities[q].symbol]));
    for (const std::size_t g : block) isPlaced[g] = 1;
    if (!block.empty()) blocks_.push_back(std::move(block));
  }
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (isPlaced[g] == 0) blocks_.push_back({g});
  error_ *= bounds::up;
}

// ---- Parts ----------------------------------------------------------------------------------------------------------

JointMasses::Part JointMasses::whole() const {
  Part all{std::vector<long>(symbols_, 0), std::vector<long>(symbols_, bins), {}, {}};
  all.elements.resize(groups_.size());
  all.boxes.resize(groups_.size());
  return all;
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
  const int group = groupOf_[symbol];
  return group >= 0 && std::ranges::any_of(blocks_, [&](const auto& b) { return b.size() == 1 && b[0] == at(group); });
}

int JointMasses::copulaOf(int symbol) const {
  const int group = groupOf_[symbol];
  return group >= 0 && groups_[group].copula ? group : -1;
}

const JointMasses::Group& JointMasses::groupOf(int symbol) const { return groups_[groupOf_[symbol]]; }

template <class Take>
void JointMasses::forEach(const Part& part, std::size_t group, const Take& take) const {
  if (part.elements[group]) {
    for (const std::uint32_t i : *part.elements[group]) take(i);
  } else {
    for (std::uint32_t i = 0; i < groups_[group].mass.size(); ++i) take(i);
  }
}

std::vector<CopulaMasses::Box> JointMasses::boxesOf(const Part& part, std::size_t group) const {
  return part.boxes[group] ? *part.boxes[group] : std::vector<CopulaMasses::Box>{groups_[group].copula->whole()};
}

/// Those elements alone, and where they lie.
JointMasses::Part JointMasses::with(const Part& part, std::size_t group, std::vector<std::uint32_t> elements) const {
  Part found = part;
  const Group& g = groups_[group];
  long from = bins, until = 0;
  for (const std::uint32_t i : elements) {
    from = std::min<long>(from, g.from[i]);
    until = std::max<long>(until, g.until[i]);
  }
  found.first[g.symbols[0]] = from;
  found.count[g.symbols[0]] = until - from;
  found.elements[group] = std::make_shared<const std::vector<std::uint32_t>>(std::move(elements));
  return found;
}

JointMasses::Part JointMasses::with(const Part& part, std::size_t group, std::vector<CopulaMasses::Box> boxes) const {
  Part found = part;
  const Group& g = groups_[group];
  for (std::size_t s = 0; s < g.symbols.size(); ++s) {
    long from = bins, until = 0;
    for (const CopulaMasses::Box& box : boxes) {
      const auto [first, end] = g.copula->binsOf(box, s);
      from = std::min(from, first), until = std::max(until, end);
    }
    found.first[g.symbols[s]] = from;
    found.count[g.symbols[s]] = until - from;
  }
  found.boxes[group] = std::make_shared<const std::vector<CopulaMasses::Box>>(std::move(boxes));
  return found;
}

/// Elements, or boxes, apart by the side, 0 to 2, of their first bin and the one behind their last; -1: of halves, but
/// where the third argument says that there are none, since a box is no more probable than `least`.
template <class Side>
std::vector<JointMasses::Part> JointMasses::apart(const Part& part, int symbol, double least,
                                                  const Side& sideOf) const {
  const std::size_t number = at(groupOf_[symbol]);
  const Group& group = groups_[number];
  std::vector<Part> parts;
  const auto collect = [&](auto& sides) {
    for (auto& side : sides)
      if (!side.empty()) parts.push_back(with(part, number, std::move(side)));
    return parts.size() > 1 ? parts : std::vector<Part>{part};
  };
  if (!group.copula) {
    std::vector<std::uint32_t> sides[3];
    Work::count(Work::focalElement, 0.2 * static_cast<double>(group.mass.size()));
    forEach(part, number, [&](std::uint32_t i) { sides[sideOf(group.from[i], group.until[i], true)].push_back(i); });
    return collect(sides);
  }
  const auto row = static_cast<std::size_t>(std::ranges::find(group.symbols, symbol) - group.symbols.begin());
  std::vector<CopulaMasses::Box> sides[3], waiting = boxesOf(part, number);
  std::size_t count = waiting.size();
  CopulaMasses::Box lower, upper;
  while (!waiting.empty()) {
    Work::count(Work::focalElement, 2);
    CopulaMasses::Box box = std::move(waiting.back());
    waiting.pop_back();
    const auto [from, until] = group.copula->binsOf(box, row);
    int side = sideOf(from, until, box.mass <= least || count >= mostBoxes);
    if (side < 0 && group.copula->halve(box, row, lower, upper)) {
      waiting.push_back(lower), waiting.push_back(upper);
      ++count;
      continue;
    }
    if (side < 0) side = sideOf(from, until, true);
    sides[side].push_back(std::move(box));
  }
  return collect(sides);
}

std::vector<JointMasses::Part> JointMasses::cut(const Part& part, int symbol, long edge) const {
  const long first = part.first[symbol], until = first + part.count[symbol];
  if (!isAlone(symbol) || edge <= first || edge >= until) return {part};
  if (!isOfBins(groupOf(symbol)))
    return apart(part, symbol, 0x1p-18, [&](long from, long end, bool isSmall) {
      return end <= edge ? 0 : from >= edge ? 1 : isSmall ? 2 : -1;
    });
  std::vector<Part> both(2, part);
  both[0].count[symbol] = edge - first;
  both[1].first[symbol] = edge;
  both[1].count[symbol] = until - edge;
  return both;
}

std::vector<JointMasses::Part> JointMasses::halves(const Part& part, int symbol) const {
  const long first = part.first[symbol], count = part.count[symbol];
  if (!isAlone(symbol) || count < 2) return {part};
  if (isOfBins(groupOf(symbol))) return cut(part, symbol, first + count / 2);
  const double least = massOf(part, at(groupOf_[symbol])) * 0x1p-14;
  std::vector<Part> halves = apart(part, symbol, least, [&](long from, long until, bool isSmall) {
    if (!isSmall && 4 * (until - from) > count) return -1;
    return 2 * (until - from) > count ? 2 : from + until > 2 * first + count ? 1 : 0;
  });
  if (halves.size() > 1) return halves;
  // All are wide, or on one side: those that begin first, and the others.
  return apart(part, symbol, 1, [&](long from, long, bool) { return from == first ? 0 : 1; });
}

double JointMasses::massOf(const Part& part, std::size_t group) const {
  const Group& g = groups_[group];
  if (g.copula) {
    if (!part.boxes[group]) return 1;
    double mass = 0;
    for (const CopulaMasses::Box& box : *part.boxes[group]) mass += box.mass;
    return mass;
  }
  if (isOfBins(g)) {
    Work::count(Work::bin, 0.07 * static_cast<double>(part.count[g.symbols[0]]));
    const auto begin = g.mass.begin() + part.first[g.symbols[0]];
    return std::accumulate(begin, begin + part.count[g.symbols[0]], 0.0);
  }
  double mass = 0;
  Work::count(Work::focalElement, 0.1 * static_cast<double>(g.mass.size()));
  forEach(part, group, [&](std::uint32_t i) { mass += g.mass[i]; });
  return mass;
}

double JointMasses::massOf(const Part& part) const {
  double mass = 1;
  for (std::size_t g = 0; g < groups_.size(); ++g) mass *= massOf(part, g);
  return mass;
}

std::size_t JointMasses::elements() const {
  std::size_t most = static_cast<std::size_t>(bins);
  for (const Group& group : groups_) most = std::max(most, group.mass.size());
  return most;
}

/// Of each group's masses, which are 1 in all, a sum is off by no more than their number; twice, for products of sums.
double JointMasses::roundings() const {
  double count = 64;
  for (const Group& group : groups_) count += 2 * static_cast<double>(group.copula ? mostBoxes : group.mass.size());
  return count * bounds::unit;
}

// ---- Sums -----------------------------------------------------------------------------------------------------------

/// Numbers below and above those of a polynomial on sets of bins.
class JointMasses::Sides {
 public:
  Sides(const BinnedPolynomial& own, const Interval& rest, double step)
      : down_(subDown(rest.lower(), own.error())), up_(addUp(rest.upper(), own.error())), step_(step) {
    const auto [least, greatest] = own.all();
    below_.first = floorOf(least), above_.first = ceilOf(least);
    below_.mass.assign(static_cast<std::size_t>(floorOf(greatest) - below_.first + 1), 0.0);
    above_.mass.assign(static_cast<std::size_t>(ceilOf(greatest) - above_.first + 1), 0.0);
  }

  void put(const std::pair<double, double>& bound, double mass) {
    below_.mass[floorOf(bound.first) - below_.first] += mass;
    above_.mass[ceilOf(bound.second) - above_.first] += mass;
  }

  GridBounds found(double elements) {
    Work::count(Work::bin, elements + 0.1 * static_cast<double>(below_.mass.size() + above_.mass.size()));
    return {std::move(below_), std::move(above_)};
  }

 private:
  long floorOf(double x) const { return static_cast<long>(std::floor(addDown(x, down_) / step_)); }
  long ceilOf(double x) const { return static_cast<long>(std::ceil(addUp(x, up_) / step_)); }

  double down_, up_, step_;
  GridMasses below_, above_;
};

/// Of a group of bins, each cut into so many of even density.
GridBounds JointMasses::boundsOfBins(const Part& part, std::size_t group, const std::vector<std::vector<double>>& f,
                                     const Interval& rest, double step, long finer) const {
  const Group& g = groups_[group];
  const std::size_t symbol = at(g.symbols[0]);
  const long first = part.first[symbol], count = part.count[symbol];
  const BinnedPolynomial own(f[symbol], count * finer);
  Sides sides(own, rest, step);
  for (long i = 0; i < count * finer; ++i)
    sides.put(own.over(i), g.mass[first + i / finer] / static_cast<double>(finer));
  return sides.found(static_cast<double>(count * finer));
}

GridSum JointMasses::boundsOf(const Part& part, std::size_t group, const std::vector<std::vector<double>>& f,
                              const std::vector<MixedTerm>& terms, const Interval& rest, double step) const {
  const Group& g = groups_[group];
  if (isOfBins(g)) return {boundsOfBins(part, group, f, rest, step, 1), 0};
  CopulaMasses::Function function;
  for (const int l : g.symbols) {
    function.f.emplace_back(f[l], part.count[l]);
    function.first.push_back(part.first[l]);
    function.f.back().makeTables();
  }
  if (g.copula) {
    for (MixedTerm term : terms) {
      if (groupOf_[term.powers.front().first] != static_cast<int>(group)) continue;
      for (auto& [row, power] : term.powers)
        row = static_cast<std::size_t>(std::ranges::find(g.symbols, static_cast<int>(row)) - g.symbols.begin());
      function.mixed.push_back(std::move(term));
    }
    return g.copula->sumOf(boxesOf(part, group), function, rest, step);
  }
  const BinnedPolynomial& own = function.f.front();
  const long first = function.first.front();
  Sides sides(own, rest, step);
  forEach(part, group, [&](std::uint32_t i) { sides.put(own.over(g.from[i] - first, g.until[i] - first), g.mass[i]); });
  return {sides.found(static_cast<double>(g.mass.size())), 0};
}

double JointMasses::stepsApart(const std::vector<std::vector<double>>& f) const {
  constexpr double kept = 2;
  double bounded = 0, swappable = 0, smooth = 0;
  for (std::size_t l = 0; l < f.size(); ++l) {
    const auto varies = [](double c) { return c != 0; };
    if (groupOf_[l] < 0 || std::ranges::none_of(f[l], varies)) continue;
    const Group& group = groupOf(static_cast<int>(l));
    if (!isOfBins(group) || !isAlone(static_cast<int>(l))) {
      ++bounded;
      continue;
    }
    ++swappable;
    if (isSteep(f[l]) && std::isfinite(group.density.variation)) ++smooth;
  }
  return bounded + (smooth < kept ? swappable : kept) + 1;
}

/// Takes known distributions of one symbol each from the blocks that vary, if that brings the sides closer; `rest` goes
/// to one that is kept. Probabilities of parts count as they are: what is said of a sum on a part is said of it over
/// its probability, times that of all.
void JointMasses::swap(const Part& part, const std::vector<std::vector<double>>& f, Interval& rest, double step,
                       std::vector<const std::vector<std::size_t>*>& varying, std::vector<GridBounds>& kept,
                       std::vector<GridMasses>& swapped, double& shift) const {
  std::vector<std::size_t> own;  // among those that vary
  std::vector<Summand> summands;
  std::vector<Swapped> found;
  for (std::size_t i = 0; i < varying.size(); ++i) {
    if (varying[i]->size() > 1 || !isOfBins(groups_[varying[i]->front()])) continue;
    const Group& group = groups_[varying[i]->front()];
    const std::size_t symbol = at(group.symbols[0]);
    const long first = part.first[symbol], count = part.count[symbol];
    const double half = static_cast<double>(count) / bins;
    own.push_back(i);
    summands.push_back({f[symbol],
                        group.mass.data() + first,
                        group.lean.data() + first,
                        count,
                        group.error,
                        {group.density.most * half, group.density.variation * half}});
    found.emplace_back(summands.back(), step);
    Work::count(Work::bin, static_cast<double>(count));
  }
  double all = 1;
  for (std::size_t g = 0; g < groups_.size(); ++g) all *= std::min(1.0, massOf(part, g) + error_ + roundings());
  const std::optional<Unswapped> best = unswapped(found, step, all * bounds::up);
  if (!best) return;
  shift = best->off;
  std::vector<char> isTaken(varying.size(), 0);
  for (std::size_t i = 0; i < own.size(); ++i) {
    isTaken[own[i]] = 1;
    if (i != best->first && i != best->second) {
      swapped.push_back(onGrid(summands[i], step));
      continue;
    }
    constexpr long most = 64;
    long finer = 1;
    while (finer < most && 4 * found[i].bin() > step * static_cast<double>(finer)) finer *= 2;
    kept.push_back(boundsOfBins(part, varying[own[i]]->front(), f, rest, step, finer));
    rest = Interval(0.0);
  }
  std::size_t i = 0;
  std::erase_if(varying, [&](const auto&) { return isTaken[i++] != 0; });
}

/// Probabilities of the groups that are off by e in all make those of sums be off by no more than Σ e.
GridSum JointMasses::sumOf(const Part& part, const std::vector<std::vector<double>>& f,
                           const std::vector<MixedTerm>& terms, Interval rest, double step, bool maySwap) const {
  const auto sizeOf = [&](int symbol) {
    double size = 0;
    for (const double c : f[symbol]) size += std::fabs(c);
    return size;
  };
  // What hardly varies counts as error.
  double scale = 1, beside = 0;
  std::vector<const std::vector<std::size_t>*> varying;
  for (const std::vector<std::size_t>& block : blocks_) {
    double size = 0;
    for (const std::size_t g : block)
      for (const int l : groups_[g].symbols) size += sizeOf(l);
    for (const MixedTerm& term : terms)
      if (block[0] == at(groupOf_[term.powers.front().first])) size += std::fabs(term.c);
    if (size > 0.05 * step) {
      varying.push_back(&block);
    } else {
      beside += size;
      for (const std::size_t g : block) scale *= massOf(part, g);
    }
  }
  for (int l = 0; l < symbols_; ++l)
    if (groupOf_[l] < 0) beside += sizeOf(l);
  beside *= bounds::up;
  rest = Interval(subDown(rest.lower(), beside), addUp(rest.upper(), beside));
  double error = error_;
  std::vector<GridBounds> parts;
  std::vector<GridMasses> swapped;
  double shift = 0;
  if (maySwap) swap(part, f, rest, step, varying, parts, swapped, shift);
  for (const std::vector<std::size_t>* block : varying) {
    std::vector<GridBounds> together;
    for (const std::size_t g : *block) {
      GridSum own = boundsOf(part, g, f, terms, rest, step);
      error += own.error;
      together.push_back(std::move(own.sum));
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
  GridSum result = gamut::sumOf(parts, swapped);
  for (GridMasses* side : {&result.sum.below, &result.sum.above})
    for (double& mass : side->mass) mass *= scale;
  result.error += roundings() + error + shift;
  result.shift = shift;
  return result;
}

}  // namespace gamut
