// The box is bisected where most is unknown of an output that is not known well enough. docs/flow.md, section 4.
#include "analyses/flow/image.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "analyses/flow/circles.hpp"
#include "analyses/flow/embedding.hpp"
#include "analyses/flow/flow.hpp"
#include "analyses/flow/outputs/outputs.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

using detail::at;

namespace {

// What bisection is for, and what it may cost.
constexpr double enough = 5e-4;        // of an output's width: twice the radius, on average over the box
constexpr double enoughAtEnds = 2e-3;  // likewise, where it is extreme
constexpr std::size_t mostImageParts = 256;
constexpr double mostImageNumbers = 1e7;  // coefficients that are kept
constexpr std::size_t mostTried = 4;      // symbols
constexpr double inVain = 0.95;           // of what was not known, is left after a bisection

/// Outputs on a part of the box, in its own η.
struct ImagePart {
  FlowPart part;
  Box box;
  std::vector<std::vector<double>> polynomial;  // [output]; empty where nothing is known but the range
  std::vector<double> radius;
  std::vector<Interval> range;
  std::vector<OutputExtremes> extremes;  // not known where polynomials are not
  double volume = 1;
  bool isFinal = false;
};

std::shared_ptr<const Monomials> monomialsOf(int symbols, int degree) {
  std::vector<int> weights(symbols, 1);
  const int chosen = degree >= 1 && symbols > 0 ? degree : degreeLadder(weights).back();
  return Monomials::of(std::move(weights), chosen);
}

/// Throws Cancelled.
class ImageFinder {
 public:
  ImageFinder(const Program& g, double t, const Box& box, int degree, const std::atomic<bool>* cancelled,
              const std::vector<int>& remainders, const Program* plain = nullptr)
      : t_(t),
        box_(box),
        remainders_(remainders),
        isPlainApart_(plain != nullptr),
        embedding_(box, 0, {}, {}, 0, remainders),
        monomials_(monomialsOf(embedding_.symbols, degree)),
        outputs_(g, monomials_, monomials_, {}, cancelled),
        plain_(plain != nullptr ? *plain : g),
        ranges_(monomials_),
        cancelled_(cancelled),
        states_(g.states()),
        workOfPart_(static_cast<double>(monomials_->pairs().size() + 64) * static_cast<double>(g.nodes().size() + 1)) {
    parts_.push_back(on({std::vector<double>(embedding_.symbols, 0.0), std::vector<double>(embedding_.symbols, 1.0)}));
  }

  const Embedding& embedding() const { return embedding_; }
  const std::shared_ptr<const Monomials>& monomials() const { return monomials_; }
  const std::vector<ImagePart>& parts() const { return parts_; }

  /// Of the output of which most is unknown, as bisection measures it.
  double unknown(const std::vector<int>& counted) {
    measureWidths(counted);
    double most = 0;
    for (const int o : counted) {
      double all = 0;
      for (const ImagePart& part : parts_) all += part.volume * unknownOf(part, o);
      most = std::max(most, all);
    }
    return most;
  }

  /// Until these outputs are known well enough, or it costs so much.
  void bisect(const std::vector<int>& counted, double work) {
    if (embedding_.symbols == 0 || counted.empty()) return;
    const double numbers = static_cast<double>(outputs_.count()) * monomials_->count();
    const auto most = std::min(mostImageParts, static_cast<std::size_t>(mostImageNumbers / numbers));
    while (parts_.size() < most && work_ < work) {
      measureWidths(counted);
      const std::size_t worst = worstOf(counted);
      if (worst == parts_.size()) break;
      std::vector<ImagePart> halves = bestHalves(parts_[worst], counted, work);
      if (halves.empty()) {
        parts_[worst].isFinal = true;
        continue;
      }
      parts_[worst] = std::move(halves[0]);
      parts_.push_back(std::move(halves[1]));
    }
    std::ranges::sort(parts_, {}, [](const ImagePart& part) { return part.part.centre; });
  }

