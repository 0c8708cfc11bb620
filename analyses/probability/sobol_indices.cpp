// With u a set of symbols, E[E[y|u]²] is a sum over pairs of parts that meet in u, of products of the moments of single
// symbols: those of u over what both parts have in common, all others of each part by itself.
#include "analyses/probability/sobol_indices.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "analyses/flow/error_bounds.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

/// A polynomial on a part, what matters of it.
struct Piece {
  const FlowPart* part;
  std::vector<double> c;
  std::vector<std::vector<int>> exponents;  // of each term, [symbol]
  double radius;
  Interval mass;
};

class Variances {
 public:
  Variances(const Surrogate& surrogate, const std::vector<SurrogatePart>& parts, std::size_t output,
            const QuantityMasses& masses)
      : symbols_(surrogate.symbols), masses_(masses) {
    double sum = 0;  // about the mean: of numbers near it little cancels
    for (const SurrogatePart& part : parts) {
      add(part, part.outputs[output]);
      const Piece& piece = pieces_.back();
      for (std::size_t t = 0; t < piece.c.size(); ++t) {
        double term = piece.c[t];
        for (int l = 0; l < symbols_; ++l) term *= midpoint(moment(l, *piece.part, piece.exponents[t][at(l)]));
        sum += term;
      }
    }
    about_ = std::isfinite(sum) ? sum : 0;
    for (Piece& piece : pieces_) {
      double& constant = piece.c.front();
      const Interval moved = Interval(constant) - Interval(about_);
      constant = midpoint(moved);
      piece.radius = (piece.radius + width(moved)) * bounds::up;
    }
  }

  int symbols() const { return symbols_; }
  double about() const { return about_; }

  /// Of the polynomials, less `about`: E[E[y|u]²] with u given by `isIn`.
  Interval meanSquare(const std::vector<char>& isIn) const {
    std::map<Box, std::pair<const FlowPart*, Terms>> groups;  // by what a part covers in u
    for (const Piece& piece : pieces_) {
      Box box;
      for (int l = 0; l < symbols_; ++l)
        if (isIn[at(l)] != 0) box.push_back({piece.part->centre[at(l)], piece.part->half[at(l)]});
      auto& [part, terms] = groups[box];
      part = piece.part;
      for (std::size_t t = 0; t < piece.c.size(); ++t) {
        Interval c(piece.c[t]);
        std::vector<int> own = piece.exponents[t];
        for (int l = 0; l < symbols_; ++l)
          if (isIn[at(l)] == 0) {
            c = c * moment(l, *piece.part, own[at(l)]);
            own[at(l)] = 0;
          }
        const auto [place, isNew] = terms.try_emplace(own, c);
        if (!isNew) place->second = place->second + c;
      }
    }
    Interval sum(0.0);
    for (auto one = groups.begin(); one != groups.end(); ++one)
      for (auto other = one; other != groups.end(); ++other) {
        const Interval product = meanProduct(isIn, one->second, other->second, one == other);
        sum = sum + (one == other ? product : 2.0 * product);
      }
    return sum;
  }

  Interval mean() const {
    Interval sum(0.0);
    for (const Piece& piece : pieces_)
      for (std::size_t t = 0; t < piece.c.size(); ++t) {
        Interval c(piece.c[t]);
        for (int l = 0; l < symbols_; ++l) c = c * moment(l, *piece.part, piece.exponents[t][at(l)]);
        sum = sum + c;
      }
    return sum;
  }

  /// The root of the mean square of what the polynomials are off by, at most.
  double radius() const {
    Interval sum(0.0);
    for (const Piece& piece : pieces_) sum = sum + piece.mass * sqr(Interval(piece.radius));
    return sqrt(max(sum, Interval(0.0))).upper();
  }

 private:
  using Box = std::vector<std::pair<double, double>>;
  using Terms = std::map<std::vector<int>, Interval>;

  void add(const SurrogatePart& part, const OutputModel& model) {
    Piece piece{&part.part, {}, {}, model.radius, Interval(1.0)};
    for (int l = 0; l < symbols_; ++l) piece.mass = piece.mass * moment(l, part.part, 0);
    const std::vector<int> none(at(symbols_), 0);
    if (model.c.empty()) {
      piece.c = {midpoint(model.bound)};
      piece.exponents = {none};
      piece.radius = subUp(model.bound.upper(), model.bound.lower());
      pieces_.push_back(std::move(piece));
      return;
    }
    // Terms that are next to nothing together count as error: |η^e| <= 1.
    std::vector<std::size_t> order(model.c.size() - 1);
    std::iota(order.begin(), order.end(), std::size_t{1});
    std::ranges::sort(order, {}, [&](std::size_t g) { return std::fabs(model.c[g]); });
    double all = 0, dropped = 0;
    for (const std::size_t g : order) all += std::fabs(model.c[g]);
    constexpr double next = 1e-6;
    std::vector<char> isDropped(model.c.size(), 0);
    for (const std::size_t g : order) {
      if (dropped + std::fabs(model.c[g]) > next * all) break;
      dropped += std::fabs(model.c[g]);
      isDropped[g] = 1;
    }
    piece.radius = (piece.radius + dropped * bounds::up) * bounds::up;
    for (std::size_t g = 0; g < model.c.size(); ++g) {
      if (isDropped[g] != 0) continue;
      piece.c.push_back(model.c[g]);
      std::vector<int>& e = piece.exponents.emplace_back();
      for (int l = 0; l < symbols_; ++l) e.push_back(part.monomials->exponent(static_cast<int>(g), l));
    }
    pieces_.push_back(std::move(piece));
  }

