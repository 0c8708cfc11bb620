// Linear systems M x = r in every scalar: one interface for numbers, which are factorised once for all right-hand
// sides, and for Recorded, which writes the systems down as wholes (Op::solution).
//
//     LinearSystem<S> system(MatrixKind::positiveDefinite, 2, {4.0, 1.0, 1.0, 3.0});  // row by row
//     std::vector<S> x{1.0, 2.0};
//     system.solve(x);  // the right-hand side becomes the solution
#pragma once

#include <span>
#include <vector>

#include "scalars/program.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

/// The systems of one matrix. The general template is for numbers that can be compared by size.
template <class S>
class LinearSystem;

/// Parts that no known non-zero entry connects are systems of their own; one or two equations are written out by
/// Cramer's rule, more become a solution of the recorded program.
template <>
class LinearSystem<Recorded> {
 public:
  /// `entries` row by row; of a positive definite matrix those on and below the diagonal are read.
  LinearSystem(MatrixKind kind, int size, std::vector<Recorded> entries);

  /// x has the right-hand side's `size` numbers and becomes the solution of M x = r, or of Mᵀ x = r.
  void solve(std::span<Recorded> x, bool transposed = false) const;

 private:
  struct Part {
    std::vector<int> rows;
    int matrix = -1;   // in the recorder, of three equations or more
    Recorded inverse;  // of the determinant, of fewer
  };
  const Recorded& entry(int i, int j) const { return entries_[detail::at(i * size_ + j)]; }
  Part part(std::vector<int> rows) const;

  MatrixKind kind_;
  int size_;
  std::vector<Recorded> entries_;
  std::vector<Part> parts_;
};

}  // namespace gamut
