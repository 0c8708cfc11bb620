// Cells that are sets of elements of the joint distribution: met, violated, or with margins that are sums of functions
// of one symbol each, whose distributions are convolved.
#include "analyses/requirements/joint_probability.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/elementary/rounding.hpp"

namespace gamut {
namespace {

constexpr std::size_t mostWaiting = 2500;
constexpr double finest = 0x1p19, coarsest = 0x1p8;  // steps from the least to the greatest of a sum

/// A part of the joint distribution, what is known of where it lies, and of its probability: so much is met, and so
/// much violated, at least.
struct Weighed {
  JointMasses::Part part;
  std::unique_ptr<Cell> cell;
  double mass = 0, met = 0, violated = 0;
  std::vector<int> symbols{};  // whose bisection says more, the first most of all
  double open() const { return mass - met - violated; }
  bool operator<(const Weighed& other) const { return open() < other.open(); }
};

/// Σ f_l + one constant is above zero, Σ f_l + another one below: with these probabilities at least, and below with
/// that one at most.
struct Sides {
  double above = 0, below = 0, mostBelow = 1;
};

class Weighing {
 public:
  Weighing(Cells& cells, const JointMasses& masses, double gap, double mostWork)
      : cells_(cells), masses_(masses), gap_(gap), mostWork_(mostWork) {
    for (std::size_t i = 0; i < cells.question().margins.size(); ++i) all_.push_back(i);
  }

  Interval operator()(const std::atomic<bool>* cancelled) {
    std::vector<Weighed> waiting;
    const auto push = [&](JointMasses::Part part, const Cell& from) {
      Weighed piece = weighed(std::move(part), from);
      open_ += piece.open();
      waiting.push_back(std::move(piece));
      std::push_heap(waiting.begin(), waiting.end());
    };
    push(masses_.whole(), *cells_.whole());
    while (!waiting.empty()) {
      std::pop_heap(waiting.begin(), waiting.end());
      const Weighed piece = std::move(waiting.back());
      waiting.pop_back();
      std::vector<JointMasses::Part> halves;
      const bool isEnough = open_ <= gap_ || waiting.size() >= mostWaiting || worked() > mostWork_ ||
                            (cancelled != nullptr && *cancelled);
      if (piece.cell->verdict() == Cell::Verdict::open && !isEnough)
        for (const int symbol : piece.symbols)
          if (halves = masses_.halves(piece.part, symbol); halves.size() > 1) break;
      if (halves.size() > 1) {
        open_ -= piece.open();
        for (JointMasses::Part& half : halves) push(std::move(half), *piece.cell);
        continue;
      }
      met_ = addDown(met_, piece.met);
      violated_ = addDown(violated_, piece.violated);
    }
    const double met = std::clamp(met_, 0.0, 1.0);
    return {met, std::max(met, std::min(1.0, subUp(1.0, violated_)))};
  }

 private:
  double worked() const { return static_cast<double>(Work::counted() - began_); }

  Weighed weighed(JointMasses::Part part, const Cell& from) {
    Weighed piece{std::move(part), nullptr};
    piece.cell = cells_.within(from, JointMasses::boxOf(piece.part));
    Work::count(Work::cellTerm, 0.1 * piece.cell->bytes());
    Work::count(Work::focalElement, 20 * static_cast<double>(masses_.boxesIn(piece.part)));
    piece.mass = masses_.massOf(piece.part);
    const double certain = std::max(0.0, subDown(piece.mass, addUp(masses_.error(), masses_.roundings())));
    switch (piece.cell->verdict()) {
      case Cell::Verdict::met:
        piece.met = certain;
        break;
      case Cell::Verdict::violated:
        piece.violated = certain;
        break;
      case Cell::Verdict::open:
        weighOpen(piece, certain);
    }
    return piece;
  }

  void weighOpen(Weighed& piece, double certain) {
    const CellSums sums = cells_.sums(*piece.cell, all_);
    const Sides sides = sidesOf(piece.part, sums.met, sums.violated, sums.rest);
    piece.met = sides.above;
    piece.violated = sides.below;
    std::vector<double> mixedOf = sums.mixedOf;
    const bool areSeveral = all_.size() > 1 && cells_.question().when == CellQuestion::When::always;
    if (areSeveral) weighOneByOne(piece, certain, mixedOf);
    piece.met = std::min(piece.met, certain);
    piece.violated = std::min(piece.violated, std::max(0.0, piece.mass - piece.met));
    const bool isKnown = !sums.met.f.empty() && !sums.violated.f.empty();
    orderSymbols(piece, mixedOf, std::max(sizeOf(sums.met), sizeOf(sums.violated)), isKnown);
  }

