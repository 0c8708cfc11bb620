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
#include <optional>
#include <utility>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/series/polynomial_range.hpp"
#include "analyses/probability/curved_sum.hpp"
#include "analyses/probability/quantity_masses.hpp"
#include "analyses/work.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

/// Polynomials of degree above 0 in one symbol, or in those of one copula, and what is left.
struct Separated {
  std::vector<std::vector<double>> c;  // [symbol][power]
  std::vector<MixedTerm> together;     // terms in several symbols of one copula
  double constant = 0, mixed = 0;      // the latter: Σ|c| of the other terms in several symbols
  std::vector<double> mixedOf;         // [symbol]: of those that hold it
  double norm = 0;                     // Σ|c| of all
  std::optional<CurvedSum> curved;     // of what `c` adds up to
};

struct BoxCell {
  JointMasses::Part part;
  std::shared_ptr<const Monomials> monomials;
  OutputModel model;
  Separated separated{};
  double mass = 1;       // about
  bool isFinal = false;  // nothing more is gained by bisection
};

constexpr double unlimited = std::numeric_limits<double>::infinity();

class Distributor {
 public:
  Distributor(const std::vector<SurrogatePart>& parts, std::size_t output, const JointMasses& masses,
              const DistributionOptions& options)
      : masses_(masses), options_(options), parts_(parts), output_(output) {}

  DistributionBounds find() {
    DistributionBounds found;
    Interval range = Interval::empty();
    for (const SurrogatePart& part : parts_) range = hull(range, part.outputs[output_].bound);
    if (!isBounded(range) || isCancelled()) return found;
    constexpr double largest = 1e290, share = 0.4;
    if (magnitude(range) > largest ||
        !std::ranges::all_of(parts_, [](const SurrogatePart& part) { return QuantityMasses::hold(part.part); }))
      return found;
    cover(masses_.whole());
    lower_ = range.lower(), upper_ = range.upper();
    if (upper_ - lower_ <= options_.negligible)
      return {{std::nextafter(lower_, -unlimited), upper_}, {0, 1}, {0, 1}, 0, false};
    constexpr double useful = 16;  // beyond, a polynomial says nothing that its bound does not
    for (BoxCell& cell : cells_)
      if (!(cell.separated.norm - std::fabs(cell.separated.constant) + cell.model.radius <= useful * (upper_ - lower_)))
        cell.model.c.clear();
    // Of an even density at first, then of the one that was found: the bounds of the output may be so far apart.
    const std::size_t mostCells = masses_.isPlain() ? options_.mostCells : options_.mostCells / 4;
    double allowed = 2 * options_.gap * (upper_ - lower_), before = unlimited, stepBefore = 0, workBefore = 0;
    // From the third on of a quarter of the step before (plain quantities): where a density grows as 1/√x gaps halve.
    constexpr int mostRounds = 8;
    for (int round = 0; round < mostRounds; ++round) {
      // Where terms in several symbols, or radii, are not less, small steps are of no use.
      const double apart = refine(0.5 * allowed, round == 0 ? mostCells / 4 : mostCells);
      allowed = std::max(allowed, 0.5 * apart);
      if (round > 1 && !(allowed < 0.9 * before)) break;
      before = allowed;
      double steps = 1;
      constexpr double finer = 1.6;  // than would do: sums of few steps cost less
      for (const BoxCell& cell : cells_) steps = std::max(steps, finer * masses_.stepsApart(cell.separated.c));
      steps = std::min(steps, static_cast<double>(mostSymbols()) + 1);
      const double finest = mostSymbols() > 1 ? 0x1p16 : 0x1p18;  // where an output is extreme its density is unlimited
      double step = stepOf(std::max((upper_ - lower_) / finest, allowed / steps));
      const double affordable = affordableStep(step);
      isLimited_ = isLimited_ || affordable > step;
      const std::uint64_t counted = Work::counted();
      if (round > 0 && affordable > step && (affordable > 0.9 * stepBefore || workLeft() < workBefore)) break;
      stepBefore = step = affordable;
      DistributionBounds now = bound(step);
      workBefore = static_cast<double>(Work::counted() - counted);
      ofEstimate_ = std::clamp(1.2 * workBefore / estimatedWork(step), 0.1, 1.0);
      if (isCancelled()) return {};
      if (round > 1 && !(now.gap < found.gap)) break;
      const bool isAllThereIs = round > 0 && !masses_.isPlain() && now.gap > 0.8 * found.gap;
      found = std::move(now);
      if (found.gap <= options_.gap || isAllThereIs) break;
      // Boxes of copulas grow many: no smaller steps than it takes.
      allowed = round == 0 ? share * options_.gap / densityOf(found)
                           : allowed * (masses_.isPlain() ? 0.25 : std::max(0.25, 0.6 * options_.gap / found.gap));
    }
    found.isLimited = isLimited_;
    return found;
  }

