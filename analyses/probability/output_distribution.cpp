// On a cell of the box the output is c + Σ f_l(η_l) + e, |e| ≤ radius + Σ|c| of the terms in several symbols. Each
// f_l(η_l) is replaced by a number below it and a number above it that are multiples of a step, one a bin of η_l; the
// sums of independent ones are found by convolution. Terms in several symbols become less by bisection.
#include "analyses/probability/output_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "analyses/flow/error_bounds.hpp"
#include "analyses/flow/polynomial_range.hpp"
#include "analyses/probability/convolution.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

/// Polynomials of degree above 0 in one symbol, and what is left.
struct Separated {
  std::vector<std::vector<double>> c;  // [symbol][power]
  double constant = 0, mixed = 0;      // the latter: Σ|c| of the terms in several symbols
  std::vector<double> mixedOf;         // [symbol]: of those that hold it
  double norm = 0;                     // Σ|c| of all
};

struct BoxCell {
  FlowPart part;
  std::shared_ptr<const Monomials> monomials;
  OutputModel model;
  Separated separated;
  double mass = 1;  // about
};

constexpr double unlimited = std::numeric_limits<double>::infinity();

class Distributor {
 public:
  Distributor(const std::vector<SurrogatePart>& parts, std::size_t output, const QuantityMasses& masses,
              const DistributionOptions& options)
      : masses_(masses), options_(options) {
    for (const SurrogatePart& part : parts) add({part.part, part.monomials, part.outputs[output], {}, 1});
  }

  DistributionBounds find() {
    DistributionBounds found;
    Interval range = Interval::empty();
    for (const BoxCell& cell : cells_) range = hull(range, cell.model.bound);
    if (!isBounded(range) || isCancelled()) return found;
    constexpr double largest = 1e290, share = 0.4;
    if (magnitude(range) > largest ||
        !std::ranges::all_of(cells_, [](const BoxCell& cell) { return QuantityMasses::hold(cell.part); }))
      return found;
    lower_ = range.lower(), upper_ = range.upper();
    if (upper_ - lower_ <= options_.negligible)
      return {{std::nextafter(lower_, -unlimited), upper_}, {0, 1}, {0, 1}, 0};
    constexpr double useful = 16;  // beyond, a polynomial says nothing that its bound does not
    for (BoxCell& cell : cells_)
      if (!(cell.separated.norm - std::fabs(cell.separated.constant) + cell.model.radius <= useful * (upper_ - lower_)))
        cell.model.c.clear();
    // Of an even density at first, then of the one that was found: the bounds of the output may be so far apart.
    double allowed = 2 * options_.gap * (upper_ - lower_), before = unlimited;
    for (int round = 0; round < 4; ++round) {
      // Where terms in several symbols, or radii, are not less, small steps are of no use.
      const double apart = refine(0.5 * allowed, round == 0 ? options_.mostCells / 4 : options_.mostCells);
      allowed = std::max(allowed, 0.5 * apart);
      if (round > 1 && !(allowed < 0.6 * before)) break;
      before = allowed;
      const double steps = static_cast<double>(mostSymbols()) + 1;
      const double finest = mostSymbols() > 1 ? 0x1p16 : 0x1p18;  // where an output is extreme its density is unlimited
      DistributionBounds now = bound(stepOf(std::max((upper_ - lower_) / finest, allowed / steps)));
      if (isCancelled()) return {};
      if (round > 1 && !(now.gap < found.gap)) break;
      found = std::move(now);
      if (found.gap <= options_.gap) break;
      allowed = round == 0 ? share * options_.gap / densityOf(found) : allowed / 4;
    }
    return found;
  }

 private:
  bool isCancelled() const { return options_.cancelled != nullptr && *options_.cancelled; }

  /// A power of two, so that quotients by it are exact, and not so small that numbers of steps grow large.
  double stepOf(double wanted) const {
    const double size = std::max({std::fabs(lower_), std::fabs(upper_), 1e-280});
    return std::ldexp(1.0, std::ilogb(std::max(wanted, size * 0x1p-48)));
  }

