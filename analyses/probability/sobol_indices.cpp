// With u a set of symbols, E[E[y|u]²] is a sum over pairs of parts that meet in u, of products of the moments of single
// symbols: those of u over what both parts have in common, all others of each part by itself.
#include "analyses/probability/sobol_indices.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/elementary/rounding.hpp"

namespace gamut {

namespace {

/// Powers of some symbols, each above 0; symbols rising.
using Powers = std::vector<std::pair<int, int>>;

/// A polynomial on a part, what matters of it; the first term is the constant.
struct Slice {
  const FlowPart* part;
  std::vector<std::pair<Powers, double>> terms;
  double radius;
  std::vector<Interval> masses;                // [symbol]: probability of its values in the part
  std::vector<std::vector<Interval>> moments;  // [symbol][n - 1]: mean of η^n there
};

class Variances {
 public:
  Variances(const Surrogate& surrogate, const std::vector<SurrogatePart>& parts, std::size_t output,
            const QuantityMasses& masses, double work)
      : symbols_(surrogate.symbols), masses_(masses) {
    const std::size_t terms = mostTerms(parts, work);
    for (const SurrogatePart& part : parts) add(part, part.outputs[output], terms);
    for (Slice& piece : pieces_) tabulate(piece);
    const double middle = midpoint(mean());
    about_ = std::isfinite(middle) ? middle : 0;  // of numbers near the mean little cancels
    for (Slice& piece : pieces_) {
      double& constant = piece.terms.front().second;
      const Interval moved = Interval(constant) - Interval(about_);
      constant = midpoint(moved);
      piece.radius = (piece.radius + width(moved)) * bounds::up;
    }
  }

  int symbols() const { return symbols_; }
  double about() const { return about_; }

  // Of the polynomials, less `about`:

  Interval mean() const {
    Interval sum(0.0);
    for (const Slice& piece : pieces_) {
      Interval own(0.0);
      for (const auto& [powers, c] : piece.terms) own = own + Interval(c) * meanOf(piece, powers);
      sum = sum + massOf(piece) * own;
    }
    return sum;
  }

  /// E[E[y|u]²] with u given by `isIn`.
  Interval meanSquare(const std::vector<char>& isIn) const {
    std::map<Box, Group> groups;  // by what a part covers in u
    for (const Slice& piece : pieces_) {
      Box box;
      Interval beside(1.0);  // probability of the part's values of all other symbols
      for (int l = 0; l < symbols_; ++l) {
        if (isIn[l] != 0)
          box.push_back({piece.part->centre[l], piece.part->half[l]});
        else
          beside = beside * piece.masses[l];
      }
      Group& group = groups[box];
      group.piece = &piece;
      for (const auto& [powers, c] : piece.terms) {
        Interval own = Interval(c) * beside;
        Powers left;
        for (const auto& [l, n] : powers) {
          if (isIn[l] != 0)
            left.emplace_back(l, n);
          else
            own = own * moment(piece, l, n);
        }
        const auto [place, isNew] = group.terms.try_emplace(std::move(left), own);
        if (!isNew) place->second = place->second + own;
      }
    }
    Interval sum(0.0);
    for (auto one = groups.begin(); one != groups.end(); ++one) {
      sum = sum + meanSquareOf(isIn, one->second);
      for (auto other = std::next(one); other != groups.end(); ++other)
        sum = sum + 2.0 * meanProduct(isIn, one->second, other->second);
    }
    return sum;
  }

  /// E[Var(y | all but symbol l)]. Where no part is cut in l, only terms that hold it matter.
  Interval left(int l, const Interval& second) const {
    const auto isCut = [&](const Slice& piece) { return piece.part->half[l] < 1; };
    if (std::ranges::any_of(pieces_, isCut)) {
      std::vector<char> others(symbols_, 1);
      others[l] = 0;
      return second - meanSquare(others);
    }
    Interval sum(0.0);
    for (const Slice& piece : pieces_) {
      // Σ c_g c_h E[Π others] (E[η^(n+m)] - E[η^n] E[η^m])
      std::vector<std::tuple<Powers, int, double>> own;
      for (const auto& [powers, c] : piece.terms)
        if (const auto place = std::ranges::find(powers, l, &std::pair<int, int>::first); place != powers.end()) {
          Powers others = powers;
          others.erase(others.begin() + (place - powers.begin()));
          own.emplace_back(std::move(others), place->second, c);
        }
      Interval of(0.0);
      Work::count(Work::momentTerm,
                  0.5 * static_cast<double>(own.size()) * static_cast<double>(own.size()) * (symbols_ + 2));
      for (std::size_t i = 0; i < own.size(); ++i)
        for (std::size_t j = i; j < own.size(); ++j) {
          const auto& [e, n, c] = own[i];
          const auto& [f, m, d] = own[j];
          const Interval both = moment(piece, l, n + m) - moment(piece, l, n) * moment(piece, l, m);
          const Interval product = Interval(c) * Interval(d) * both * meanOf(piece, productOf(e, f));
          of = of + (i == j ? product : 2.0 * product);
        }
      sum = sum + massOf(piece) * of;
    }
    return sum;
  }

