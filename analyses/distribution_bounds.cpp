// Distribution functions with bounds: every one is a formula of interval functions, or a series of positive terms, of
// which what is left is at most geometric.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analyses/normal_distribution.hpp"
#include "analyses/uncertainty.hpp"
#include "scalars/elementary/special_functions.hpp"

namespace gamut {
namespace {

Interval between(const detail::Bounds& bounds) { return {bounds.down, bounds.up}; }
/// Of a function that rises.
template <class F>
Interval rising(const F& f, const Interval& x) {
  return hull(f(x.lower()), f(x.upper()));
}

const Interval share(0.0, 1.0);
constexpr double unlimited = std::numeric_limits<double>::infinity();

/// |d/dx log Γ(x)| ≤ |log x| + 1/x (Abramowitz and Stegun 6.3.21: log x - 1/x < ψ(x) < log x), which counts where x is
/// no single number.
Interval logGamma(const Interval& x) {
  const Interval slope = abs(log(x)) + Interval(1.0) / x;
  return between(detail::boundLogGamma(x.lower())) + slope * (x - Interval(x.lower())) * Interval(-1.0, 1.0);
}

/// 1 + r_0 + r_0 r_1 + …, all ratios positive, as bounded by `atMost(n)` from r_n on. Where that stays at 1 or above,
/// the sum is not known.
template <class Ratio, class AtMost>
Interval sumOf(const Ratio& ratio, const AtMost& atMost) {
  constexpr int most = 100000;
  constexpr double enough = 0x1p-60;
  Interval sum(1.0), term(1.0);
  for (int n = 0; n < most; ++n) {
    const double bound = atMost(n);
    if (bound < 1) {
      const Interval rest = term * Interval(0.0, bound) / (Interval(1.0) - Interval(bound));
      if (rest.upper() <= enough * sum.lower()) return sum + rest;
    }
    term = term * ratio(n);
    sum = sum + term;
  }
  return {sum.lower(), std::numeric_limits<double>::infinity()};
}

/// P(a, x) = x^a e^-x / Γ(a+1) Σ xⁿ/((a+1)…(a+n)) (Abramowitz and Stegun 6.5.29).
Interval gammaBelow(double a, double value, const Interval& logGamma) {
  if (value <= 0) return Interval(0.0);
  const Interval x(value), shape(a);
  const auto ratio = [&](int n) { return x / (shape + Interval(n + 1.0)); };
  const Interval sum = sumOf(ratio, [&](int n) { return ratio(n).upper(); });  // they fall
  return intersection(exp(shape * log(x) - x - logGamma) / shape * sum, share);
}

/// x^a (1-x)^b / (a B(a, b)) Σ Π (a+b+i)/(a+1+i) xⁿ, n ≥ 0 and i < n (Abramowitz and Stegun 26.5.4).
Interval betaSeries(const Interval& a, const Interval& b, const Interval& x, const Interval& logBeta) {
  const Interval both = a + b;
  const auto ratio = [&](int n) { return (both + Interval(static_cast<double>(n))) / (a + Interval(n + 1.0)) * x; };
  // They run from r_n to x, rising or falling.
  const Interval sum = sumOf(ratio, [&](int n) { return std::max(ratio(n).upper(), x.upper()); });
  return exp(a * log(x) + b * log(Interval(1.0) - x) - logBeta) / a * sum;
}

/// I_x(a, b), from the side where its series converges sooner.
Interval betaBelow(double a, double b, double value, const Interval& logBeta) {
  if (value <= 0) return Interval(0.0);
  if (value >= 1) return Interval(1.0);
  const Interval x(value), first(a), second(b);
  const Interval found = value <= (a + 1) / (a + b + 2)
                             ? betaSeries(first, second, x, logBeta)
                             : Interval(1.0) - betaSeries(second, first, Interval(1.0) - x, logBeta);
  return intersection(found, share);
}

}  // namespace

Interval Distribution::boundBelow(const Interval& value, const Member& member) const {
  const Interval &first = member.first, &second = member.second;
  switch (shape_) {
    case Shape::gamma:
      return rising([&](double v) { return gammaBelow(midpoint(first), v, member.logFactor); }, value / second);
    case Shape::weibull:
    case Shape::exponential: {
      const Interval v = intersection(value / second, Interval(0.0, std::numeric_limits<double>::infinity()));
      return -expm1(-pow(v, first));
    }
    case Shape::lognormal:
      if (value.upper() <= 0) return Interval(0.0);
      return normalBelow((log(value) - first) / second);
    default:
      return normalBelow((value - first) / second);
  }
}

/// The piece that begins at or before a value inside the support, the last of them.
std::size_t Distribution::pieceAt(double value) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(pieces_, value, {}, &Piece::end) - pieces_.begin());
}

/// Whether some value has a probability of its own: F jumps there.
bool Distribution::hasSingleValues() const {
  double from = support_.lower();
  for (const Piece& piece : pieces_)
    if (std::exchange(from, piece.end) == piece.end && piece.weight > 0) return true;
  return false;
}

