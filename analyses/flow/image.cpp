// The image of a box: outputs without motion, by the flow's polynomials.
#include <cmath>
#include <memory>

#include "analyses/flow/embedding.hpp"
#include "analyses/flow/flow.hpp"
#include "analyses/flow/outputs.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

/// Outputs of a box as polynomials in its symbols.
struct Image {
  /// Throws Cancelled.
  Image(const Program& g, double t, const Box& box, int degree, const std::atomic<bool>* cancelled)
      : embedding(box),
        weights(at(embedding.symbols), 1),
        monomials(std::make_shared<const Monomials>(
            weights, degree >= 1 && embedding.symbols > 0 ? degree : degreeLadder(weights).back())),
        outputs(g, monomials, monomials, {}, cancelled) {
    const int n = g.states(), N = monomials->count();
    FlowPoint point;
    point.p.assign(at(n * N), 0.0);
    point.low.assign(at(n), 0.0);
    point.psi.assign(at(n * n), 0.0);
    point.psiSum = point.psi;
    point.total.assign(at(n), 0.0);
    for (int i = 0; i < n; ++i) {
      const Embedded& e = embedding.components[at(i)];
      point.p[at(i * N)] = e.centre;
      if (e.symbol >= 0) point.p[at(i * N + monomials->linear(e.symbol))] = e.half;
      point.loose.push_back(e.radius);
    }
    point.radius = point.loose;
    point.ofR = point.total;
    point.beyond = point.known = point.total;
    outputs.evaluate(t, point, std::vector<double>(at(n), 0.0),
                     {embedding.components.begin() + n, embedding.components.end()});
  }
  FlowPart whole() const {
    return {std::vector<double>(at(embedding.symbols), 0.0), std::vector<double>(at(embedding.symbols), 1.0)};
  }

  Embedding embedding;
  std::vector<int> weights;
  std::shared_ptr<const Monomials> monomials;
  FlowOutputs outputs;
};

/// Throws Cancelled.
std::vector<std::vector<Interval>> image(const Program& g, double t, const Box& box, const std::vector<Box>& levels,
                                         int degree, const std::atomic<bool>* cancelled) {
  Image of(g, t, box, degree, cancelled);
  FlowOutputs& outputs = of.outputs;
  PlainOutputs plain(g);
  PolynomialRange range(of.monomials);
  std::vector<std::vector<Interval>> result;
  std::vector<Box> boxes = levels;
  boxes.insert(boxes.begin(), box);
  for (const Box& level : boxes) {
    Box xi(at(of.embedding.symbols), Interval(-1.0, 1.0));
    restrictTo(level, of.embedding, of.whole().centre, of.whole().half, xi);
    const std::vector<Interval> direct = plain.over(t, level);
    std::vector<Interval> row;
    for (int o = 0; o < outputs.count(); ++o) {
      if (cancelled != nullptr && *cancelled) throw Cancelled();
      Interval value = direct[at(o)];
      if (std::isfinite(outputs.radius(o))) {
        const Interval byPolynomial = inflated(range(outputs.polynomial(o), xi), outputs.radius(o));
        value = outputs.hasKinks() ? intersection(byPolynomial, value) : byPolynomial;
      }
      if (!result.empty()) value = intersection(value, result.back()[at(o)]);
      row.push_back(value);
    }
    result.push_back(std::move(row));
  }
  return result;
}

void requireImage(const Program& g, const Box& box, int degree) {
  requireThat(box.size() == at(g.states() + g.parameters()), "the box needs one interval a state and a parameter");
  requireThat(degree >= -1 && degree <= 40, "the degree of the polynomials must be 0 to 40 (-1: automatic)");
  requireNearest();
}

}  // namespace

std::vector<std::vector<Interval>> encloseImage(const Program& g, double t, const Box& box,
                                                const std::vector<Box>& levels, int degree,
                                                const std::atomic<bool>* cancelled) {
  requireImage(g, box, degree);
  requireNested(box, levels);
  try {
    return image(g, t, box, levels, degree, cancelled);
  } catch (const Cancelled&) {
    return {};
  }
}

std::shared_ptr<const FlowModels> modelImage(const Program& g, double t, const Box& box,
                                             const std::vector<int>& modelled, int degree,
                                             const std::atomic<bool>* cancelled) {
  requireImage(g, box, degree);
  requireNested(box, {});
  try {
    Image of(g, t, box, degree, cancelled);
    const std::vector<Interval> direct = PlainOutputs(g).over(t, box);
    auto snapshot = std::make_shared<FlowSnapshot>();
    snapshot->time = t;
    snapshot->part = of.whole();
    snapshot->monomials = of.monomials;
    for (const int o : modelled)
      snapshot->outputs.push_back(
          modelOf(of.outputs.polynomial(o), of.outputs.radius(o), *of.monomials, of.embedding.symbols, direct[at(o)]));
    auto models = std::make_shared<FlowModels>();
    for (const Embedded& e : of.embedding.components) models->components.push_back({e.centre, e.half, e.symbol});
    models->symbols = of.embedding.symbols;
    models->modelled = modelled.size();
    models->at = {{snapshot}};
    models->over.resize(1);
    return models;
  } catch (const Cancelled&) {
    return nullptr;
  }
}

}  // namespace gamut