  /// The root of the mean square of what the polynomials are off by, at most.
  double radius() const {
    Interval sum(0.0);
    for (const Slice& piece : pieces_) sum = sum + massOf(piece) * sqr(Interval(piece.radius));
    return sqrt(max(sum, Interval(0.0))).upper();
  }

 private:
  using Box = std::vector<std::pair<double, double>>;
  struct Group {
    const Slice* piece = nullptr;  // one that covers it
    std::map<Powers, Interval> terms;
  };

  /// Of a part: all pairs of terms once, and once more for each symbol in which parts are cut, then also of about half
  /// of the pairs of parts.
  std::size_t mostTerms(const std::vector<SurrogatePart>& parts, double work) const {
    constexpr double least = 64, most = 1200;
    const auto count = static_cast<double>(parts.size());
    double cut = 0;
    for (int l = 0; l < symbols_; ++l)
      cut += std::ranges::any_of(parts, [&](const SurrogatePart& part) { return part.part.half[l] < 1; }) ? 1 : 0;
    const double pairs = 0.5 * count * (1 + cut) + 0.25 * cut * count * (count - 1);
    const double each = Work::of(Work::momentTerm, pairs * symbols_);
    return static_cast<std::size_t>(std::clamp(std::sqrt(work / std::max(each, 1.0)), least, most));
  }

  void add(const SurrogatePart& part, const OutputModel& model, std::size_t most) {
    Slice piece{&part.part, {{{}, 0.0}}, model.radius, {}, {}};
    if (model.c.empty() || !std::isfinite(model.radius)) {
      piece.terms.front().second = midpoint(model.bound);
      piece.radius = subUp(model.bound.upper(), model.bound.lower());
    } else {
      piece.terms.front().second = model.c[0];
      // Terms that are next to nothing together, and the least of very many, count as error: |η^e| <= 1.
      constexpr double next = 1e-6;
      std::vector<std::size_t> order(model.c.size() - 1);
      std::iota(order.begin(), order.end(), std::size_t{1});
      std::ranges::sort(order, std::greater<>(), [&](std::size_t g) { return std::fabs(model.c[g]); });
      double all = 0, kept = 0, dropped = 0;
      for (const std::size_t g : order) all += std::fabs(model.c[g]);
      for (std::size_t i = 0; i < order.size(); ++i) {
        const double c = model.c[order[i]];
        if (i >= most || all - kept <= next * all) {
          dropped += std::fabs(c);
          continue;
        }
        kept += std::fabs(c);
        Powers powers;
        for (int l = 0; l < symbols_; ++l)
          if (const int n = part.monomials->exponent(static_cast<int>(order[i]), l); n > 0) {
            powers.emplace_back(l, n);
            degree_ = std::max(degree_, n);
          }
        piece.terms.emplace_back(std::move(powers), c);
      }
      piece.radius = (piece.radius + dropped * bounds::up) * bounds::up;
    }
    pieces_.push_back(std::move(piece));
  }

  /// As far as products of terms of any pieces ask for.
  void tabulate(Slice& piece) const {
    for (int l = 0; l < symbols_; ++l) {
      piece.masses.push_back(masses_.moment(l, *piece.part, 0, *piece.part, 0));
      Work::count(Work::momentTerm, 150.0 * (2 * degree_ + 1));
      std::vector<Interval>& moments = piece.moments.emplace_back();
      for (int n = 1; n <= 2 * degree_; ++n)  // |η^n| <= 1, also where the probability is not known from zero
        moments.push_back(intersection(masses_.moment(l, *piece.part, n, *piece.part, 0) / piece.masses.back(),
                                       Interval(n % 2 == 0 ? 0.0 : -1.0, 1.0)));
    }
  }

  static Interval moment(const Slice& piece, int l, int n) { return n == 0 ? Interval(1.0) : piece.moments[l][n - 1]; }

