// With x = f cos ψ and y = f sin ψ of each far angle as two symbols more, an output is P(ξ, x, y) ± radius. Terms with
// one of all x and y make A x + B y, A and B polynomials in ξ: |A x + B y| ≤ √(A² + B²) |f|. The factor f is an
// eccentricity times a clearance, where it is the same in all that holds sine and cosine, else 1.
#include "analyses/flow/circles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "analyses/flow/embedding.hpp"
#include "analyses/flow/outputs/outputs.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr double farRound = 1.5;  // rad: of less, polynomials of the angle itself know enough
constexpr double nearlyWhole = 6;

/// Of an angle that goes far round.
struct Circle {
  int angle = -1;   ///< node of the original program
  int factor = -1;  ///< another one, by which its sine and its cosine are multiplied wherever they are used; -1: none
};

/// g with points of circles as further parameters, of each x, then y: cosine and sine of the angle, times the factor.
struct Circles {
  std::vector<Circle> all;
  Program g;
  bool areWhole = true;
};

/// That of all uses of both; -1 where there is another use.
int commonFactor(const Program& g, int cosine, int sine) {
  int factor = -1;
  bool isOnly = true;
  for (const int node : g.outputNodes()) isOnly = isOnly && node != cosine && node != sine;
  for (std::size_t i = 0; i < g.nodes().size(); ++i) {
    const Node& node = g.nodes()[i];
    const auto isEither = [&](int operand) { return operand == cosine || operand == sine; };
    bool uses = false;
    detail::forEachOperand(g.table(), static_cast<int>(i), [&](int operand) { uses = uses || isEither(operand); });
    if (!uses) continue;
    const int other = isEither(node.a) ? node.b : node.a;
    if (node.op != Op::mul || isEither(other) || (factor >= 0 && other != factor)) isOnly = false;
    factor = other;
  }
  return isOnly ? factor : -1;
}

/// Ranges of these nodes over a box.
std::vector<Interval> rangesOf(const Program& g, const std::vector<int>& nodes, double t, const Box& box) {
  Evaluator<Interval> evaluator(Recorder(g).finish(nodes));
  const auto states = box.begin() + g.states();
  evaluator.setParameters(std::vector<Interval>(states, box.end()));
  return evaluator(Interval(t), std::vector<Interval>(box.begin(), states));
}

/// Without circles where no angle goes far round.
Circles circlesOf(const Program& g, double t, const Box& box) {
  Circles circles;
  const std::vector<Node>& nodes = g.nodes();
  std::vector<int> sines, angles;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].op == Op::sin) sines.push_back(static_cast<int>(i)), angles.push_back(nodes[i].a);
  if (angles.empty()) return circles;
  const std::vector<Interval> ranges = rangesOf(g, angles, t, box);
  Recorder recorder(g.states(), g.parameters() + 2 * static_cast<int>(angles.size()));
  std::vector<int> instead(nodes.size(), -1), outputs;
  for (std::size_t k = 0; k < angles.size(); ++k) {
    if (!(width(ranges[k]) > farRound)) continue;
    circles.areWhole = circles.areWhole && width(ranges[k]) > nearlyWhole;
    const int sine = sines[k], cosine = sine + 1, factor = commonFactor(g, cosine, sine);
    const int place = g.parameters() + 2 * static_cast<int>(circles.all.size());
    const int x = recorder.parameter(place), y = recorder.parameter(place + 1);
    circles.all.push_back({angles[k], factor});
    if (factor < 0) instead[cosine] = x, instead[sine] = y;
    for (std::size_t i = 0; i < nodes.size() && factor >= 0; ++i)
      if (nodes[i].op == Op::mul) {
        if (nodes[i].a == cosine || nodes[i].b == cosine) instead[i] = x;
        if (nodes[i].a == sine || nodes[i].b == sine) instead[i] = y;
      }
  }
  if (circles.all.empty()) return circles;
  const std::vector<int> here = recorder.append(g, {}, instead);
  for (const int node : g.outputNodes()) outputs.push_back(here[node]);
  circles.g = recorder.finish(outputs);
  return circles;
}

/// How far from the origin each point may be, at most.
std::vector<double> radiiOf(const Program& g, const Circles& circles, double t, const Box& box) {
  constexpr double tiny = 0x1p-500;  // of a point that cannot leave the origin
  std::vector<double> radii;
  for (const Circle& circle : circles.all)
    radii.push_back(circle.factor < 0 ? 1.0 : std::max(tiny, magnitude(rangesOf(g, {circle.factor}, t, box)[0])));
  return radii;
}

