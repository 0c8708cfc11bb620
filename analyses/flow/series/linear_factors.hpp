// A square matrix of doubles factorised once for many right-hand sides: sparse Gaussian elimination that takes pivots
// by how little they fill in (H. Markowitz 1957) among those that are not small for their column. Plain floating point;
// what a solution misses is measured.
#pragma once

#include <vector>

#include "scalars/index.hpp"

namespace gamut {

class LinearFactors {
 public:
  explicit LinearFactors(int size);

  /// `a` row by row. After a singular matrix, or one that is not finite, every solution holds NaN.
  void factorise(const double* a);

  /// x becomes about A⁻¹ x; |x before - A x after| is added to `residual`, but for the rounding of this evaluation: at
  /// most T + 1 roundings of Σ|A||x| and of |x before| in a row of T entries.
  void solve(double* x, double* residual) const;

  /// C, about A⁻¹, row by row.
  const std::vector<double>& inverse() const { return inverse_; }
  /// |A|‖x‖ in a row of A.
  double size(int row, const double* norms) const;

 private:
  struct Term {
    int index;
    double value;
  };
  /// Rows of terms, one after another.
  struct Rows {
    std::vector<Term> terms;
    std::vector<int> first{0};

    void add(int index, double value) { terms.push_back({index, value}); }
    void endRow() { first.push_back(static_cast<int>(terms.size())); }
    const Term* begin(int row) const { return terms.data() + first[row]; }
    const Term* end(int row) const { return terms.data() + first[detail::at(row) + 1]; }
  };
  void eliminate(std::vector<double> a);
  void substitute(double* x) const;
  void subtract(const double* right, const double* x, double* missing) const;

  int n_;
  Rows a_, lower_, upper_;  // lower: what is taken from other rows in a step; upper: a pivot's row without the pivot
  std::vector<int> row_, column_;  // of the pivots
  std::vector<double> pivot_, inverse_;
  mutable std::vector<double> right_, missing_, work_;
};

}  // namespace gamut
