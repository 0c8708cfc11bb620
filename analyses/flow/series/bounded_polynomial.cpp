// Sums and products in round-to-nearest, and what they miss.
#include "analyses/flow/series/bounded_polynomial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "analyses/flow/series/embedded.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/series/polynomial_series.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

double BoundedPolynomial::variation() const {
  double sum = 0;
  for (std::size_t g = 1; g < c.size(); ++g) sum += std::fabs(c[g]);
  return sum * bounds::up;
}

double BoundedPolynomial::norm() const {
  return ((c.empty() ? 0.0 : std::fabs(c[0])) + variation() + error) * bounds::up;
}

BoundedPolynomial& BoundedPolynomial::operator+=(const BoundedPolynomial& other) {
  if (c.size() < other.c.size()) c.resize(other.c.size(), 0.0);
  double rounding = 0;
  for (std::size_t g = 0; g < other.c.size(); ++g) {
    c[g] += other.c[g];
    rounding += bounds::unit * std::fabs(c[g]);
  }
  error = (error + other.error + rounding) * bounds::up;
  return *this;
}

BoundedPolynomial& BoundedPolynomial::operator*=(double factor) {
  double rounding = 0;
  for (double& coefficient : c) {
    coefficient *= factor;
    rounding += bounds::unit * std::fabs(coefficient);
  }
  error = (error * std::fabs(factor) + rounding) * bounds::up + bounds::tiny;
  return *this;
}

Interval rangeOf(const Monomials& monomials, const BoundedPolynomial& a) {
  Interval sum = Interval(a.c.empty() ? 0.0 : a.c[0]) + Interval(-a.error, a.error);
  for (std::size_t g = 1; g < a.c.size(); ++g) {
    bool isSquare = true;
    for (int l = 0; l < monomials.symbols(); ++l)
      isSquare = isSquare && monomials.exponent(static_cast<int>(g), l) % 2 == 0;
    sum += Interval(a.c[g]) * Interval(isSquare ? 0.0 : -1.0, 1.0);
  }
  return sum;
}

/// A coefficient of N products has 2N roundings at most, in whatever order they are added. Dropped are the products
/// whose grades add up to more than the degree.
BoundedPolynomial product(const Monomials& monomials, const BoundedPolynomial& a, const BoundedPolynomial& b) {
  BoundedPolynomial result{std::vector<double>(monomials.count(), 0.0)};
  const auto padded = [&](const BoundedPolynomial& x) {
    std::vector<double> c = x.c;
    c.resize(result.c.size(), 0.0);
    return c;
  };
  const std::vector<double> ofA = padded(a), ofB = padded(b);
  const Monomials::Pair* const pairs = monomials.pairs().data();
  double rounding = 0, dropped = 0;
  constexpr std::size_t together = 4;  // sums, since each waits for itself
  for (int g = 0; g < monomials.count(); ++g) {
    std::array<double, together> sums{}, sizes{};
    const auto add = [&](std::size_t to, std::int32_t q) {
      const double term = ofA[pairs[q].a] * ofB[pairs[q].b];
      sums[to] += term;
      sizes[to] += std::fabs(term);
    };
    auto q = monomials.first()[g];
    const auto end = monomials.first()[at(g) + 1];
    for (; q + static_cast<std::int32_t>(together) <= end; q += static_cast<std::int32_t>(together))
      for (std::size_t k = 0; k < together; ++k) add(k, q + static_cast<std::int32_t>(k));
    for (; q < end; ++q) add(0, q);
    result.c[g] = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    rounding += 2 * monomials.multiplicity(g) * bounds::unit * ((sizes[0] + sizes[1]) + (sizes[2] + sizes[3]));
  }
  std::vector<double> gradesOfA(at(monomials.degree()) + 1, 0.0), gradesOfB = gradesOfA;
  for (std::size_t g = 0; g < a.c.size(); ++g) gradesOfA[monomials.grade(static_cast<int>(g))] += std::fabs(a.c[g]);
  for (std::size_t g = 0; g < b.c.size(); ++g) gradesOfB[monomials.grade(static_cast<int>(g))] += std::fabs(b.c[g]);
  for (std::size_t p = 0; p < gradesOfA.size(); ++p)
    for (std::size_t q = gradesOfA.size() - p; q < gradesOfB.size(); ++q) dropped += gradesOfA[p] * gradesOfB[q];
  const double errors = a.error * b.norm() + b.error * a.norm();
  result.error = (errors + dropped + rounding) * bounds::up + bounds::tiny;
  return result;
}

