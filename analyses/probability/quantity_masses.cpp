#include "analyses/probability/quantity_masses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

bool QuantityMasses::hold(const FlowPart& part) {
  return std::ranges::all_of(part.half, [](double half) { return half * bins >= 2; });
}

std::pair<long, long> QuantityMasses::of(const FlowPart& part, int symbol) {
  const double centre = part.centre[symbol], half = part.half[symbol];
  return {static_cast<long>((centre - half + 1) * bins / 2), static_cast<long>(half * bins)};
}

namespace {

/// F at the edges, as far as it matters. Of a distribution that is one, at all of them. Of several F lies, between two
/// edges, above the lower bound at the first and below the upper bound at the second: where these are hardly farther
/// apart than the bounds at an edge are anyway, that is enough.
class Edges {
 public:
  Edges(const FlowSymbol& symbol, const Distribution& distribution) : symbol_(symbol), distribution_(distribution) {
    below_.assign(bins + 1, Interval(0.0, 1.0));
    below_.front() = Interval(0.0);  // what has the value there counts in the first bin
    below_.back() = Interval(1.0);
    if (distribution.isPrecise())
      for (int i = 1; i < bins; ++i) find(i);
    else
      fill(0, bins);
  }

  /// Both bounds rise with F.
  std::vector<Interval> rising() const {
    std::vector<Interval> edges = below_;
    for (std::size_t i = 1; i < edges.size(); ++i)
      edges[i] = Interval(std::max(edges[i].lower(), edges[i - 1].lower()), edges[i].upper());
    for (std::size_t i = edges.size() - 1; i-- > 0;)
      edges[i] = Interval(edges[i].lower(), std::min(edges[i].upper(), edges[i + 1].upper()));
    return edges;
  }

  int found() const { return found_; }

 private:
  static constexpr int bins = QuantityMasses::bins;

  void find(int i) {
    const Interval value = Interval(symbol_.centre) + Interval(symbol_.half) * Interval(-1 + i * (2.0 / bins));
    below_[i] = distribution_.enclosedBelow(value);
    ++found_;
  }

  void fill(int from, int until) {
    constexpr double hardly = 1.01, nothing = 0x1p-12;
    const Interval &first = below_[from], &second = below_[until];
    if (until - from < 2) return;
    if (second.upper() - first.lower() <= std::max(hardly * std::min(width(first), width(second)), nothing)) {
      const Interval between(first.lower(), second.upper());
      std::fill(below_.begin() + from + 1, below_.begin() + until, between);
      return;
    }
    const int middle = from + (until - from) / 2;
    find(middle);
    fill(from, middle);
    fill(middle, until);
  }

  const FlowSymbol& symbol_;
  const Distribution& distribution_;
  std::vector<Interval> below_;
  int found_ = 0;
};

}  // namespace

namespace {

/// Of what is not known exactly there are up to 16 of each.
Work::Kind kindOf(const Distribution& distribution) {
  const bool isSlow = distribution.isSlow();
  if (distribution.isPrecise()) return isSlow ? Work::preciseEdge : Work::quickEdge;
  return isSlow ? Work::vagueEdge : Work::preciseEdge;
}

}  // namespace

/// Those of the last distributions are kept: requirements, probabilities and indices ask for the same, and many
/// quantities may be alike. What is kept, by this thread, counts as work once more, so that no thread counts otherwise.
const std::vector<Interval>& edgesOf(const FlowSymbol& symbol, const Distribution& distribution) {
  constexpr std::size_t most = 128;
  using Key = std::pair<std::string, std::vector<double>>;
  struct Known {
    std::vector<Interval> edges;
    int found;
  };
  thread_local std::map<Key, Known> known;
  Key key(distribution.name(), std::vector<double>{symbol.centre, symbol.half});
  for (const ShapeNumber& number : distribution.numbers()) key.second.push_back(number.value);
  auto place = known.find(key);
  if (place == known.end()) {
    if (known.size() >= most) known.clear();
    const Edges edges(symbol, distribution);
    place = known.emplace(std::move(key), Known{edges.rising(), edges.found()}).first;
  }
  Work::count(kindOf(distribution), place->second.found);
  return place->second.edges;
}