  /// Over the box.
  std::vector<OutputExtremes> extremes() const {
    std::vector<OutputExtremes> result(outputs_.count());
    for (const ImagePart& part : parts_)
      for (std::size_t o = 0; o < result.size(); ++o) result[o].join(part.extremes[o]);
    return result;
  }

  /// Over the box, then over each level.
  std::vector<std::vector<Interval>> ranges(const std::vector<Box>& levels) {
    std::vector<std::vector<Interval>> result(1, std::vector<Interval>(outputs_.count(), Interval::empty()));
    for (const ImagePart& part : parts_) join(result[0], part.range);
    for (const Box& level : levels) {
      std::vector<Interval> row(outputs_.count(), Interval::empty());
      for (const ImagePart& part : parts_) {
        Box xi(at(embedding_.symbols), Interval(-1.0, 1.0)), own = part.box;
        if (!restrictTo(level, embedding_, part.part.centre, part.part.half, xi)) continue;
        for (std::size_t i = 0; i < own.size(); ++i)
          if (const Interval both = intersection(own[i], level[i]); !isEmpty(both)) own[i] = both;
        for (const int i : remainders_) own[at(i)] = level[at(i)];
        join(row, rangesOf(part, xi, parts_.size() == 1 ? level : own));
      }
      for (std::size_t o = 0; o < row.size(); ++o) row[o] = intersection(row[o], result.back()[o]);
      result.push_back(std::move(row));
    }
    return result;
  }

 private:
  static void join(std::vector<Interval>& into, const std::vector<Interval>& other) {
    for (std::size_t o = 0; o < into.size(); ++o) into[o] = hull(into[o], other[o]);
  }

  /// centre + half ξ with ξ = c + h η is centre + half c + (half h) η, of which the first is rounded twice; h is a
  /// power of two.
  Embedded embeddedOn(const Embedded& e, const FlowPart& part) const {
    if (e.symbol < 0 || part.half[e.symbol] == 1) return e;
    Embedded own = e;
    const double moved = e.half * part.centre[e.symbol];
    own.centre = e.centre + moved;
    own.half = e.half * part.half[e.symbol];
    own.radius = (e.radius + bounds::unit * (std::fabs(moved) + std::fabs(own.centre))) * bounds::up + bounds::tiny;
    return own;
  }

  ImagePart on(FlowPart where) {
    if (cancelled_ != nullptr && *cancelled_) throw Cancelled();
    work_ += workOfPart_;
    ImagePart found{std::move(where), box_, {}, {}, {}, {}};
    for (const double half : found.part.half) found.volume *= half;
    const int n = states_, N = monomials_->count();
    FlowPoint point;
    point.p.assign(n * N, 0.0);
    point.low.assign(n, 0.0);
    point.psi.assign(n * n, 0.0);
    point.psiSum = point.psi;
    point.total.assign(n, 0.0);
    std::vector<Embedded> parameters;
    for (std::size_t i = 0; i < box_.size(); ++i) {
      const Embedded e = embeddedOn(embedding_.components[i], found.part);
      if (e.symbol >= 0 && found.part.half[e.symbol] < 1) found.box[i] = intersection(rangeOf(e), box_[i]);
      if (i >= at(n)) {
        parameters.push_back(e);
        continue;
      }
      point.p[i * at(N)] = e.centre;
      if (e.symbol >= 0) point.p[i * at(N) + at(monomials_->linear(e.symbol))] = e.half;
      point.loose.push_back(e.radius);
    }
    point.radius = point.loose;
    point.ofR = point.total;
    point.beyond = point.known = point.total;
    outputs_.evaluate(t_, point, std::vector<double>(n, 0.0), parameters);
    for (int o = 0; o < outputs_.count(); ++o) {
      found.radius.push_back(outputs_.radius(o));
      found.polynomial.emplace_back();
      if (std::isfinite(outputs_.radius(o)))
        found.polynomial.back().assign(outputs_.polynomial(o), outputs_.polynomial(o) + N);
    }
    found.extremes.resize(outputs_.count());
    found.range = rangesOf(found, Box(at(embedding_.symbols), Interval(-1.0, 1.0)), found.box, &found.extremes);
    return found;
  }

