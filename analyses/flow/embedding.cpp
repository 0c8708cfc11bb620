// Boxes in symbols.
#include "analyses/flow/embedding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "scalars/elementary/double_double.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

Embedding::Embedding(const Box& box, int states, const std::vector<VaryingParameter>& inputs,
                     const std::vector<int>& weights, int dependent, const std::vector<int>& remainders) {
  std::size_t wide = 0;
  for (const Interval& value : box) {
    const int parameter = static_cast<int>(components.size()) - states;
    const bool isDependent = (parameter < 0 && parameter >= -dependent) ||
                             std::ranges::find(remainders, static_cast<int>(components.size())) != remainders.end();
    const bool isInput = std::ranges::find(inputs, parameter, &VaryingParameter::parameter) != inputs.end();
    Embedded e;
    e.centre = midpoint(value);
    e.radius = isThin(value) ? 0.0 : radius(value);
    // Widths of the order of rounding are carried by the remainder; wider ones get a symbol.
    if (!isInput && !isDependent && e.radius > 1e-13 * std::fabs(e.centre) &&
        (weights.empty() || weights[wide++] > 0)) {
      e.half = e.radius;
      e.radius = 0;
      e.symbol = symbols++;
      widest = std::max(widest, e.half < std::fabs(e.centre) ? e.half / std::fabs(e.centre) : 1.0);
    }
    components.push_back(e);
  }
}

void Embedding::takeDigitsOf(const std::vector<PreciseValue>& values) {
  for (const PreciseValue& value : values) {
    const auto [high, low] = detail::exactSum(value.high, value.low);
    components[value.component] = {high, 0, value.radius, -1, low};
  }
}

bool restrictTo(const Box& level, const Embedding& embedding, const std::vector<double>& centre,
                const std::vector<double>& half, Box& xi) {
  for (std::size_t i = 0; i < level.size(); ++i) {
    const Embedded& e = embedding.components[i];
    if (e.symbol < 0) continue;
    const Interval study = (level[i] - Interval(e.centre)) / Interval(e.half);
    const Interval own = (study - Interval(centre[e.symbol])) / Interval(half[e.symbol]);
    const Interval part = intersection(own, Interval(-1.0, 1.0));
    if (isEmpty(part)) return false;
    xi[e.symbol] = part;
  }
  return true;
}

OutputExtremes extremesOf(const PolynomialRange& range, const Box& box, const Embedding& embedding,
                          const std::vector<double>& centre, const std::vector<double>& half) {
  const auto valuesAt = [&](const std::vector<double>& xi) {
    std::vector<double> values;
    for (std::size_t i = 0; i < box.size(); ++i) {
      const Embedded& e = embedding.components[i];
      double value = midpoint(box[i]);
      if (const auto l = static_cast<std::size_t>(e.symbol); e.symbol >= 0)
        value = std::clamp(e.centre + e.half * (centre[l] + half[l] * xi[l]), box[i].lower(), box[i].upper());
      values.push_back(value);
    }
    return values;
  };
  return {range.least().value, range.greatest().value, valuesAt(range.least().xi), valuesAt(range.greatest().xi)};
}

double countOfMonomials(const std::vector<int>& weights, int degree) {
  std::vector<double> count(degree + 1, 0.0);  // of each grade
  count[0] = 1;
  for (const int weight : weights)
    for (int grade = std::min(weight, degree); grade <= degree; ++grade)
      count[grade] += count[grade - std::min(weight, degree)];
  return std::accumulate(count.begin(), count.end(), 0.0);
}

std::vector<int> degreeLadder(const std::vector<int>& weights, int fixedDegree) {
  if (weights.empty()) return {0};
  static constexpr int highest[] = {16, 16, 12, 10};
  constexpr double mostMonomials = 2000, mostOfFixed = 8100;
  const auto active = std::ranges::count(weights, 1);
  std::vector<int> ladder;
  for (int degree : {2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 16}) {
    if (fixedDegree > 0 && degree > fixedDegree) break;
    if (countOfMonomials(weights, degree) > (fixedDegree > 0 ? mostOfFixed : mostMonomials)) break;
    if (active > 3 || (degree % 2 == 0 && degree <= highest[active])) ladder.push_back(degree);
  }
  if (ladder.empty()) ladder.push_back(1);
  return ladder;
}

bool Emphasis::isUniform() const { return std::ranges::count(weights, 1) == std::ssize(weights); }