/// The program's box, with the middle of what it does not use, and squares about the circles.
Box boxOf(const Circles& circles, Box box, const std::vector<double>& radii) {
  std::vector<char> isUsed(circles.g.nodes().size(), 0);
  for (const int node : circles.g.outputNodes()) isUsed[node] = 1;
  for (std::size_t i = 0; i < isUsed.size(); ++i)
    detail::forEachOperand(circles.g.table(), static_cast<int>(i), [&](int operand) { isUsed[operand] = 1; });
  for (std::size_t i = 0; i < box.size(); ++i)
    if (isUsed[i] == 0) box[i] = Interval(midpoint(box[i]));
  for (const double radius : radii) box.insert(box.end(), 2, Interval(-radius, radius));
  return box;
}

/// Where points of circles may be on a part of the box, in units of their symbols: factor times (cos, sin) of the
/// angle.
struct CircleReach {
  Interval factor, angle;
};

/// Moves values of states and parameters inside the box to where the node is about as far from zero, or as near, as it
/// becomes; returns its value there.
double goAsFar(const Program& g, int node, double t, const Box& box, bool isFar, std::vector<double>& values) {
  Evaluator<double> evaluator(Recorder(g).finish({node}));
  const auto valueAt = [&](const std::vector<double>& at) {
    evaluator.setParameters(std::span(at).subspan(static_cast<std::size_t>(g.states())));
    return evaluator(t, std::vector<double>(at.begin(), at.begin() + g.states()))[0];
  };
  double best = valueAt(values);
  for (std::size_t i = 0; i < box.size(); ++i)
    for (const double end : {box[i].lower(), box[i].upper()}) {
      std::vector<double> other = values;
      other[i] = end;
      const double value = valueAt(other);
      if (isFar ? std::fabs(value) > std::fabs(best) : std::fabs(value) < std::fabs(best)) best = value, values = other;
    }
  return best;
}

/// 2 at least, for play beside other quantities. Nothing where that is too much.
std::optional<int> degreeFor(int symbols, int degree) {
  constexpr double mostMonomials = 6000;
  const std::vector<int> weights(at(symbols), 1);
  const int chosen = degree >= 1 ? degree : std::max(2, degreeLadder(weights).back());
  if (countOfMonomials(weights, chosen) > mostMonomials) return std::nullopt;
  return chosen;
}

class CircleFinder {
 public:
  CircleFinder(const Circles& circles, double t, const Embedding& embedding, int degree,
               const std::atomic<bool>* cancelled)
      : embedding_(embedding),
        monomials_(Monomials::of(std::vector<int>(at(embedding.symbols), 1), degree)),
        outputs_(circles.g, monomials_, monomials_, {}, cancelled),
        ranges_(monomials_),
        first_(embedding.symbols - 2 * static_cast<int>(circles.all.size())) {
    evaluate(circles.g.states(), t);
  }

  int outputs() const { return outputs_.count(); }
  const std::shared_ptr<const Monomials>& monomials() const { return monomials_; }
  bool isKnown(int output) const { return std::isfinite(outputs_.radius(output)); }