  /// By polynomials over a part of η, and by plain intervals over a box that holds it: these know more of what has
  /// kinks, and of small parts.
  std::vector<Interval> rangesOf(const ImagePart& part, const Box& eta, const Box& box,
                                 std::vector<OutputExtremes>* extremes = nullptr) {
    std::vector<Interval> found = plain_.over(t_, box);
    const bool isWhole = part.volume == 1;
    for (std::size_t o = 0; o < found.size(); ++o) {
      if (cancelled_ != nullptr && *cancelled_) throw Cancelled();
      if (part.polynomial[o].empty()) continue;
      const Interval byPolynomial = inflated(ranges_(part.polynomial[o].data(), eta), part.radius[o]);
      if (extremes != nullptr) (*extremes)[o] = extremesOf(ranges_, box_, embedding_, part.part.centre, part.part.half);
      found[o] = outputs_.hasKinks() || !isWhole || isPlainApart_ ? intersection(byPolynomial, found[o]) : byPolynomial;
    }
    return found;
  }

  // ---- Bisection ----------------------------------------------------------------------------------------------------

  void measureWidths(const std::vector<int>& counted) {
    whole_.assign(outputs_.count(), Interval::empty());
    for (const ImagePart& part : parts_)
      for (const int o : counted) whole_[o] = hull(whole_[o], part.range[o]);
  }

  /// Of an output on a part: twice what the polynomial may be off by, beside the width of the output over the box; 1 at
  /// most.
  double unknownOf(const ImagePart& part, int output) const {
    const Interval& whole = whole_[output];
    const double own = part.polynomial[output].empty() ? width(part.range[output])
                                                       : std::min(2 * part.radius[output], width(part.range[output]));
    if (!(own > rounding * magnitude(whole))) return 0;
    return isBounded(whole) ? std::min(1.0, own / width(whole)) : 1;
  }
  static constexpr double rounding = 1e-12;

  bool isExtreme(const ImagePart& part, int output) const {
    const Interval &whole = whole_[output], &own = part.range[output];
    return own.lower() <= whole.lower() || own.upper() >= whole.upper();
  }

  /// Where most is unknown of an output that is not known well enough; the number of parts if all are.
  std::size_t worstOf(const std::vector<int>& counted) const {
    std::size_t worst = parts_.size();
    double most = 0;
    for (const int o : counted) {
      double all = 0;
      for (const ImagePart& part : parts_) all += part.volume * unknownOf(part, o);
      for (std::size_t i = 0; i < parts_.size(); ++i) {
        if (parts_[i].isFinal) continue;
        const double unknown = unknownOf(parts_[i], o);
        double key = all > enough ? parts_[i].volume * unknown / enough : 0;
        if (unknown > enoughAtEnds && isExtreme(parts_[i], o)) key = std::max(key, 0.01 * unknown / enoughAtEnds);
        if (key > most) most = key, worst = i;
      }
    }
    return worst;
  }

  double unknownOfAll(const ImagePart& part, const std::vector<int>& counted) const {
    double sum = 0;
    for (const int o : counted) sum += unknownOf(part, o);
    return sum;
  }

  /// Symbols with most in nonlinear terms, then in any.
  std::vector<std::size_t> likelySymbols(const ImagePart& part, const std::vector<int>& counted) const {
    constexpr double linear = 1e-3;
    std::vector<double> weight(embedding_.symbols, 0.0);
    for (const int o : counted) {
      const double unknown = unknownOf(part, o), size = width(whole_[o]);
      const std::vector<double>& c = part.polynomial[o];
      for (std::size_t l = 0; l < weight.size(); ++l) weight[l] += 1e-6 * unknown * part.part.half[l];
      for (int g = 1; g < static_cast<int>(c.size()) && unknown > 0 && size > 0; ++g)
        for (std::size_t l = 0; l < weight.size(); ++l)
          if (const int power = monomials_->exponent(g, static_cast<int>(l)); power > 0)
            weight[l] += unknown * power * (monomials_->grade(g) > 1 ? 1.0 : linear) * std::fabs(c[g]) / size;
    }
    std::vector<std::size_t> order(weight.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t l) { return weight[l]; });
    while (!order.empty() && !(weight[order.back()] > 0)) order.pop_back();
    return order;
  }

