#include "analyses/probability/quantity_masses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "analyses/flow/error_bounds.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

bool QuantityMasses::hold(const FlowPart& part) {
  return std::ranges::all_of(part.half, [](double half) { return half * bins >= 2; });
}

std::pair<long, long> QuantityMasses::of(const FlowPart& part, int symbol) {
  const double centre = part.centre[at(symbol)], half = part.half[at(symbol)];
  return {static_cast<long>((centre - half + 1) * bins / 2), static_cast<long>(half * bins)};
}

namespace {

std::vector<Interval> foundEdgesOf(const FlowSymbol& symbol, const Distribution& distribution) {
  constexpr int bins = QuantityMasses::bins;
  std::vector<double> lower, upper;
  for (int i = 0; i <= bins; ++i) {
    const Interval value = Interval(symbol.centre) + Interval(symbol.half) * Interval(-1 + i * (2.0 / bins));
    const Interval below = i == 0      ? Interval(0.0)  // what has the value there counts in the first bin
                           : i == bins ? Interval(1.0)
                                       : distribution.enclosedBelow(value);
    lower.push_back(i == 0 ? 0 : std::max(lower.back(), below.lower()));
    upper.push_back(below.upper());
  }
  for (std::size_t i = upper.size() - 1; i-- > 0;) upper[i] = std::min(upper[i], upper[i + 1]);
  std::vector<Interval> edges;
  for (std::size_t i = 0; i < lower.size(); ++i) edges.emplace_back(lower[i], upper[i]);
  return edges;
}

}  // namespace

/// Those of the last distributions are kept: requirements, probabilities and indices ask for the same, and many
/// quantities may be alike.
const std::vector<Interval>& edgesOf(const FlowSymbol& symbol, const Distribution& distribution) {
  constexpr std::size_t most = 128;
  using Key = std::pair<std::string, std::vector<double>>;
  thread_local std::map<Key, std::vector<Interval>> known;
  Key key(distribution.name(), std::vector<double>{symbol.centre, symbol.half});
  for (const ShapeNumber& number : distribution.numbers()) key.second.push_back(number.value);
  if (const auto found = known.find(key); found != known.end()) return found->second;
  if (known.size() >= most) known.clear();
  return known.emplace(std::move(key), foundEdgesOf(symbol, distribution)).first->second;
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

QuantityMasses::QuantityMasses(const Surrogate& surrogate, const std::vector<const Uncertain*>& uncertain)
    : symbols_(at(surrogate.symbols)) {
  constexpr double width = 2.0 / bins;
  for (std::size_t q = 0; q < uncertain.size(); ++q) {
    const FlowSymbol& of = surrogate.quantities[q];
    if (of.symbol < 0) continue;
    const Distribution& distribution = uncertain[q]->distribution;
    const auto valueAt = [&](double xi) { return Interval(of.centre) + Interval(of.half) * Interval(xi); };
    Symbol& symbol = symbols_[at(of.symbol)];
    BinMasses known = massesBetween(edgesOf(of, distribution));
    symbol.mass = std::move(known.mass);
    symbol.error = known.error;
    // Any density: half the bin's width off its middle. One that rises (or falls) over the bin and its neighbours: it
    // lies between the means of these, a and b, so that |∫ (ξ - middle) (d - (a+b)/2) dξ| <= (width²/4) |b - a|/2.
    for (int i = 0; i < bins; ++i) {
      double lean = 0.5 * width * symbol.mass[at(i)];
      if (i > 0 && i + 1 < bins &&
          distribution.isMonotone(hull(valueAt(-1 + (i - 1) * width), valueAt(-1 + (i + 2) * width))))
        lean = std::min(lean, width / 8 * std::fabs(symbol.mass[at(i + 1)] - symbol.mass[at(i - 1)]));
      symbol.lean.push_back(lean);
    }
  }
}

/// On a bin f(ξ) = η^n ζ^m is f(middle) + f'(middle) (ξ - middle) + f'' (ξ - middle)²/2, |f'| <= n/h + m/k and
/// |f''| <= (n/h + m/k)² with the parts' half-widths h and k.
Interval QuantityMasses::moment(int symbol, const FlowPart& eta, int n, const FlowPart& zeta, int m) const {
  const Symbol& s = symbols_[at(symbol)];
  const auto [first, count] = of(eta, symbol);
  const auto [otherFirst, otherCount] = of(zeta, symbol);
  const long from = std::max(first, otherFirst), until = std::min(first + count, otherFirst + otherCount);
  double sum = 0, lean = 0, mass = 0;
  for (long i = from; i < until; ++i) {
    const auto own = [&](long begin, long all) {
      return (2 * static_cast<double>(i - begin) + 1) / static_cast<double>(all) - 1;
    };
    const double p = s.mass[static_cast<std::size_t>(i)];
    double value = 1;
    const double x = own(first, count), z = own(otherFirst, otherCount);
    for (int j = 0; j < n; ++j) value *= x;
    for (int j = 0; j < m; ++j) value *= z;
    sum += p * value;
    lean += s.lean[static_cast<std::size_t>(i)];
    mass += p;
  }
  const double slope = n / eta.half[at(symbol)] + m / zeta.half[at(symbol)], reach = 1.0 / bins;
  // The lean is of masses that are off by `error` in all; |f| <= 1.
  const double leanError =
      n + m > 0 ? slope * (lean + s.error / bins) + 0.5 * slope * slope * reach * reach * (mass + s.error) : 0;
  const double roundings = static_cast<double>(until - from + 4 * (n + m) + 8) * bounds::unit;
  const double error = (leanError + s.error + roundings * (mass + bounds::tiny)) * bounds::up;
  return until > from ? Interval(subDown(sum, error), addUp(sum, error)) : Interval(0.0);
}

}  // namespace gamut