  /// Where the output is extreme: ξ, and the angles of the points of circles.
  struct Peak {
    std::vector<double> xi, angles;
  };
  struct Found {
    Interval range, beside;  ///< of the output, and of what of it is not in `plain`
    double leastValue = 0, greatestValue = 0;
    Peak least, greatest;
    std::vector<double> plain;  ///< polynomial
  };
  /// Over a part of ξ, in which points of circles reach so far.
  Found over(int output, const Box& xi, const std::vector<CircleReach>& reach) {
    const std::vector<double> all(outputs_.polynomial(output), outputs_.polynomial(output) + monomials_->count());
    std::vector<double> plain(all.size()), rest(all.size());
    std::vector<std::vector<double>> along(at(embedding_.symbols - first_), plain);  // [x or y of a circle]
    for (int g = 0; g < monomials_->count(); ++g) {
      int power = 0, last = 0;
      for (int l = first_; l < embedding_.symbols; ++l)
        if (const int own = monomials_->exponent(g, l); own > 0) power += own, last = l;
      if (power == 0)
        plain[g] = all[g];
      else if (power == 1)
        along[at(last - first_)][monomials_->shifted(g, last, -1)] = all[g];
      else
        rest[g] = all[g];
    }
    Found found;
    const Interval alone = ranges_(plain.data(), xi);
    found.least.xi = ranges_.least().xi;
    found.greatest.xi = ranges_.greatest().xi;
    constexpr double roughly = 1;  // of what is of second order in play, about the sum of its terms
    Interval separately = ranges_(rest.data(), xi, roughly);
    std::vector<Interval> lines;
    for (const std::vector<double>& each : along) lines.push_back(rangeOf(each, xi));
    for (std::size_t k = 0; k < lines.size(); k += 2) separately += alongCircle(lines[k], lines[k + 1], reach[k / 2]);
    const std::vector<double> bend = takeSquares(rest);
    const Interval together = ranges_(rest.data(), xi, roughly) + alongBentCircles(lines, bend, reach);
    found.beside = inflated(intersection(separately, together), outputs_.radius(output));
    found.range = alone + found.beside;
    for (const double sign : {-1.0, 1.0}) {
      Peak& peak = sign < 0 ? found.least : found.greatest;
      for (std::size_t k = 0; k < along.size(); k += 2) {
        const double a = valueAt(along[k], peak.xi), b = valueAt(along[k + 1], peak.xi);
        peak.angles.push_back(std::atan2(sign * b, sign * a));
        const double most = magnitude(reach[k / 2].factor);
        peak.xi[at(first_) + k] = most * std::cos(peak.angles.back());
        peak.xi[at(first_) + k + 1] = most * std::sin(peak.angles.back());
      }
      (sign < 0 ? found.leastValue : found.greatestValue) = valueAt(all, peak.xi);
    }
    found.plain = std::move(plain);
    return found;
  }

 private:
  void evaluate(int states, double t) {
    const int N = monomials_->count();
    FlowPoint point;
    point.p.assign(at(states * N), 0.0);
    point.low.assign(at(states), 0.0);
    point.psi.assign(at(states * states), 0.0);
    point.psiSum = point.psi;
    point.total.assign(at(states), 0.0);
    std::vector<Embedded> parameters;
    for (std::size_t i = 0; i < embedding_.components.size(); ++i) {
      const Embedded& e = embedding_.components[i];
      if (i >= at(states)) {
        parameters.push_back(e);
        continue;
      }
      point.p[i * at(N)] = e.centre;
      if (e.symbol >= 0) point.p[i * at(N) + at(monomials_->linear(e.symbol))] = e.half;
      point.loose.push_back(e.radius);
    }
    point.radius = point.loose;
    point.ofR = point.beyond = point.known = point.total;
    outputs_.evaluate(t, point, std::vector<double>(at(states), 0.0), parameters);
  }

  /// A x + B y = f (|(A₀, B₀)| cos(ψ − θ₀) + (A − A₀) cos ψ + (B − B₀) sin ψ), θ₀ the angle of (A₀, B₀).
  static Interval alongCircle(const Interval& a, const Interval& b, const CircleReach& reach) {
    const Interval whole = inflated(Interval(0.0), (sqrt(sqr(a) + sqr(b)) * magnitude(reach.factor)).upper());
    const Interval a0(midpoint(a)), b0(midpoint(b));
    if (!isBounded(whole) || (midpoint(a) == 0 && midpoint(b) == 0)) return whole;
    const Interval about = sqrt(sqr(a0) + sqr(b0)) * cos(reach.angle - atan2(b0, a0));
    return intersection(whole, reach.factor * inflated(about, sqrt(sqr(a - a0) + sqr(b - b0)).upper()));
  }

  /// Takes the terms of second order in points of circles alone, c_lm z_l z_m, l ≤ m, out of a polynomial: a matrix Q,
  /// by rows, with zᵀ Q z.
  std::vector<double> takeSquares(std::vector<double>& c) const {
    const int size = embedding_.symbols - first_;
    std::vector<double> squares(at(size * size), 0.0);
    for (int l = 0; l < size; ++l)
      for (int m = l; m < size; ++m)
        if (const int g = monomials_->shifted(monomials_->linear(first_ + l), first_ + m, 1); g >= 0)
          squares[at(l * size + m)] = std::exchange(c[g], 0.0);
    return squares;
  }