  /// In the symbol whose halves leave least unknown; none where that is as much as before.
  std::vector<ImagePart> bestHalves(const ImagePart& part, const std::vector<int>& counted, double work) {
    constexpr double finest = 1.0 / 1024;  // of the box: distributions are cut into 4096 bins
    std::vector<ImagePart> best;
    const double before = 2 * unknownOfAll(part, counted);
    double least = inVain * before;
    std::size_t tried = 0;
    for (const std::size_t l : likelySymbols(part, counted)) {
      if (part.part.half[l] <= finest) continue;
      if (++tried > mostTried || work_ > work) break;
      std::vector<ImagePart> halves;
      double left = 0;
      for (const double side : {-0.5, 0.5}) {
        FlowPart half = part.part;
        half.centre[l] += side * half.half[l];
        half.half[l] *= 0.5;
        halves.push_back(on(std::move(half)));
        left += unknownOfAll(halves.back(), counted);
      }
      if (!(left < least)) continue;
      least = left;
      best = std::move(halves);
    }
    return best;
  }

  const double t_;
  const Box& box_;
  const std::vector<int> remainders_;
  const bool isPlainApart_;
  const Embedding embedding_;
  const std::shared_ptr<const Monomials> monomials_;
  FlowOutputs outputs_;
  PlainOutputs plain_;
  PolynomialRange ranges_;
  const std::atomic<bool>* cancelled_;
  const int states_;
  const double workOfPart_;
  double work_ = 0;
  std::vector<ImagePart> parts_;
  std::vector<Interval> whole_;  // [output]
};

void requireImage(const Program& g, const Box& box, int degree) {
  requireThat(box.size() == at(g.states() + g.parameters()), "the box needs one interval a state and a parameter");
  requireThat(degree >= -1 && degree <= 40, "the degree of the polynomials must be 0 to 40 (-1: automatic)");
  requireNearest();
}

/// The next degree, for many symbols, which are hardly bisected: nothing is integrated, so that terms are cheap. 0:
/// there are too many.
int richerDegree(const Monomials& monomials) {
  constexpr double most = 6000;
  constexpr int fewSymbols = 3;
  double count = 1;
  for (int i = 1; i <= monomials.degree() + 1; ++i) count *= static_cast<double>(monomials.symbols() + i) / i;
  return monomials.symbols() > fewSymbols && count <= most ? monomials.degree() + 1 : 0;
}

/// By what is known of angles that go far round.
void narrow(Image& image, const CircleImage& circles) {
  for (std::size_t row = 0; row < circles.ranges.size(); ++row)
    for (std::size_t o = 0; o < circles.ranges[row].size(); ++o) {
      Interval& range = image.ranges[row][o];
      const bool isNarrower = width(circles.ranges[row][o]) < width(range);
      if (row == 0 && isNarrower) image.extremes[o] = circles.extremes[row][o];
      range = intersection(range, circles.ranges[row][o]);
      if (row > 0) range = intersection(range, image.ranges[row - 1][o]);
    }
  if (!circles.extremes.empty()) image.levelExtremes.assign(circles.extremes.begin() + 1, circles.extremes.end());
}

bool areAllKnown(const CircleImage& circles) {
  return !circles.ranges.empty() && std::ranges::all_of(circles.radius, [](double r) { return std::isfinite(r); });
}

