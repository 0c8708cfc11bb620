// The range of a polynomial in ξ over a box inside [-1,1]^k: a proved enclosure, and nearly the range itself.
#pragma once

#include <memory>
#include <vector>

#include "analyses/flow/series/monomials.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// Holds the tables and the workspace for one set of monomials; one a thread.
class PolynomialRange {
 public:
  explicit PolynomialRange(std::shared_ptr<const Monomials> monomials);

  /// Encloses { Σ c_g ξ^g : ξ in box }. c: one coefficient a monomial. box: one interval inside [-1,1] a symbol.
  /// The result is wider than the range by at most about `tolerance` (relative) where bisection can achieve that.
  Interval operator()(const double* c, const Box& box, double tolerance = 1e-4);
  /// By how much, about, a bound of the last result may lie outside the range.
  double gap() const { return gap_; }
  /// A point of the box where the polynomial is about as small (great) as it becomes, and what it is there.
  struct Extreme {
    double value = 0;
    std::vector<double> xi;
  };
  const Extreme& least() const { return least_; }
  const Extreme& greatest() const { return greatest_; }

  /// Writes the coefficients of the polynomial in η, where ξ_l = middle + half·η, |middle| + half ≤ 1. Each coefficient
  /// is a sum of exact terms; all rounding together is at most `shiftError` times Σ|c|. With a `count`, c and out have
  /// so many coefficients: all up to some grade. Of `width` polynomials at once, [monomial][polynomial].
  void substitute(int symbol, double middle, double half, const double* c, double* out, int count = -1,
                  std::size_t width = 1) const;
  double shiftError() const { return shiftError_; }

 private:
  /// ξ = middle + half·η with η in [-1,1]^k; half is 0 of symbols that are at an end.
  struct Place {
    std::vector<double> middle, half;
  };
  /// The polynomial over a part of the box, that in η.
  struct Part {
    double bound;
    int depth;  // bisections above it
    std::vector<double> c;
    Place place;
  };
  double maximum(std::vector<double> c, Place place, double rounding, double tolerance, Extreme& extreme);
  double upperBound(const std::vector<double>& c) const;
  void findGreatest(const Part& part, Extreme& extreme) const;
  int mostNonlinear(const std::vector<double>& c) const;
  double nonlinear(int symbol, const std::vector<double>& c) const;
  void reduceMonotone(std::vector<double>& c, Place& place) const;

  std::shared_ptr<const Monomials> monomials_;
  std::vector<std::vector<int>> down_;     // [symbol][g]: g / ξ_symbol, or -1
  std::vector<std::vector<int>> axis_;     // [symbol][i]: ξ_symbol^(i+1)
  std::vector<std::vector<double>> bend_;  // [symbol][g]: the exponent of ξ_symbol, and 0 of ξ_symbol itself
  std::vector<std::vector<double>> binomial_;
  std::vector<char> even_;
  double shiftError_, gap_ = 0;
  Extreme least_, greatest_;
  std::vector<Part> parts_;  // a heap by bounds
};

}  // namespace gamut