/// Of pieces: F rises linearly from one end to the next.
Interval Distribution::belowOf(double value) const {
  if (value < support_.lower()) return Interval(0.0);
  const std::size_t i = pieceAt(value);
  if (i == pieces_.size()) return Interval(1.0);
  const Interval before = i == 0 ? Interval(0.0) : pieces_[i - 1].below;
  const Interval from(i == 0 ? support_.lower() : pieces_[i - 1].end), end(pieces_[i].end);
  const Interval found = before + (pieces_[i].below - before) * ((Interval(value) - from) / (end - from));
  return intersection(found, hull(before, pieces_[i].below));
}

/// With parameters of which those of gamma and beta distributions are single numbers.
Interval Distribution::boundOf(const Interval& value, const Member& member) const {
  const Interval lower(support_.lower()), upper(support_.upper()), span = upper - lower,
                                                                   v = intersection(value, support_);
  switch (shape_) {
    case Shape::uniform:
      return intersection((v - lower) / span, share);
    case Shape::triangular: {
      const double mode = midpoint(member.first);
      const auto at = [&](double x) {
        if (x <= mode)
          return x <= support_.lower() ? Interval(0.0) : sqr(Interval(x) - lower) / (span * (Interval(mode) - lower));
        return x >= support_.upper() ? Interval(1.0)
                                     : Interval(1.0) - sqr(upper - Interval(x)) / (span * (upper - Interval(mode)));
      };
      return intersection(rising(at, v), share);
    }
    case Shape::beta:
      return rising(
          [&](double x) { return betaBelow(midpoint(member.first), midpoint(member.second), x, member.logFactor); },
          (v - lower) / span);
    default: {
      const Interval found = (boundBelow(v, member) - member.cut) / member.all;
      return isEmpty(found) ? share : intersection(found, share);
    }
  }
}

/// Those whose distribution functions are, together, above those of all others (`low`: values are low) or below them.
/// By parameters on which the likelihood ratio depends monotonously: the quantity grows, as they do, with mode, mean,
/// scale, a and gamma's shape, and falls with b, truncated or not, since densities are h(x) exp(θ T(x)), T monotone in
/// x (E. L. Lehmann, J. P. Romano, Testing Statistical Hypotheses, lemma 3.4.2). In deviations and Weibull's shape
/// nothing is monotone: parts of these.
std::vector<Distribution::Member> Distribution::members(bool low) const {
  const auto end = [](const Interval& range, bool lower) { return Interval(lower ? range.lower() : range.upper()); };
  const bool isNormal = shape_ == Shape::normal || shape_ == Shape::lognormal, isWeibull = shape_ == Shape::weibull;
  const Interval first = isWeibull ? firstRange_ : end(firstRange_, low);
  const Interval second = isNormal ? secondRange_ : end(secondRange_, shape_ == Shape::beta ? !low : low);
  const Interval& divided = isWeibull ? first : second;
  // Of F what is cut off alone keeps parameters that are not single numbers from being as good.
  constexpr int count = 16;
  const auto hidden = [&] {
    const Member all{isWeibull ? firstRange_ : first, isWeibull ? second : secondRange_};
    const Interval below = boundBelow(Interval(support_.lower()), all);
    return below.upper() + 1 - boundBelow(Interval(support_.upper()), all).lower();
  };
  const int parts = isThin(divided) || (isTruncated() && hidden() < 1e-4) ? 1 : count;
  std::vector<Member> found;
  for (int i = 0; i < parts; ++i) {
    const auto cutAt = [&](int k) {
      return k == 0       ? divided.lower()
             : k == parts ? divided.upper()
                          : std::clamp(divided.lower() + (divided.upper() - divided.lower()) * k / parts,
                                       divided.lower(), divided.upper());
    };
    const Interval part(cutAt(i), cutAt(i + 1));
    Member member{isWeibull ? part : first, isWeibull ? second : part};
    if (shape_ == Shape::gamma) member.logFactor = logGamma(member.first);
    if (shape_ == Shape::beta)
      member.logFactor = logGamma(member.first) + logGamma(member.second) - logGamma(member.first + member.second);
    if (isTruncated()) {
      member.cut = boundBelow(Interval(support_.lower()), member);
      member.all = boundBelow(Interval(support_.upper()), member) - member.cut;
    }
    found.push_back(member);
  }
  return found;
}

/// Of evidence: at least what lies below for certain, at most what may.
Interval Distribution::believedBelow(const Interval& value) const {
  Interval all(0.0), least(0.0), most(0.0);
  for (const FocalInterval& focal : focal_) {
    all = all + focal.mass;
    if (focal.values.upper() <= value.lower()) least = least + focal.mass;
    if (focal.values.lower() <= value.upper()) most = most + focal.mass;
  }
  return intersection(Interval((least / all).lower(), (most / all).upper()), share);
}