/// The polynomial of an output in other monomials, in which each component of the box has the symbol that it has there;
/// what these do not hold counts in the radius.
std::vector<double> movedTo(const Monomials& monomials, const Embedding& embedding, const CircleImage& circles,
                            int output, double& radius) {
  std::vector<double> moved(at(monomials.count()), 0.0);
  double left = 0;
  for (int g = 0; g < circles.monomials->count(); ++g) {
    const double c = circles.polynomial[output][g];
    int place = 0;
    for (std::size_t l = 0; l < circles.component.size() && c != 0; ++l)
      for (int n = circles.monomials->exponent(g, static_cast<int>(l)); n > 0 && place >= 0; --n)
        place = monomials.shifted(place, embedding.components[circles.component[l]].symbol, 1);
    if (place < 0)
      left += std::fabs(c);
    else
      moved[place] += c;
  }
  radius = (radius + left * bounds::up) * bounds::up;
  return moved;
}

std::shared_ptr<FlowModels> modelsIn(const Embedding& embedding, std::size_t modelled) {
  auto models = std::make_shared<FlowModels>();
  models->at.resize(1);
  models->over.resize(1);
  for (const Embedded& e : embedding.components) models->components.push_back({e.centre, e.half, e.symbol});
  models->symbols = embedding.symbols;
  models->modelled = modelled;
  return models;
}

/// `ranges`: of all outputs, over the whole box.
std::shared_ptr<const FlowModels> modelsOf(const ImageFinder& image, double t, const std::vector<int>& modelled,
                                           const std::vector<Interval>& ranges) {
  const auto models = modelsIn(image.embedding(), modelled.size());
  for (const ImagePart& part : image.parts()) {
    auto snapshot = std::make_shared<FlowSnapshot>();
    snapshot->time = t;
    snapshot->part = part.part;
    snapshot->monomials = image.monomials();
    for (const int o : modelled) {
      const Interval bound = intersection(part.range[o], ranges[o]);
      snapshot->outputs.push_back(part.polynomial[o].empty() ? OutputModel{{}, part.radius[o], bound}
                                                             : modelOf(part.polynomial[o].data(), part.radius[o],
                                                                       *image.monomials(), models->symbols, bound));
    }
    models->at[0].push_back(std::move(snapshot));
  }
  return models;
}

/// Of far angles models know nothing but how far they move outputs.
Image imageOf(const CircleImage& circles, const Embedding& embedding, double t, const std::vector<int>& modelled) {
  Image image{circles.ranges, nullptr, circles.extremes[0], {}, 1};
  narrow(image, circles);
  if (modelled.empty()) return image;
  constexpr double mostMonomials = 8000;
  const std::vector<int> weights(at(embedding.symbols), 1);
  int degree = circles.monomials->degree();
  while (degree > 1 && countOfMonomials(weights, degree) > mostMonomials) --degree;
  auto snapshot = std::make_shared<FlowSnapshot>();
  snapshot->time = t;
  snapshot->part = {std::vector<double>(weights.size(), 0.0), std::vector<double>(weights.size(), 1.0)};
  const auto monomials = Monomials::of(weights, degree);
  snapshot->monomials = monomials;
  for (const int o : modelled) {
    double radius = circles.radius[o];
    const std::vector<double> polynomial = movedTo(*monomials, embedding, circles, o, radius);
    snapshot->outputs.push_back(modelOf(polynomial.data(), radius, *monomials, embedding.symbols, image.ranges[0][o]));
  }
  const auto models = modelsIn(embedding, modelled.size());
  models->at[0].push_back(std::move(snapshot));
  image.models = models;
  return image;
}

}  // namespace