BinMasses massesBetween(const std::vector<Interval>& edges) {
  BinMasses found;
  double middle = 0, off = 0;  // `middle` is off by that at most
  for (std::size_t i = 1; i < edges.size(); ++i) {
    // Bounds of what rises: their middles rise.
    const double next = midpoint(edges[i]), nextOff = width(edges[i]);
    found.mass.push_back(next - middle);
    found.error += off + nextOff + 2 * bounds::unit;
    middle = next;
    off = nextOff;
  }
  found.error *= bounds::up;
  return found;
}

/// Any density: half the bin's width off its middle. One that rises (or falls) over the bin and its neighbours: it lies
/// between the means of these, a and b, so that |∫ (ξ - middle) (d - (a+b)/2) dξ| <= (width²/4) |b - a|/2.
std::vector<double> leansOf(const FlowSymbol& symbol, const Distribution& distribution,
                            const std::vector<double>& mass) {
  const auto count = static_cast<int>(mass.size());
  const double width = 2.0 / count;
  const auto valueAt = [&](double xi) { return Interval(symbol.centre) + Interval(symbol.half) * Interval(xi); };
  std::vector<double> leans;
  for (int i = 0; i < count; ++i) {
    double lean = mass[i];
    if (i > 0 && i + 1 < count &&
        distribution.isMonotone(hull(valueAt(-1 + (i - 1) * width), valueAt(-1 + (i + 2) * width))))
      lean = std::min(lean, 0.25 * std::fabs(mass[i + 1] - mass[i - 1]));
    leans.push_back(lean);
  }
  return leans;
}

QuantityMasses::QuantityMasses(const Surrogate& surrogate, const std::vector<const Uncertain*>& uncertain)
    : symbols_(at(surrogate.symbols)) {
  for (std::size_t q = 0; q < uncertain.size(); ++q) {
    const FlowSymbol& of = surrogate.quantities[q];
    if (of.symbol < 0) continue;
    const Distribution& distribution = uncertain[q]->distribution;
    Symbol& symbol = symbols_[of.symbol];
    BinMasses known = massesBetween(edgesOf(of, distribution));
    symbol.mass = std::move(known.mass);
    symbol.error = known.error;
    symbol.lean = leansOf(of, distribution, symbol.mass);
    for (double& lean : symbol.lean) lean /= bins;
  }
}

/// On a bin f(ξ) = η^n ζ^m is f(middle) + f'(middle) (ξ - middle) + f'' (ξ - middle)²/2, |f'| <= n/h + m/k and
/// |f''| <= (n/h + m/k)² with the parts' half-widths h and k.
Interval QuantityMasses::moment(int symbol, const FlowPart& eta, int n, const FlowPart& zeta, int m) const {
  const Symbol& s = symbols_[symbol];
  const auto [first, count] = of(eta, symbol);
  const auto [otherFirst, otherCount] = of(zeta, symbol);
  const long from = std::max(first, otherFirst), until = std::min(first + count, otherFirst + otherCount);
  double sum = 0, lean = 0, mass = 0;
  for (long i = from; i < until; ++i) {
    const auto own = [&](long begin, long all) {
      return (2 * static_cast<double>(i - begin) + 1) / static_cast<double>(all) - 1;
    };
    const double p = s.mass[i];
    double value = 1;
    const double x = own(first, count), z = own(otherFirst, otherCount);
    for (int j = 0; j < n; ++j) value *= x;
    for (int j = 0; j < m; ++j) value *= z;
    sum += p * value;
    lean += s.lean[i];
    mass += p;
  }
  const double slope = n / eta.half[symbol] + m / zeta.half[symbol], reach = 1.0 / bins;
  // The lean is of masses that are off by `error` in all; |f| <= 1.
  const double leanError =
      n + m > 0 ? slope * (lean + s.error / bins) + 0.5 * slope * slope * reach * reach * (mass + s.error) : 0;
  const double roundings = static_cast<double>(until - from + 4 * (n + m) + 8) * bounds::unit;
  const double error = (leanError + s.error + roundings * (mass + bounds::tiny)) * bounds::up;
  return until > from ? Interval(subDown(sum, error), addUp(sum, error)) : Interval(0.0);
}

}  // namespace gamut