Interval Distribution::enclosedBelow(const Interval& value) const {
  if (shape_ != Shape::evidence && hasPieces()) return rising([&](double x) { return belowOf(x); }, value);
  if (value.lower() >= support_.upper()) return Interval(1.0);
  if (value.upper() < support_.lower() || (shape_ != Shape::evidence && value.upper() == support_.lower()))
    return Interval(0.0);
  if (shape_ == Shape::evidence) return believedBelow(value);
  double lower = 1, upper = 0;
  for (const Member& member : least_) upper = std::max(upper, boundOf(value, member).upper());
  if (isPrecise()) return {boundOf(value, least_.front()).lower(), upper};
  for (const Member& member : greatest_) lower = std::min(lower, boundOf(value, member).lower());
  return {lower, upper};
}

bool Distribution::isMonotone(const Interval& values) const {
  const Interval v = intersection(values, support_);
  if (isEmpty(v)) return true;
  if (values.lower() < support_.lower() || values.upper() > support_.upper()) return false;  // it jumps from zero
  if (!isPrecise()) return false;
  const auto isBeside = [&](const Interval& mode) { return mode.upper() <= v.lower() || mode.lower() >= v.upper(); };
  const Interval first(first_), one(1.0);
  switch (shape_) {
    case Shape::histogram:
    case Shape::empirical:  // even inside a piece
      return !hasSingleValues() && !isThin(v) && pieceAt(v.lower()) == pieceAt(std::nextafter(v.upper(), v.lower()));
    case Shape::uniform:
    case Shape::exponential:
      return true;
    case Shape::triangular:
    case Shape::normal:
      return isBeside(first);
    case Shape::beta: {
      if (first_ == 1 && second_ == 1) return true;
      if ((first_ <= 1) != (second_ <= 1)) return true;  // (a-1)/v - (b-1)/(1-v) has one sign
      const Interval place = (first - one) / (first + Interval(second_) - Interval(2.0));
      return isBeside(Interval(support_.lower()) + place * (Interval(support_.upper()) - Interval(support_.lower())));
    }
    case Shape::lognormal:
      return isBeside(exp(first - sqr(Interval(second_))));
    case Shape::weibull:
      return first_ <= 1 || isBeside(Interval(second_) * pow((first - one) / first, one / first));
    case Shape::gamma:
      return first_ <= 1 || isBeside(Interval(second_) * (first - one));
    case Shape::evidence:
      break;
  }
  return false;
}

/// Of what has no pieces, at its mode: what is truncated has it by as much more as `all` is less than 1.
Interval Distribution::densest(const Member& member) const {
  const Interval &first = member.first, &second = member.second, one(1.0), anything(0.0, unlimited);
  const Interval span = Interval(support_.upper()) - Interval(support_.lower());
  const Interval ofNormal = one / (second * sqrt(2.0 * pi()));
  switch (shape_) {
    case Shape::uniform:
      return one / span;
    case Shape::triangular:
      return 2.0 / span;
    case Shape::normal:
      return ofNormal / member.all;
    case Shape::lognormal:  // of exp(z): φ(z) exp(-z), most at z = mean - deviation²
      return ofNormal * exp(0.5 * sqr(second) - first) / member.all;
    case Shape::exponential:
      return one / second / member.all;
    case Shape::weibull:  // v^(k-1) exp(-v^k) <= 1: below v = 1 both are, beyond it v^k exp(-v^k) <= 1/e
      return first.lower() >= 1 ? first / second / member.all : anything;
    case Shape::gamma:
    case Shape::beta: {
      const Interval a = first - one, b = second - one, both = a + b;
      const bool isBeta = shape_ == Shape::beta;
      if (a.lower() < 0 || (isBeta && b.lower() < 0)) return anything;
      const Interval scale = isBeta ? span : second * member.all;
      if (a.lower() == 0 || (isBeta && b.lower() == 0)) return exp(-member.logFactor) / scale;  // all powers are <= 1
      const Interval power = isBeta ? a * log(a / both) + b * log(b / both) : a * log(a) - a;
      return exp(power - member.logFactor) / scale;
    }
    case Shape::histogram:
    case Shape::empirical:
    case Shape::evidence:
      break;
  }
  return anything;
}

Distribution::DensityBound Distribution::densityBound() const {
  if (!isPrecise() || !focal_.empty()) return {unlimited, unlimited};
  if (!hasPieces()) {  // it rises to its mode and falls from there
    const double most = densest(least_.front()).upper();
    return {most, 2 * most};
  }
  if (hasSingleValues()) return {unlimited, unlimited};
  double most = 0;
  Interval variation(0.0), density(0.0), before(0.0), from(support_.lower());
  for (const Piece& piece : pieces_) {
    const Interval end(piece.end);
    if (piece.end == from.lower()) continue;  // without a weight
    const Interval next = abs(piece.below - before) / (end - from);
    variation = variation + abs(next - density);
    most = std::max(most, next.upper());
    before = piece.below, from = end, density = next;
  }
  return {most, (variation + density).upper()};
}

}  // namespace gamut