 private:
  bool isCancelled() const { return options_.cancelled != nullptr && *options_.cancelled; }

  /// A power of two, so that quotients by it are exact, and not so small that numbers of steps grow large.
  double stepOf(double wanted) const {
    const double size = std::max({std::fabs(lower_), std::fabs(upper_), 1e-280});
    return std::ldexp(1.0, std::ilogb(std::max(wanted, size * 0x1p-48)));
  }

  double workLeft() const { return options_.mostWork - static_cast<double>(Work::counted() - began_); }

  /// Of sums: of every cell and symbol a transform, of all numbers between the bounds of its output, at most.
  double estimatedWork(double step) const {
    double work = 0;
    for (const BoxCell& cell : cells_) {
      const double range = 2 * (cell.separated.norm - std::fabs(cell.separated.constant));
      const double numbers = std::min(range, upper_ - lower_) / step + 2;
      const double symbols = static_cast<double>(cell.separated.c.size());
      work += Work::of(Work::transformed, (symbols + 1) * 1.5 * numbers * (std::log2(numbers) + 2)) +
              Work::of(Work::bin, symbols * (static_cast<double>(masses_.elements()) + 0.4 * numbers));
    }
    return work;
  }

  /// No smaller than the work that is left allows, as far as the last sums tell; but such that bounds say something.
  double affordableStep(double step) const {
    constexpr double least = 64;
    while ((upper_ - lower_) / step > least && ofEstimate_ * estimatedWork(step) > workLeft()) step *= 2;
    return step;
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
    s.c.assign(m.symbols(), {});
    s.mixedOf.assign(m.symbols(), 0.0);
    for (std::size_t g = 0; g < cell.model.c.size(); ++g) {
      const double c = cell.model.c[g], size = std::fabs(c);
      s.norm += size;
      int count = 0, symbol = 0;
      bool isTogether = true;
      for (int l = 0; l < m.symbols(); ++l) {
        if (m.exponent(static_cast<int>(g), l) == 0) continue;
        if (count > 0) isTogether = isTogether && masses_.copulaOf(l) == masses_.copulaOf(symbol);
        ++count, symbol = l;
      }
      if (count == 0) {
        s.constant = c;
      } else if (count == 1) {
        const std::size_t power = at(m.exponent(static_cast<int>(g), symbol));
        std::vector<double>& own = s.c[symbol];
        own.resize(std::max(own.size(), power + 1), 0.0);
        own[power] = c;
      } else if (isTogether && masses_.copulaOf(symbol) >= 0) {
        MixedTerm& term = s.together.emplace_back(MixedTerm{c, {}});
        for (int l = 0; l < m.symbols(); ++l)
          if (const int power = m.exponent(static_cast<int>(g), l); power > 0)
            term.powers.emplace_back(at(l), at(power));
      } else {
        s.mixed += size;
        for (int l = 0; l < m.symbols(); ++l)
          if (m.exponent(static_cast<int>(g), l) > 0) s.mixedOf[l] += size;
      }
    }
    if (s.mixed > 0 && s.together.empty()) curve(cell);
    cell.mass = masses_.massOf(cell.part);
    const double looked = static_cast<double>(cell.model.c.size()) * (m.symbols() + 2) + 40;
    Work::count(Work::cellTerm, looked + 0.3 * static_cast<double>(cells_.size()));  // the widest is looked for in all
    cells_.push_back(std::move(cell));
  }

  /// If less is left of the terms in several symbols so.
  static void curve(BoxCell& cell) {
    Separated& s = cell.separated;
    CurvedSum sum = curvedSumOf(cell.model.c, *cell.monomials, std::vector<char>(s.c.size(), 1));
    const double mixed = 0.5 * (sum.down + sum.up);
    if (!(mixed < s.mixed)) return;
    s.c = sum.f;
    s.mixed = mixed * bounds::up;
    s.constant = sum.constant + 0.5 * (sum.up - sum.down);
    s.mixedOf = sum.mixedOf;
    s.norm += sum.reach;
    s.curved = std::move(sum);
  }