  /// Whether they are functions of different quantities, all independent.
  bool areApart(const CellSum& s, const CellSum& t) const {
    const auto holds = [](const CellSum& sum, std::size_t l) {
      return l < sum.f.size() && std::ranges::any_of(sum.f[l], [](double c) { return c != 0; });
    };
    for (std::size_t l = 0; l < s.f.size(); ++l)
      if (holds(s, l) && holds(t, l)) return false;
    return masses_.isPlain() && !s.f.empty() && !t.f.empty();
  }

  /// All are met with a probability of 1 - Σ P(not i) at least, one is violated with that of Σ P_i - Σ P_ij, the latter
  /// of two together (Bonferroni); of independent ones these are products.
  void weighOneByOne(Weighed& piece, double certain, std::vector<double>& mixedOf) {
    const double most = addUp(piece.mass, addUp(masses_.error(), masses_.roundings()));
    double met = certain, product = certain;
    std::vector<CellSum> violated, all;
    std::vector<Sides> sides;
    for (const std::size_t margin : all_) {
      CellSums one = cells_.sums(*piece.cell, {margin});
      sides.push_back(sidesOf(piece.part, one.met, one.violated, one.rest));
      met = subDown(met, std::max(0.0, subUp(most, sides.back().above)));
      product = most > 0 ? mulDown(product, std::min(1.0, divDown(sides.back().above, most))) : 0;
      for (const CellSum& other : all)
        if (!areApart(one.met, other)) product = 0;
      all.push_back(std::move(one.met));
      violated.push_back(std::move(one.violated));
      for (std::size_t l = 0; l < mixedOf.size(); ++l) mixedOf[l] = std::max(mixedOf[l], one.mixedOf[l]);
    }
    piece.met = std::max({piece.met, met, product});
    std::vector<std::size_t> order = all_, taken;
    std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return sides[i].below; });
    double sum = 0;
    for (const std::size_t i : order) {
      double more = sides[i].below;
      for (const std::size_t j : taken)
        if (more > 0) more = subDown(more, together(piece, certain, violated[i], sides[i], violated[j], sides[j]));
      if (!(more > 0)) continue;
      sum = addDown(sum, more);
      taken.push_back(i);
    }
    piece.violated = std::max(piece.violated, sum);
  }

  /// Both sums are below zero: only where a S + b T is, of any a, b > 0.
  double together(const Weighed& piece, double certain, const CellSum& s, const Sides& ofS, const CellSum& t,
                  const Sides& ofT) {
    const double least = std::min(ofS.mostBelow, ofT.mostBelow);
    if (s.f.empty() || t.f.empty()) return least;
    if (certain > 0 && areApart(s, t)) return std::min(least, divUp(mulUp(ofS.mostBelow, ofT.mostBelow), certain));
    const double ratio = sizeOf(t) > 0 ? sizeOf(s) / sizeOf(t) : 1;
    double most = least;
    for (const double factor : {1.0, std::ldexp(1.0, std::isfinite(ratio) && ratio > 0 ? std::ilogb(ratio) : 0)}) {
      CellSum sum = s;  // of powers of two: products are exact
      double norm = std::fabs(s.constant) + factor * std::fabs(t.constant);
      for (std::size_t l = 0; l < t.f.size(); ++l) {
        sum.f[l].resize(std::max(s.f[l].size(), t.f[l].size()), 0.0);
        for (std::size_t n = 0; n < t.f[l].size(); ++n) {
          sum.f[l][n] += factor * t.f[l][n];
          norm += std::fabs(sum.f[l][n]);
        }
      }
      const double rounding = 4 * bounds::unit * (norm + sizeOf(s) + factor * sizeOf(t)) * bounds::up + bounds::tiny;
      sum.constant = subDown(addDown(s.constant, factor * t.constant), rounding);
      if (sum.constant > sizeOf(sum)) return 0;
      if (least < 0.05 * gap_) continue;
      most = std::min(most, sidesOf(piece.part, {}, sum, 0).mostBelow);
    }
    return most;
  }