  static Interval massOf(const Slice& piece) {
    Interval mass(1.0);
    for (const Interval& of : piece.masses) mass = mass * of;
    return mass;
  }

  static Interval meanOf(const Slice& piece, const Powers& powers) {
    Interval mean(1.0);
    for (const auto& [l, n] : powers) mean = mean * moment(piece, l, n);
    return mean;
  }

  static Powers productOf(const Powers& a, const Powers& b) {
    Powers product;
    auto i = a.begin(), j = b.begin();
    while (i != a.end() || j != b.end()) {
      if (j == b.end() || (i != a.end() && i->first < j->first)) {
        product.push_back(*i++);
      } else if (i == a.end() || j->first < i->first) {
        product.push_back(*j++);
      } else {
        product.emplace_back(i->first, i->second + j->second);
        ++i, ++j;
      }
    }
    return product;
  }

  Interval meanSquareOf(const std::vector<char>& isIn, const Group& group) const {
    Interval mass(1.0), sum(0.0);
    const auto terms = static_cast<double>(group.terms.size());
    Work::count(Work::momentTerm, 0.5 * terms * terms * symbols_);
    for (int l = 0; l < symbols_; ++l)
      if (isIn[l] != 0) mass = mass * group.piece->masses[l];
    for (auto one = group.terms.begin(); one != group.terms.end(); ++one)
      for (auto other = one; other != group.terms.end(); ++other) {
        const Interval product =
            one->second * other->second * meanOf(*group.piece, productOf(one->first, other->first));
        sum = sum + (one == other ? product : 2.0 * product);
      }
    return mass * sum;
  }

  /// Over what both cover.
  Interval meanProduct(const std::vector<char>& isIn, const Group& one, const Group& other) const {
    const FlowPart &a = *one.piece->part, &b = *other.piece->part;
    std::vector<int> in;
    for (int l = 0; l < symbols_; ++l) {
      if (isIn[l] == 0) continue;
      if (!(std::fabs(a.centre[l] - b.centre[l]) < std::max(a.half[l], b.half[l]))) return Interval(0.0);
      in.push_back(l);
    }
    std::map<std::tuple<int, int, int>, Interval> known;
    const auto moment = [&](int l, int n, int m) -> const Interval& {
      const auto [place, isNew] = known.try_emplace({l, n, m}, 0.0);
      if (isNew) place->second = masses_.moment(l, a, n, b, m);
      return place->second;
    };
    const auto powerOf = [](const Powers& powers, int l) {
      const auto place = std::ranges::find(powers, l, &std::pair<int, int>::first);
      return place == powers.end() ? 0 : place->second;
    };
    Interval sum(0.0);
    Work::count(Work::momentTerm, static_cast<double>(one.terms.size()) * static_cast<double>(other.terms.size()) *
                                      static_cast<double>(in.size() + 1));
    for (const auto& [e, c] : one.terms)
      for (const auto& [f, d] : other.terms) {
        Interval product = c * d;
        for (const int l : in) product = product * moment(l, powerOf(e, l), powerOf(f, l));
        sum = sum + product;
      }
    return sum;
  }

  int symbols_;
  const QuantityMasses& masses_;
  std::vector<Slice> pieces_;
  int degree_ = 0;  // the greatest power of a symbol
  double about_ = 0;
};

Interval root(const Interval& square) { return sqrt(max(square, Interval(0.0))); }

/// Of a vector of length b, a part of length a: y and its polynomial are apart by r at most, so that the angle whose
/// sine is a/b is off by no more than arcsin(r/b).
Interval shareOf(const Interval& partSquare, const Interval& square, double r) {
  if (!isBounded(partSquare) || !isBounded(square)) return {0.0, 1.0};  // squares overflow before their numbers do
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
                          const QuantityMasses& masses, double work) {
  SobolIndices indices;
  indices.first.assign(surrogate.quantities.size(), Interval(0.0, 1.0));
  indices.total = indices.first;
  const auto isKnown = [&](const SurrogatePart& part) {
    return QuantityMasses::hold(part.part) && isBounded(part.outputs[output].bound);
  };
  if (parts.empty() || !std::ranges::all_of(parts, isKnown)) return indices;
  const Variances of(surrogate, parts, output, masses, work);
  std::vector<char> all(of.symbols(), 1);
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
    std::vector<char> alone(of.symbols(), 0);
    alone[l] = 1;
    indices.first[q] = shareOf(of.meanSquare(alone) - meanSquare, variance, r);
    indices.total[q] = shareOf(of.left(l, second), variance, r);
  }
  return indices;
}

}  // namespace gamut