  std::size_t mostSymbols() const {
    std::size_t most = 0;
    for (const BoxCell& cell : cells_) most = std::max(most, cell.separated.c.size());
    return most;
  }

  // ---- Cells --------------------------------------------------------------------------------------------------------

  void add(BoxCell cell) {
    const Monomials& m = *cell.monomials;
    Separated& s = cell.separated;
    s.c.assign(at(m.symbols()), {});
    s.mixedOf.assign(at(m.symbols()), 0.0);
    for (std::size_t g = 0; g < cell.model.c.size(); ++g) {
      const double c = cell.model.c[g], size = std::fabs(c);
      s.norm += size;
      int count = 0, symbol = 0;
      for (int l = 0; l < m.symbols(); ++l)
        if (m.exponent(static_cast<int>(g), l) > 0) ++count, symbol = l;
      if (count == 0) {
        s.constant = c;
      } else if (count == 1) {
        const std::size_t power = at(m.exponent(static_cast<int>(g), symbol));
        std::vector<double>& own = s.c[at(symbol)];
        own.resize(std::max(own.size(), power + 1), 0.0);
        own[power] = c;
      } else {
        s.mixed += size;
        for (int l = 0; l < m.symbols(); ++l)
          if (m.exponent(static_cast<int>(g), l) > 0) s.mixedOf[at(l)] += size;
      }
    }
    cell.mass = 1;
    for (int l = 0; l < m.symbols(); ++l) cell.mass *= massOf(cell, l);
    cells_.push_back(std::move(cell));
  }

  /// Bisects where the terms in several symbols are greatest, until they matter no more; returns by how much these, and
  /// radii, part the bounds of the output, on average.
  double refine(double allowed, std::size_t mostCells) {
    constexpr double finest = 0x1p-9;
    const auto weight = [](const BoxCell& cell) { return 2 * cell.separated.mixed * cell.mass; };
    double all = 0;
    for (const BoxCell& cell : cells_) all += weight(cell);
    while (all > allowed && cells_.size() < mostCells && !isCancelled()) {
      const auto widest = std::ranges::max_element(cells_, {}, weight);
      const std::vector<double>& mixedOf = widest->separated.mixedOf;
      const int symbol = static_cast<int>(std::ranges::max_element(mixedOf) - mixedOf.begin());
      if (mixedOf.empty() || weight(*widest) == 0 || widest->part.half[at(symbol)] <= finest) break;
      const BoxCell cell = std::move(*widest);
      cells_.erase(widest);
      all -= weight(cell);
      for (const double side : {-0.5, 0.5}) {
        add(halfOf(cell, symbol, side));
        all += weight(cells_.back());
      }
    }
    double apart = 0;
    for (const BoxCell& cell : cells_) apart += 2 * (cell.separated.mixed + cell.model.radius) * cell.mass;
    return std::isfinite(apart) ? apart : 0;
  }

  BoxCell halfOf(const BoxCell& cell, int symbol, double side) {
    std::unique_ptr<PolynomialRange>& tables = tables_[cell.monomials.get()];
    if (!tables) tables = std::make_unique<PolynomialRange>(cell.monomials);
    BoxCell half{cell.part, cell.monomials, cell.model, {}, 1};
    half.part.centre[at(symbol)] += side * cell.part.half[at(symbol)];
    half.part.half[at(symbol)] *= 0.5;
    tables->substitute(symbol, side, 0.5, cell.model.c.data(), half.model.c.data(),
                       static_cast<int>(cell.model.c.size()));
    half.model.radius = (cell.model.radius + tables->shiftError() * cell.separated.norm) * bounds::up + bounds::tiny;
    return half;
  }

  // ---- Sums ---------------------------------------------------------------------------------------------------------

  double massOf(const BoxCell& cell, int symbol) const {
    const auto [first, count] = QuantityMasses::of(cell.part, symbol);
    const auto begin = masses_.mass(symbol).begin() + first;
    return std::accumulate(begin, begin + count, 0.0);
  }

