// How much an error of a linear system's right-hand side may become in its solution.
#pragma once

#include <vector>

namespace gamut {

/// Y ≥ (I - H)⁻¹ C for nonnegative matrices H and C: the errors of x where (I - H) |x| ≤ C r.
class Amplifier {
 public:
  /// H, row by row, for whoever fills it in before `bound`.
  double* matrix(int size);
  /// False if it is not proved that I - H is an M-matrix, or an entry is too large.
  bool bound(const std::vector<double>& C);
  double operator()(int i, int j) const { return Y_[i * n_ + j]; }

 private:
  double contraction(const std::vector<double>& C);

  int n_ = 0;
  std::vector<double> H_, Y_, next_, w_, v_, Hv_;
};

}  // namespace gamut