  /// Those of terms in several symbols that matter; then, where that is not all that is not known, those of all terms.
  void orderSymbols(Weighed& piece, const std::vector<double>& mixedOf, double size, bool isKnown) const {
    constexpr double little = 0.02;
    std::vector<int> order(mixedOf.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater<>(), [&](int l) { return mixedOf[l]; });
    for (const int l : order)
      if (mixedOf[l] > little * gap_ * size) piece.symbols.push_back(l);
    if (isKnown && all_.size() == 1 && masses_.isPlain()) return;
    for (const int l : cells_.symbolsOf(*piece.cell))
      if (std::ranges::find(piece.symbols, l) == piece.symbols.end()) piece.symbols.push_back(l);
  }

  /// Steps so small that they matter less than what is asked for, and than what is not known anyway.
  double stepOf(const CellSum& sum, double band) const {
    const double size = sizeOf(sum);
    double square = 0;
    for (const std::vector<double>& f : sum.f)
      for (std::size_t n = 1; n < f.size(); ++n) square += f[n] * f[n] / static_cast<double>(2 * n + 1);
    constexpr double share = 0.1, ofBand = 0.25;
    const double wanted = std::max(share * gap_ * 2.5 * std::sqrt(square), ofBand * band) / masses_.stepsApart(sum.f);
    const double steps = std::clamp(2 * size / wanted, coarsest, finest);
    return std::ldexp(1.0, std::ilogb(2 * size / steps));
  }

  Sides sidesOf(const JointMasses::Part& part, const CellSum& met, const CellSum& violated, double rest) {
    const bool isOne = !met.f.empty() && met.f == violated.f;
    if (isOne) return sidesOf(part, met, met.constant, violated.constant, rest);
    Sides sides;
    if (!met.f.empty()) sides.above = sidesOf(part, met, met.constant, met.constant, rest).above;
    if (!violated.f.empty()) {
      const Sides other = sidesOf(part, violated, violated.constant, violated.constant, rest);
      sides.below = other.below, sides.mostBelow = other.mostBelow;
    }
    return sides;
  }

  /// Of Σ f_l + from above zero, and Σ f_l + to below.
  Sides sidesOf(const JointMasses::Part& part, const CellSum& sum, double from, double to, double rest) {
    const double size = sizeOf(sum);
    if (!std::isfinite(size) || !std::isfinite(from) || !std::isfinite(to)) return {};
    const double off = addUp(masses_.error(), masses_.roundings());
    const double certain = std::max(0.0, subDown(masses_.massOf(part), off));
    const double far = std::max(std::fabs(from), std::fabs(to));
    if (!(size > bounds::tiny) || far > 0x1p40 * size)
      return {from > size ? certain : 0, to < -size ? certain : 0, to > size ? 0.0 : 1.0};
    const double step = stepOf(sum, std::max(rest, to - from));
    const Interval constant(std::min(from, to), std::max(from, to));
    const GridSum found = masses_.sumOf(part, sum.f, {}, constant, step);
    Sides sides = sidesOf(found);
    constexpr double little = 100;  // shifts from what is certain
    if (found.shift > 0 && std::min(sides.mostBelow, certain - sides.below) < little * found.shift) {
      const Sides other = sidesOf(masses_.sumOf(part, sum.f, {}, constant, step, false));
      sides = {std::max(sides.above, other.above), std::max(sides.below, other.below),
               std::min(sides.mostBelow, other.mostBelow)};
    }
    return sides;
  }

  Sides sidesOf(const GridSum& found) const {
    Sides sides{0, 0, 0};
    for (std::size_t i = 0; i < found.sum.below.mass.size(); ++i) {
      const long value = found.sum.below.first + static_cast<long>(i);
      (value > 0 ? sides.above : sides.mostBelow) += std::max(0.0, found.sum.below.mass[i]);
    }
    for (std::size_t i = 0; i < found.sum.above.mass.size(); ++i)
      if (found.sum.above.first + static_cast<long>(i) < 0) sides.below += std::max(0.0, found.sum.above.mass[i]);
    const double error = addUp(found.error, masses_.roundings());
    return {std::max(0.0, subDown(sides.above, error)), std::max(0.0, subDown(sides.below, error)),
            addUp(sides.mostBelow, error)};
  }

  Cells& cells_;
  const JointMasses& masses_;
  const double gap_, mostWork_;
  const std::uint64_t began_ = Work::counted();
  std::vector<std::size_t> all_;   // margins
  double met_ = 0, violated_ = 0;  // rounded down
  double open_ = 0;
};

}  // namespace

Interval probabilityOf(Cells& cells, const JointMasses& masses, double gap, double mostWork,
                       const std::atomic<bool>* cancelled) {
  return Weighing(cells, masses, gap, mostWork)(cancelled);
}

}  // namespace gamut
