// Sums and products in round-to-nearest, and what they miss.
#include "analyses/flow/bounded_polynomial.hpp"

#include <algorithm>
#include <cmath>

#include "analyses/flow/error_bounds.hpp"
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

/// A coefficient of N products has 2N roundings at most. Dropped are the products whose grades add up to more than the
/// degree.
BoundedPolynomial product(const Monomials& monomials, const BoundedPolynomial& a, const BoundedPolynomial& b) {
  BoundedPolynomial result{std::vector<double>(at(monomials.count()), 0.0)};
  const auto of = [](const BoundedPolynomial& x, int g) { return at(g) < x.c.size() ? x.c[at(g)] : 0.0; };
  double rounding = 0, dropped = 0;
  for (int g = 0; g < monomials.count(); ++g) {
    double sum = 0, size = 0;
    for (auto q = monomials.first()[at(g)]; q < monomials.first()[at(g) + 1]; ++q) {
      const auto [left, right] = monomials.pairs()[at(q)];
      const double term = of(a, left) * of(b, right);
      sum += term;
      size += std::fabs(term);
    }
    result.c[at(g)] = sum;
    rounding += 2 * monomials.multiplicity(g) * bounds::unit * size;
  }
  std::vector<double> gradesOfA(at(monomials.degree()) + 1, 0.0), gradesOfB = gradesOfA;
  for (std::size_t g = 0; g < a.c.size(); ++g) gradesOfA[at(monomials.grade(static_cast<int>(g)))] += std::fabs(a.c[g]);
  for (std::size_t g = 0; g < b.c.size(); ++g) gradesOfB[at(monomials.grade(static_cast<int>(g)))] += std::fabs(b.c[g]);
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

}  // namespace gamut