Image findImage(const Program& g, double t, const Box& box, const std::vector<Box>& levels,
                const std::vector<int>& modelled, int degree, const std::atomic<bool>* cancelled, double work,
                const std::vector<int>& remainders, const Program* plain) {
  requireImage(g, box, degree);
  std::vector<Box> parts = levels;
  for (Box& part : parts)
    for (const int i : remainders) part.at(at(i)) = box.at(at(i));
  requireNested(box, parts);
  try {
    std::vector<int> counted = modelled;
    for (int o = 0; o < g.outputs(); ++o)
      if (modelled.empty()) counted.push_back(o);
    const CircleImage circles = imageByCircles(g, t, box, levels, degree, cancelled, remainders);
    constexpr int many = 8, few = 2;  // of so many symbols, or beyond so many of them, far angles are bisected in vain
    if (const Embedding embedding(box, 0, {}, {}, 0, remainders);
        circles.areWhole && (circles.angles > few || embedding.symbols > many) && areAllKnown(circles))
      return imageOf(circles, embedding, t, modelled);
    auto found = std::make_unique<ImageFinder>(g, t, box, degree, cancelled, remainders, plain);
    const double unknown = found->unknown(counted);
    if (const int richer = richerDegree(*found->monomials()); degree < 0 && work > 0 && richer > 0 && unknown > enough)
      if (auto other = std::make_unique<ImageFinder>(g, t, box, richer, cancelled, remainders, plain);
          other->unknown(counted) < unknown)
        found = std::move(other);
    ImageFinder& finder = *found;
    finder.bisect(counted, work);
    Image image{finder.ranges(levels), nullptr, finder.extremes(), {}, finder.parts().size()};
    narrow(image, circles);
    if (!modelled.empty()) image.models = modelsOf(finder, t, modelled, image.ranges[0]);
    return image;
  } catch (const Cancelled&) {
    return {};
  }
}

/// Nothing of them is proved, so that all are computed together, however many there are.
Program recordPolynomials(const Program& g, const Box& box, int degree) {
  constexpr double small = 1e-5;  // of the largest coefficient of what varies
  requireImage(g, box, degree);
  requireThat(g.states() == 0, "polynomials are recorded of programs without states");
  const Embedding embedding(box, 0, {}, {}, 0, {});
  const auto layout = monomialsOf(embedding.symbols, degree);
  const Monomials& monomials = *layout;
  PolynomialSeries series(g, g.outputs(), layout, 0, 1, false);
  for (std::size_t i = 0; i < box.size(); ++i) series.setParameter(static_cast<int>(i), embedding.components[i]);
  series.compute(0.0, 1.0);
  std::vector<std::vector<double>> polynomial;
  double largest = 0;
  for (int o = 0; o < g.outputs(); ++o) {
    std::vector<double>& own = polynomial.emplace_back();
    for (int m = 0; m < monomials.count(); ++m) {
      own.push_back(series.series(series.outputNode(o))[m * series.stride()]);
      if (!std::isfinite(own.back())) return g;
      if (m > 0) largest = std::max(largest, std::fabs(own.back()));
    }
  }
  return record(0, g.parameters(), g.outputs(), [&](auto, const auto&, const auto& p, auto& y) {
    std::vector<Recorded> xi(embedding.symbols, Recorded(0.0));
    for (std::size_t i = 0; i < box.size(); ++i)
      if (const Embedded& e = embedding.components[i]; e.symbol >= 0) xi[e.symbol] = (p[i] - e.centre) / e.half;
    std::vector<Recorded> powers{Recorded(1.0)};
    for (int m = 1; m < monomials.count(); ++m) {
      int factor = 0;
      while (monomials.exponent(m, factor) == 0) ++factor;
      powers.push_back(powers[monomials.shifted(m, factor, -1)] * xi[factor]);
    }
    for (std::size_t o = 0; o < polynomial.size(); ++o) {
      Recorded sum(polynomial[o][0]);
      for (int m = 1; m < monomials.count(); ++m)
        if (std::fabs(polynomial[o][m]) > small * largest) sum = sum + polynomial[o][m] * powers[m];
      y[o] = sum;
    }
  });
}

std::vector<std::vector<Interval>> encloseImage(const Program& g, double t, const Box& box,
                                                const std::vector<Box>& levels, int degree,
                                                const std::atomic<bool>* cancelled,
                                                const std::vector<int>& remainders) {
  return findImage(g, t, box, levels, {}, degree, cancelled, 0, remainders).ranges;
}

std::shared_ptr<const FlowModels> modelImage(const Program& g, double t, const Box& box,
                                             const std::vector<int>& modelled, int degree,
                                             const std::atomic<bool>* cancelled, const std::vector<int>& remainders) {
  return findImage(g, t, box, {}, modelled, degree, cancelled, imageWork, remainders).models;
}

}  // namespace gamut