  /// f(η_l) + [down, up] as multiples of a step.
  GridBounds sidesOf(const BoxCell& cell, int symbol, double down, double up, double step) const {
    const std::vector<double>& f = cell.separated.c[at(symbol)];
    const auto [first, count] = QuantityMasses::of(cell.part, symbol);
    double size = 0, bend = 0;  // Σ|c|; |f''| at most
    for (std::size_t n = 1; n < f.size(); ++n) {
      size += std::fabs(f[n]);
      bend += static_cast<double>(n * (n - 1)) * std::fabs(f[n]);
    }
    // Horner's scheme is off by 2 n u Σ|c|, an η of the grid is exact; between its values f leaves its chord by
    // (2/count)²/8 |f''|.
    const double rounding = 2 * static_cast<double>(f.size() + 2) * bounds::unit * size * bounds::up;
    const double sag = 0.5 * bend / (static_cast<double>(count) * static_cast<double>(count)) * bounds::up;
    down = subDown(down, (rounding + sag) * bounds::up);
    up = addUp(up, (rounding + sag) * bounds::up);
    std::vector<double> value;
    for (long i = 0; i <= count; ++i) {
      const double eta = -1 + 2 * (static_cast<double>(i) / static_cast<double>(count));
      double sum = 0;
      for (std::size_t n = f.size(); n-- > 1;) sum = (sum + f[n]) * eta;
      value.push_back(sum);
    }
    const auto floorOf = [&](double x) { return static_cast<long>(std::floor(addDown(x, down) / step)); };
    const auto ceilOf = [&](double x) { return static_cast<long>(std::ceil(addUp(x, up) / step)); };
    const auto [least, greatest] = std::ranges::minmax(value);
    GridMasses below{floorOf(least), {}}, above{ceilOf(least), {}};
    below.mass.assign(static_cast<std::size_t>(floorOf(greatest) - below.first + 1), 0.0);
    above.mass.assign(static_cast<std::size_t>(ceilOf(greatest) - above.first + 1), 0.0);
    for (long i = 0; i < count; ++i) {
      const double mass = masses_.mass(symbol)[static_cast<std::size_t>(first + i)];
      const auto [low, high] = std::minmax(value[static_cast<std::size_t>(i)], value[static_cast<std::size_t>(i + 1)]);
      below.mass[static_cast<std::size_t>(floorOf(low) - below.first)] += mass;
      above.mass[static_cast<std::size_t>(ceilOf(high) - above.first)] += mass;
    }
    return {std::move(below), std::move(above)};
  }

  /// Of the output on a cell. Probabilities of the symbols that are off by e_l in all make those of sums be off by no
  /// more than Σ e_l.
  GridSum sumOn(const BoxCell& cell, double step) const {
    const int symbols = cell.monomials->symbols();
    // What hardly varies counts as error.
    double beside = cell.separated.mixed, scale = 1;
    std::vector<int> varying;
    for (int l = 0; l < symbols; ++l) {
      double size = 0;
      for (const double c : cell.separated.c[at(l)]) size += std::fabs(c);
      if (size > 0.05 * step && !cell.model.c.empty()) {
        varying.push_back(l);
      } else {
        beside += size;
        scale *= massOf(cell, l);
      }
    }
    Interval rest = cell.model.bound;
    if (!cell.model.c.empty()) {
      const double radius =
          (cell.model.radius + beside + 4 * bounds::unit * cell.separated.norm) * bounds::up + bounds::tiny;
      rest = Interval(subDown(cell.separated.constant, radius), addUp(cell.separated.constant, radius));
    }
    std::vector<GridBounds> parts;
    for (const int l : varying) {
      parts.push_back(sidesOf(cell, l, rest.lower(), rest.upper(), step));
      rest = Interval(0.0);
    }
    if (parts.empty())
      parts.push_back({{static_cast<long>(std::floor(rest.lower() / step)), {1.0}},
                       {static_cast<long>(std::ceil(rest.upper() / step)), {1.0}}});
    GridSum result = sumOf(parts);
    for (GridMasses* side : {&result.sum.below, &result.sum.above})
      for (double& mass : side->mass) mass *= scale;
    constexpr double roundings = 2 * QuantityMasses::bins + 64;  // of sums of masses
    result.error += roundings * bounds::unit;
    for (int l = 0; l < symbols; ++l) result.error += masses_.error(l);
    return result;
  }