  /// Σ A_j x_j + B_j y_j + zᵀ Q z. With x' along (A₀, B₀) and y' across, n = |(A₀, B₀)|, |y'| ≤ √(ρ² − x'²), what is
  /// across is bounded by m |y'| + w y'²: for n ≥ 2 w ρ, n x' + m |y'| + w (ρ² − x'²) ≤ √((n − 2wρ)² + m²) ρ + 2wρ²,
  /// since 2wρ x' + w (ρ² − x'²) ≤ 2wρ²; else at most √(n² + m²) ρ + wρ².
  static Interval alongBentCircles(const std::vector<Interval>& lines, const std::vector<double>& bend,
                                   const std::vector<CircleReach>& reach) {
    struct Turn {
      Interval c, s, n, off;
    };
    std::vector<Turn> turns;
    for (std::size_t j = 0; j < reach.size(); ++j) {
      const Interval &a = lines[2 * j], &b = lines[2 * j + 1];
      if (!isBounded(a) || !isBounded(b)) return Interval::entire();
      const Interval a0(midpoint(a)), b0(midpoint(b)), n = sqrt(sqr(a0) + sqr(b0));
      const bool isKnown = n.lower() > 0;
      turns.push_back(
          {isKnown ? a0 / n : Interval(1.0), isKnown ? b0 / n : Interval(0.0), n, sqrt(sqr(a - a0) + sqr(b - b0))});
    }
    const std::size_t count = turns.size();
    std::vector<Interval> m(count, Interval(0.0)), w = m, rho;
    for (const CircleReach& each : reach) rho.emplace_back(magnitude(each.factor));
    Interval bound(0.0);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) {
        const double *upper = &bend[2 * i * 2 * count + 2 * j], *lower = upper + 2 * count;
        const Turn &p = turns[i], &q = turns[j];
        const Interval x0 = upper[0] * q.c + upper[1] * q.s, x1 = lower[0] * q.c + lower[1] * q.s,  // of x'_j
            y0 = upper[1] * q.c - upper[0] * q.s, y1 = lower[1] * q.c - lower[0] * q.s;             // of y'_j
        const auto size = [](const Interval& x) { return Interval(magnitude(x)); };
        bound += size(p.c * x0 + p.s * x1) * rho[i] * rho[j];
        m[j] += size(p.c * y0 + p.s * y1) * rho[i];
        m[i] += size(p.c * x1 - p.s * x0) * rho[j];
        const Interval half = 0.5 * size(p.c * y1 - p.s * y0);  // |y'_i y'_j| ≤ (y'_i² + y'_j²)/2
        w[i] += half;
        w[j] += half;
      }
    for (std::size_t j = 0; j < count; ++j) {
      const Interval &n = turns[j].n, most = 2.0 * w[j] * rho[j];
      bound += turns[j].off * rho[j];
      if (n.lower() >= most.upper())
        bound += sqrt(sqr(n - most) + sqr(m[j])) * rho[j] + most * rho[j];
      else
        bound += sqrt(sqr(n) + sqr(m[j])) * rho[j] + w[j] * sqr(rho[j]);
    }
    return isBounded(bound) ? inflated(Interval(0.0), bound.upper()) : Interval::entire();
  }

  Interval rangeOf(const std::vector<double>& c, const Box& xi) {
    const bool isConstant = std::all_of(c.begin() + 1, c.end(), [](double each) { return each == 0; });
    return isConstant ? Interval(c[0]) : ranges_(c.data(), xi);
  }

  double valueAt(const std::vector<double>& c, const std::vector<double>& xi) const {
    double sum = 0;
    for (int g = 0; g < monomials_->count(); ++g) {
      double term = c[g];
      for (std::size_t l = 0; l < xi.size() && term != 0; ++l)
        for (int n = monomials_->exponent(g, static_cast<int>(l)); n > 0; --n) term *= xi[l];
      sum += term;
    }
    return sum;
  }

  const Embedding& embedding_;
  const std::shared_ptr<const Monomials> monomials_;
  FlowOutputs outputs_;
  PolynomialRange ranges_;
  const int first_;  // symbol of the circles
};