  const Interval& moment(int symbol, const FlowPart& part, int n) const { return moment(symbol, part, n, part, 0); }
  const Interval& moment(int symbol, const FlowPart& a, int n, const FlowPart& b, int m) const {
    const std::size_t l = at(symbol);
    const auto key = std::tuple(symbol, a.centre[l], a.half[l], n, b.centre[l], b.half[l], m);
    const auto found = moments_.find(key);
    return found != moments_.end() ? found->second
                                   : moments_.try_emplace(key, masses_.moment(symbol, a, n, b, m)).first->second;
  }

  Interval meanProduct(const std::vector<char>& isIn, const std::pair<const FlowPart*, Terms>& one,
                       const std::pair<const FlowPart*, Terms>& other, bool isSame) const {
    const FlowPart &a = *one.first, &b = *other.first;
    std::vector<int> in;
    for (int l = 0; l < symbols_; ++l) {
      if (isIn[at(l)] == 0) continue;
      if (!isSame && !(std::fabs(a.centre[at(l)] - b.centre[at(l)]) < std::max(a.half[at(l)], b.half[at(l)])))
        return Interval(0.0);
      in.push_back(l);
    }
    Interval sum(0.0);
    for (const auto& [e, c] : one.second)
      for (const auto& [f, d] : other.second) {
        Interval product = c * d;
        for (const int l : in)
          product = product * (isSame ? moment(l, a, e[at(l)] + f[at(l)]) : moment(l, a, e[at(l)], b, f[at(l)]));
        sum = sum + product;
      }
    return sum;
  }

  int symbols_;
  const QuantityMasses& masses_;
  std::vector<Piece> pieces_;
  double about_ = 0;
  mutable std::map<std::tuple<int, double, double, int, double, double, int>, Interval> moments_;
};

Interval root(const Interval& square) { return sqrt(max(square, Interval(0.0))); }

/// Of a vector of length b, a part of length a: y and its polynomial are apart by r at most, so that the angle whose
/// sine is a/b is off by no more than arcsin(r/b).
Interval shareOf(const Interval& partSquare, const Interval& square, double r) {
  const Interval b = root(square), a = min(root(partSquare), Interval(b.upper()));
  const Interval rest = root(square - partSquare);
  if (!(b.lower() > 0) || !(r < b.lower())) return {0.0, 1.0};
  const Interval turn = Interval(r) / b, cosine = root(Interval(1.0) - sqr(turn));
  const Interval least = (a * cosine - rest * turn) / b, most = (a * cosine + rest * turn) / b;
  const bool mayBeAll = !((a / b).upper() < cosine.lower());
  return intersection(Interval(least.lower() > 0 ? mulDown(least.lower(), least.lower()) : 0.0,
                               mayBeAll ? 1.0 : mulUp(most.upper(), most.upper())),
                      Interval(0.0, 1.0));
}

}  // namespace

SobolIndices sobolIndices(const Surrogate& surrogate, const std::vector<SurrogatePart>& parts, std::size_t output,
                          const QuantityMasses& masses) {
  SobolIndices indices;
  indices.first.assign(surrogate.quantities.size(), Interval(0.0, 1.0));
  indices.total = indices.first;
  const auto isKnown = [&](const SurrogatePart& part) {
    return QuantityMasses::hold(part.part) && isBounded(part.outputs[output].bound);
  };
  if (parts.empty() || !std::ranges::all_of(parts, isKnown)) return indices;
  const Variances of(surrogate, parts, output, masses);
  std::vector<char> all(at(of.symbols()), 1);
  const double r = of.radius();
  const Interval mean = of.mean(), meanSquare = sqr(mean);
  const Interval second = of.meanSquare(all);
  const Interval variance = max(second - meanSquare, Interval(0.0));
  indices.mean = Interval(of.about()) + mean + Interval(-r, r);
  indices.deviation = max(root(variance) + Interval(-r, r), Interval(0.0));
  for (std::size_t q = 0; q < surrogate.quantities.size(); ++q) {
    const int l = surrogate.quantities[q].symbol;
    if (l < 0) {  // polynomials do not depend on it
      indices.first[q] = indices.total[q] = shareOf(Interval(0.0), variance, r);
      continue;
    }
    std::vector<char> alone(at(of.symbols()), 0), others = all;
    alone[at(l)] = 1;
    others[at(l)] = 0;
    indices.first[q] = shareOf(of.meanSquare(alone) - meanSquare, variance, r);
    indices.total[q] = shareOf(second - of.meanSquare(others), variance, r);
  }
  return indices;
}

}  // namespace gamut
