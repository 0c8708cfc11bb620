// Polynomials in ξ with a bound of what they leave out, for the few places where one is put into another.
#pragma once

#include <vector>

#include "analyses/flow/series/monomials.hpp"
#include "scalars/interval.hpp"

namespace gamut {

class PolynomialSeries;

/// Σ_g c_g ξ^g ± error for ξ in [-1,1]^k; of all monomials, or of the first ones.
struct BoundedPolynomial {
  std::vector<double> c;
  double error = 0;

  /// Σ_g |c_g|, without what belongs to 1: rounded up.
  double variation() const;
  double norm() const;  ///< of all, and the error

  BoundedPolynomial& operator+=(const BoundedPolynomial& other);
  BoundedPolynomial& operator*=(double factor);
};

/// For ξ in [-1,1]^k: squares are none below zero.
Interval rangeOf(const Monomials& monomials, const BoundedPolynomial& a);

/// a b, of all monomials; of what these do not hold, the bound.
BoundedPolynomial product(const Monomials& monomials, const BoundedPolynomial& a, const BoundedPolynomial& b);

/// Σ_i a_i x^i.
BoundedPolynomial composed(const Monomials& monomials, const std::vector<BoundedPolynomial>& a,
                           const BoundedPolynomial& x);

/// Σ_i a_i s^i of whichever s is within `around` of x: by as many powers of what x varies by as leave over no more than
/// `little` of what the sum varies by.
BoundedPolynomial composedNear(const Monomials& monomials, const std::vector<BoundedPolynomial>& a,
                               const BoundedPolynomial& x, double around, double little);

/// Σ_i u_i σ^i for all σ from `from` to `to`, of one sign or zero.
Interval rangeOver(const std::vector<BoundedPolynomial>& u, double from, double to);

/// The first orders of σ of a node of the series: without what they leave out.
std::vector<BoundedPolynomial> ordersOf(const PolynomialSeries& series, int node, std::size_t orders);
/// Per second, of what is given by orders of σ, whose unit is h0 seconds.
std::vector<BoundedPolynomial> rateOf(const std::vector<BoundedPolynomial>& u, double h0);

/// x such that |Σ_i u_i x^i| ≤ rest, by Newton's method from the number `about`; x has no error of its own.
struct PolynomialRoot {
  BoundedPolynomial x;
  double rest = 0, slope = 0;  ///< slope: of what is constant in u, there
};
PolynomialRoot rootOf(const Monomials& monomials, const std::vector<BoundedPolynomial>& u, double about);

}  // namespace gamut