/// Of the box's components: those that circles stand for are where these are.
std::vector<double> valuesAt(const Program& g, const Circles& circles, double t, const Box& box,
                             const Embedding& embedding, const CircleFinder::Peak& peak) {
  std::vector<double> values;
  for (std::size_t i = 0; i < box.size(); ++i) {
    const Embedded& e = embedding.components[i];
    values.push_back(e.symbol >= 0 ? e.centre + e.half * peak.xi[at(e.symbol)] : midpoint(box[i]));
    values.back() = std::clamp(values.back(), box[i].lower(), box[i].upper());
  }
  constexpr double turn = 2 * std::numbers::pi;
  for (std::size_t k = 0; k < circles.all.size(); ++k) {
    const auto [angle, factor] = circles.all[k];
    const bool isBack = factor >= 0 && goAsFar(g, factor, t, box, true, values) < 0;
    if (angle >= std::ssize(box)) continue;  // a function of several
    const double middle = midpoint(box[angle]), wanted = peak.angles[k] + (isBack ? std::numbers::pi : 0),
                 nearest = wanted + turn * std::round((middle - wanted) / turn);
    values[angle] = std::clamp(nearest, box[angle].lower(), box[angle].upper());
    if (factor >= 0 && std::cos(values[angle] - nearest) < 0) goAsFar(g, factor, t, box, false, values);
  }
  return values;
}

}  // namespace

std::size_t countFarAngles(const Program& g, double t, const Box& box) { return circlesOf(g, t, box).all.size(); }

CircleImage imageByCircles(const Program& g, double t, const Box& box, const std::vector<Box>& levels, int degree,
                           const std::atomic<bool>* cancelled, const std::vector<int>& remainders) {
  const Circles circles = circlesOf(g, t, box);
  CircleImage image;
  if (circles.all.empty()) return image;
  const std::vector<double> radii = radiiOf(g, circles, t, box);
  if (!std::ranges::all_of(radii, [](double radius) { return std::isfinite(radius); })) return image;
  const Box whole = boxOf(circles, box, radii);
  const Embedding embedding(whole, 0, {}, {}, 0, remainders);
  const std::optional<int> chosen = degreeFor(embedding.symbols, degree);
  if (!chosen) return image;
  CircleFinder finder(circles, t, embedding, *chosen, cancelled);
  const std::size_t outputs = at(finder.outputs());
  image.angles = circles.all.size();
  image.areWhole = circles.areWhole;
  image.monomials = finder.monomials();
  image.polynomial.resize(outputs);
  image.radius.assign(outputs, std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (embedding.components[i].symbol >= 0) image.component.push_back(i < box.size() ? static_cast<int>(i) : -1);
  const std::vector<double> middle(at(embedding.symbols), 0.0), half(at(embedding.symbols), 1.0);
  for (std::size_t level = 0; level <= levels.size(); ++level) {
    const Box& within = level == 0 ? box : levels[level - 1];
    image.ranges.emplace_back(outputs, Interval::entire());
    image.extremes.emplace_back(outputs);
    std::vector<double> own = radiiOf(g, circles, t, within);
    std::vector<CircleReach> reach;
    for (std::size_t k = 0; k < own.size(); ++k) {
      const auto [angle, factor] = circles.all[k];
      own[k] = std::min(own[k], radii[k]);
      const Interval far = factor < 0 ? Interval(1.0) : rangesOf(g, {factor}, t, within)[0] / Interval(radii[k]);
      reach.push_back({intersection(far, Interval(-1.0, 1.0)), rangesOf(g, {angle}, t, within)[0]});
    }
    Box xi(at(embedding.symbols), Interval(-1.0, 1.0));
    if (!restrictTo(boxOf(circles, within, own), embedding, middle, half, xi)) continue;
    for (std::size_t o = 0; o < outputs; ++o) {
      if (cancelled != nullptr && *cancelled) return {};
      if (!finder.isKnown(static_cast<int>(o))) continue;
      CircleFinder::Found found = finder.over(static_cast<int>(o), xi, reach);
      image.ranges[level][o] = found.range;
      image.extremes[level][o] = {found.leastValue, found.greatestValue,
                                  valuesAt(g, circles, t, within, embedding, found.least),
                                  valuesAt(g, circles, t, within, embedding, found.greatest)};
      if (level > 0) continue;
      image.polynomial[o] = std::move(found.plain);
      image.radius[o] = magnitude(found.beside);
    }
  }
  return image;
}

std::optional<CircleImage> imageUnlessCancelled(const Program& g, double t, const Box& box,
                                                const std::vector<Box>& levels, int degree,
                                                const std::atomic<bool>* cancelled,
                                                const std::vector<int>& remainders) {
  try {
    return imageByCircles(g, t, box, levels, degree, cancelled, remainders);
  } catch (const Cancelled&) {
    return std::nullopt;
  }
}

}  // namespace gamut