  /// What of the joint distribution lies in one part of the box has its polynomial. What lies in several, and cannot be
  /// cut, has their bounds. Edges between parts, by symbol, are cut at once, those up to `last` have been.
  void cover(const JointMasses::Part& joint, std::pair<int, long> last = {-1, 0}) {
    const auto isAcross = [&](int l, long edge) {
      return joint.first[l] < edge && edge < joint.first[l] + joint.count[l];
    };
    std::vector<const SurrogatePart*> met;
    std::vector<std::pair<int, long>> edges;
    Interval bound = Interval::empty();
    for (const SurrogatePart& part : parts_) {
      bool isMet = true;
      std::vector<std::pair<int, long>> own;
      for (int l = 0; l < part.monomials->symbols() && isMet; ++l) {
        const auto [first, count] = QuantityMasses::of(part.part, l);
        const long from = joint.first[l], until = from + joint.count[l];
        isMet = from < first + count && first < until;
        for (const long edge : {first, first + count})
          if (isAcross(l, edge)) own.emplace_back(l, edge);
      }
      if (!isMet) continue;
      met.push_back(&part);
      edges.insert(edges.end(), own.begin(), own.end());
      bound = hull(bound, part.outputs[output_].bound);
    }
    if (edges.empty() && met.size() == 1) {
      add(within({joint, met[0]->monomials, met[0]->outputs[output_], {}}, met[0]->part, joint));
      return;
    }
    std::ranges::sort(edges);
    for (const std::pair<int, long>& edge : edges) {
      if (edge <= last || isCancelled()) continue;
      const std::vector<JointMasses::Part> pieces = masses_.cut(joint, edge.first, edge.second);
      if (pieces.size() == 1) continue;
      for (const JointMasses::Part& piece : pieces) cover(piece, edge);
      return;
    }
    add({joint, parts_.front().monomials, {{}, 0, bound}});
  }

  /// Bisects where the terms in several symbols are greatest, until they matter no more; returns by how much these, and
  /// radii, part the bounds of the output, on average.
  double refine(double allowed, std::size_t mostCells) {
    constexpr long finest = 16;  // bins
    const auto weight = [](const BoxCell& cell) { return cell.isFinal ? 0.0 : 2 * cell.separated.mixed * cell.mass; };
    double all = 0;
    double off = 0;  // by radii: less of the terms in several symbols would not bring bounds much closer
    for (const BoxCell& cell : cells_) {
      all += 2 * cell.separated.mixed * cell.mass;
      off += 2 * cell.model.radius * cell.mass;
    }
    constexpr double ofRadii = 0.3;
    if (std::isfinite(off)) allowed = std::max(allowed, ofRadii * off);
    // Half of the work is left for sums.
    const double least = 0.5 * workLeft();
    while (all > allowed && cells_.size() < mostCells && workLeft() >= least && !isCancelled()) {
      const auto widest = std::ranges::max_element(cells_, {}, weight);
      if (!(weight(*widest) > 0)) break;
      std::vector<double> mixedOf = widest->separated.mixedOf;
      std::vector<JointMasses::Part> halves;
      while (halves.size() < 2) {
        const auto most = std::ranges::max_element(mixedOf);
        const int symbol = static_cast<int>(most - mixedOf.begin());
        if (*most == 0) break;
        *most = 0;
        if (widest->part.count[symbol] >= finest) halves = masses_.halves(widest->part, symbol);
      }
      if (halves.size() < 2) {
        widest->isFinal = true;
        continue;
      }
      const BoxCell cell = std::move(*widest);
      cells_.erase(widest);
      all -= weight(cell);
      for (const JointMasses::Part& half : halves) {
        add(within(cell, JointMasses::boxOf(cell.part), half));
        all += weight(cells_.back());
      }
    }
    isLimited_ = isLimited_ || (all > allowed && cells_.size() < mostCells && workLeft() < least);
    double apart = 0;
    for (const BoxCell& cell : cells_) apart += 2 * (cell.separated.mixed + cell.model.radius) * cell.mass;
    return std::isfinite(apart) ? apart : 0;
  }

  /// The polynomial of a part on what a piece of the joint distribution lies in.
  BoxCell within(const BoxCell& cell, const FlowPart& part, const JointMasses::Part& piece) {
    BoxCell found{piece, cell.monomials, cell.model};
    if (cell.model.c.empty()) return found;
    std::unique_ptr<PolynomialRange>& tables = tables_[cell.monomials.get()];
    if (!tables) tables = std::make_unique<PolynomialRange>(cell.monomials);
    const FlowPart box = JointMasses::boxOf(piece);
    for (std::size_t l = 0; l < box.half.size(); ++l) {
      if (box.half[l] == part.half[l]) continue;  // it is the same
      const std::vector<double> before = found.model.c;
      double norm = 0;
      for (const double c : before) norm += std::fabs(c);
      tables->substitute(static_cast<int>(l), (box.centre[l] - part.centre[l]) / part.half[l],
                         box.half[l] / part.half[l], before.data(), found.model.c.data(),
                         static_cast<int>(before.size()));
      found.model.radius = (found.model.radius + tables->shiftError() * norm * bounds::up) * bounds::up + bounds::tiny;
    }
    return found;
  }