BoundedPolynomial composed(const Monomials& monomials, const std::vector<BoundedPolynomial>& a,
                           const BoundedPolynomial& x) {
  BoundedPolynomial result;
  for (auto term = a.rbegin(); term != a.rend(); ++term) {
    if (!result.c.empty()) result = product(monomials, result, x);
    result += *term;
  }
  return result;
}

/// With x = c + δ, |δ| ≤ d: Σ_k v_k δ^k, v_k = Σ_{i≥k} C(i, k) c^(i-k) a_i, of norm n_k at most. What is cut off is
/// less than Σ_{k≥K} n_k d^k, and s as far from x as `around` makes of it `around` Σ_k k n_k (d + around)^(k-1) more. A
/// weight has 3(i - k) roundings, its product with a coefficient one, a sum as many as it has terms.
BoundedPolynomial composedNear(const Monomials& monomials, const std::vector<BoundedPolynomial>& a,
                               const BoundedPolynomial& x, double around, double little) {
  const std::size_t orders = a.size();
  BoundedPolynomial beside = x;
  const double c = std::exchange(beside.c[0], 0.0), d = (x.variation() + x.error) * bounds::up;
  const auto weights = [&](std::size_t k, double by) {  // of a_k, a_{k+1}, …
    std::vector<double> result{1.0};
    for (std::size_t i = k + 1; i < orders; ++i)
      result.push_back(result.back() * by * (static_cast<double>(i) / static_cast<double>(i - k)));
    return result;
  };
  std::vector<double> norms, most(orders, 0.0);  // of a; of v, but for roundings
  for (const BoundedPolynomial& term : a) norms.push_back(term.norm());
  double varies = 0, power = 1;
  for (std::size_t i = 0; i < orders; ++i, power *= std::fabs(c)) varies += a[i].variation() * power;
  const double roundings = 1 + static_cast<double>(4 * orders + 4) * bounds::unit;
  for (std::size_t k = 0; k < orders; ++k) {
    const std::vector<double> weight = weights(k, std::fabs(c));
    for (std::size_t i = k; i < orders; ++i) most[k] += weight[i - k] * norms[i];
    most[k] *= roundings * bounds::up;
  }
  const double farthest = (d + around) * bounds::up;
  std::vector<double> cutOff(orders + 1, 0.0);  // of all from v_k on, over d^k
  for (std::size_t k = orders; k-- > 0;) cutOff[k] = (most[k] + d * cutOff[k + 1]) * bounds::up;
  std::size_t K = 0;
  double toK = 1;
  while (K < orders && (K == 0 || toK * cutOff[K] > little * varies)) ++K, toK = toK * d * bounds::up;
  double moved = 0;  // by `around`
  if (around > 0)
    for (std::size_t k = orders; k-- > 1;) moved = (moved * farthest + static_cast<double>(k) * most[k]) * bounds::up;
  BoundedPolynomial result;
  for (std::size_t k = K; k-- > 0;) {
    BoundedPolynomial v;
    const std::vector<double> weight = weights(k, c);
    for (std::size_t i = k; i < orders; ++i) {
      if (v.c.size() < a[i].c.size()) v.c.resize(a[i].c.size(), 0.0);
      for (std::size_t g = 0; g < a[i].c.size(); ++g) v.c[g] += weight[i - k] * a[i].c[g];
      v.error += std::fabs(weight[i - k]) * a[i].error;
    }
    v.error = (v.error * roundings + static_cast<double>(4 * orders + 4) * bounds::unit * most[k]) * bounds::up;
    if (!result.c.empty()) result = product(monomials, result, beside);
    result += v;
  }
  result.error = (result.error + (K < orders ? toK * cutOff[K] : 0.0) + around * moved) * bounds::up + bounds::tiny;
  return result;
}