void measureInfluence(const double* polynomial, const Monomials& m, std::vector<Influence>& influence) {
  const int symbols = static_cast<int>(influence.size());
  std::vector<Influence> mass(influence.size());
  double all = 0;
  for (int g = 1; g < m.count(); ++g) {
    const double size = std::fabs(polynomial[g]);
    if (size == 0) continue;
    all += size;
    for (int l = 0; l < symbols; ++l)
      if (m.exponent(g, l) > 0) {
        mass[l].any += size;
        if (g != m.linear(l)) mass[l].nonlinear += size;
      }
  }
  if (!(all > 0)) return;
  for (std::size_t l = 0; l < mass.size(); ++l) {
    influence[l].any = std::max(influence[l].any, mass[l].any / all);
    influence[l].nonlinear = std::max(influence[l].nonlinear, mass[l].nonlinear / all);
  }
}

Emphasis emphasisOf(const std::vector<Influence>& influence, double negligible, double share) {
  double greatest = 0;
  for (const Influence& of : influence) greatest = std::max(greatest, of.nonlinear);
  Emphasis emphasis{std::vector<int>(influence.size(), 1), 0};
  std::vector<int>& weights = emphasis.weights;
  std::vector<int> order(influence.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int l) { return influence[l].any; });
  const double ratio = std::log(std::clamp(greatest, 0.02, 0.1));
  double carried = 0, squares = 0;
  if (!std::ranges::any_of(influence, [](const Influence& of) { return of.any > 0; }))
    order.clear();  // nothing is known
  for (const int l : order) {
    const Influence& of = influence[l];
    squares += of.any * of.any;
    if (carried += of.any; carried <= 5 * negligible * share) {
      weights[l] = 0;
    } else if (of.nonlinear < negligible * greatest) {
      const double grades = of.nonlinear > 0 ? std::log(of.nonlinear / greatest) / ratio : mostWeight;
      weights[l] = static_cast<int>(std::clamp(1.3 + grades, 1.0, static_cast<double>(mostWeight)));
    }
  }
  emphasis.effective = squares > 0 ? carried * carried / squares : static_cast<double>(influence.size());
  return emphasis;
}

int frameDegreeOfFixed(const std::vector<int>& weights, int degree) {
  constexpr double most = 350;
  int frame = std::min(4, degree);
  while (frame > 1 && countOfMonomials(weights, frame) > most) --frame;
  return frame;
}

int automaticFrameDegree(int symbols, int degree) {
  return std::min(degree, symbols == 1 ? 4 : symbols <= 3 ? 2 : symbols <= 8 ? 3 : 1);
}

FlowSet startOf(const Embedding& embedding, int n, const Monomials& monomials, int frameDegree) {
  FlowSet s;
  const int N = monomials.count();
  s.powers = at(monomials.countUpTo(frameDegree));
  s.p.assign(n * N, 0.0);
  s.C.assign(n * n, 0.0);
  s.R.assign(n, 0.0);
  s.W.assign(n, 0.0);
  for (int i = 0; i < n; ++i) {
    const Embedded& e = embedding.components[i];
    s.p[i * N] = e.centre;
    if (e.symbol >= 0) s.p[i * N + monomials.linear(e.symbol)] = e.half;
    s.R[i] = e.coarseRadius();
    s.C[i * n + i] = 1.0;
  }
  s.parameters.assign(embedding.components.begin() + n, embedding.components.end());
  s.centre.assign(embedding.symbols, 0.0);
  s.half.assign(embedding.symbols, 1.0);
  return s;
}

void requireThat(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument(what);
}

void requireNested(const Box& box, const std::vector<Box>& levels) {
  for (const Interval& value : box)
    requireThat(!isEmpty(value) && isBounded(value), "every interval of the box must be bounded");
  const Box* outer = &box;
  for (const Box& level : levels) {
    requireThat(level.size() == box.size(), "a sub-box needs as many components as the box");
    for (std::size_t i = 0; i < level.size(); ++i)
      requireThat(!isEmpty(level[i]) && isSubset(level[i], (*outer)[i]),
                  "sub-boxes must lie inside the box, each inside the one before");
    outer = &level;
  }
}

void requireNearest() {
  if (!detail::isArithmeticNearest())
    throw std::runtime_error(
        "the flow's bounds need rounding to nearest and subnormal numbers: restore the floating-point environment");
}

}  // namespace gamut