  // ---- Sums ---------------------------------------------------------------------------------------------------------

  /// Of the output on a cell.
  GridSum sumOn(const BoxCell& cell, double step) const {
    const Separated& s = cell.separated;
    if (cell.model.c.empty())
      return masses_.sumOf(cell.part, std::vector<std::vector<double>>(s.c.size()), {}, cell.model.bound, step);
    // Terms that hardly matter count as errors.
    std::vector<MixedTerm> terms;
    double small = 0;
    for (const MixedTerm& term : s.together)
      if (std::fabs(term.c) * static_cast<double>(s.together.size()) > 0.1 * step)
        terms.push_back(term);
      else
        small += std::fabs(term.c);
    const double radius = (cell.model.radius + s.mixed + small + 8 * bounds::unit * s.norm) * bounds::up + bounds::tiny;
    if (s.curved && !s.curved->curve.empty()) return curvedSumOn(cell, radius, step);
    return masses_.sumOf(cell.part, s.c, terms, Interval(subDown(s.constant, radius), addUp(s.constant, radius)), step);
  }

  /// φ rises: of the sum's bounds come those of φ and what is added to it.
  GridSum curvedSumOn(const BoxCell& cell, double radius, double step) const {
    const CurvedSum& curved = *cell.separated.curved;
    GridSum sum = masses_.sumOf(cell.part, cell.separated.c, {}, Interval(0.0), step);
    const double off = (radius + curved.rounding()) * bounds::up;
    const auto map = [&](GridMasses& side, const auto& valueOf) {
      GridMasses mapped;
      for (std::size_t i = 0; i < side.mass.size(); ++i) {  // numbers of steps rise
        const double s = static_cast<double>(side.first + static_cast<long>(i)) * step;
        const long value = valueOf(curved.at(std::clamp(s, -curved.reach, curved.reach)));
        if (i == 0) mapped.first = value;
        const auto place = static_cast<std::size_t>(std::max(value - mapped.first, 0L));
        if (mapped.mass.size() <= place) mapped.mass.resize(place + 1, 0.0);
        mapped.mass[place] += side.mass[i];
      }
      side = std::move(mapped);
    };
    map(sum.sum.below, [&](double y) {
      return static_cast<long>(std::floor(addDown(y, subDown(cell.separated.constant, off)) / step));
    });
    map(sum.sum.above,
        [&](double y) { return static_cast<long>(std::ceil(addUp(y, addUp(cell.separated.constant, off)) / step)); });
    return sum;
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
      Work::count(Work::bin, 0.1 * static_cast<double>(own.sum.below.mass.size() + own.sum.above.mass.size()));
      error += own.error;
      // The output lies in its bound besides.
      const auto include = [&](const GridMasses& side, std::vector<double>& all) {
        for (std::size_t i = 0; i < side.mass.size(); ++i) {
          const long value = std::clamp(side.first + static_cast<long>(i), stepBelow(cell.model.bound.lower()),
                                        stepAbove(cell.model.bound.upper()));
          all[value - first] += side.mass[i];
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
      // None is less than the enclosure's least value, or greater than its greatest.
      const double value = static_cast<double>(first + static_cast<long>(i)) * step;
      if (i > 0 && i < end && (value <= lower_ || value >= upper_)) continue;
      bounds.value.push_back(i == 0 ? std::nextafter(lower_, -unlimited) : i == end ? upper_ : value);
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

  const JointMasses& masses_;
  const DistributionOptions& options_;
  const std::vector<SurrogatePart>& parts_;
  const std::size_t output_;
  std::vector<BoxCell> cells_;
  const std::uint64_t began_ = Work::counted();
  double lower_ = 0, upper_ = 0, ofEstimate_ = 1;
  bool isLimited_ = false;
  std::map<const Monomials*, std::unique_ptr<PolynomialRange>> tables_;
};

}  // namespace

DistributionBounds boundDistribution(const std::vector<SurrogatePart>& parts, std::size_t output,
                                     const JointMasses& masses, const DistributionOptions& options) {
  return Distributor(parts, output, masses, options).find();
}

}  // namespace gamut