  DistributionBounds bound(double step) {
    const auto stepBelow = [&](double x) { return static_cast<long>(std::floor(x / step)); };
    const auto stepAbove = [&](double x) { return static_cast<long>(std::ceil(x / step)); };
    const long first = stepBelow(lower_) - 1, last = stepAbove(upper_);
    std::vector<double> low(static_cast<std::size_t>(last - first + 1), 0.0), high = low;
    double error = 0;
    for (const BoxCell& cell : cells_) {
      if (isCancelled()) return {};
      const GridSum own = sumOn(cell, step);
      error += own.error;
      // The output lies in its bound besides.
      const auto include = [&](const GridMasses& side, std::vector<double>& all) {
        for (std::size_t i = 0; i < side.mass.size(); ++i) {
          const long value = std::clamp(side.first + static_cast<long>(i), stepBelow(cell.model.bound.lower()),
                                        stepAbove(cell.model.bound.upper()));
          all[static_cast<std::size_t>(value - first)] += side.mass[i];
        }
      };
      include(own.sum.below, high);
      include(own.sum.above, low);
    }
    error = (error + static_cast<double>(low.size() + cells_.size()) * 4 * bounds::unit) * bounds::up;
    for (std::vector<double>* side : {&low, &high}) {
      std::partial_sum(side->begin(), side->end(), side->begin());
      for (double& p : *side) p = std::clamp(side == &low ? p - error : p + error, 0.0, 1.0);
    }
    high.front() = 0;  // no value is less
    low.back() = 1;    // none is greater
    for (std::size_t i = 1; i < low.size(); ++i) low[i] = std::max(low[i], low[i - 1]);
    for (std::size_t i = high.size() - 1; i-- > 0;) high[i] = std::min(high[i], high[i + 1]);
    return chosen(first, step, low, high);
  }

  // ---- Values -------------------------------------------------------------------------------------------------------

  /// Those between which the probabilities rise by little, and the ends.
  DistributionBounds chosen(long first, double step, const std::vector<double>& low,
                            const std::vector<double>& high) const {
    DistributionBounds bounds;
    const double rise = 1.0 / options_.points;
    double last = -1;
    const auto middle = [&](std::size_t i) { return 0.5 * (low[i] + high[i]); };
    const std::size_t end = low.size() - 1;
    for (std::size_t i = 0; i <= end; ++i) {
      // The next one would be too far: this one.
      if (i > 0 && i < end && middle(i + 1) - last < rise) continue;
      if (i > 0 && i < end && middle(i) == last) continue;
      bounds.value.push_back(static_cast<double>(first + static_cast<long>(i)) * step);
      bounds.lower.push_back(low[i]);
      bounds.upper.push_back(high[i]);
      last = middle(i);
    }
    bounds.gap = 0;
    for (std::size_t i = 0; i + 1 < bounds.value.size(); ++i)
      bounds.gap = std::max(bounds.gap, bounds.upper[i + 1] - bounds.lower[i]);
    return bounds;
  }

  /// About the greatest density.
  static double densityOf(const DistributionBounds& about) {
    constexpr std::size_t apart = 8;  // of two values, since bounds are uneven
    double most = 0;
    const auto middle = [&](std::size_t i) { return 0.5 * (about.lower[i] + about.upper[i]); };
    const std::size_t count = about.value.size(), by = std::min(apart, count - 1);
    for (std::size_t i = 0; i + by < count; ++i)
      most = std::max(most, (middle(i + by) - middle(i)) / (about.value[i + by] - about.value[i]));
    return most;
  }

  const QuantityMasses& masses_;
  const DistributionOptions& options_;
  std::vector<BoxCell> cells_;
  double lower_ = 0, upper_ = 0;
  std::map<const Monomials*, std::unique_ptr<PolynomialRange>> tables_;
};

}  // namespace

DistributionBounds boundDistribution(const std::vector<SurrogatePart>& parts, std::size_t output,
                                     const QuantityMasses& masses, const DistributionOptions& options) {
  return Distributor(parts, output, masses, options).find();
}

}  // namespace gamut