/// By parts: between two moments a polynomial is no farther from the hull of what it is at both than an eighth of its
/// second derivative times their distance squared. A sum of orders and monomials has two roundings a term.
Interval rangeOver(const std::vector<BoundedPolynomial>& u, double from, double to) {
  constexpr int parts = 8;
  const double farthest = std::max(std::fabs(from), std::fabs(to));
  double size = 0, second = 0, error = 0, power = 1, powerOfSecond = 1;
  std::size_t terms = 0;
  for (std::size_t order = 0; order < u.size(); ++order, power *= farthest) {
    const double norm = BoundedPolynomial{u[order].c}.norm();
    size += norm * power;
    error += u[order].error * power;
    terms = std::max(terms, u[order].c.size());
    if (order < 2) continue;
    second += static_cast<double>(order * (order - 1)) * norm * powerOfSecond;
    powerOfSecond *= farthest;
  }
  error += static_cast<double>(2 * u.size() + terms + 2) * bounds::unit * size;
  const auto at = [&](double sigma) {
    double leading = 0, others = 0;
    for (std::size_t g = 0; g < terms; ++g) {
      double sum = 0;
      for (auto of = u.rbegin(); of != u.rend(); ++of) sum = sum * sigma + (g < of->c.size() ? of->c[g] : 0.0);
      (g == 0 ? leading : others) += g == 0 ? sum : std::fabs(sum);
    }
    return inflated(Interval(leading), (others + error) * bounds::up + bounds::tiny);
  };
  Interval before = at(from), result = before;
  double begin = from;
  for (int part = 1; part <= parts && to > from; ++part) {
    const double end = part == parts ? to : from + (to - from) * part / parts, length = (end - begin) * bounds::up;
    const Interval then = at(end);
    result = hull(result, inflated(hull(before, then), 0.125 * second * length * length * bounds::up + bounds::tiny));
    before = then;
    begin = end;
  }
  return result;
}

std::vector<BoundedPolynomial> ordersOf(const PolynomialSeries& series, int node, std::size_t orders) {
  std::vector<BoundedPolynomial> result(orders);
  for (std::size_t order = 0; order < orders; ++order)
    for (int g = 0; g < series.count(node); ++g)
      result[order].c.push_back(series.series(node)[at(g * series.stride()) + order]);
  return result;
}

std::vector<BoundedPolynomial> rateOf(const std::vector<BoundedPolynomial>& u, double h0) {
  std::vector<BoundedPolynomial> rates(u.begin() + 1, u.end());
  for (std::size_t order = 0; order < rates.size(); ++order) rates[order] *= static_cast<double>(order + 1) / h0;
  return rates;
}

PolynomialRoot rootOf(const Monomials& monomials, const std::vector<BoundedPolynomial>& u, double about) {
  double middle = about, slope = 0;
  for (int round = 0; round < 4; ++round) {
    double value = 0;
    slope = 0;
    for (std::size_t order = u.size(); order-- > 0;) {
      slope = slope * middle + value;
      value = value * middle + u[order].c[0];
    }
    middle -= value / slope;
  }
  PolynomialRoot result{{std::vector<double>(monomials.count(), 0.0)}, 0, slope};
  BoundedPolynomial next{result.x};
  next.c[0] = middle;
  constexpr int rounds = 12;
  for (int round = 0; round < rounds; ++round) {
    BoundedPolynomial left = composed(monomials, u, next);
    if (round > 0 && !(left.norm() < 0.5 * result.rest)) break;  // as good as it comes
    result.rest = left.norm();
    result.x = next;
    left.error = 0;
    next += (left *= -1 / slope);
    next.error = 0;
  }
  return result;
}

}  // namespace gamut
